"""Columns whose scans contradict their job, from scan to verdict: each gets its own sentence, none passes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from aadm_workbench.assembly.findings.diameters import odd_bar_findings
from aadm_workbench.assembly.findings.finding import SeenGroup
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.extract.method import extract
from aadm_workbench.inspection.check import check_column
from aadm_workbench.inspection.measure import CheckSettings, ColumnScans
from aadm_workbench.model import ColumnDesign, ColumnReport, Kind, Scan, Verdict
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Foot
from aadm_workbench.twin.scenes import FIELD, LAB, random_bars, random_foot
from aadm_workbench.twin.truth import sample_design
from tests.scenes import lab_scan

SETTINGS = CheckSettings(load_profile("cn"))
KEY_MM = 9.0


def built(key_mm: float = 0.0) -> tuple[Foot, BarGroup]:
    """A foot and bars that go together; with a key, S2 and R2 stand so much further along +y, as designed."""
    foot, bars = random_foot(LAB, np.random.default_rng(40), 0.2), random_bars(LAB, np.random.default_rng(41), 0.2)
    sleeves = tuple(replace(s, y=s.y + key_mm * (k == 1), lean=(0.0, 0.0)) for k, s in enumerate(foot.sleeves))
    upright = tuple(replace(b, y=b.y + key_mm * (k == 1), lean=(0.0, 0.0)) for k, b in enumerate(bars.bars))
    return replace(foot, sleeves=sleeves), replace(bars, bars=upright)


def design(key_mm: float = 0.0) -> ColumnDesign:
    plain, step = sample_design(LAB), np.array([0.0, key_mm, 0.0])
    sleeves = tuple(replace(p, centre=p.centre + step * (k == 1)) for k, p in enumerate(plain.sleeves))
    rebars = tuple(replace(p, centre=p.centre + step * (k == 1)) for k, p in enumerate(plain.rebars))
    return replace(plain, sleeves=sleeves, rebars=rebars)


@cache
def scans(key_mm: float = 0.0) -> tuple[Scan, Scan]:
    foot, bars = built(key_mm)
    return lab_scan(foot).scan("foot"), lab_scan(bars).scan("bars")


def rescanned(change: Callable[[int, BarAsBuilt], BarAsBuilt]) -> Scan:
    bars = built()[1]
    return lab_scan(replace(bars, bars=tuple(change(k, bar) for k, bar in enumerate(bars.bars)))).scan("bars")


def checked(foot: Scan, bars: Scan, of: ColumnDesign | None = None, **more: object) -> ColumnReport:
    ups: dict[str, object] = {"sleeves_up_deg": 90.0, "rebars_up_deg": 90.0}
    return check_column(of or design(), ColumnScans((foot,), (bars,), **(ups | more)), SETTINGS)  # type: ignore[arg-type]


def flipped(scan: Scan) -> Scan:
    """The depth map stored with left and right exchanged, read with the intrinsics of the camera."""
    camera, depth = scan.camera, scan.points[:, ::-1, 2]
    assert camera is not None
    x = (np.arange(camera.width) - camera.cx) / camera.fx * depth
    y = (np.arange(camera.height)[:, None] - camera.cy) / camera.fy * depth
    return replace(scan, points=np.stack([x, y, depth], axis=-1).astype(scan.points.dtype))


def only_code(report: ColumnReport) -> str:
    (code,) = {finding.code for finding in report.findings}
    return code


def test_a_sound_column_passes_without_a_finding() -> None:
    for key_mm in (0.0, KEY_MM):
        report = checked(*scans(key_mm), of=design(key_mm))
        assert report.findings == ()
        assert report.verdict in (Verdict.PASS, Verdict.INCONCLUSIVE)


def test_swapped_scans_say_so() -> None:
    foot, bars = scans()
    report = checked(bars, foot)
    assert (report.verdict, report.goes_on, only_code(report)) == ("not_measured", "not_measured", "swapped")
    assert report.reasons[0].startswith("the scans of the sleeves and of the rebars are swapped")


def test_the_bars_twice_say_which_file_is_wrong() -> None:
    _, bars = scans()
    report = checked(replace(bars, source="wrong.tiff"), bars)
    assert (report.verdict, only_code(report)) == ("not_measured", "swapped")
    assert "named for the sleeves (wrong.tiff) shows the rebars" in report.reasons[0]


def test_the_scan_of_another_column_says_whose_it_is() -> None:
    other = replace(sample_design(FIELD), id="C-207")
    foreign = lab_scan(random_foot(FIELD, np.random.default_rng(4)), setting=FIELD).scan("foot")
    report = checked(foreign, scans()[1], others=(other,))
    assert (report.verdict, only_code(report)) == ("not_measured", "other_column")
    assert "fit the design of C-207" in report.reasons[0]


@pytest.mark.parametrize("up_deg", [None, 90.0])
def test_a_mirrored_scan_says_so(up_deg: float | None) -> None:
    foot, bars = scans(KEY_MM)
    report = checked(flipped(foot), bars, design(KEY_MM), sleeves_up_deg=up_deg)
    assert (report.verdict, only_code(report)) == ("not_measured", "mirrored")
    assert report.reasons[0].startswith("the scan of the sleeves is mirrored")


def test_an_up_that_the_pattern_contradicts_names_the_one_that_fits() -> None:
    foot, bars = scans(KEY_MM)
    report = checked(foot, bars, design(KEY_MM), sleeves_up_deg=180.0)
    assert (report.verdict, only_code(report)) == ("not_measured", "turn_contradicted")
    assert report.findings[0].values["fitting_deg"] == pytest.approx(90.0, abs=8.0)


@pytest.mark.parametrize(("core_mm", "fits"), [(20.0, "20 mm"), (15.4, "16 mm"), (24.2, "25 mm")])
def test_bars_of_another_size_hold_the_column_back_and_are_named(core_mm: float, fits: str) -> None:
    """Those near to 18 mm are measured all the same, the others are found when it is asked what stands there."""
    report = checked(scans()[0], rescanned(lambda _, bar: replace(bar, core_diameter=core_mm)))
    assert only_code(report) == "diameter_differs"
    assert report.verdict is not Verdict.PASS
    assert report.goes_on is not Verdict.PASS
    assert report.findings[0].values["seems"] == fits


@pytest.mark.parametrize(("core_mm", "seems"), [(19.3, "20 mm"), (24.2, "25 mm"), (15.4, "16 mm")])
def test_one_bar_of_another_size_is_named(core_mm: float, seems: str) -> None:
    """Near to 18 mm it is measured with the diameter that all share, further off it is not measured at all."""
    odd = rescanned(lambda k, bar: replace(bar, core_diameter=core_mm) if k == 4 else bar)
    report = checked(scans()[0], odd)
    (finding,) = report.findings
    assert (finding.code, finding.about) == ("diameter_differs", ("R5",))
    assert seems.removesuffix(" mm") in str(finding.values["seems"]).removesuffix(" mm").split("/")
    assert abs(float(str(finding.values["measured_mm"])) - core_mm) < 0.6
    assert report.verdict is not Verdict.PASS
    assert report.goes_on is not Verdict.PASS


def all_thinner(scan: Scan, by_mm: float, u_mm: float) -> SeenGroup:
    """The bars of a scan whose edges were lost: each diameter reads so much less, which their uncertainty tells."""
    found = extract(scan, Kind.REBAR, 18.0, "refined", np.random.default_rng(0))
    points = tuple(replace(point, diameter_mm=point.diameter_mm - by_mm) for point in found.points)
    found = replace(found, points=points, quality={**found.quality, "diameter_u_mm": u_mm})
    match = match_extraction(design().rebars, found, up=90.0, image_up_scan=np.array([0.0, -1.0, 0.0]))
    return SeenGroup(Kind.REBAR, design().rebars, found, match)


@pytest.mark.parametrize(("core_mm", "named"), [(None, []), (24.2, [("R5",)])])
def test_lost_edges_make_no_bar_an_odd_one_and_hide_none(core_mm: float | None, named: list[tuple[str]]) -> None:
    scan = rescanned(lambda k, bar: replace(bar, core_diameter=core_mm) if core_mm and k == 4 else bar)
    group = all_thinner(scan, 2.0, 2.5)
    findings = list(odd_bar_findings(group, scan, (), np.random.default_rng(0)))
    assert [finding.about for finding in findings] == named


def cut_off(left_mm: float) -> Scan:
    return rescanned(lambda k, bar: replace(bar, top=bar.top - (LAB.exposed - left_mm) * (k == 4)))


def test_what_hardly_stands_out_of_the_floor_is_no_bar() -> None:
    report = checked(scans()[0], cut_off(6.0))
    assert (report.verdict, report.goes_on) == (Verdict.NOT_MEASURED, Verdict.NOT_MEASURED)
    assert report.reasons[0].startswith("R5 not measured: no bar stands there")


@pytest.mark.parametrize("left_mm", [25.0, 45.0])
def test_a_bar_that_was_cut_off_holds_the_column_back(left_mm: float) -> None:
    report = checked(scans()[0], cut_off(left_mm))
    assert only_code(report) == "exposed_length_differs"
    assert report.findings[0].about == ("R5",)
    assert report.verdict is not Verdict.PASS
    assert report.findings[0].values["measured_mm"] == pytest.approx(left_mm, abs=6.0)


def test_a_camera_whose_lengths_are_wrong_is_told_first() -> None:
    foot, bars = (replace(scan, points=(1.02 * scan.points).astype(scan.points.dtype)) for scan in scans())
    report = checked(foot, bars)
    assert "scale_differs" in [finding.code for finding in report.findings]
    assert "times as large as designed" in report.reasons[0]
    assert report.goes_on is not Verdict.PASS


def test_points_that_hang_on_a_declared_up_say_so_in_the_report() -> None:
    ring, key = checked(*scans()), checked(*scans(KEY_MM), of=design(KEY_MM))
    assert ring.sleeves is not None
    assert ring.sleeves.fit is not None
    assert (ring.sleeves.fit.orientation, ring.sleeves.fit.declared_up) == ("declared", "+y")
    assert key.sleeves is not None
    assert key.sleeves.fit is not None
    assert key.sleeves.fit.declared_up is None
