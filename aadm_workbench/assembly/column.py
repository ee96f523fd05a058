"""The verdict on a column: the sum of what was checked of it."""

from __future__ import annotations

from aadm_workbench.assembly.rules import not_assessed
from aadm_workbench.model import GroupReport, Profile, Reason, RuleResult, TrialReport, Verdict, worst

_OF_THE_ERECTED_COLUMN = ("column_axis", "elevation", "verticality")


def sum_up(
    sleeves: GroupReport | None, rebars: GroupReport | None, trial: TrialReport | None
) -> tuple[Verdict, Verdict, tuple[str, ...]]:
    """Verdict of a column, whether it goes on its bars, and the reasons.

    The verdict is the worst of what was asked for (None: not asked for): error, fail, not measured, inconclusive,
    pass. Whether it goes on is the trial's verdict alone: a bar may be 4 mm from design and the column still go on.
    What is in the way is the first reason.
    """
    parts = [part for part in (sleeves, rebars, trial) if part is not None]
    goes_on = Verdict.NOT_ASSESSED if trial is None else trial.verdict
    said = tuple(reason for part in parts if part.verdict is not Verdict.PASS for reason in part.reasons)
    if trial is not None and trial.in_the_way:
        said = (trial.reasons[0], *said)
    return worst(part.verdict for part in parts), goes_on, tuple(dict.fromkeys(said))


def rules_of_the_erected_column(profile: Profile) -> tuple[RuleResult, ...]:
    """The rules of a profile that no scan before hoisting can answer, as not assessed."""
    return tuple(
        not_assessed(rule, Reason("assembly.erected"))
        for rule in profile.rules
        if rule.limits in _OF_THE_ERECTED_COLUMN
    )
