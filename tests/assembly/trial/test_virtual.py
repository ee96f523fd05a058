"""Virtual trial assembly: distances, clearance with lean, verdict, turns, missing points, ambiguity."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.pairs import embedded_length_mm
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import try_assembly
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, TrialReport, Verdict

CN = load_profile("cn")
Y_UP = np.array([0.0, 1.0])


def tried(
    build: Any, design: ColumnDesign, bars: Array, *, u_mm: float | None = None, seed: int = 0, **more: Any
) -> TrialReport:
    """Perfect sleeves against bars that are displaced by (n, 2)."""
    sleeves = build.moved(design.sleeves, np.zeros_like(bars), u_mm)
    return try_assembly(
        design, sleeves, build.moved(design.rebars, bars, u_mm), CN, np.random.default_rng(seed), **more
    )


def test_perfect_bars_go_on(build: Any, square: Array) -> None:
    report = tried(build, build.column(square), np.zeros((12, 2)))
    assert report.verdict is Verdict.PASS
    assert report.minimax is not None
    assert report.least_squares is not None
    assert report.minimax.max_mm < 1e-9
    assert [pair.rebar for pair in report.minimax.pairs] == [f"R{k}" for k in range(1, 13)]
    assert report.minimax.pairs[0].clearance_mm == pytest.approx((36.0 - 23.5) / 2.0)
    assert report.embedded_length_mm == pytest.approx(160.0)
    assert report.window is not None
    assert report.window.dx_mm == pytest.approx((-3.0, 3.0), abs=1e-5)
    assert report.window.yaw_deg[1] == pytest.approx(np.degrees(2.0 * np.arcsin(1.5 / np.hypot(240, 240))), abs=1e-5)
    assert report.margin == pytest.approx(1.0)
    assert any("unverified" in note for note in report.notes)


def test_sign_of_the_offset_is_rebar_minus_sleeve(build: Any, square: Array) -> None:
    """The column moves by plus offset to meet the bar: here the window says so too."""
    design = build.column(square)
    bars = np.zeros((12, 2))
    bars[6] = [2.0, 0.0]
    report = tried(build, design, bars)
    assert report.minimax is not None
    offset = report.minimax.pairs[6].offset_mm
    assert offset[0] == pytest.approx(1.0, abs=0.25)
    assert offset[0] > 0.0
    assert report.window is not None
    assert report.window.dx_mm[1] > -report.window.dx_mm[0] - 3.0
    T = report.minimax.T_sleeves_rebars
    placed = T[:3, :3] @ (design.rebars[6].centre + np.array([2.0, 0.0, 0.0])) + T[:3, 3]
    np.testing.assert_allclose(placed[:2] - design.sleeves[6].centre[:2], offset, atol=1e-12)


def test_one_bar_1_mm_beyond_what_any_pose_can_take_fails(build: Any, square: Array) -> None:
    """Opposite bars 8 mm further apart than their sleeves: half of it is left at best, 1 mm beyond the limit."""
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-4.0 / np.sqrt(2.0)] * 2, [4.0 / np.sqrt(2.0)] * 2
    report = tried(build, build.column(square), bars)
    assert report.verdict is Verdict.FAIL
    assert report.minimax is not None
    assert report.minimax.max_mm == pytest.approx(4.0, abs=1e-9)
    assert report.margin == pytest.approx(1.0 - 4.0 / 3.0)
    assert report.window is None
    failing = [pair for pair in report.minimax.pairs if pair.verdict is Verdict.FAIL]
    assert {pair.sleeve for pair in failing} == {"S1", "S7"}
    assert "R1 is 4.00 mm from the centre of S1, limit 3 mm (GB/T 51231-2016, 10.4)" in report.reasons
    just = tried(build, build.column(square), bars * (2.999 / 4.0))
    assert just.verdict is Verdict.PASS


def test_minimax_decides_where_least_squares_would_refuse(build: Any, square: Array) -> None:
    rng = np.random.default_rng(0)
    seen = set()
    for _ in range(25):
        report = tried(build, build.column(square), rng.normal(0.0, 1.2, (12, 2)), decision="simple")
        assert report.minimax is not None
        assert report.least_squares is not None
        assert report.minimax.max_mm <= report.least_squares.max_mm + 1e-9
        assert report.verdict is (Verdict.PASS if report.minimax.max_mm <= 3.0 else Verdict.FAIL)
        seen.add((report.least_squares.max_mm <= 3.0, report.verdict))
    assert (False, Verdict.PASS) in seen


def test_numbers_of_a_pose(build: Any, square: Array) -> None:
    report = tried(build, build.column(square), np.random.default_rng(1).normal(0.0, 1.0, (12, 2)), u_mm=0.1)
    for pose in (report.least_squares, report.minimax):
        assert pose is not None
        distances = [np.hypot(*pair.offset_mm) for pair in pose.pairs]
        assert pose.max_mm == pytest.approx(max(distances))
        assert pose.mean_mm == pytest.approx(np.mean(distances))
        assert pose.sd_mm == pytest.approx(np.std(distances))
        assert {round(pair.u_mm or 0.0, 9) for pair in pose.pairs} == {round(0.1 * np.sqrt(2.0), 9)}


@pytest.mark.parametrize(("sleeve_mm", "collides"), [(30.0, False), (27.0, True)])
def test_a_rib_touches_within_the_3_mm(sleeve_mm: float, collides: bool, build: Any, square: Array) -> None:
    """Opposite bars 2.5 mm off: room 3.25 mm in a sleeve of 30 mm, 1.75 mm in one of 27 mm."""
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-2.5 / np.sqrt(2.0)] * 2, [2.5 / np.sqrt(2.0)] * 2
    report = tried(build, build.column(square, sleeve_mm=sleeve_mm), bars)
    assert report.minimax is not None
    assert report.minimax.max_mm == pytest.approx(2.5)
    assert report.minimax.pairs[0].clearance_mm == pytest.approx((sleeve_mm - 23.5) / 2.0 - 2.5)
    assert report.collisions == (("S1", "S7") if collides else ())
    assert report.verdict is (Verdict.FAIL if collides else Verdict.PASS)
    if collides:
        assert "R1 collides with S1: 0.75 mm of room are missing over the ribs" in report.reasons


def test_diameter_over_the_ribs_of_the_design_comes_first(build: Any, square: Array) -> None:
    report = tried(build, build.column(square, sleeve_mm=26.0, outer_mm=20.0), np.zeros((12, 2)))
    assert report.minimax is not None
    assert report.minimax.pairs[0].clearance_mm == pytest.approx(3.0)
    assert report.notes == ()
    unknown = tried(build, build.column(square, rebar_mm=19.05), np.zeros((12, 2)))
    assert unknown.minimax is not None
    assert unknown.minimax.pairs[0].clearance_mm is None
    assert any("clearance over the ribs not checked" in note for note in unknown.notes)


def test_lean_over_the_embedded_length_takes_room(build: Any, square: Array) -> None:
    """A bar's measured centre is its top: leaning by 1.5° it is 4.19 mm off at the mouth, 160 mm further down.

    With 2 mm of room no pose helps: at the mouth the bar wants to go one way, at its top it may not go so far.
    """
    design = build.column(square, sleeve_mm=27.5)
    still = np.zeros((12, 2))
    lean = np.array([np.tan(np.radians(1.5)), 0.0])
    sleeves = build.moved(design.sleeves, still)
    leaning = build.moved(design.rebars, still)
    leaning[3] = build.moved(design.rebars, still, lean=lean)[3]
    report = try_assembly(design, sleeves, leaning, CN, np.random.default_rng(0))
    assert report.minimax is not None
    assert report.minimax.max_mm < 1e-9
    assert report.minimax.pairs[3].clearance_mm == pytest.approx(2.0 - 160.0 * lean[0])
    assert "S4" in report.collisions
    assert report.verdict is Verdict.FAIL
    # Sleeve and bar leaning alike: mouth and top are off by the same, in the same direction, and only by that.
    alike = try_assembly(
        design,
        build.moved(design.sleeves, still, lean=lean / 4.0),
        build.moved(design.rebars, still, lean=lean / 4.0),
        CN,
        np.random.default_rng(0),
    )
    assert alike.minimax is not None
    assert alike.minimax.pairs[0].clearance_mm == pytest.approx(2.0 - 40.0 * lean[0])


def test_lean_turns_with_the_bars(build: Any, square: Array) -> None:
    """Bars set in a frame that is turned by 90°: their lean must be turned as well."""
    design = build.column(square, sleeve_mm=27.5)
    quarter = turn(np.pi / 2.0)
    lean = np.array([0.01, 0.0])
    back = quarter.T @ lean
    bars: list[AssemblyPoint | None] = [
        replace(bar, centre=np.array([*(quarter.T @ bar.centre[:2]), bar.centre[2]]), axis=np.array([*back, 1.0]))
        for bar in design.rebars
    ]
    sleeves = build.moved(design.sleeves, np.tile([0.0, 0.0], (12, 1)), lean=lean)
    report = try_assembly(design, sleeves, bars, CN, np.random.default_rng(0))
    assert report.minimax is not None
    assert {round(pair.clearance_mm or 0.0, 6) for pair in report.minimax.pairs} == {round(2.0 - 1.6, 6)}


def test_embedded_length(build: Any, square: Array) -> None:
    design = build.column(square)
    assert embedded_length_mm(replace(design, embedded_length_mm=120.0)) == 120.0
    assert embedded_length_mm(design) == 160.0
    flat = tuple(replace(bar, centre=bar.centre * np.array([1.0, 1.0, 0.0])) for bar in design.rebars)
    assert embedded_length_mm(replace(design, rebars=flat)) == 160.0 == 8.0 * 20.0


def test_missing_points_are_tried_with_the_rest(build: Any, square: Array) -> None:
    design = build.column(square)
    bars = build.moved(design.rebars, np.zeros((12, 2)), 0.05)
    sleeves = build.moved(design.sleeves, np.zeros((12, 2)), 0.05)
    bars[4] = sleeves[7] = None
    report = try_assembly(design, sleeves, bars, CN, np.random.default_rng(0))
    assert report.verdict is Verdict.NOT_MEASURED
    assert report.missing == ("R5", "S8")
    assert report.minimax is not None
    assert len(report.minimax.pairs) == 10
    assert "not measured: R5, S8" in report.reasons
    assert report.probability is None, "ten pairs that fit say nothing of the two that nobody saw"
    assert any("for lack of R5, S8 no probability" in note for note in report.notes)
    far = np.zeros((12, 2))
    far[0], far[6] = [-4.0, -4.0], [4.0, 4.0]
    bars = build.moved(design.rebars, far, 0.05)
    bars[4] = None
    report = try_assembly(design, sleeves, bars, CN, np.random.default_rng(0))
    assert report.verdict is Verdict.FAIL, "no pose of eleven pairs is no pose of twelve"
    assert report.probability is not None
    assert report.probability <= 0.05
    assert any("for the pairs that were measured is 0.0 %" in reason for reason in report.reasons)
    few = try_assembly(design, sleeves[:1] + [None] * 11, bars, CN, np.random.default_rng(0))
    assert few.verdict is Verdict.NOT_MEASURED
    assert few.minimax is None
    sleeves_only = replace(design, rebars=())
    assert try_assembly(sleeves_only, sleeves, (), CN, np.random.default_rng(0)).verdict is Verdict.NOT_MEASURED


def test_guarded_verdict_is_the_probability_that_a_pose_exists(build: Any, square: Array) -> None:
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-2.9 / np.sqrt(2.0)] * 2, [2.9 / np.sqrt(2.0)] * 2
    sharp = tried(build, build.column(square), bars, u_mm=0.02)
    assert sharp.verdict is Verdict.PASS
    assert sharp.probability is not None
    assert sharp.probability > 0.99
    vague = tried(build, build.column(square), bars, u_mm=0.2)
    assert vague.verdict is Verdict.INCONCLUSIVE
    assert vague.probability is not None
    assert 0.05 < vague.probability < 0.95
    assert any("rescan closer" in reason for reason in vague.reasons)
    assert tried(build, build.column(square), bars, u_mm=0.2, decision="simple").verdict is Verdict.PASS
    assert tried(build, build.column(square), bars * 1.1, u_mm=0.02).verdict is Verdict.FAIL
    again = tried(build, build.column(square), bars, u_mm=0.2)
    assert again.probability == vague.probability, "the same seed gives the same bytes"


def test_without_a_rule_the_room_is_the_limit(build: Any, square: Array) -> None:
    design = build.column(square, sleeve_mm=36.0)
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-5.0 / np.sqrt(2.0)] * 2, [5.0 / np.sqrt(2.0)] * 2
    other = load_profile("us-nmb-2014")
    sleeves = build.moved(design.sleeves, 0 * bars)
    assert try_assembly(design, sleeves, build.moved(design.rebars, bars), other, np.random.default_rng(0)).margin == (
        pytest.approx(1.0 - 5.0 / 6.25, abs=1e-9)
    )
    thick = replace(design, rebar_outer_diameter_mm=37.0)
    report = try_assembly(thick, sleeves, build.moved(design.rebars, 0 * bars), other, np.random.default_rng(0))
    assert report.verdict is Verdict.FAIL
    assert len(report.collisions) == 12
    unknown = replace(design, rebars=tuple(replace(bar, diameter_mm=19.05) for bar in design.rebars))
    report = try_assembly(unknown, sleeves, build.moved(unknown.rebars, 0 * bars), other, np.random.default_rng(0))
    assert report.verdict is Verdict.NOT_ASSESSED


def test_a_design_that_misses_the_tolerance_itself_is_told(build: Any, square: Array) -> None:
    design = build.column(square)
    drawn = list(design.rebars)
    drawn[2] = replace(drawn[2], centre=drawn[2].centre + np.array([3.4, 0.0, 0.0]))
    report = tried(build, replace(design, rebars=tuple(drawn)), np.zeros((12, 2)))
    assert "in the design itself R3 is 3.40 mm off S3, limit 3 mm (GB/T 51231-2016, 10.4)" in report.notes


def test_each_pair_has_the_room_of_its_own_sizes(build: Any, square: Array) -> None:
    design = build.column(square, outer_mm=23.5)
    sleeves, rebars = list(design.sleeves), list(design.rebars)
    sleeves[4], rebars[4] = replace(sleeves[4], diameter_mm=44.0), replace(rebars[4], diameter_mm=25.0)
    rebars[5] = replace(rebars[5], diameter_mm=22.0, outer_diameter_mm=25.0)
    report = tried(build, replace(design, sleeves=tuple(sleeves), rebars=tuple(rebars)), np.zeros((12, 2)))
    assert report.best is not None
    allowed = [pair.allowance_mm for pair in report.best.pairs]
    # One diameter over the ribs for all is not that of a bar of another size: the table's, or its own.
    assert allowed[4] == pytest.approx((44.0 - 29.4) / 2.0)
    assert allowed[5] == pytest.approx((36.0 - 25.0) / 2.0)
    assert {round(value or 0.0, 6) for k, value in enumerate(allowed) if k not in (4, 5)} == {6.25}


def test_the_best_pose_shares_its_room_between_both_ends(build: Any, square: Array) -> None:
    """All bars lean alike by 3 mm over their length: the column gives way by half of it, and the report says so."""
    design = build.column(square, sleeve_mm=28.5)
    still, lean = np.zeros((12, 2)), np.array([3.0 / 160.0, 0.0])
    sleeves = build.moved(design.sleeves, still)
    rebars = build.moved(design.rebars, still, lean=lean)
    report = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert report.verdict is Verdict.PASS
    assert report.minimax is not None
    assert report.minimax.pairs[0].clearance_mm == pytest.approx(2.5 - 3.0, abs=1e-6)
    assert report.best is not None
    for pair in report.best.pairs:
        assert pair.room_mm == pair.clearance_mm == pytest.approx(1.0, abs=1e-6)
        assert pair.distance_mm == pytest.approx(1.5, abs=1e-6)
        assert pair.margin == pytest.approx(0.4, abs=1e-6)
    assert report.window is not None
    # 1 mm is left along the lean, on both sides; the limit of 3 mm would leave less only beyond 1.5 mm.
    assert report.window.dx_mm == pytest.approx((-1.0, 1.0), abs=1e-5)


def test_how_much_of_a_bar_was_seen_is_said(build: Any, square: Array) -> None:
    design = build.column(square)
    still = np.zeros((12, 2))
    known = [
        replace(bar, seen_length_mm=float(45 + 10 * k), axis_covariance=np.diag([1e-6, 1e-6, 0.0]))
        for k, bar in enumerate(build.moved(design.rebars, still, 0.05))
    ]
    report = try_assembly(design, build.moved(design.sleeves, still, 0.05), known, CN, np.random.default_rng(0))
    assert report.best is not None
    assert [pair.seen_length_mm for pair in report.best.pairs[:2]] == [45.0, 55.0]
    assert any("45 to 155 mm were seen" in note and "4 mm a metre" in note for note in report.notes)
    u_mm = [pair.u_room_mm or 0.0 for pair in report.best.pairs]
    assert u_mm[0] > u_mm[11], "what was not seen may be bent"
