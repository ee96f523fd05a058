"""Which topics a report makes: one for each column that is not a pass, or one for each pair."""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from aadm_workbench.model import Verdict, worst
from aadm_workbench.report.read import Report
from aadm_workbench.report.shown_pose import shown_pose

Document: TypeAlias = Mapping[str, Any]
"""A part of report.json as ``json.loads`` gives it."""

_TOPICS = uuid.UUID("b2b1b1de-53d5-5f0b-8a5e-0c7c6b3f9a41")
_TITLE_LENGTH = 200  # a line in the lists of viewers; the description has all
_SETTLED = (Verdict.PASS, Verdict.NOT_ASSESSED)
_SAYS = {
    Verdict.PASS: "passes",
    Verdict.FAIL: "fails",
    Verdict.INCONCLUSIVE: "is inconclusive",
    Verdict.NOT_MEASURED: "was not measured",
    Verdict.ERROR: "could not be checked",
}


@dataclass(frozen=True)
class Finding:
    """What one topic is about: a column, or one pair of it where ``number`` is given.

    A pass closes the topic of an earlier run; what was not assessed leaves it as it is.
    """

    guid: str
    column: Document
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
        called = str(self.column["id"])
        return called if self.number is None else f"{called} S{self.number}/R{self.number}"

    @property
    def title(self) -> str:
        """One line: what, how it came out, and the first reason."""
        said = f"{self.name} {_SAYS[self.verdict]}"
        said += f": {self.reasons[0]}" if self.reasons else ""
        return said if len(said) <= _TITLE_LENGTH else f"{said[: _TITLE_LENGTH - 1]}…"

    @property
    def numbers(self) -> tuple[int, ...]:
        """Numbers of the pairs that the topic selects: its own, or all that are not a pass."""
        if self.number is not None:
            return (self.number,)
        return tuple(k for k in pair_numbers(self.column) if _pair_verdict(self.column, k) not in _SETTLED)


def findings(report: Report, per: str) -> Iterator[Finding]:
    """Every topic that this report opens, keeps open or may close.

    Parameters
    ----------
    report
        report.json, schema 1.
    per
        ``"column"`` or ``"pair"``. A column that is not a pass without a pair to blame (its scan is missing, say) has
        a topic of its own in either case.
    """
    for column in report["columns"]:
        whole = _of_column(report, column)
        if per == "column":
            yield whole
            continue
        pairs = [_of_pair(report, column, number) for number in pair_numbers(column)]
        yield from pairs
        if not any(pair.is_open for pair in pairs):
            yield whole


def pair_numbers(column: Document) -> list[int]:
    """Numbers of a column's sleeves and bars, as far as they were looked for."""
    labels = [point["label"] for group in groups(column) for point in group["points"]]
    return sorted({int(label[1:]) for label in labels})


def groups(column: Document) -> list[Document]:
    """The sleeves and the rebars of a column, as far as it was checked for them."""
    return [column[kind] for kind in ("sleeves", "rebars") if column[kind]]


def points_of(column: Document, number: int) -> list[Document]:
    """The sleeve and the bar with a number."""
    return [point for group in groups(column) for point in group["points"] if point["label"][1:] == str(number)]


def pair_of(column: Document, number: int) -> Document | None:
    """The pair with the number of its sleeve, at the best pose; None where no trial assembly was made."""
    trial = column["trial_assembly"]
    pose = shown_pose(trial)
    return next((pair for pair in (pose or {"pairs": ()})["pairs"] if pair["sleeve"] == f"S{number}"), None)


def topic_guid(report: Report, column: Document, number: int | None = None) -> str:
    """The GUID of a topic: the same in every run, for the GlobalId of a column is, or its job's name and its id."""
    key = column["global_id"] or f"{report['job']['name']}/{column['id']}"
    if column["global_id"] and _shares_its_id(report, column):
        key = f"{column['global_id']}/{column['id']}"
    return str(uuid.uuid5(_TOPICS, key if number is None else f"{key}/{number}"))


def _shares_its_id(report: Report, column: Document) -> bool:
    """Whether another element of the model, or another column of the report, has the GlobalId of a column."""
    found = (finding for finding in column.get("findings", ()) if finding["code"] == "duplicate_global_id")
    if any("column" in finding["about"] for finding in found):
        return True
    return [other["global_id"] for other in report["columns"]].count(column["global_id"]) > 1


def _of_column(report: Report, column: Document) -> Finding:
    verdict = Verdict(column["verdict"])
    return Finding(
        guid=topic_guid(report, column),
        column=column,
        number=None,
        verdict=verdict,
        reasons=tuple(column["reasons"]),
        labels=_labels(column, verdict, [kind for kind in ("sleeves", "rebars") if _speaks(column[kind])]),
    )


def _of_pair(report: Report, column: Document, number: int) -> Finding:
    verdict = _pair_verdict(column, number)
    unsettled = [entry for entry in _judged(column, number) if Verdict(entry["verdict"]) not in _SETTLED]
    blamed = {"S": "sleeves", "R": "rebars"}
    return Finding(
        guid=topic_guid(report, column, number),
        column=column,
        number=number,
        verdict=verdict,
        reasons=tuple(entry["reason"] for entry in unsettled if entry["reason"]),
        labels=_labels(column, verdict, [blamed[entry["label"][0]] for entry in unsettled if "label" in entry]),
    )


def _judged(column: Document, number: int) -> list[Document]:
    """A sleeve, its bar and their pair, as far as the report has them."""
    pair = pair_of(column, number)
    return [*points_of(column, number), *([pair] if pair else [])]


def _pair_verdict(column: Document, number: int) -> Verdict:
    """The worst of a sleeve, its bar and their pair; a pass only where something was judged."""
    verdicts = {Verdict(entry["verdict"]) for entry in _judged(column, number)} - {Verdict.NOT_ASSESSED}
    return worst(verdicts) if verdicts else Verdict.NOT_ASSESSED


def _labels(column: Document, verdict: Verdict, kinds: Sequence[str]) -> tuple[str, ...]:
    trial = column["trial_assembly"]
    trial_speaks = trial is not None and Verdict(trial["verdict"]) not in _SETTLED
    places = [column["storey"], column["grid"], column["piece_mark"]]
    named = ["AADM", verdict.value.replace("_", " "), *kinds, *(["trial assembly"] if trial_speaks else [])]
    return tuple(dict.fromkeys([*named, *(place for place in places if place)]))


def _speaks(group: Document | None) -> bool:
    return group is not None and Verdict(group["verdict"]) not in _SETTLED
