"""What would let a column go on its bars: the fewest bars to bend, by which vectors, or the sleeve to reject.

Of all sets of the smallest size the one is chosen in which every bar stays within its own limit of position, then the
one that bends least. Advice is all that this is: it is subject to the engineer's release, and beyond the profile's
``rebar_adjustment`` it is no bend but a disposal plan agreed with the designer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.eopa import NoFit
from aadm_workbench.assembly.existence import probability_of_a_pose
from aadm_workbench.assembly.minimax import fit_minimax
from aadm_workbench.assembly.repair_case import RepairCase, repair_case
from aadm_workbench.assembly.repair_plan import RepairPlan, after_repair, choose_plan
from aadm_workbench.assembly.repair_search import of_bars_that_stay, smallest_sets, within_reach
from aadm_workbench.assembly.repair_steps import repair_steps
from aadm_workbench.assembly.repair_words import NOTHING_FOUND, advice_on_pose, advice_on_steps
from aadm_workbench.assembly.tolerances import describe_clause
from aadm_workbench.assembly.trial_pose import evaluate_pose
from aadm_workbench.assembly.trial_verdict import collisions
from aadm_workbench.model import (
    AssemblyPoint,
    ColumnDesign,
    Profile,
    RepairAction,
    RepairReport,
    TrialReport,
    Verdict,
)

SAMPLES = 1000

_GRAVEST_FIRST = tuple(reversed(RepairAction))


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
    found = _best_plan(case)
    if found is None:
        return RepairReport(RepairAction.DISPOSAL_PLAN, NOTHING_FOUND, exact=False)
    plan, exact = found
    report = _tried_again(_report(case, plan, exact, trial), case, plan, decision, generator)
    advice = advice_on_steps(report, trial) if plan.bends else advice_on_pose(report, case, plan)
    notes = (f"not measured, and not in this advice: {', '.join(trial.missing)}",) if trial.missing else ()
    return replace(report, advice=advice, notes=(*report.notes, *notes))


def _best_plan(case: RepairCase) -> tuple[RepairPlan, bool] | None:
    """The plan to advise, and whether no smaller set of bars would do.

    A larger set within the adjustment limit takes the place of a smaller one beyond it only where it keeps every bar
    near its own place: one bar that stands far off is no reason to bend its neighbours after it.
    """
    count, stay = len(case.pairs), of_bars_that_stay(case.constraints)
    sets, exact = smallest_sets([stay], count)
    if case.adjustment_mm is not None:
        reach = within_reach(case.constraints, case.rebars, case.sleeves, case.places, case.adjustment_mm)
        reachable, proven = smallest_sets([stay, reach], count)
        if reachable:
            plan = choose_plan(case, reachable, [stay, reach], case.adjustment_mm)
            if plan.within_own or len(reachable[0].bent) == len(sets[0].bent):
                return plan, proven
    return (choose_plan(case, sets, [stay], None), exact) if sets else None


def _report(case: RepairCase, plan: RepairPlan, exact: bool, trial: TrialReport) -> RepairReport:
    steps = repair_steps(case, plan)
    if steps:
        present = {step.action for step in steps}
        action = next(action for action in _GRAVEST_FIRST if action in present)
    else:
        action = RepairAction.REPOSITION if trial.collisions else RepairAction.RESCAN
    return RepairReport(
        action=action,
        advice="",
        steps=steps,
        exact=exact,
        adjustment_limit_mm=case.adjustment_mm,
        clause="" if case.adjustment_rule is None else describe_clause(case.adjustment_rule),
    )


def _tried_again(
    report: RepairReport, case: RepairCase, plan: RepairPlan, decision: DecisionRule, generator: np.random.Generator
) -> RepairReport:
    """The trial once all steps are done; at the plan's own pose where that of the least distance still collides."""
    pairs = after_repair(case, plan)
    rebars, sleeves = np.array([pair.rebar_xy for pair in pairs]), case.sleeves
    fit = fit_minimax(rebars, sleeves, case.limits_mm)
    if isinstance(fit, NoFit) or any(step.bend_mm is None for step in report.steps):
        return report
    after = evaluate_pose(pairs, fit.yaw, fit.shift, case.distance_rule, decision)
    notes: tuple[str, ...] = ()
    if collisions(after):
        after = evaluate_pose(pairs, plan.yaw, plan.shift, case.distance_rule, decision)
        notes = ("it goes in without touching at the pose given here, not at that of the least distance",)
    probability = None
    if decision == "guarded":
        probability = probability_of_a_pose(pairs, case.limits_mm, fit.yaw, fit.shift, generator, SAMPLES)
    return replace(report, after=after, margin=fit.margin, probability=probability, notes=notes)
