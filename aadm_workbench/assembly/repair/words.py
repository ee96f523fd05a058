"""Advice on a repair in one line, as the terminal and report.json give it."""

from __future__ import annotations

from aadm_workbench.assembly.decision import PASS_PROBABILITY
from aadm_workbench.model import Reason, RepairAction, RepairReport, RepairStep, TrialReport, Verdict, in_one

DISPOSAL_PLAN = Reason("assembly.disposal_plan")
NOTHING_FOUND = Reason("assembly.no_bars_found", plan=DISPOSAL_PLAN)

ADVICE_TO_RESCAN = Reason("assembly.rescan")

_MOST_NAMED = 3  # more of them make no line


def advice_on_steps(report: RepairReport, trial: TrialReport) -> Reason:
    """What to do about each pair, and what the trial comes to once it is done."""
    if report.action is RepairAction.DISPOSAL_PLAN:
        why = [step.reason for step in report.steps if step.action is RepairAction.DISPOSAL_PLAN]
        more = [Reason("assembly.more", count=len(why) - _MOST_NAMED)] if len(why) > _MOST_NAMED else []
        return Reason("assembly.advise_plan", plan=DISPOSAL_PLAN, why=[*why[:_MOST_NAMED], *more])
    what = Reason("said.all", parts=[_of_step(step) for step in report.steps])
    if not report.exact:
        what = Reason("assembly.best_found", what=what)
    if report.after is not None:
        what = _outcome(what, report.after.max_mm, report.probability)
    if report.still_fails:
        one = len(report.still_fails) == 1
        code = "assembly.still_beyond" if one else "assembly.still_beyond.several"
        what = Reason(code, what=what, labels=report.still_fails)
    doubtful = trial.verdict is Verdict.INCONCLUSIVE
    return Reason("assembly.advise.if_confirmed" if doubtful else "assembly.advise", what=what)


def _of_step(step: RepairStep) -> str:
    if step.action is RepairAction.REJECT_SLEEVE:
        return Reason("assembly.reject", sleeve=step.sleeve, why=step.reason)
    dx, dy = step.bend_mm or (0.0, 0.0)
    text = Reason("assembly.bend.upright" if step.upright else "assembly.bend", rebar=step.rebar, dx=dx, dy=dy)
    return in_one([text, step.reason] if step.reason else [text])


def _outcome(what: Reason, max_mm: float, probability: float | None) -> Reason:
    if probability is not None and probability < PASS_PROBABILITY:
        return Reason("assembly.after.doubtful", what=what, max_mm=max_mm, percent=100.0 * probability)
    return Reason("assembly.after", what=what, max_mm=max_mm)
