"""Absolute position of the bars: a group that stands off as a whole, which the fit to design hides."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.inspect import NO_ABSOLUTE_POSITION, inspect_group
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.assembly.pairs import place_points
from aadm_workbench.assembly.pose.eopa import NoFit, turn
from aadm_workbench.assembly.survey.absolute import DatumRules, inspect_absolute, results_of, with_absolute
from aadm_workbench.assembly.survey.control import DEFAULT_U_MM, fit_control_points
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.model import AbsolutePosition, Array, ControlPoint, GroupReport, Kind, Profile, Rule, Verdict

CN = load_profile("cn")
Y_UP = np.array([0.0, 1.0])
CORNERS = np.array([[-800.0, -700.0, 0.0], [900.0, -600.0, 0.0], [700.0, 850.0, 0.0]])
TO_DATUM = Rule("bars", "rebar_position", 6.35, None, "our spec, 3", "shall", "verified", level="group_to_datum")


def checked(
    build: Any,
    square: Array,
    offset: Any = (0.0, 0.0),
    yaw_deg: float = 0.0,
    profile: Profile = CN,
    u_mm: float = 0.1,
    missing: tuple[int, ...] = (),
    up: Array = Y_UP,
) -> tuple[GroupReport, AbsolutePosition]:
    """Bars that stand off as a group, scanned from anywhere together with three control points."""
    design = build.column(square)
    tops = np.array([bar.centre for bar in design.rebars])
    built = tops.copy()
    built[:, :2] = tops[:, :2] @ turn(np.radians(yaw_deg)).T + offset
    seen = build.see(built, np.random.default_rng(4), missing=missing)
    found = build.extraction(Kind.REBAR, seen, 20.0, u_mm=0.05)
    match = match_extraction(design.rebars, found, up=up, image_up_scan=seen.image_up)
    corners = CORNERS @ seen.turned.T + seen.moved
    points = [
        ControlPoint(f"G{k}", tuple(known), tuple(scan), False, u_mm)
        for k, (known, scan) in enumerate(zip(CORNERS.tolist(), corners.tolist(), strict=True), 1)
    ]
    absolute = inspect_absolute(
        design.rebars,
        place_points(found, match.placements[0]),
        points,
        fit_control_points(points, None, found.vertical),
        DatumRules.of(profile),
        decision="guarded",
        scale_error=1e-4,
    )
    report = inspect_group(design.rebars, found, match, profile)
    return with_absolute(report, absolute, profile), absolute


def test_a_group_that_stands_off_is_seen_by_control_points_alone(build: Any, square: Array) -> None:
    report, absolute = checked(build, square, (9.0, -2.0), 0.3)
    assert {point.verdict for point in report.points} == {Verdict.PASS}, "the fit hides it"
    assert absolute.offset_mm == pytest.approx((9.0, -2.0), abs=1e-6)
    assert absolute.turn_deg == pytest.approx(0.3, abs=1e-6)
    assert absolute.deviation_mm == pytest.approx(np.hypot(9.0, 2.0))
    assert absolute.verdict is Verdict.FAIL
    assert report.verdict is Verdict.FAIL
    assert report.absolute is absolute
    assert (
        "the bars as a group are 9.22 mm off their place (+9.00, -2.00), limit 8 mm (GB/T 51231-2016, table 10.4.12, "
        "unverified)" in report.reasons
    )
    (rule,) = [rule for rule in report.rules if rule.rule == "group_position"]
    assert (rule.verdict, rule.counted, rule.worst_mm) == (Verdict.FAIL, True, pytest.approx(9.2195, abs=1e-3))
    assert NO_ABSOLUTE_POSITION not in report.notes
    expected = square[:, :2] @ turn(np.radians(0.3)).T + (9.0, -2.0) - square[:, :2]
    np.testing.assert_allclose([point.offset_mm for point in absolute.points], expected, atol=1e-6)


def test_a_group_in_its_place_passes_with_its_uncertainty(build: Any, square: Array) -> None:
    report, absolute = checked(build, square, (3.0, 0.0))
    assert (absolute.verdict, report.verdict) == (Verdict.PASS, Verdict.PASS)
    assert absolute.u_mm is not None
    # Three control points of 0.1 mm are a little worse than 0.1/sqrt(3) away from their centroid.
    assert 0.05 < absolute.u_mm < 0.12
    assert all(point.u_mm is not None and point.u_mm > 0.07 for point in absolute.points)
    assert [point.name for point in absolute.control_points] == ["G1", "G2", "G3"]
    assert absolute.clause.endswith("unverified")
    vague = checked(build, square, (7.6, 0.0), u_mm=1.0)[1]
    assert vague.verdict is Verdict.INCONCLUSIVE


def test_rules_for_single_bars_and_profiles_without_any(build: Any, square: Array) -> None:
    own = build.profile(TO_DATUM)
    report, absolute = checked(build, square, (4.0, 0.0), 0.8, own)
    assert absolute.verdict is Verdict.NOT_ASSESSED
    assert {point.limit_mm for point in absolute.points} == {6.35}
    assert report.verdict is Verdict.FAIL
    assert any("R1 is" in reason or "R7 is" in reason for reason in report.reasons)
    axis = Rule("axis", "column_axis", 8.0, None, "table 10.4.12", "shall", "unverified", level="component")
    assert checked(build, square, (9.0, 0.0), 0.0, build.profile(axis))[0].verdict is Verdict.FAIL
    silent = checked(build, square, (90.0, 0.0), 0.0, build.profile())[1]
    assert silent.verdict is Verdict.NOT_ASSESSED
    assert silent.deviation_mm == pytest.approx(90.0)


def test_what_control_points_cannot_say_is_not_measured(build: Any, square: Array) -> None:
    report, _ = checked(build, square)
    nothing = inspect_absolute((), (), (), NoFit("they contradict each other"), DatumRules.of(CN), decision="guarded")
    assert nothing.verdict is Verdict.NOT_MEASURED
    assert [result.verdict for result in results_of(nothing, DatumRules.of(CN))] == [Verdict.NOT_MEASURED]
    bare = with_absolute(replace(report, absolute=None), nothing, CN)
    assert bare.verdict is Verdict.NOT_MEASURED
    assert "absolute position: they contradict each other" in bare.reasons
    turned = checked(build, square, up=np.array([1.0, 0.0]))[1]
    assert turned.verdict is Verdict.NOT_MEASURED
    assert "turned by 90° against the declared up" in turned.reason.replace("-", "")


def test_missing_bars_do_not_move_the_group(build: Any, square: Array) -> None:
    _, absolute = checked(build, square, (5.0, 1.0), missing=(0, 5))
    assert absolute.offset_mm == pytest.approx((5.0, 1.0), abs=1e-6)
    assert len(absolute.points) == 10
    assert DEFAULT_U_MM == 0.5
