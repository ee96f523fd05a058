"""Repair advice: the smallest set against a search of all sets, bends that work, and what must never be advised."""

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.matching.symmetry import symmetric_turns
from aadm_workbench.assembly.pairs import form_pairs
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.pose.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.repair.bends import advise_repair
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.virtual import _try_pairs, try_assembly
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    ColumnDesign,
    Profile,
    RepairAction,
    RepairReport,
    TrialReport,
    Verdict,
)

CN = load_profile("cn")
Points = list[AssemblyPoint | None]


def advised(
    design: ColumnDesign, sleeves: Points, rebars: Points, profile: Profile = CN, **more: Any
) -> tuple[TrialReport, RepairReport | None]:
    trial = try_assembly(design, sleeves, rebars, profile, np.random.default_rng(0), **more)
    decision = more.get("decision", "guarded")
    return trial, advise_repair(design, sleeves, rebars, trial, profile, np.random.default_rng(3), decision=decision)


def repair_of(
    build: Any, design: ColumnDesign, bars: Array, sleeves: Array | None = None, u_mm: float | None = 0.05, **more: Any
) -> RepairReport:
    mouths = build.moved(design.sleeves, np.zeros_like(bars) if sleeves is None else sleeves, u_mm)
    trial, repair = advised(design, mouths, build.moved(design.rebars, bars, u_mm), **more)
    assert trial.verdict in (Verdict.FAIL, Verdict.INCONCLUSIVE)
    assert repair is not None
    return repair


def bent(rebars: Points, repair: RepairReport) -> Points:
    """The bars once the advice was followed."""
    by = {step.rebar: step.bend_mm for step in repair.steps}
    return [
        bar
        if bar is None or by.get(bar.label) is None
        else replace(bar, centre=bar.centre + np.array([*(by[bar.label] or (0.0, 0.0)), 0.0]))
        for bar in rebars
    ]


def fewest(source: Array, target: Array, most: int) -> int | None:
    """How many bars have to be left out for the rest to go in: every set is tried, each by the full minimax fit."""
    for count in range(most + 1):
        for left_out in itertools.combinations(range(len(source)), count):
            stay = np.setdiff1d(np.arange(len(source)), left_out)
            pose = fit_minimax(source[stay], target[stay], np.full(len(stay), 3.0))
            assert isinstance(pose, MinimaxPose)
            if pose.ratio <= 1.0:
                return count
    return None


@pytest.mark.parametrize("seed", range(12))
def test_no_smaller_set_would_do(seed: int, build: Any, square: Array) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 3))
    bars = rng.normal(0.0, 0.7, (12, 2))
    for index in rng.choice(12, count, replace=False):
        angle = rng.uniform(0.0, 2.0 * np.pi)
        bars[index] += 7.0 * np.array([np.cos(angle), np.sin(angle)])
    design = build.column(square)
    sleeves, rebars = build.moved(design.sleeves, 0 * bars), build.moved(design.rebars, bars)
    trial, repair = advised(design, sleeves, rebars)
    expected = fewest(square[:, :2] + bars, square[:, :2], 2)
    if trial.verdict is Verdict.PASS:
        assert repair is None
        assert expected == 0
        return
    assert repair is not None
    assert repair.exact
    if repair.action is RepairAction.BEND:
        assert len(repair.steps) == expected
        again = try_assembly(design, sleeves, bent(rebars, repair), CN, np.random.default_rng(0))
        assert again.verdict is Verdict.PASS
        assert again.minimax is not None
        assert repair.after is not None
        assert again.minimax.max_mm == pytest.approx(repair.after.max_mm, abs=1e-9)
        assert again.margin == pytest.approx(repair.margin)


def test_several_bars_and_each_stays_within_its_own_limit(build: Any, square: Array) -> None:
    """Four bars 4.8 mm off their places: as few as need be are bent back to within 2 mm of them."""
    bars = np.random.default_rng(2).normal(0.0, 0.3, (12, 2))
    for index, by in {1: [4.8, 0.0], 2: [-4.8, 0.0], 5: [0.0, 4.8], 10: [0.0, -4.8]}.items():
        bars[index] += by
    repair = repair_of(build, build.column(square), bars)
    assert repair.action is RepairAction.BEND
    assert repair.exact
    assert len(repair.steps) == fewest(square[:, :2] + bars, square[:, :2], 3)
    for step in repair.steps:
        assert step.position_before_mm > 2.0
        assert step.position_after_mm is not None
        assert step.position_after_mm <= 2.0
        assert step.bend_length_mm is not None
        assert step.bend_length_mm <= 5.0 + 1e-9
        assert 0.0 < (step.least_bend_mm or 0.0) < step.bend_length_mm
    assert repair.adjustment_limit_mm == 5.0
    assert repair.probability == 1.0


