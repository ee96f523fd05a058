"""Feet and bars as sites leave them, cameras as they are set, jobs as they slip: noticed and never falsely certain."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import ColumnReport, GroupReport, Kind, Verdict
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.filters import NO_FILTERS, Filters, filtered
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot, random_pose
from aadm_workbench.twin.site import left_by_site
from aadm_workbench.twin.slips import NO_SLIP, SLIPS, Slip, seen_with, told_scan
from aadm_workbench.twin.truth import sample_design
from tests.extract.hard_scenes import SEEN_DEPTH_MM, WARP_PERIOD, window

SETTINGS = CheckSettings(load_profile("cn"))
DECIDED = (Verdict.PASS, Verdict.FAIL)


@cache
def built(site: tuple[str, ...] = ()) -> tuple[Foot, BarGroup]:
    rng = np.random.default_rng(61)
    foot, bars = random_foot(LAB, rng, 0.3), random_bars(LAB, rng, 0.3)
    foot = replace(foot, sleeves=tuple(replace(sleeve, depth=SEEN_DEPTH_MM) for sleeve in foot.sleeves))
    return left_by_site(site, foot, bars, rng)


@cache
def shot(kind: Kind, site: tuple[str, ...] = ()) -> TrueScan:
    """Rendered once; a site that changes the other part alone gives the same scan again."""
    part = built(site)[0 if kind is Kind.SLEEVE else 1]
    if site and part == built()[0 if kind is Kind.SLEEVE else 1]:
        return shot(kind)
    rng = np.random.default_rng([62, list(Kind).index(kind)])
    pose = random_pose(LAB, kind is Kind.SLEEVE, rng)
    noise = CameraNoise(scale=0.0, warp_period=WARP_PERIOD)
    return scan_of(part, pose, noise, rng, window(PRO_M, pose, LAB.half_width + 34.0))


def checked(site: tuple[str, ...] = (), filters: Filters = NO_FILTERS, slip: Slip = NO_SLIP) -> ColumnReport:
    scans = []
    for kind in Kind:
        scan, rng = shot(kind, site), np.random.default_rng(63)
        scan = replace(scan, depth=filtered(scan.depth, filters))
        scans.append(told_scan(seen_with(scan, slip, rng, is_foot=kind is Kind.SLEEVE), slip).scan(kind.plural))
    return check_column(sample_design(LAB), ColumnScans((scans[0],), (scans[1],), 90.0, 90.0), SETTINGS)


def group(report: ColumnReport, kind: Kind) -> GroupReport:
    found = report.sleeves if kind is Kind.SLEEVE else report.rebars
    assert found is not None
    return found


def misses_mm(report: ColumnReport, kind: Kind, site: tuple[str, ...] = ()) -> dict[str, float]:
    """How far each measured point is from the true one of its label, in the plane."""
    truth = shot(kind, site)
    true = {point.label: place for point, place in zip(truth.points, truth.points_scan(), strict=True)}
    across = truth.T_column_scan[:2, :3]
    return {
        point.label: float(np.hypot(*(across @ (np.array(point.scan_mm) - true[point.label]))))
        for point in group(report, kind).points
        if point.scan_mm is not None
    }


def codes(report: ColumnReport) -> set[str]:
    return {finding.code for finding in report.findings}


def test_a_sound_scan_shows_no_filter_and_no_slip() -> None:
    assert codes(checked()) == set()


@pytest.mark.parametrize(
    ("filters", "code", "word"),
    [
        (Filters(gaps=5), "gaps_filled", "hole filling"),
        (Filters(gaps=15), "gaps_filled", "hole filling"),
        (Filters(gaussian=0.8), "smoothed", "spatial filter"),
        (Filters(gaussian=2.5), "smoothed", "surface smoothing"),
        (Filters(median=5), "smoothed", "median"),
    ],
)
def test_filters_are_named_and_nothing_is_measured_under_them(filters: Filters, code: str, word: str) -> None:
    report = checked(filters=filters)
    assert codes(report) == {code}
    assert word in report.reasons[0]
    assert report.verdict is Verdict.NOT_MEASURED
    bars = group(report, Kind.REBAR)
    assert {point.verdict for point in bars.points} == {Verdict.NOT_MEASURED}


@pytest.mark.parametrize(
    ("slip", "word"),
    [
        (SLIPS["focal-2-percent"], "focal length"),
        (Slip(focal=0.5), "2 times what the job says"),
        (Slip(lengths=10.0), "divided by 10"),
        (Slip(lengths=0.1), "divided by 0.1"),
    ],
)
def test_wrong_lengths_are_named_and_decide_nothing(slip: Slip, word: str) -> None:
    report = checked(slip=slip)
    assert "scale_differs" in codes(report)
    assert word in report.reasons[0]
    assert report.verdict not in DECIDED
    assert report.goes_on not in DECIDED
    for kind in Kind:
        said = [*group(report, kind).points, *group(report, kind).spacing]
        assert {one.verdict for one in said} == {Verdict.NOT_MEASURED}


def test_a_wrong_principal_point_leans_all_to_one_side_and_moves_nothing_in_its_plane() -> None:
    report = checked(slip=Slip(principal_px=(-70.0, 40.0)))
    (finding,) = report.findings
    assert (finding.code, finding.about) == ("common_lean", ("sleeves", "rebars"))
    assert "principal point" in finding.text
    # 80.6 pixels of 2425 are 1.9 degrees
    assert finding.values["sleeves_deg"] == pytest.approx(1.9, abs=0.3)
    assert report.verdict is not Verdict.PASS


@pytest.mark.parametrize("name", ["outliers", "no-floor"])
def test_bars_are_found_among_outliers_and_without_a_floor(name: str) -> None:
    off = misses_mm(checked(slip=SLIPS[name]), Kind.REBAR)
    assert len(off) == len(built()[1].bars)
    assert max(off.values()) < 0.4


@pytest.mark.parametrize("site", ["rough", "keyed", "proud-rings"])
def test_feet_that_are_no_plane_are_measured_and_have_no_ghosts(site: str) -> None:
    report = checked((site,))
    off = misses_mm(report, Kind.SLEEVE, (site,))
    assert len(off) >= 11
    assert max(off.values()) < 0.6
    assert not any("belong" in note for note in group(report, Kind.SLEEVE).notes)


def test_a_spall_beside_a_taped_mouth_is_no_mouth() -> None:
    site = ("taped-spalls",)
    taped = {f"S{k}" for k, sleeve in enumerate(built(site)[0].sleeves, 1) if sleeve.taped}
    off = misses_mm(checked(site), Kind.SLEEVE, site)
    assert taped
    assert set(off).isdisjoint(taped)
    assert max(off.values()) < 0.4


def test_plugs_ten_millimetres_inside_leave_mouths_to_measure() -> None:
    off = misses_mm(checked(("plugs",)), Kind.SLEEVE, ("plugs",))
    assert len(off) == len(built()[0].sleeves)
    assert max(off.values()) < 0.4


def test_bars_of_two_heights_are_all_found_without_a_floor_too() -> None:
    site = ("two-heights",)
    for slip in (NO_SLIP, SLIPS["outliers"]):
        off = misses_mm(checked(site, slip=slip), Kind.REBAR, site)
        assert len(off) == len(built(site)[1].bars)
        assert max(off.values()) < 0.4
