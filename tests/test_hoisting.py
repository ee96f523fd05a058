"""Alignment while a column hangs, held to the exact truth of the virtual camera."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.assembly.pose.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.model import ColumnDesign, HoistingMeasurement, Scan, Verdict
from aadm_workbench.twin.hoisting import HoistingScan
from aadm_workbench.twin.scenes import FIELD, LAB, Setting
from aadm_workbench.twin.study.hoisting import design_of
from tests import hoisting_scenes as scenes
from tests.scenes import as_cloud

SETTINGS = HoistingSettings(load_profile("cn"))
CASES = {"usual": (scenes.usual, LAB), "turned": (scenes.turned_and_aside, LAB), "field": (scenes.field, FIELD)}


def measured(truth: HoistingScan, setting: Setting, **more: object) -> HoistingMeasurement:
    return measure_hoisting(truth.frame.scan(), design_of(setting), near=scenes.NEAR, settings=SETTINGS, **more)  # type: ignore[arg-type]


@cache
def plain(case: str) -> HoistingMeasurement:
    """A frame measured with nothing but its design, once for all tests that look at it."""
    truth, setting = CASES[case]
    return measured(truth(), setting)


def lab_design(**changes: object) -> ColumnDesign:
    table: dict[str, object] = {
        "sleeve_diameter": 26.0,
        "rebar_diameter": 18.0,
        "size": [250.0, 250.0],
        "centres": LAB.centres().tolist(),
    }
    return inline_design("L-1", table | changes)


@pytest.mark.parametrize("case", CASES)
def test_every_seen_pair_is_measured_to_a_tenth_of_a_millimetre(case: str) -> None:
    truth = CASES[case][0]()
    found = plain(case)
    errors = scenes.distance_errors(found, truth)
    assert len(errors) >= 7
    assert errors.mean() < 0.15
    assert errors.max() < 0.45
    assert found.report.column_tilt_deg == pytest.approx(truth.tilt_deg, abs=0.3)


@pytest.mark.parametrize("case", CASES)
def test_uncertainties_cover_the_errors_of_seen_and_of_inferred_pairs(case: str) -> None:
    truth = CASES[case][0]()
    found = plain(case)
    off = scenes.offset_errors(found, truth)
    squared = np.einsum("ki,kij,kj->k", off, np.linalg.inv(found.covariances), off)
    assert (squared < 5.991).sum() >= len(off) - 1
    assert (squared < 18.4).all()  # one in ten thousand of chi-squared with two degrees of freedom
    inferred = [pair.u_mm for pair in found.report.pairs if not pair.seen]
    seen = [pair.u_mm for pair in found.report.pairs if pair.seen]
    assert min(inferred, default=1.0) > np.median(seen)
    assert all(pair.reason for pair in found.report.pairs if not pair.seen)


@pytest.mark.parametrize("case", CASES)
def test_the_correction_is_that_of_the_true_centres(case: str) -> None:
    truth = CASES[case][0]()
    move = plain(case).report.correction
    assert move is not None
    over = [k for k, pair in enumerate(truth.pairs) if pair.sleeve in move.over]
    places = np.array([truth.T_bars_scan[:3, :3] @ pair.sleeve_scan_mm for pair in truth.pairs])
    source = (places + truth.T_bars_scan[:3, 3] - truth.T_bars_column[:3, 3])[over, :2]
    target = source + np.array([truth.pairs[k].offset_mm for k in over])
    true = fit_minimax(source, target, np.full(len(over), 3.0))
    assert isinstance(true, MinimaxPose)
    turned_mm = 0.003 * float(np.hypot(*truth.T_bars_column[:2, 3]))  # the bars' frame turns with their scatter
    assert np.hypot(move.dx_mm - true.shift[0], move.dy_mm - true.shift[1]) < 0.3 + turned_mm
    # where a bar that is half hidden has a say, as surely as the frame says
    assert move.u_yaw_deg is not None
    assert move.yaw_deg == pytest.approx(np.degrees(true.yaw), abs=max(0.1, 2.5 * move.u_yaw_deg))


def test_the_correction_brings_the_column_to_its_bars() -> None:
    truth = scenes.turned_and_aside()
    found = plain("turned")
    move = found.report.correction
    assert move is not None
    assert found.report.verdict is Verdict.FAIL
    assert move.yaw_deg == pytest.approx(-40.0, abs=0.6)
    assert (move.left_mm or 9.0) < 2.5
    assert move.margin == pytest.approx(1.0 - (move.left_mm or 0.0) / 3.0)
    camera = move.camera
    assert camera is not None
    assert np.hypot(camera.right_mm, camera.away_mm) == pytest.approx(np.hypot(move.dx_mm, move.dy_mm), rel=1e-3)
    pose = truth.T_bars_scan[:3, :3]
    seen_move = np.array([move.dx_mm, move.dy_mm]) @ pose[:2]
    assert np.sign(seen_move[0]) == np.sign(camera.right_mm)


def test_half_of_the_mouths_under_tape() -> None:
    truth = scenes.taped()
    errors = scenes.distance_errors(measured(truth, LAB), truth)
    assert len(errors) >= 6
    assert errors.mean() < 0.30


def test_scans_from_before_hoisting_make_all_pairs_known() -> None:
    truth = scenes.usual()
    sleeves, rebars = scenes.before(truth.foot, 0.05, 0), scenes.before(truth.bars, 0.05, 1)
    alone = plain("usual")
    known = measured(truth, LAB, sleeves_before=sleeves, rebars_before=rebars)
    everything = scenes.distance_errors(known, truth, seen=False)
    assert not all(pair.seen for pair in alone.report.pairs)
    assert everything.mean() < 0.15
    assert everything.max() < scenes.distance_errors(alone, truth, seen=False).max()
    assert len(known.report.correction.over) == 12  # type: ignore[union-attr]


@pytest.mark.parametrize("kind", ["no camera", "cloud", "moved cloud", "portrait", "upside down"])
def test_any_faithful_scan_of_the_frame_will_do(kind: str) -> None:
    truth = scenes.usual()
    scan = truth.frame.scan()
    points = scan.points
    if kind == "no camera":
        scan = Scan(points)
    elif kind == "cloud":
        scan = Scan(points[np.isfinite(points[..., 2])])
    elif kind == "moved cloud":
        scan, _, _ = as_cloud(scan, 3, viewpoint=True)
    elif kind == "portrait":
        turned = np.rot90(points, 1)
        scan = Scan(np.stack([turned[..., 1], -turned[..., 0], turned[..., 2]], -1))
    else:
        scan = Scan(np.rot90(points, 2) * np.float32([-1.0, -1.0, 1.0]))
    found = measure_hoisting(scan, design_of(LAB), near=scenes.NEAR, settings=SETTINGS)
    errors = scenes.distance_errors(found, truth)
    assert len(errors) >= 6
    assert errors.mean() < 0.2


def test_bars_in_plain_sight_are_seen_and_the_keys_are_the_papers() -> None:
    report = plain("usual").report
    assert report.keys == ("S1", "S4", "S10")
    assert report.orientation == "declared"
    assert [pair.sleeve for pair in report.pairs] == [f"S{k}" for k in range(1, 13)]
    assert all(pair.rebar_seen for pair in report.pairs if pair.rebar in ("R1", "R2", "R3", "R4", "R10", "R11", "R12"))
    assert report.mean_mm == pytest.approx(
        np.mean([pair.distance_mm for pair in report.pairs if pair.sleeve in report.keys])
    )


def test_without_near_a_square_pattern_is_ambiguous_and_says_so() -> None:
    truth = scenes.usual()
    found = measure_hoisting(truth.frame.scan(), design_of(LAB), near=None, settings=SETTINGS)
    assert found.report.orientation == "ambiguous"
    by_size = sorted(pair.distance_mm or 0.0 for pair in found.report.pairs if pair.seen)
    declared = sorted(pair.distance_mm or 0.0 for pair in plain("usual").report.pairs if pair.seen)
    assert by_size == pytest.approx(declared, abs=0.1)


def test_the_same_frame_gives_the_same_numbers() -> None:
    assert measured(scenes.usual(), LAB).report == plain("usual").report


def spoilt(kind: str) -> Scan:
    scan = scenes.usual().frame.scan()
    points = scan.points.copy()
    if kind == "empty":
        points[:] = np.nan
    elif kind == "half a column":
        points[:, :960] = np.nan
    elif kind == "no bars":
        points[640:] = np.nan
    elif kind == "no column":
        points[:620] = np.nan
    elif kind == "metres":
        points /= 1000.0
    return replace(scan, points=points)


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("empty", "0 points"),
        ("half a column", "sleeves are in what the frame shows"),
        ("no bars", "no bar of 18 mm"),
        ("no column", "no foot of a column"),
        ("metres", 'units = "m"'),
    ],
)
def test_a_bad_frame_is_not_measured_and_says_why(kind: str, reason: str) -> None:
    found = measure_hoisting(spoilt(kind), design_of(LAB), near=scenes.NEAR, settings=SETTINGS)
    assert found.report.verdict is Verdict.NOT_MEASURED
    assert reason in found.report.reasons[0]


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"centres": [[x, y] for x in (-90.0, 0.0, 90.0) for y in (-90.0, 0.0, 90.0) if x or y]}, "another column"),
        ({"centres": (LAB.centres() * 75.0 / 90.0).tolist()}, "another column"),
        ({"rebar_diameter": 14.0}, "another column"),
        ({"sleeve_diameter": 34.0}, "another column"),
    ],
)
def test_another_columns_bars_or_foot_are_not_measured(changes: dict[str, object], reason: str) -> None:
    found = measure_hoisting(scenes.usual().frame.scan(), lab_design(**changes), near=scenes.NEAR, settings=SETTINGS)
    assert found.report.verdict is Verdict.NOT_MEASURED
    assert reason in found.report.reasons[0]
