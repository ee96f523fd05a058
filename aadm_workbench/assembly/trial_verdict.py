"""The verdict on a trial assembly, after its minimax pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.decision import decide_probability
from aadm_workbench.assembly.existence import pose_exists
from aadm_workbench.assembly.minimax import MinimaxPose
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.rules import applicable_rules, not_assessed, rule_result
from aadm_workbench.assembly.upright import turn
from aadm_workbench.assembly.window import find_window
from aadm_workbench.model import Array, PairResult, PoseWindow, Profile, RuleResult, TrialPose, TrialReport, Verdict

QUANTITY = "sleeve_rebar_distance"


def collisions(pose: TrialPose) -> tuple[str, ...]:
    """Labels of the sleeves whose bars touch at that pose."""
    return tuple(pair.sleeve for pair in pose.pairs if _collides(pair))


def judge_trial(
    report: TrialReport,
    pairs: Sequence[Pair],
    limits_mm: Array,
    fit: MinimaxPose,
    probability: float | None,
    profile: Profile,
) -> TrialReport:
    """Verdict of a trial with its margin, its window and its reasons.

    A collision at the minimax pose fails. Else the probability that a pose exists decides, or, where there is none,
    the largest ratio of distance to limit. What does not fail but lacks a pair is not measured.

    Parameters
    ----------
    report
        Holding the poses, the collisions and the missing points.
    limits_mm
        (n,) float64, of the distances.
    probability
        That a pose exists; None decides by value alone.
    """
    if report.minimax is None:
        return report
    if probability is None:
        verdict = Verdict.PASS if fit.ratio <= 1.0 else Verdict.FAIL
    else:
        verdict = decide_probability(probability)
    by_distance = verdict
    if report.collisions:
        verdict = Verdict.FAIL
    if report.missing and verdict is not Verdict.FAIL:
        verdict = Verdict.NOT_MEASURED
    return replace(
        report,
        verdict=verdict,
        reasons=_reasons(report, verdict, by_distance, probability),
        rules=_rules(profile, report.minimax, by_distance),
        probability=probability,
        margin=fit.margin,
        window=_window(pairs, fit, limits_mm),
        notes=_notes(report, pairs, fit, limits_mm),
    )


def judge_without_limits(report: TrialReport) -> TrialReport:
    """Verdict where no rule limits the distance and no room is known for every pair: only a collision is certain."""
    if report.minimax is not None and report.collisions:
        reasons = tuple(pair.reason for pair in report.minimax.pairs if _collides(pair))
        return replace(report, verdict=Verdict.FAIL, reasons=reasons)
    reason = "neither a limit of the distance nor the room over the ribs is known"
    return replace(report, verdict=Verdict.NOT_ASSESSED, reasons=(reason,))


def _collides(pair: PairResult) -> bool:
    return pair.clearance_mm is not None and pair.clearance_mm < 0.0


def _reasons(report: TrialReport, verdict: Verdict, by_distance: Verdict, probability: float | None) -> tuple[str, ...]:
    pairs = () if report.minimax is None else report.minimax.pairs
    reasons: list[str] = []
    if verdict is Verdict.FAIL:
        reasons += [pair.reason for pair in pairs if pair.reason and (pair.verdict is Verdict.FAIL)]
        if by_distance is Verdict.FAIL and not reasons:
            reasons.append("no pose brings every rebar into its sleeve")
    if probability is not None and by_distance is not Verdict.PASS:
        reasons.append(f"the probability that a pose exists is {100.0 * probability:.1f} %")
    if by_distance is Verdict.INCONCLUSIVE:
        reasons[-1] += ", too close to the limit for the uncertainty: rescan closer"
    if report.missing:
        reasons.append(f"not measured: {', '.join(report.missing)}")
    return tuple(reasons)


def _rules(profile: Profile, minimax: TrialPose, by_distance: Verdict) -> tuple[RuleResult, ...]:
    rules, skipped = applicable_rules(profile, QUANTITY)
    results = []
    for index, rule in enumerate(rules):
        looser = Verdict.PASS if minimax.max_mm <= rule.upper else Verdict.FAIL
        verdict = by_distance if index == 0 else looser
        reason = "" if verdict is Verdict.PASS else f"largest distance {minimax.max_mm:.2f} mm, limit {rule.upper:g} mm"
        results.append(rule_result(rule, verdict, reason, minimax.max_mm))
    return (*results, *(not_assessed(rule, "it is no limit of a single pair") for rule in skipped))


def _window(pairs: Sequence[Pair], fit: MinimaxPose, limits_mm: Array) -> PoseWindow | None:
    """How far the column, the sleeves, can move from the minimax pose while all distances stay in their limits."""
    rotation = turn(fit.yaw)
    bars = np.array([rotation @ pair.rebar_xy + fit.shift for pair in pairs])
    return find_window(np.array([pair.sleeve_xy for pair in pairs]), bars, limits_mm)


def _notes(report: TrialReport, pairs: Sequence[Pair], fit: MinimaxPose, limits_mm: Array) -> tuple[str, ...]:
    notes = []
    if any(pair.room_mm is None for pair in pairs):
        notes.append("clearance over the ribs not checked: the outer diameter of a bar is not known")
    if report.collisions and fit.ratio <= 1.0 and pose_exists(pairs, limits_mm, fit.yaw, fit.shift):
        notes.append(
            "another pose within the limits is free of collisions, but it is not the one with the least distance"
        )
    return tuple(notes)
