"""What captures of a plate tell of a camera, against a camera that was made up, and what jobs do with it."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.calibration.learn.capture import PlateCapture
from aadm_workbench.calibration.learn.stretch import Stretches, stretches_of
from aadm_workbench.calibration.learn.verify import append_log, verified, write_control_chart
from aadm_workbench.calibration.plate.plate import Plate, drawn_plate
from aadm_workbench.errors import CameraError, JobError, ReportError
from aadm_workbench.extract.edges.learned_edges import EDGE_LAWS, with_learned_stretch
from aadm_workbench.inspection.learned import named_profile, notes_on_profile
from aadm_workbench.model import (
    AssemblyPoint,
    Camera,
    CameraProfile,
    Extraction,
    Kind,
    LearnedEdges,
    Measure,
    Plane,
    Scan,
    Verdict,
    codes_of,
)
from aadm_workbench.scan.camera_profile import profile_text, read_profile
from batch.job.file import read_job

CAMERA = Camera(2400.0, 2400.0, 960.0, 600.0, 1920, 1200)
STRETCH = {Kind.SLEEVE: -9e-4, Kind.REBAR: 7e-4}
SCATTER_MM = {Kind.SLEEVE: 0.03, Kind.REBAR: 0.06}
U_MM = 0.01
PITCH_MM = 1300.0 / CAMERA.fx
SPREAD = {Kind.SLEEVE: 4e-5, Kind.REBAR: 1.4e-4}  # scatter over the root of the sum of squared distances


@pytest.fixture(scope="module")
def plate() -> Plate:
    drawn = drawn_plate(12, 36.0, 160.0, 20.0)
    return replace(drawn, places=tuple(replace(one, u_mm=U_MM) for one in drawn.places))


def captures(plate: Plate, rng: np.random.Generator, count: int = 8, more: float = 0.0) -> list[PlateCapture]:
    """Made up with complex numbers: true places off by their u, turned, moved, stretched about the foot point."""
    true = np.array([one.x_mm + 1j * one.y_mm for one in plate.places])
    true = true + rng.normal(0.0, U_MM, len(true)) + 1j * rng.normal(0.0, U_MM, len(true))
    stretch = np.array([1.0 + STRETCH[one.kind] + more for one in plate.places])
    sigma = np.array([SCATTER_MM[one.kind] for one in plate.places])
    found = []
    for number in range(count):
        turn = np.exp(1j * np.radians(90.0 * number + rng.uniform(-3.0, 3.0)))
        seen = stretch * (turn * true + complex(*rng.uniform(-80.0, 80.0, 2)))
        seen = seen + sigma * (rng.normal(size=len(true)) + 1j * rng.normal(size=len(true)))
        flat = np.column_stack([seen.real, seen.imag])
        scan, face = Scan(np.zeros((1, 1, 3))), Plane(np.array([0.0, 0.0, -1.0]), -1300.0)
        heights = np.array([one.z_mm for one in plate.places])
        place = np.arange(len(true))
        sizes = np.array([one.diameter_mm for one in plate.places])
        found.append(PlateCapture(f"{number}", scan, CAMERA, face, flat, heights, place, np.eye(4), sizes))
    return found


@pytest.fixture(scope="module")
def learned(plate: Plate) -> list[Stretches]:
    return [stretches_of(captures(plate, np.random.default_rng(seed)), plate) for seed in range(5)]


def test_the_stretch_of_each_kind_is_learned_within_its_uncertainty(learned: list[Stretches]) -> None:
    for kind in Kind:
        off = [(one.mean[kind].value - STRETCH[kind]) / one.mean[kind].u for one in learned]
        assert np.abs(off).max() < 3.5
        assert np.sqrt(np.mean(np.square(off))) < 1.7, "u is too small"
        assert max(one.mean[kind].u for one in learned) < 1e-4


def test_the_scatter_of_centres_is_learned(learned: list[Stretches]) -> None:
    for kind in Kind:
        assert np.mean([one.scatter_mm[kind] for one in learned]) == pytest.approx(SCATTER_MM[kind], rel=0.15)


def profile() -> CameraProfile:
    edges = {
        kind: LearnedEdges(
            Measure(STRETCH[kind], 2e-5),
            SPREAD[kind],
            SCATTER_MM[kind] / PITCH_MM,
            Measure(0.0, 1e-4),
            ((-0.1, 1.5), (0.1, 0.0)),
            0.75,
            0.125,
        )
        for kind in Kind
    }
    ends = ((1300.0, 1450.0), (0.5, 4.6))
    known = Measure(5e-4, 3e-5)
    return CameraProfile("", "", "42", "indoor", "2026-11-01", 90, CAMERA, *ends, known, edges, "ab", 8, laws=EDGE_LAWS)


def test_a_profile_is_read_as_it_was_written(tmp_path: Path) -> None:
    path = tmp_path / "camera.toml"
    path.write_text(profile_text(profile()))
    read = read_profile(path, "camera.toml")
    assert replace(read, source="", sha256="", camera=CAMERA) == replace(profile(), edges=read.edges)
    for name in ("stretch", "lost", "share", "apart_pitches"):
        assert getattr(read.edges[Kind.SLEEVE], name) == getattr(profile().edges[Kind.SLEEVE], name)
    assert len(read.sha256) == 64
    path.write_text(profile_text(profile()).replace(f"laws = {EDGE_LAWS}\n", ""))
    assert read_profile(path).laws == 0, "a file of before laws had a number"
    path.write_text(profile_text(profile()).replace("scale = [0.0005", "scale = [0.5"))
    with pytest.raises(CameraError, match="aadm camera learn"):
        read_profile(path)


def test_what_was_learned_is_taken_out_of_centres() -> None:
    true = np.array([[-240.0, -200.0, 1300.0], [240.0, -190.0, 1300.0], [10.0, 300.0, 1300.0]])
    normal = np.array([0.0, 0.0, -1.0])
    seen = true * [1.0 + STRETCH[Kind.SLEEVE], 1.0 + STRETCH[Kind.SLEEVE], 1.0]
    points = tuple(
        AssemblyPoint("", Kind.SLEEVE, centre, normal, 36.0, np.diag([0.2, 0.2, 0.02]) ** 2) for centre in seen
    )
    found = Extraction(Kind.SLEEVE, "refined", points, Plane(normal, -1300.0), normal)
    right = with_learned_stretch(found, profile())
    assert np.array([one.centre for one in right.points]) == pytest.approx(true, abs=1e-9)
    assert right.points[0].covariance == pytest.approx(points[0].covariance)
    assert with_learned_stretch(found, None) is found
    assert "learned_by_laws" not in right.quality
    assert with_learned_stretch(found, replace(profile(), laws=0)).quality["learned_by_laws"] == 0


def test_a_capture_of_the_same_camera_passes_and_one_that_drifted_fails(plate: Plate, tmp_path: Path) -> None:
    (same,) = captures(plate, np.random.default_rng(40), 1)
    (drifted,) = captures(plate, np.random.default_rng(41), 1, more=6e-4)
    good, bad = verified(same, plate, profile()), verified(drifted, plate, profile())
    assert {one.verdict for one in good} == {Verdict.PASS}
    assert Verdict.FAIL in {one.verdict for one in bad if one.name.startswith("stretch")}
    log = tmp_path / "log.csv"
    append_log(log, "2026-11-02", "a.tiff", good)
    append_log(log, "2026-11-03", "<b>.tiff", bad)
    assert len(log.read_text().splitlines()) == 1 + len(good) + len(bad)
    write_control_chart(log, replace(profile(), serial="<script>"), tmp_path / "chart.html")
    chart = (tmp_path / "chart.html").read_text(encoding="utf-8")
    assert "<script>" not in chart
    assert chart.count("<svg") == len(good)
    log.write_text("something else\n")
    with pytest.raises(ReportError, match="no log"):
        append_log(log, "", "", good)


def test_a_profile_of_another_camera_is_noticed() -> None:
    told = {"camera_serial": "42", "settings": "indoor", "date": "2026-12-01"}
    assert notes_on_profile(profile(), None, told) == ()
    for key, value, code in (
        ("camera_serial", "43", "calibration.other_camera_serial"),
        ("settings", "outdoor", "calibration.other_settings"),
        ("date", "2027-03-01", "calibration.too_old"),
        ("date", "2026-10-01", "calibration.not_yet"),
        ("date", "", "calibration.age_unknown"),
        ("camera_serial", "", "calibration.no_camera_serial"),
    ):
        (note,) = notes_on_profile(profile(), None, told | {key: value})
        assert codes_of(note) == {code}
    (note,) = notes_on_profile(profile(), replace(CAMERA, fx=2500.0), told)
    assert codes_of(note) == {"calibration.other_intrinsics"}


def test_a_job_names_its_camera_profile(tmp_path: Path) -> None:
    (tmp_path / "camera.toml").write_text(profile_text(profile()))
    text = 'schema = 1\nmodel = { path = "a.ifc" }\n[camera]\nprofile = "camera.toml"\ndepth_scale_mm = 0.03\n'
    columns = '[[columns]]\nid = "A"\nsleeves = "a.tiff"\n'
    path = tmp_path / "job.toml"
    path.write_text(text + columns)
    job = read_job(path)
    assert job.camera is None
    assert job.camera_profile is not None
    assert job.camera_profile.serial == "42"
    named = named_profile(job.camera_profile)
    assert named == {"camera_profile": f"camera.toml sha256:{job.camera_profile.sha256}"}
    json.dumps(named)
    path.write_text(text.replace("camera.toml", "no.toml") + columns)
    with pytest.raises(JobError, match="line 4"):
        read_job(path)
