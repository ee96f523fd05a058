"""May this column be hoisted: the one question that a report is opened for.

A column may be hoisted where everything that was asked for passed and its trial assembly says that it goes on. A pass
without a trial (sleeves checked in the yard, before the bars exist) is not cleared yet. All else must not be hoisted.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from aadm_workbench.model import WORST_FIRST, ColumnReport, JobReport
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages

HoistState: TypeAlias = Literal["no", "not_yet", "yes"]

_OPEN = ("undecided", "not_seen")


@dataclass(frozen=True)
class Hoist:
    """Whether a column may be hoisted, its cause in a few words, and the sentences of the check behind it."""

    state: HoistState
    cause: Phrase
    reasons: tuple[Phrase, ...]


def hoist_of(column: ColumnReport) -> Hoist:
    """Whether one column of a report may be hoisted."""
    state, cause = _state(column.verdict, column.goes_on)
    if cause in _OPEN and any(finding.holds_back for finding in column.findings):
        cause = "contradicted"
    return Hoist(state, phrase(f"cause.{cause}"), tuple(in_both_languages(text) for text in column.reasons))


def _state(verdict: str, goes_on: str) -> tuple[HoistState, str]:
    if verdict == "pass":
        return ("yes", "all_good") if goes_on == "pass" else ("not_yet", "no_trial")
    if verdict == "fail":
        return "no", "goes_not_on" if goes_on == "fail" else "out_of_tolerance"
    return "no", {"error": "not_checked", "not_measured": "not_seen"}.get(verdict, "undecided")


def worst_first(report: JobReport) -> list[ColumnReport]:
    """Columns by verdict, the worst first; what does not go on before what does; those alike in the job's order."""
    return sorted(report.columns, key=lambda column: (_rank(column.verdict), column.goes_on != "fail"))


def in_state(report: JobReport, state: HoistState) -> list[ColumnReport]:
    """The columns of a report that may (not) be hoisted, the worst first."""
    return [column for column in worst_first(report) if hoist_of(column).state == state]


def _rank(verdict: str) -> int:
    # What passes without a trial stands before what may be hoisted only by its goes_on; the verdict alone ranks here.
    return WORST_FIRST.index(verdict)


def headline(report: JobReport) -> Phrase:
    """``4 of 8 columns must not be hoisted``; where none must not, how many wait; else that all may."""
    total = len(report.columns)
    state = worst_state(report)
    if total == 1:
        return phrase(f"headline.{_OF_ONE[state]}")
    number = len(in_state(report, state))
    name = {"yes": "all_may", "not_yet": "some_wait"}.get(state, "one_forbidden" if number == 1 else "forbidden")
    return phrase(f"headline.{name}").filled(number=number, total=total)


_OF_ONE = {"yes": "the_one_may", "not_yet": "the_one_waits", "no": "the_one_must_not"}


def worst_state(report: JobReport) -> HoistState:
    """What a report has to say first."""
    states = {hoist_of(column).state for column in report.columns}
    return "no" if "no" in states else "not_yet" if "not_yet" in states else "yes"
