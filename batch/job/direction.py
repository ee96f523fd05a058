"""Directions in the column frame as a job writes them: ``up`` of a scan, ``near`` of a hoisting frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .table import JobTable, is_finite_number

NEAR = {"+x+y": (1, 1), "-x+y": (-1, 1), "-x-y": (-1, -1), "+x-y": (1, -1)}


def up_deg(table: JobTable, key: str) -> float | None:
    """The column-frame direction at the top of the image, degrees from +x, counter-clockwise from above.

    Written as one of :data:`aadm_workbench.model.UP_DEG`, or as the number itself.
    """
    from aadm_workbench.model import UP_DEG

    value = table.values.get(key)
    if value is None:
        return None
    if isinstance(value, str) and value in UP_DEG:
        return UP_DEG[value]
    if is_finite_number(value):
        return float(value)
    raise table.wrong(key, "jobfile.direction", shown=repr(value))


def near_corner(table: JobTable) -> tuple[int, int] | None:
    """Signs of x and y of the corner of the bars that is nearest to the camera."""
    value = table.values.get("near")
    if value is None:
        return None
    if not isinstance(value, str) or value not in NEAR:
        listed = [f'"{corner}"' for corner in NEAR]
        raise table.wrong("near", "jobfile.corner", listed=listed, shown=repr(value))
    return NEAR[value]


def read_frames(table: JobTable) -> tuple[tuple[str, ...], tuple[tuple[int, int] | None, ...]]:
    """The hoisting frames of a column, and the corner that each was taken from.

    A frame is a file, taken from the column's ``near``, or a table with its ``file`` and a ``near`` of its own.
    """
    value, common = table.values.get("hoisting"), near_corner(table)
    entries = [value] if isinstance(value, Mapping) else value
    if not isinstance(entries, list) or not any(isinstance(entry, Mapping) for entry in entries):
        names = table.paths("hoisting")
        return names, (common,) * len(names)
    files: list[str] = []
    corners: list[tuple[int, int] | None] = []
    for index, entry in enumerate(entries):
        frame = _frame(table, entry, index)
        files.append(frame.path("file") or "")
        own = near_corner(frame)
        corners.append(common if own is None else own)
    return tuple(files), tuple(corners)


def _frame(table: JobTable, entry: Any, index: int) -> JobTable:
    values = {"file": entry} if isinstance(entry, str) else entry
    if not isinstance(values, Mapping):
        raise table.wrong(
            "hoisting", "jobfile.hoisting", index, example='{file = "…", near = "-x-y"}', shown=repr(entry)
        )
    frame = JobTable(values, (*table.at, "hoisting", index), "a frame of hoisting", table.source, table.lines)
    frame.allow(("file", "near"))
    frame.require("file", 'file = "…"')
    return frame
