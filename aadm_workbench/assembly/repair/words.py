"""Advice on a repair in one line, as the terminal and report.json give it."""

from __future__ import annotations

from aadm_workbench.assembly.decision import PASS_PROBABILITY
from aadm_workbench.model import RepairAction, RepairReport, RepairStep, TrialReport, Verdict

DISPOSAL_PLAN = "a disposal plan (特殊处理方案) agreed with the designer is needed"
NOTHING_FOUND = f"no set of bars was found whose bending would let the column in: {DISPOSAL_PLAN}"

ADVICE_TO_RESCAN = "rescan closer: at the measured values the column goes in, no bar has to be bent"

_MOST_NAMED = 3  # more of them make no line
_RELEASE = "subject to the engineer's release"


def advice_on_steps(report: RepairReport, trial: TrialReport) -> str:
    """What to do about each pair, and what the trial comes to once it is done."""
    if report.action is RepairAction.DISPOSAL_PLAN:
        why = [step.reason for step in report.steps if step.action is RepairAction.DISPOSAL_PLAN]
        more = f"; and {len(why) - _MOST_NAMED} more" if len(why) > _MOST_NAMED else ""
        return f"{_RELEASE}: no bend can be advised; {DISPOSAL_PLAN}: {'; '.join(why[:_MOST_NAMED])}{more}"
    parts = [_of_step(step) for step in report.steps]
    first = "rescan closer; if that confirms it, " if trial.verdict is Verdict.INCONCLUSIVE else ""
    bars = "" if report.exact else " (the best that was found; fewer bars might do)"
    return f"{_RELEASE}: {first}{'; '.join(parts)}{bars}{_outcome(report)}{_still(report)}"


def _of_step(step: RepairStep) -> str:
    if step.action is RepairAction.REJECT_SLEEVE:
        return f"reject the position of {step.sleeve}: {step.reason}"
    dx, dy = step.bend_mm or (0.0, 0.0)
    text = f"bend {step.rebar} by ({dx:+.1f}, {dy:+.1f}) mm"
    if step.upright:
        text += " and set it upright"
    return text + (f"; {step.reason}" if step.reason else "")


def _outcome(report: RepairReport) -> str:
    if report.after is None:
        return ""
    then = f". Then the largest distance is {report.after.max_mm:.2f} mm"
    if report.probability is not None and report.probability < PASS_PROBABILITY:
        then += f", and the trial may stay inconclusive (a pose exists with {100.0 * report.probability:.0f} %)"
    return then


def _still(report: RepairReport) -> str:
    """What fails even then: the position of bars that the trial does not ask for."""
    if not report.still_fails:
        return ""
    one = len(report.still_fails) == 1
    return f". Still beyond {'its' if one else 'their'} own limit of position then: {', '.join(report.still_fails)}"