def test_a_bar_is_bent_by_minus_its_offset_to_meet_its_sleeve(build: Any, square: Array) -> None:
    bars = np.zeros((12, 2))
    bars[3], bars[9] = [3.2, -3.2], [-3.2, 3.2]
    repair = repair_of(build, build.column(square), bars)
    (step,) = repair.steps
    index = int(step.rebar[1:]) - 1
    assert index in (3, 9)
    assert step.bend_mm is not None
    assert step.bend_mm[0] * bars[index][0] < 0.0
    assert repair.after is not None
    pair = repair.after.pairs[index]
    assert np.hypot(*pair.offset_mm) <= 3.0
    assert f"bend {step.rebar} by ({step.bend_mm[0]:+.1f}, {step.bend_mm[1]:+.1f}) mm" in repair.advice
    assert repair.advice.startswith("subject to the engineer's release")
    assert repair.subject_to == "the engineer's release"


def test_beyond_the_adjustment_limit_nothing_is_advised_but_a_disposal_plan(build: Any, square: Array) -> None:
    bars = np.zeros((12, 2))
    bars[4] = [13.9, 0.0]
    repair = repair_of(build, build.column(square), bars)
    assert repair.action is RepairAction.DISPOSAL_PLAN
    assert repair.exact
    (step,) = repair.steps
    assert step.rebar == "R5"
    assert "特殊处理方案" in repair.advice
    assert "limit 5 mm (no clause, unverified)" in repair.advice
    assert "bend R" not in repair.advice


def test_without_a_limit_of_adjustment_no_bend_is_advised(build: Any, square: Array) -> None:
    bars = np.zeros((12, 2))
    bars[3], bars[9] = [3.2, -3.2], [-3.2, 3.2]
    silent = replace(
        CN, rules=tuple(rule for rule in CN.rules if rule.limits != "rebar_adjustment"), adjustment_limit_mm=None
    )
    repair = repair_of(build, build.column(square), bars, profile=silent)
    assert repair.action is RepairAction.DISPOSAL_PLAN
    assert "does not say how far a bar may be bent" in repair.advice
    assert repair.adjustment_limit_mm is None


@pytest.mark.parametrize(("off_mm", "action"), [(8.0, "reject_sleeve"), (4.6, "bend")])
def test_a_sleeve_that_stands_off_is_rejected_and_its_bar_left_alone(
    off_mm: float, action: str, build: Any, square: Array
) -> None:
    """What a bar can make good within its own 2 mm it does; else the sleeve is what is wrong."""
    sleeves = np.zeros((12, 2))
    sleeves[6] = [off_mm, off_mm]
    repair = repair_of(build, build.column(square), np.zeros((12, 2)), sleeves)
    assert repair.action == action
    step = repair.steps[0]
    if action == "reject_sleeve":
        assert step.sleeve == "S7"
        assert step.sleeve_off_mm == pytest.approx(8.0 * np.sqrt(2.0), abs=1e-6)
        assert "reject the position of S7" in repair.advice
    else:
        assert (step.position_after_mm or 0.0) <= 2.0


