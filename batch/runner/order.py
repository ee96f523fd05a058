"""The work on one column as it travels: a pure function of its inputs, so that it may run twice, anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from aadm_workbench.inspection.column import inspect_column, lost
from aadm_workbench.inspection.tasks import ColumnTask

from ..job.inputs import ShippedFile, read_for_shipping, task_key
from .record import Record


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
    return None if key == order.known else Record.of(inspect_column(order.task), key)


def give_up(order: CheckOrder, reason: str) -> Record:
    """The record of a column that cost its process too often."""
    return Record.of(lost(order.task, reason), "")


def ship_order(order: CheckOrder) -> tuple[ShippedFile, ...]:
    """The files of an order by content."""
    return read_for_shipping(order.task)
