"""The work on one column as it travels: a pure function of its inputs, so that it may run twice, anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from ..job.inputs import ShippedFile, read_for_shipping, task_key
from .column_task import check_task, killed
from .record import Record
from .task import ColumnTask


@dataclass(frozen=True, eq=False)
class CheckOrder:
    """A column to be checked unless its key is still ``known``, the one of a result that was kept.

    ``program`` is the key of the program that asks; a worker has the same one.
    """

    task: ColumnTask
    program: str
    known: str = ""

    def at(self, places: Mapping[str, Path]) -> CheckOrder:
        """The same order where its files lie elsewhere."""
        return replace(self, task=self.task.at(places))


def fill_order(order: CheckOrder) -> Record | None:
    """Check a column; None where nothing that its result follows from has changed."""
    key = task_key(order.task, order.program)
    return None if key == order.known else Record.of(check_task(order.task), key)


def give_up(order: CheckOrder, reason: str) -> Record:
    """The record of a column that cost its process too often."""
    return Record.of(killed(order.task, reason), "")


def ship_order(order: CheckOrder) -> tuple[ShippedFile, ...]:
    """The files of an order by content."""
    return read_for_shipping(order.task)
