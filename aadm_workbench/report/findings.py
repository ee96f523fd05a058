"""What a report says of each column, worst first, and of its reasons the decisive ones first."""

from __future__ import annotations

from dataclasses import dataclass

from aadm_workbench.model import ColumnReport, JobReport, codes_of
from aadm_workbench.report.hoist import Hoist, hoist_of, worst_first
from aadm_workbench.report.words.labels import Phrase
from aadm_workbench.report.words.reasons import in_both_languages, recognised

_SHOWN = 2  # reasons: a person reads two, the table has all


@dataclass(frozen=True)
class Finding:
    """A column, the name of its place in the document, whether it may be hoisted, and its decisive reasons."""

    column: ColumnReport
    anchor: str
    hoist: Hoist
    key_reasons: tuple[Phrase, ...]
    more: int

    @property
    def is_told(self) -> bool:
        """Whether there are but words to say: nothing of the column was measured."""
        return not self.column.groups and not self.column.hoisting_frames


def findings(report: JobReport) -> list[Finding]:
    """One for each column, the worst first."""
    found = []
    for number, column in enumerate(worst_first(report), start=1):
        reasons = _decisive(column)
        shown = tuple(in_both_languages(text) for text in reasons[:_SHOWN])
        found.append(Finding(column, f"column-{number}", hoist_of(column), shown, max(0, len(reasons) - _SHOWN)))
    return found


def _decisive(column: ColumnReport) -> list[str]:
    """The column's reasons; those of the trial first where it is the trial that fails."""
    reasons = list(column.reasons)
    codes = [codes_of(recognised(reason)) for reason in reasons]
    # "not measured: S7" of the trial says less than "S7 not measured: the mouth is plugged" of the foot.
    if any("assembly.not_measured" in one for one in codes):
        reasons = [reason for reason, one in zip(reasons, codes, strict=True) if one != {"assembly.missing"}]
    if column.goes_on == "fail" and column.trial_assembly is not None:
        of_trial = set(column.trial_assembly.reasons)
        reasons.sort(key=lambda reason: reason not in of_trial)
    return reasons