def test_in_a_turn_the_bend_is_in_the_frame_of_the_bars(build: Any, square: Array) -> None:
    design = build.column(square)
    quarter = next(found for found in symmetric_turns(square) if found.angle == pytest.approx(np.pi / 2.0))
    offsets = np.random.default_rng(4).normal(0.0, 0.2, (12, 2))
    offsets[0], offsets[4] = [-6.0, 0.0], [0.0, 8.0]
    bars = np.zeros((12, 2))
    bars[quarter.onto] = offsets @ turn(quarter.angle).T
    bars[7] += [0.0, 4.8]
    bars[1] += [0.0, -4.8]
    sleeves, rebars = build.moved(design.sleeves, offsets), build.moved(design.rebars, bars)
    straight = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0), turns=True)
    assert straight.verdict is Verdict.FAIL
    yaw = next(found for found in straight.turns if found.turn_deg == pytest.approx(90.0))
    assert yaw.max_mm is not None
    assert yaw.max_mm < 6.0
    turned = one_turn(design, sleeves, rebars, 90.0)
    repair = advise_repair(design, sleeves, rebars, turned, CN, np.random.default_rng(3))
    assert repair is not None
    (step,) = repair.steps
    assert step.rebar in ("R2", "R8")
    assert step.bend_mm is not None
    assert abs(step.bend_mm[0]) < 1.0, "the bar is bent the way it stands off, not the way its turned sleeve does"
    again = try_assembly(design, sleeves, bent(rebars, repair), CN, np.random.default_rng(0), turns=True)
    assert again.verdict is Verdict.PASS
    assert again.turn_deg == pytest.approx(90.0)


def one_turn(design: ColumnDesign, sleeves: Points, rebars: Points, turn_deg: float) -> TrialReport:
    """The trial in one turn alone: the bars are renamed after the sleeves that they would enter."""
    option = next(
        found
        for found in symmetric_turns(np.array([p.centre for p in design.sleeves]))
        if np.degrees(found.angle) == pytest.approx(turn_deg)
    )
    pairs, missing = form_pairs(design, sleeves, rebars, option.onto.tolist())
    report = _try_pairs(pairs, missing, CN, np.random.default_rng(0), "guarded", 100)
    return replace(report, turn_deg=turn_deg)


def test_where_another_pose_is_free_no_bar_is_bent(build: Any, square: Array) -> None:
    """One tight sleeve touches at the pose of the least distance, and not a little aside: the trial passes there."""
    design = build.column(square, sleeve_mm=36.0)
    tight = list(design.sleeves)
    tight[6] = replace(tight[6], diameter_mm=25.5)
    bars = np.zeros((12, 2))
    bars[6] = [2.4, 0.0]
    design = replace(design, sleeves=tuple(tight))
    trial, repair = advised(design, build.moved(design.sleeves, 0 * bars), build.moved(design.rebars, bars))
    assert trial.verdict is Verdict.PASS
    assert repair is None


def test_the_bar_that_is_wrong_is_bent_and_not_its_good_neighbour(build: Any, square: Array) -> None:
    """R6 stands 3.6 mm off, R12 opposite 1.8 mm within its own limit: each bend would do, that of R12 is shorter."""
    for seed in range(6):
        rng = np.random.default_rng(seed)
        bars = rng.normal(0.0, 0.15, (12, 2))
        away = square[5, :2] / np.hypot(*square[5, :2])
        bars[5], bars[11] = 4.6 * away, -1.85 * away
        design = build.column(square)
        trial, repair = advised(
            design, build.moved(design.sleeves, 0 * bars, 0.05), build.moved(design.rebars, bars, 0.05)
        )
        assert trial.verdict is Verdict.FAIL
        assert repair is not None
        assert [step.rebar for step in repair.steps] == ["R6"]
        assert repair.still_fails == ()


def test_what_still_fails_then_is_said(build: Any, square: Array) -> None:
    """R6 is in the way; R2 stands 2.6 mm off its place, so does its sleeve, and the trial does not mind."""
    bars, mouths = np.zeros((12, 2)), np.zeros((12, 2))
    bars[5] = [7.0, 0.0]
    bars[1] = mouths[1] = [0.0, 2.9]
    repair = repair_of(build, build.column(square), bars, mouths)
    assert "R6" in {step.rebar for step in repair.steps}
    assert repair.still_fails == ("R2",)
    assert "Still beyond its own limit of position then: R2" in repair.advice


