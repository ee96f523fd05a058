"""The work on one column as it travels, and what is kept of it.

An order is a pure function's input, so that it may be filled twice, anywhere; a record is one line of text, from which
the column's report comes back as report.json will show it.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from aadm_workbench.inspection.column import ColumnOutcome, inspect_column, lost
from aadm_workbench.inspection.tasks import ColumnTask
from aadm_workbench.model import ColumnReport, Verdict
from aadm_workbench.report.json import as_shown

from ..job.inputs import ShippedFile, read_for_shipping, task_key
from .exact_json import from_exact_json, plainly, to_exact_json
from .packed import pack, unpack

_CHECKSUM = ',"crc32":"'


@dataclass(frozen=True, eq=False)
class Record:
    """A column that was checked.

    Parameters
    ----------
    id
        Of the column.
    key
        Hash of all that its report follows from; empty for a report that may come out differently the next time (an
        error: a file may have been missing, a process killed).
    report
        The :class:`~aadm_workbench.model.ColumnReport` as JSON, packed: its numbers as report.json shows them, and
        exactly those that all columns together are judged by.
    seconds, where
        As of a :class:`~aadm_workbench.inspection.column.ColumnOutcome`.
    seen
        What the files looked like from outside while they were read (:class:`~..job.inputs.Looks`); empty where that
        says nothing.
    """

    id: str
    key: str
    verdict: str
    goes_on: str
    report: str
    seconds: dict[str, float] = field(default_factory=dict)
    where: str = ""
    seen: str = ""

    @classmethod
    def of(cls, outcome: ColumnOutcome, key: str) -> Record:
        """What is to be kept of an outcome."""
        report = outcome.report
        kept_key = "" if report.verdict is Verdict.ERROR else key
        return cls(
            report.id, kept_key, report.verdict, report.goes_on, pack(kept_text(report)), outcome.seconds, outcome.where
        )

    def column(self) -> ColumnReport:
        """The column's report.

        Raises
        ------
        ValueError
            Where another version wrote it.
        """
        return from_exact_json(ColumnReport, unpack(self.report))

    def line(self) -> bytes:
        """The record as one line of JSON, its checksum at its end."""
        head = {
            "id": self.id,
            "key": self.key,
            "verdict": self.verdict,
            "goes_on": self.goes_on,
            "seconds": self.seconds,
            "where": self.where,
            "seen": self.seen,
            "report": self.report,
        }
        content = to_exact_json(head)[:-1].encode(errors="surrogatepass")
        return content + f'{_CHECKSUM}{zlib.crc32(content):08x}"}}\n'.encode()


def kept_text(report: ColumnReport) -> str:
    """A column's report as it is kept, before it is packed."""
    return to_exact_json(as_shown(plainly(report)))


def read_record(line: bytes) -> Record | None:
    """The record that a line holds; None for a line that broke off or does not agree with its checksum."""
    content, mark, rest = line.rpartition(_CHECKSUM.encode())
    if not mark or rest != f'{zlib.crc32(content):08x}"}}\n'.encode():
        return None
    try:
        record = Record(**json.loads(content.decode(errors="surrogatepass") + "}"))
    except (ValueError, TypeError, RecursionError):
        return None
    return record if _is_sound(record) else None


def _is_sound(record: Record) -> bool:
    """Whether each value is of its kind: a checksum can be calculated by anybody."""
    texts = (record.id, record.key, record.verdict, record.goes_on, record.where, record.seen, record.report)
    seconds: object = record.seconds
    return all(isinstance(text, str) for text in texts) and (
        isinstance(seconds, dict) and all(isinstance(value, int | float) for value in seconds.values())
    )


@dataclass(frozen=True, eq=False)
class CheckOrder:
    """A column to be checked unless its key is still ``known``, the one of a result that was kept.

    ``order`` is the key of all but its files, by the program that asks; a worker is the same one.
    """

    task: ColumnTask
    order: str
    known: str = ""

    def at(self, places: Mapping[str, Path]) -> CheckOrder:
        """The same order where its files lie elsewhere."""
        return replace(self, task=self.task.at(places))


def fill_order(order: CheckOrder) -> Record | None:
    """Check a column; None where nothing that its result follows from has changed."""
    key = task_key(order.task, order.order)
    return None if key == order.known else Record.of(inspect_column(order.task), key)


def give_up(order: CheckOrder, reason: str) -> Record:
    """The record of a column that cost its process too often."""
    return Record.of(lost(order.task, reason), "")


def ship_order(order: CheckOrder) -> tuple[ShippedFile, ...]:
    """The files of an order by content."""
    return read_for_shipping(order.task)
