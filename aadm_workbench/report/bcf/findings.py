"""Which topics a report makes: one for each column that is not a pass, or one for each pair."""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from aadm_workbench.assembly.following import blame_of, name_of
from aadm_workbench.model import ColumnReport, JobReport, Kind, PairResult, PointResult, Verdict, worst

_TOPICS = uuid.UUID("b2b1b1de-53d5-5f0b-8a5e-0c7c6b3f9a41")
_SETTLED = (Verdict.PASS, Verdict.NOT_ASSESSED)


@dataclass(frozen=True)
class Finding:
    """What one topic is about: a column, or one pair of it where ``number`` is given.

    A pass closes the topic of an earlier run; what was not assessed leaves it as it is.
    """

    guid: str
    column: ColumnReport
    number: int | None
    verdict: Verdict
    reasons: tuple[str, ...]
    labels: tuple[str, ...]

    @property
    def is_open(self) -> bool:
        """Whether somebody has to do something about it."""
        return self.verdict not in _SETTLED

    @property
    def name(self) -> str:
        """``C-301``, or ``C-301 S7/R7``."""
        called = self.column.id
        return called if self.number is None else f"{called} S{self.number}/R{self.number}"

    @property
    def numbers(self) -> tuple[int, ...]:
        """Numbers of the pairs that the topic selects: its own, or all that are not a pass by themselves."""
        if self.number is not None:
            return (self.number,)
        follows = {*blame_of(self.column).follows}
        return tuple(
            number
            for number in pair_numbers(self.column)
            if any(one.verdict not in _SETTLED and name_of(one) not in follows for one in _judged(self.column, number))
        )


def findings(report: JobReport, per: str) -> Iterator[Finding]:
    """Every topic that this report opens, keeps open or may close.

    Parameters
    ----------
    report
        report.json, schema 1.
    per
        ``"column"`` or ``"pair"``. A column that is not a pass without a pair to blame (its scan is missing, say) has
        a topic of its own in either case.
    """
    for column in report.columns:
        whole = _of_column(report, column)
        if per == "column":
            yield whole
            continue
        pairs = [_of_pair(report, column, number) for number in pair_numbers(column)]
        yield from pairs
        if not any(pair.is_open for pair in pairs):
            yield whole


def pair_numbers(column: ColumnReport) -> list[int]:
    """Numbers of a column's sleeves and bars, as far as they were looked for."""
    return sorted({int(point.label[1:]) for kind in Kind for point in column.points(kind)})


def points_of(column: ColumnReport, number: int) -> list[PointResult]:
    """The sleeve and the bar with a number."""
    return [point for kind in Kind for point in column.points(kind) if point.label[1:] == str(number)]


def topic_guid(report: JobReport, column: ColumnReport, number: int | None = None) -> str:
    """The GUID of a topic: the same in every run, for the GlobalId of a column is, or its job's name and its id."""
    key = column.global_id or f"{report.job['name']}/{column.id}"
    if column.global_id and _shares_its_id(report, column):
        key = f"{column.global_id}/{column.id}"
    return str(uuid.uuid5(_TOPICS, key if number is None else f"{key}/{number}"))


def _shares_its_id(report: JobReport, column: ColumnReport) -> bool:
    """Whether another element of the model, or another column of the report, has the GlobalId of a column."""
    found = (finding for finding in column.findings if finding.code == "duplicate_global_id")
    if any("column" in finding.about for finding in found):
        return True
    return [other.global_id for other in report.columns].count(column.global_id) > 1


def _of_column(report: JobReport, column: ColumnReport) -> Finding:
    speaking = [kind.plural for kind, group in column.groups.items() if group.verdict not in _SETTLED]
    return Finding(
        guid=topic_guid(report, column),
        column=column,
        number=None,
        verdict=column.verdict,
        reasons=column.reasons,
        labels=_labels(column, column.verdict, speaking),
    )


def _of_pair(report: JobReport, column: ColumnReport, number: int) -> Finding:
    verdict = _pair_verdict(column, number)
    unsettled = [entry for entry in _judged(column, number) if entry.verdict not in _SETTLED]
    blamed = {kind.letter: kind.plural for kind in Kind}
    return Finding(
        guid=topic_guid(report, column, number),
        column=column,
        number=number,
        verdict=verdict,
        reasons=tuple(entry.reason for entry in unsettled if entry.reason),
        labels=_labels(column, verdict, [blamed[e.label[0]] for e in unsettled if isinstance(e, PointResult)]),
    )


def _judged(column: ColumnReport, number: int) -> list[PointResult | PairResult]:
    """A sleeve, its bar and their pair at the pose that is shown, as far as the report has them."""
    pairs = [pair for pair in column.pairs if pair.sleeve == f"S{number}"]
    return [*points_of(column, number), *pairs[:1]]


def _pair_verdict(column: ColumnReport, number: int) -> Verdict:
    """The worst of a sleeve, its bar and their pair; a pass only where something was judged."""
    verdicts = {entry.verdict for entry in _judged(column, number)} - {Verdict.NOT_ASSESSED}
    return worst(verdicts) if verdicts else Verdict.NOT_ASSESSED


def _labels(column: ColumnReport, verdict: Verdict, kinds: Sequence[str]) -> tuple[str, ...]:
    trial = column.trial_assembly
    trial_speaks = trial is not None and trial.verdict not in _SETTLED
    places = [column.storey, column.grid, column.piece_mark]
    named = ["AADM", verdict.value.replace("_", " "), *kinds, *(["trial assembly"] if trial_speaks else [])]
    return tuple(dict.fromkeys([*named, *(place for place in places if place and place.strip())]))