@pytest.mark.parametrize("seed", range(8))
def test_followed_advice_lets_the_column_in_as_it_truly_stands(seed: int, build: Any, square: Array) -> None:
    """What is bent is the true bar, by what was read off a scan with errors; then no error may stand in the way."""
    rng, u_mm = np.random.default_rng(seed), 0.12
    true = rng.normal(0.0, 0.6, (12, 2))
    angle = rng.uniform(0.0, 2.0 * np.pi)
    true[int(rng.integers(12))] += 6.0 * np.array([np.cos(angle), np.sin(angle)])
    design = build.column(square, sleeve_mm=30.0)
    noise = rng.normal(0.0, u_mm, (2, 12, 2))
    trial, repair = advised(
        design, build.moved(design.sleeves, noise[0], u_mm), build.moved(design.rebars, true + noise[1], u_mm)
    )
    if repair is None or repair.action is not RepairAction.BEND or (repair.probability or 0.0) < 0.95:
        pytest.skip("nothing is promised")
    as_built = build.moved(design.sleeves, 0 * true), bent(build.moved(design.rebars, true), repair)
    assert try_assembly(design, *as_built, CN, np.random.default_rng(0)).verdict is Verdict.PASS
    assert trial.verdict is not Verdict.PASS


def test_a_bar_whose_lean_alone_takes_the_room_is_set_upright(build: Any, square: Array) -> None:
    design = build.column(square, sleeve_mm=27.5)
    still = np.zeros((12, 2))
    rebars = build.moved(design.rebars, still)
    rebars[3] = build.moved(design.rebars, still, lean=np.array([np.tan(np.radians(2.0)), 0.0]))[3]
    trial, repair = advised(design, build.moved(design.sleeves, still), rebars)
    assert "S4" in trial.collisions
    assert repair is not None
    (step,) = repair.steps
    assert step.rebar == "R4"
    assert step.upright
    assert repair.action is RepairAction.BEND
    assert "set it upright" in repair.advice


def test_no_bend_helps_a_bar_that_is_wider_than_its_sleeve(build: Any, square: Array) -> None:
    design = build.column(square)
    narrow = list(design.sleeves)
    narrow[2] = replace(narrow[2], diameter_mm=23.0)
    repair = repair_of(build, replace(design, sleeves=tuple(narrow)), np.zeros((12, 2)))
    (step,) = repair.steps
    assert step.action is RepairAction.DISPOSAL_PLAN
    assert step.bend_mm is None
    assert "no bend helps: R3 over its ribs" in repair.advice


def test_inconclusive_is_told_to_rescan_first(build: Any, square: Array) -> None:
    bars = np.zeros((12, 2))
    bars[0], bars[6] = [-2.9 / np.sqrt(2.0)] * 2, [2.9 / np.sqrt(2.0)] * 2
    repair = repair_of(build, build.column(square), bars, u_mm=0.15)
    assert repair.action is RepairAction.RESCAN
    assert repair.steps == ()
    assert "rescan closer" in repair.advice
    beyond = repair_of(build, build.column(square), bars * (3.05 / 2.9), u_mm=0.15)
    assert beyond.action is RepairAction.BEND
    assert "rescan closer; if that confirms it, bend" in beyond.advice


def test_many_bars_are_the_best_found_and_said_so(build: Any, square: Array) -> None:
    design = build.column(square)
    bars = np.random.default_rng(11).normal(0.0, 3.2, (12, 2))
    sleeves, rebars = build.moved(design.sleeves, 0 * bars), build.moved(design.rebars, bars)
    _, repair = advised(design, sleeves, rebars)
    assert repair is not None
    assert len(repair.steps) > 3
    assert not repair.exact
    again = try_assembly(design, sleeves, bent(rebars, repair), CN, np.random.default_rng(0))
    assert again.minimax is not None
    assert again.minimax.max_mm <= 3.0 + 1e-6
    if repair.action is RepairAction.BEND:
        assert "fewer bars might do" in repair.advice


def test_no_advice_on_what_passes_or_was_not_measured(build: Any, square: Array) -> None:
    design = build.column(square)
    still = np.zeros((12, 2))
    sleeves, rebars = build.moved(design.sleeves, still), build.moved(design.rebars, still)
    assert advised(design, sleeves, rebars)[1] is None
    assert advised(design, sleeves, [None, *rebars[1:]])[1] is None
    far = build.moved(design.rebars, still)
    far[4] = build.moved(design.rebars, np.tile([9.0, 0.0], (12, 1)))[4]
    trial, repair = advised(design, sleeves, [None, *far[1:]])
    assert trial.verdict is Verdict.FAIL
    assert repair is not None
    assert repair.notes == ("not measured, and not in this advice: R1",)
