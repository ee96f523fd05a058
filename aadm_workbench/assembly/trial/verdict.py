"""The verdict on a trial assembly: does a pose exist in which every pair keeps its limit and its room."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.decision import PASS_PROBABILITY, decide_probability
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.best_pose import BestFit
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.pose.minimax import find_window
from aadm_workbench.assembly.pose.pose_probability import Existence
from aadm_workbench.assembly.tolerances import applicable_rules, not_assessed, rule_result
from aadm_workbench.model import PairResult, PoseWindow, Profile, Reason, RuleResult, TrialPose, TrialReport, Verdict

QUANTITY = "sleeve_rebar_distance"
NO_POSE = Reason("assembly.no_pose")

_MOST_RESCANNED = 2  # a person scans again once or twice, and then sees further
_OF_THE_WORST = 0.5  # of the worst one's share: the second counts as long as it is about as bad


def collisions(pose: TrialPose) -> tuple[str, ...]:
    """Labels of the sleeves whose bars touch at that pose."""
    return tuple(pair.sleeve for pair in pose.pairs if _collides(pair))


def judge_trial(
    report: TrialReport, pairs: Sequence[Pair], fit: BestFit, existence: Existence | None, profile: Profile
) -> TrialReport:
    """Verdict of a trial with its margin, its window and its reasons.

    The probability that a pose exists decides, or, where there is none, whether one does by value alone; a trial fails
    only where the measured values themselves say that none does, and passes only where every pair was seen well enough
    to hold its limit. What does not fail but lacks a pair is not measured, and no probability is stated of it: that of
    the other pairs says nothing of the one that nobody saw. Where these alone have no pose, all have none, and theirs
    is the most that it can be.

    Parameters
    ----------
    report
        Holding the poses and the missing points.
    fit
        The best pose.
    existence
        How likely it is that a pose exists; None decides by value alone.
    """
    if existence is None:
        verdict = Verdict.PASS if fit.exists else Verdict.FAIL
    else:
        verdict = decide_probability(existence.probability, fit.exists or not existence.contradicted)
        if existence.hardly_seen.any() and verdict is Verdict.PASS:
            verdict = Verdict.INCONCLUSIVE
    by_measure = verdict
    if report.missing and verdict is not Verdict.FAIL:
        verdict = Verdict.NOT_MEASURED
    rescan: tuple[tuple[str, str], ...] = ()
    if by_measure is Verdict.INCONCLUSIVE and existence is not None:
        rescan = points_to_rescan(pairs, fit, existence)
    return replace(
        report,
        verdict=verdict,
        reasons=_reasons(report, verdict, by_measure, existence, rescan),
        rules=_rules(profile, report, by_measure),
        probability=None if existence is None or verdict is Verdict.NOT_MEASURED else existence.probability,
        margin=fit.margin,
        window=_window(fit) if fit.exists else None,
        notes=_notes(pairs, report.missing if verdict is Verdict.NOT_MEASURED and existence is not None else ()),
        rescan=tuple(label for label, _ in rescan),
    )


def judge_without_limits(report: TrialReport) -> TrialReport:
    """Verdict where no rule limits the distance and no room is known for every pair: only a collision is certain."""
    if report.minimax is not None and report.collisions:
        reasons = tuple(pair.reason for pair in report.minimax.pairs if _collides(pair))
        return replace(report, verdict=Verdict.FAIL, reasons=reasons)
    reason = Reason("assembly.no_limit_nor_room")
    return replace(report, verdict=Verdict.NOT_ASSESSED, reasons=(reason,))


def points_to_rescan(pairs: Sequence[Pair], fit: BestFit, existence: Existence) -> tuple[tuple[str, str], ...]:
    """Labels of the points whose uncertainty leaves it open whether a pose exists, and what is to be said of each.

    Of the pairs that break a limit in most draws, and that decide at the best pose or cannot be decided at any, each
    gives the one of its two points that is known worse.
    """
    weight = existence.violated * np.array([pair_u_mm(pair) for pair in pairs])
    if not weight.any():
        weight = fit.multipliers
    order = np.argsort(-weight, kind="stable")[:_MOST_RESCANNED]
    return tuple(_to_rescan(pairs[k]) for k in order.tolist() if weight[k] >= _OF_THE_WORST * weight[order[0]])


def pair_u_mm(pair: Pair) -> float:
    """Standard uncertainty per axis of a pair, mm, of its centres and of both leans over the embedded length."""
    parts = (pair.covariance, pair.bar_shift_covariance, pair.sleeve_shift_covariance)
    return math.sqrt(sum(float(np.trace(part)) / 2.0 for part in parts if part is not None))


def _to_rescan(pair: Pair) -> tuple[str, str]:
    label = pair.sleeve if pair.sleeve_u_mm > pair.rebar_u_mm else pair.rebar
    return label, Reason("assembly.with_u", label=label, u_mm=max(pair.sleeve_u_mm, pair.rebar_u_mm))


def _collides(pair: PairResult) -> bool:
    return pair.clearance_mm is not None and pair.clearance_mm < 0.0


def _reasons(
    report: TrialReport,
    verdict: Verdict,
    by_measure: Verdict,
    existence: Existence | None,
    rescan: tuple[tuple[str, str], ...],
) -> tuple[str, ...]:
    pairs = () if report.best is None else report.best.pairs
    reasons: list[str] = []
    if verdict is Verdict.FAIL:
        reasons += [pair.reason for pair in pairs if pair.reason and (pair.verdict is Verdict.FAIL or _collides(pair))]
        reasons = reasons or [NO_POSE]
    if existence is not None and by_measure is not Verdict.PASS:
        of = "assembly.probability.of_measured" if report.missing else "assembly.probability"
        text = Reason(of, percent=100.0 * existence.probability)
        if by_measure is Verdict.INCONCLUSIVE:
            likely = existence.probability >= PASS_PROBABILITY
            code = "assembly.hardly_seen" if likely else "assembly.undecided"
            text = Reason(f"{code}.above_all" if rescan else code, text=text, points=[said for _, said in rescan])
        reasons.append(text)
    if report.missing:
        reasons.append(Reason("assembly.missing", labels=report.missing))
    return tuple(reasons)


def _rules(profile: Profile, report: TrialReport, by_measure: Verdict) -> tuple[RuleResult, ...]:
    rules, skipped = applicable_rules(profile, QUANTITY)
    largest_mm = 0.0 if report.minimax is None else report.minimax.max_mm
    results = []
    for index, rule in enumerate(rules):
        looser = Verdict.PASS if largest_mm <= rule.upper else Verdict.FAIL
        verdict = by_measure if index == 0 else looser
        reason = "" if verdict is Verdict.PASS else _why(report, largest_mm, rule.upper)
        results.append(rule_result(rule, verdict, reason, largest_mm))
    return (*results, *(not_assessed(rule, Reason("assembly.of_no_pair")) for rule in skipped))


def _why(report: TrialReport, largest_mm: float, limit_mm: float) -> str:
    code = "assembly.largest.no_room" if largest_mm <= limit_mm and report.collisions else "assembly.largest"
    return Reason(code, largest_mm=largest_mm, limit_mm=limit_mm, sleeves=report.collisions)


def _window(fit: BestFit) -> PoseWindow | None:
    """How far the column, the sleeves, can move from the best pose while all gaps stay in their limits."""
    bars = fit.gaps.source @ turn(fit.yaw).T + fit.shift
    return find_window(fit.gaps.target, bars, fit.gaps.limits_mm)


def _notes(pairs: Sequence[Pair], without: Sequence[str]) -> tuple[str, ...]:
    """What bears on the trial; ``without`` are the labels for lack of which no probability is stated."""
    notes = []
    if without:
        notes.append(Reason("assembly.no_probability", labels=without))
    if any(pair.room_mm is None for pair in pairs):
        notes.append(Reason("assembly.room_not_checked"))
    seen = [pair.seen_length_mm for pair in pairs if pair.seen_length_mm is not None]
    if seen:
        notes.append(Reason("assembly.seen_length", least_mm=min(seen), most_mm=max(seen)))
    return tuple(notes)
