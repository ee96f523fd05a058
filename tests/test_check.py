"""One column from its scans to its report: what only the whole way shows."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import ColumnDesign, ControlPoint, GroupReport, Scan, Verdict
from aadm_workbench.scan.read import read_scan
from aadm_workbench.twin.parts import BarGroup
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot
from aadm_workbench.twin.truth import sample_design
from tests.scenes import lab_bars, lab_scan

CORNERS = (0, 3, 6, 9)


def up_to(group: BarGroup, heights_mm: list[float]) -> BarGroup:
    """The bars with their tops at some heights over the usual level, standing as designed otherwise."""
    bars = [replace(bar, top=height) for bar, height in zip(group.bars, heights_mm, strict=True)]
    return replace(group, bars=tuple(bars))


@pytest.fixture(scope="module")
def long_bars() -> TrueScan:
    """Bars whose tops stand 5 mm above the design's level, but for one that stands 14 mm above it."""
    return lab_scan(up_to(lab_bars(), [5.0] * 4 + [14.0] + [5.0] * 7))


def exposed_rule(design: ColumnDesign, truth: TrueScan) -> tuple[Verdict, str]:
    settings = CheckSettings(load_profile("cn-gb50204-2015"), checks=("rebars",))
    report = check_column(design, ColumnScans(rebars=(truth.scan(),), rebars_up_deg=90.0), settings)
    assert report.rebars is not None
    found = next(rule for rule in report.rebars.rules if rule.rule == "rebar_exposed_length")
    return found.verdict, found.reason


def test_a_bar_that_sticks_out_14_mm_too_far_fails_the_limit_of_10(long_bars: TrueScan) -> None:
    design = replace(sample_design(LAB), exposed_length_mm=LAB.exposed)
    verdict, reason = exposed_rule(design, long_bars)
    assert verdict is Verdict.FAIL
    assert reason.startswith("R5 sticks out 134.")
    assert reason.count("sticks out") == 1


def test_a_design_that_asks_for_more_finds_all_others_too_short(long_bars: TrueScan) -> None:
    verdict, reason = exposed_rule(replace(sample_design(LAB), exposed_length_mm=LAB.exposed + 8.0), long_bars)
    assert verdict is Verdict.FAIL
    assert reason.count("sticks out") == 11
    assert "R5 " not in reason


def test_without_an_exposed_length_in_the_design_nothing_is_said_of_it(long_bars: TrueScan) -> None:
    assert exposed_rule(sample_design(LAB), long_bars)[0] is Verdict.NOT_ASSESSED


def test_a_column_with_thicker_bars_at_its_corners_goes_on() -> None:
    """Sleeves of 26 and 34 mm, bars of 18 and 25: each pair with the room that is its own."""
    foot, group = (draw(LAB, np.random.default_rng(40), 0.2) for draw in (random_foot, random_bars))
    wide = tuple(replace(s, diameter=s.diameter + 8.0) if k in CORNERS else s for k, s in enumerate(foot.sleeves))
    thick = tuple(replace(b, core_diameter=24.5) if k in CORNERS else b for k, b in enumerate(group.bars))
    plain = sample_design(LAB)
    design = replace(
        plain,
        sleeves=tuple(replace(p, diameter_mm=34.0) if k in CORNERS else p for k, p in enumerate(plain.sleeves)),
        rebars=tuple(replace(p, diameter_mm=25.0) if k in CORNERS else p for k, p in enumerate(plain.rebars)),
    )
    scans = ColumnScans(
        (lab_scan(replace(foot, sleeves=wide)).scan("foot"),),
        (lab_scan(replace(group, bars=thick)).scan("bars"),),
        sleeves_up_deg=90.0,
        rebars_up_deg=90.0,
    )
    report = check_column(design, scans, CheckSettings(load_profile("cn")))
    assert report.sleeves is not None
    assert report.rebars is not None
    assert (report.sleeves.found, report.rebars.found) == (12, 12)
    # 25 mm bars leave 2.3 mm over their ribs: by value there is room for all, with each its own.
    assert report.trial_assembly is not None
    assert report.trial_assembly.margin is not None
    assert report.trial_assembly.margin > 0.2
    assert report.trial_assembly.collisions == ()
    assert report.goes_on in (Verdict.PASS, Verdict.INCONCLUSIVE)
    diameters = [point.diameter_mm for point in report.sleeves.points]
    assert diameters == pytest.approx([34.0 if k in CORNERS else 26.0 for k in range(12)], abs=0.5)


