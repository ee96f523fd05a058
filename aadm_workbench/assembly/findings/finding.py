"""The one place where findings are made: a code, what it is about, its values, and the sentence that they fill.

And what they do to a verdict: one that holds back keeps a column from passing, and from being hoisted. One scan that is
named for two columns, or twice for one, is found by the hash of its file, whatever it is called.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.assembly.pairs import PlacedPoint, place_points
from aadm_workbench.model import (
    AssemblyPoint,
    ColumnReport,
    Extraction,
    Finding,
    GroupReport,
    Kind,
    Reason,
    TrialReport,
    Verdict,
    worst,
)
from aadm_workbench.model.made import changed, each

NOT_MEASURED = ("mirrored", "swapped", "turn_contradicted", "other_column", "sleeves_by_design")
"""What was to be measured was not scanned, or not measured; all else that holds back leaves a verdict open."""

SPOILS_ALL = (*NOT_MEASURED, "same_scan_twice", "scale_differs")
"""These stand before whatever else is said: with them no deviation is to be believed."""

_NAMED = 4  # more of them make no sentence


def make_finding(name: str, about: Sequence[str], **values: Any) -> Finding:
    """A finding that holds back, whose sentence is ``name``, a code with or without a part after a dot.

    Parameters
    ----------
    name
        The code of its sentence in :mod:`aadm_workbench.model.sentences.finding`, without the first part.
    about
        Labels of points, or ``sleeves``, ``rebars``, ``column``.
    values
        What the sentence says; numbers as they are, the sentence rounds them.
    """
    text = Reason(f"finding.{name}", about=about, **values)
    return Finding(name.partition(".")[0], tuple(about), values, text, holds_back=True)


def held_back(report: ColumnReport, findings: Sequence[Finding], superseded: Sequence[str] = ()) -> ColumnReport:
    """The report with some findings more, in its verdicts too.

    Parameters
    ----------
    superseded
        Reasons that a finding says better.
    """
    if not findings:
        return report
    holding = [finding for finding in findings if finding.holds_back]
    told = [finding.text for finding in findings if not finding.holds_back]
    verdict = worst((report.verdict, *(_verdict_of(finding) for finding in holding)))
    trial = report.trial_assembly
    goes_on = report.goes_on
    if holding and report.goes_on is Verdict.PASS and trial is not None:
        trial = _held_trial(trial, holding)
        goes_on = trial.verdict
    return replace(
        report,
        verdict=verdict,
        goes_on=goes_on,
        trial_assembly=trial,
        reasons=_reasons(report, holding, superseded),
        notes=(*report.notes, *told),
        findings=(*report.findings, *findings),
    )


def _verdict_of(finding: Finding) -> Verdict:
    return Verdict.NOT_MEASURED if finding.code in NOT_MEASURED else Verdict.INCONCLUSIVE


def _held_trial(trial: TrialReport, holding: Sequence[Finding]) -> TrialReport:
    verdict = worst((trial.verdict, *(_verdict_of(finding) for finding in holding)))
    return replace(trial, verdict=verdict, reasons=(*trial.reasons, *(finding.text for finding in holding)))


def _reasons(report: ColumnReport, holding: Sequence[Finding], superseded: Sequence[str]) -> tuple[str, ...]:
    """The findings first, unless a failure was found that does not hang on them."""
    kept = [reason for reason in report.reasons if reason not in superseded]
    first = [finding.text for finding in holding if finding.code in SPOILS_ALL or report.verdict is not Verdict.FAIL]
    last = [finding.text for finding in holding if finding.text not in first]
    return tuple(dict.fromkeys([*first, *kept, *last]))


@dataclass(frozen=True, eq=False)
class SeenGroup:
    """The sleeves or the rebars of a column, as designed, as extracted and as matched.

    ``scale_error`` is the relative standard uncertainty (k = 1) of the camera's lengths.
    """

    kind: Kind
    design: Sequence[AssemblyPoint]
    extraction: Extraction
    match: Match
    scale_error: float = 0.0

    def placed(self) -> list[tuple[AssemblyPoint, PlacedPoint]]:
        """Each design point that was measured, with its measurement, in the first placement."""
        if not self.match:
            return []
        points = place_points(self.extraction, self.match.placements[0])
        return [(target, point) for target, point in zip(self.design, points, strict=True) if point is not None]


@dataclass(frozen=True, slots=True)
class _Use:
    """One file of one group of one column."""

    group: str
    source: str
    sha256: str


@dataclass(frozen=True)
class _Shared:
    """A file that is used more than once: by which columns, their ids by their number, and in which groups of each."""

    ids: dict[int, str]
    uses: dict[int, list[_Use]]

    def others(self, number: int) -> str:
        """The first of the other columns, and how many more there are."""
        first = [name for other, name in islice(self.ids.items(), _NAMED + 1) if other != number][:_NAMED]
        more = len(self.ids) - 1 - len(first)
        return ", ".join(first) + (f", … (+{more})" if more else "")


def with_same_scans(columns: Sequence[ColumnReport]) -> Sequence[ColumnReport]:
    """The columns of a job, each with a finding where a scan of it was used elsewhere too."""
    scans = each(columns, scans_of)
    often = Counter(use.sha256 for _, uses in scans for use in uses)
    by_hash: dict[str, _Shared] = {}
    for number, (name, uses) in enumerate(scans):
        for use in uses:
            if often[use.sha256] < 2:  # as nearly all are: nothing is kept of those
                continue
            shared = by_hash.setdefault(use.sha256, _Shared({}, {}))
            shared.ids[number] = name
            shared.uses.setdefault(number, []).append(use)
    twice: dict[int, list[_Shared]] = {}
    for shared in by_hash.values():
        for number, own in shared.uses.items():
            if len(shared.uses) > 1 or len(own) > 1:
                twice.setdefault(number, []).append(shared)
    return changed(
        columns, lambda number, column: held_back(column, _findings(number, twice.get(number, ()))), at=twice
    )


def scans_of(column: ColumnReport) -> tuple[str, tuple[_Use, ...]]:
    """The id of a column, and the scans that it was checked with."""
    return column.id, tuple(_uses(column))


def _uses(column: ColumnReport) -> Iterator[_Use]:
    for name, group in (("sleeves", column.sleeves), ("rebars", column.rebars)):
        if isinstance(group, GroupReport):
            files = zip(group.source.split(", "), group.sha256.split(", "), strict=False)
            yield from (_Use(name, source, sha256) for source, sha256 in files if sha256)


def _findings(number: int, twice: Sequence[_Shared]) -> list[Finding]:
    found = []
    for shared in twice:
        own = shared.uses[number]
        if len(shared.uses) > 1:
            use, others = own[0], shared.others(number)
            said = {"group": use.group, "source": use.source, "others": others}
            found.append(make_finding("same_scan_twice.columns", [use.group], **said))
        if len(own) > 1:
            about = list(dict.fromkeys(use.group for use in own))
            found.append(make_finding("same_scan_twice.column", about, source=own[0].source))
    return found
