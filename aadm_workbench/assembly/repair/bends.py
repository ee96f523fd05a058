"""What would let a column go on its bars: the fewest bars to bend, by which vectors, or the sleeve to reject.

Bars that stand beyond their own limit of position are tried first, then those whose sleeves do, then all: a bar that
is right is not bent after one that is wrong. Of all sets of the smallest size the one is chosen in which every bar
stays within its own limit, then the one that bends least. The limits are narrowed by what is not known, and the trial
is made again with the bars as they then stand. Advice is all that this is: it is subject to the engineer's release, and
beyond the profile's ``rebar_adjustment`` it is no bend but a disposal plan agreed with the designer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.decision import PASS_PROBABILITY, DecisionRule
from aadm_workbench.assembly.pose.best_pose import fit_best_pose
from aadm_workbench.assembly.pose.eopa import NoFit
from aadm_workbench.assembly.pose.pose_probability import existence_of_a_pose
from aadm_workbench.assembly.repair.case import RepairCase, guarded_case, repair_case
from aadm_workbench.assembly.repair.plan import RepairPlan, after_repair, choose_plan
from aadm_workbench.assembly.repair.search import of_bars_that_stay, smallest_sets, within_reach
from aadm_workbench.assembly.repair.steps import repair_steps, still_beyond
from aadm_workbench.assembly.tolerances import describe_clause
from aadm_workbench.assembly.trial.pose import evaluate_best_pose
from aadm_workbench.model import (
    AssemblyPoint,
    BoolArray,
    ColumnDesign,
    Profile,
    Reason,
    RepairAction,
    RepairReport,
    RepairStep,
    TrialReport,
    Verdict,
    in_one,
)

SAMPLES = 1000
"""As of the trial itself (existence.py)."""

_GRAVEST_FIRST = tuple(reversed(RepairAction))

DISPOSAL_PLAN = Reason("repair.disposal_plan")
NOTHING_FOUND = Reason("repair.no_bars_found", plan=DISPOSAL_PLAN)

ADVICE_TO_RESCAN = Reason("repair.rescan")

_MOST_NAMED = 3  # more of them make no line


def advise_repair(
    design: ColumnDesign,
    sleeves: Sequence[AssemblyPoint | None],
    rebars: Sequence[AssemblyPoint | None],
    trial: TrialReport,
    profile: Profile,
    generator: np.random.Generator,
    *,
    decision: DecisionRule = "guarded",
) -> RepairReport | None:
    """Advice on a column whose trial fails or is inconclusive; None for any other, and for one without limits.

    Parameters
    ----------
    sleeves, rebars
        What the trial was made with: measured, in the column frame, in the order of the design.
    trial
        Its turn is the one that the advice is for.
    generator
        For the probability that a pose exists once all is done, in a guarded decision.
    """
    if trial.verdict not in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        return None
    case = repair_case(design, sleeves, rebars, trial, profile)
    if case is None:
        return None
    if case.best.exists:
        plan, exact = RepairPlan((), case.best.yaw, case.best.shift, True, case.best.ratio), True
    else:
        found = _best_plan(guarded_case(case)) or _best_plan(case)
        if found is None:
            return RepairReport(RepairAction.DISPOSAL_PLAN, NOTHING_FOUND, exact=False)
        plan, exact = found
    report = _tried_again(_report(case, plan, exact), case, plan, decision, generator)
    advice = advice_on_steps(report, trial) if plan.bends else ADVICE_TO_RESCAN
    if trial.missing:
        notes = (*report.notes, Reason("repair.not_in_advice", labels=trial.missing))
        return replace(report, advice=advice, notes=notes, probability=None)
    return replace(report, advice=advice)


def _best_plan(case: RepairCase) -> tuple[RepairPlan, bool] | None:
    """The plan to advise among the first kind of bars that helps, and whether no smaller set of these would do."""
    kinds = (case.rebar_fails, case.rebar_fails | case.sleeve_fails, np.ones(len(case.pairs), dtype=bool))
    tried: list[BoolArray] = []
    for among in kinds:
        if not among.any() or any(np.array_equal(among, other) for other in tried):
            continue
        found = _plan_among(case, among)
        if found is not None:
            return found
        tried.append(among)
    return None


def _plan_among(case: RepairCase, among: BoolArray) -> tuple[RepairPlan, bool] | None:
    """The plan to advise of those that bend only some bars (n,).

    A larger set within the adjustment limit takes the place of a smaller one beyond it only where it keeps every bar
    near its own place: one bar that stands far off is no reason to bend its neighbours after it.
    """
    count, stay = len(case.pairs), of_bars_that_stay(case.constraints)
    near: tuple[RepairPlan, bool, int] | None = None
    if case.adjustment_mm is not None:
        reach = within_reach(case.constraints, case.rebars, case.sleeves, case.places, case.adjustment_mm)
        reachable, proven = smallest_sets([stay, reach], count, among)
        if reachable:
            plan = choose_plan(case, reachable, [stay, reach], case.adjustment_mm)
            if plan.within_own:
                return plan, proven
            near = plan, proven, len(reachable[0].bent)
    sets, exact = smallest_sets([stay], count, among)
    if near is not None and sets and len(sets[0].bent) == near[2]:
        return near[:2]
    return (choose_plan(case, sets, [stay], None), exact) if sets else None


def _report(case: RepairCase, plan: RepairPlan, exact: bool) -> RepairReport:
    steps = repair_steps(case, plan)
    present = {step.action for step in steps}
    action = next((action for action in _GRAVEST_FIRST if action in present), RepairAction.RESCAN)
    return RepairReport(
        action=action,
        advice="",
        steps=steps,
        exact=exact,
        adjustment_limit_mm=case.adjustment_mm,
        clause="" if case.adjustment_rule is None else describe_clause(case.adjustment_rule),
        working_figure=case.adjustment_rule is not None and case.adjustment_rule.working_figure,
    )


def _tried_again(
    report: RepairReport, case: RepairCase, plan: RepairPlan, decision: DecisionRule, generator: np.random.Generator
) -> RepairReport:
    """The trial once all steps are done, and the bars that then still stand beyond their own limit."""
    pairs = after_repair(case, plan)
    fit = fit_best_pose(pairs, case.limits_mm)
    if isinstance(fit, NoFit) or any(step.bend_mm is None for step in report.steps):
        return report
    existence = None
    if decision == "guarded":
        existence = existence_of_a_pose(pairs, case.limits_mm, fit, generator, SAMPLES)
    return replace(
        report,
        after=evaluate_best_pose(pairs, case.limits_mm, fit, case.distance_rule, decision),
        margin=fit.margin,
        probability=None if existence is None else existence.probability,
        still_fails=still_beyond(case, pairs),
    )


def advice_on_steps(report: RepairReport, trial: TrialReport) -> Reason:
    """What to do about each pair, and what the trial comes to once it is done."""
    if report.action is RepairAction.DISPOSAL_PLAN:
        why = [step.reason for step in report.steps if step.action is RepairAction.DISPOSAL_PLAN]
        more = [Reason("assembly.more", count=len(why) - _MOST_NAMED)] if len(why) > _MOST_NAMED else []
        return Reason("repair.advise_plan", plan=DISPOSAL_PLAN, why=[*why[:_MOST_NAMED], *more])
    what = Reason("said.all", parts=[_of_step(step) for step in report.steps])
    if not report.exact:
        what = Reason("repair.best_found", what=what)
    if report.after is not None:
        what = _outcome(what, report.after.max_mm, report.probability)
    if report.still_fails:
        one = len(report.still_fails) == 1
        code = "repair.still_beyond" if one else "repair.still_beyond.several"
        what = Reason(code, what=what, labels=report.still_fails)
    doubtful = trial.verdict is Verdict.INCONCLUSIVE
    return Reason("repair.advise.if_confirmed" if doubtful else "repair.advise", what=what)


def _of_step(step: RepairStep) -> str:
    if step.action is RepairAction.REJECT_SLEEVE:
        return Reason("repair.reject", sleeve=step.sleeve, why=step.reason)
    dx, dy = step.bend_mm or (0.0, 0.0)
    text = Reason("repair.bend.upright" if step.upright else "repair.bend", rebar=step.rebar, dx=dx, dy=dy)
    return in_one([text, step.reason] if step.reason else [text])


def _outcome(what: Reason, max_mm: float, probability: float | None) -> Reason:
    if probability is not None and probability < PASS_PROBABILITY:
        return Reason("repair.after.doubtful", what=what, max_mm=max_mm, percent=100.0 * probability)
    return Reason("repair.after", what=what, max_mm=max_mm)