def of_the_bars(scan: Scan, control_points: tuple[ControlPoint, ...] = ()) -> GroupReport:
    design = replace(sample_design(LAB), exposed_length_mm=LAB.exposed)
    settings = CheckSettings(load_profile("cn-gb50204-2015"), checks=("rebars",))
    scans = ColumnScans(rebars=(scan,), rebars_up_deg=90.0, control_points=control_points)
    report = check_column(design, scans, settings).rebars
    assert report is not None
    return report


def test_a_cloud_in_the_axes_of_opengl_is_the_same_bars_with_the_same_labels(
    long_bars: TrueScan, tmp_path: Path
) -> None:
    flat = long_bars.scan().points.reshape(-1, 3)
    flat = flat[np.isfinite(flat).all(axis=1)]
    known = [(name, float(x), float(y), 900.0) for name, x, y in (("A", -80, 60), ("B", 90, 70), ("C", 10, -95))]
    reports = {}
    for axes, signs in (("camera", (1.0, 1.0)), ("opengl", (-1.0, -1.0))):
        turned = flat * np.array([1.0, *signs])
        np.savez(tmp_path / f"{axes}.npz", points=turned)
        scan = read_scan(tmp_path / f"{axes}.npz")
        plain = of_the_bars(scan)
        assert plain.fit is not None
        T = plain.fit.T_design_scan
        control = []
        for name, x, y, z in known:
            place = np.array([x, signs[0] * y, signs[1] * z])
            in_column = (T[:3, :3] @ place + T[:3, 3]).tolist()
            control.append(ControlPoint(name, tuple(in_column), tuple(place.tolist()), in_model=False))
        reports[axes] = of_the_bars(scan, tuple(control))
    camera, opengl = reports["camera"], reports["opengl"]
    assert [rule.reason for rule in opengl.rules] == [rule.reason for rule in camera.rules]
    assert any(rule.reason.startswith("R5 sticks out") for rule in opengl.rules)
    assert any("OpenGL's axes" in note for note in opengl.notes)
    assert opengl.fit is not None
    for one, other in zip(camera.points, opengl.points, strict=True):
        assert one.scan_mm is not None
        assert other.scan_mm is not None
        assert other.offset_mm == pytest.approx(one.offset_mm, abs=0.01)
        x, y, z = one.scan_mm
        assert other.scan_mm == pytest.approx((x, -y, -z), abs=0.01)
        placed = opengl.fit.T_design_scan @ [*other.scan_mm, 1.0]
        assert other.aligned_mm == pytest.approx(placed[:3].tolist(), abs=1e-6)
    assert camera.absolute is not None
    assert opengl.absolute is not None
    assert camera.absolute.deviation_mm == pytest.approx(0.0, abs=0.2)
    assert opengl.absolute.deviation_mm == pytest.approx(0.0, abs=0.2)
    assert opengl.absolute.control_points[0].scan_mm == pytest.approx((-80.0, -60.0, -900.0))


def test_axes_that_nobody_knows_are_noted_where_a_job_says_what_is_at_the_top(long_bars: TrueScan) -> None:
    scan = replace(long_bars.scan(), axes="")
    assert any('write axes = "opengl" where it is +y' in note for note in of_the_bars(scan).notes)
    assert not any("axes" in note for note in of_the_bars(replace(scan, axes="camera")).notes)
