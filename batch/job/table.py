"""Typed access to the tables of a job, with errors that name the file and the line."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from aadm_workbench.errors import JobError, did_you_mean

from ..switches import steering_character

if TYPE_CHECKING:
    from .lines import KeyPath

LONGEST_TEXT = 4096
"""Longest path that Linux takes."""


def is_finite_number(value: Any) -> bool:
    """Whether a value of a TOML file is a number that a float can hold."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def local_path(name: str, folder: Path) -> str:
    """A path of a job: backslashes of Windows as slashes where it has none, unless a file is really called so."""
    if os.sep == "\\" or "\\" not in name or os.path.exists(folder / name):  # noqa: PTH110 - names may be too long
        return name
    return name.replace("\\", "/")


class Lines:
    """On which line of a text its keys stand; the text is looked through when somebody asks: most jobs are right."""

    def __init__(self, text: str) -> None:
        self._text = text

    def of(self, path: KeyPath) -> int:
        """The line of a key, or of what it would stand in."""
        while path and path not in self._known:
            path = path[:-1]
        return self._known.get(path, 1)

    @cached_property
    def _known(self) -> dict[KeyPath, int]:
        from .lines import lines_of

        try:
            return lines_of(self._text)
        except RecursionError:  # arrays within arrays that the parser, which goes less deep into itself, has taken
            return {}


@dataclass(frozen=True, eq=False)
class JobTable:
    """One table of a job.

    Parameters
    ----------
    values
        What the table holds.
    at
        Where it stands in the job: () for the top.
    called
        What messages call it, such as ``[camera]``.
    source
        The job's file, as it was named.
    lines
        Line of each key.
    """

    values: Mapping[str, Any]
    at: KeyPath
    called: str
    source: str
    lines: Lines

    def wrong(self, key: str | None, code: str, *index: int, **values: object) -> JobError:
        """The error about a key, about an element of its array, or about the table itself; ``code`` of its sentence."""
        path: KeyPath = () if key is None else (key, *index)
        from aadm_workbench.model.reason import Reason  # not before it is needed: it loads numpy

        what = Reason(code, **{"key": key, **values})
        return JobError.because("jobfile.at_line", file=self.source, line=self.line(*path), what=what)

    def paths(self, key: str) -> tuple[str, ...]:
        """One path or a list of paths, as this system writes them; empty where the key is absent."""
        return tuple(local_path(name, Path(self.source).parent) for name in self.texts(key, or_one=True))

    def path(self, key: str) -> str | None:
        """A path as this system writes it; None where the key is absent."""
        name = self.text(key)
        return None if name is None else local_path(name, Path(self.source).parent)

    def line(self, *path: str | int) -> int:
        """The line that a key inside this table stands in."""
        return self.lines.of((*self.at, *path))

    def allow(self, known: Iterable[str]) -> None:
        """Refuse keys that are not known."""
        known = tuple(known)
        for key in self.values:
            if key not in known:
                raise self.wrong(key, "jobfile.unknown_key", table=self.called, meant=did_you_mean(key, known))

    def require(self, key: str, what: str) -> None:
        """Refuse a table that lacks a key; ``what`` is an example or says what it holds."""
        if key not in self.values:
            raise self.wrong(None, "jobfile.lacks", table=self.called, lacking=key, what=what)

    def text(self, key: str) -> str | None:
        """A text that is not empty; None where the key is absent."""
        value = self.values.get(key)
        if value is None:
            return None
        if not isinstance(value, str):
            raise self.wrong(key, "jobfile.not_text", shown=_shown(value))
        if not value.strip():
            raise self.wrong(key, "jobfile.empty_text")
        self._check_plain(key, value)
        return value

    def one_of(self, key: str, choices: tuple[str, ...], default: str) -> str:
        """One of some words."""
        value = self.text(key)
        if value is None:
            return default
        if value not in choices:
            raise self.wrong(
                key, "jobfile.not_one_of", choices=[f'"{choice}"' for choice in choices], shown=_shown(value)
            )
        return value

    def flag(self, key: str, default: bool) -> bool:
        """True or false."""
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            raise self.wrong(key, "jobfile.not_boolean", shown=_shown(value))
        return value

    def number(self, key: str) -> float | None:
        """A finite number; None where the key is absent."""
        value = self.values.get(key)
        return None if value is None else self._number(key, value)

    def length(self, key: str) -> float | None:
        """A number above zero; None where the key is absent."""
        value = self.number(key)
        if value is not None and value <= 0.0:
            raise self.wrong(key, "jobfile.not_above_zero", value=value)
        return value

    def count(self, key: str) -> int | None:
        """A whole number above zero; None where the key is absent."""
        value = self.values.get(key)
        if value is not None and (isinstance(value, bool) or not isinstance(value, int) or value <= 0):
            raise self.wrong(key, "jobfile.not_whole", shown=_shown(value))
        return value

    def numbers(self, key: str, how_many: int) -> tuple[float, ...]:
        """A list of so many finite numbers; empty where the key is absent."""
        if key not in self.values:
            return ()
        self._numbers(key, self.values[key], how_many)
        return tuple(float(value) for value in self.values[key])

    def number_lists(self, key: str, how_many: int) -> None:
        """Check that a key, where present, is a list of lists of so many finite numbers."""
        value = self.values.get(key, [])
        if not isinstance(value, list):
            raise self.wrong(key, "jobfile.not_lists", shown=_shown(value))
        for index, item in enumerate(value):
            self._numbers(key, item, how_many, index)

    def texts(self, key: str, *, or_one: bool = False) -> tuple[str, ...]:
        """A list of texts, and with ``or_one`` also one text; empty where the key is absent."""
        value = self.values.get(key)
        if value is None:
            return ()
        if or_one and isinstance(value, str):
            return (self.text(key) or "",)
        if not isinstance(value, list):
            code = "jobfile.not_text_or_list" if or_one else "jobfile.not_list"
            raise self.wrong(key, code, shown=_shown(value))
        if not value:
            raise self.wrong(key, "jobfile.empty_list")
        for index, item in enumerate(value):
            if not isinstance(item, str) or not item.strip():
                raise self.wrong(key, "jobfile.holds_no_text", index, shown=_shown(item))
            self._check_plain(key, item, index)
        return tuple(value)

    def table(self, key: str, called: str) -> JobTable | None:
        """A table inside this one; None where it is absent."""
        value = self.values.get(key)
        if value is None:
            return None
        if not isinstance(value, dict):
            raise self.wrong(key, "jobfile.not_table", called=called, shown=_shown(value))
        return JobTable(value, (*self.at, key), called, self.source, self.lines)

    def tables(self, key: str, called: str) -> tuple[JobTable, ...]:
        """The tables of an array of tables."""
        value = self.values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
            raise self.wrong(key, "jobfile.not_tables", called=called)
        return tuple(
            JobTable(item, (*self.at, key, index), called, self.source, self.lines) for index, item in enumerate(value)
        )

    def _check_plain(self, key: str, value: str, *index: int) -> None:
        """Refuse what no name and no path holds: signs that steer a terminal, and endless ones."""
        if len(value) > LONGEST_TEXT:
            raise self.wrong(key, "jobfile.long_text", *index, count=len(value), most=LONGEST_TEXT)
        if (sign := steering_character(value)) is not None:
            raise self.wrong(key, "jobfile.control_character", *index, sign=sign)

    def _number(self, key: str, value: Any, *index: int) -> float:
        if not is_finite_number(value):
            raise self.wrong(key, "jobfile.not_number", *index, shown=_shown(value))
        return float(value)

    def _numbers(self, key: str, value: Any, how_many: int, *index: int) -> None:
        if not isinstance(value, list) or len(value) != how_many:
            named = ", ".join("xyz"[:how_many])
            raise self.wrong(key, "jobfile.how_many_numbers", *index, count=how_many, named=named, shown=_shown(value))
        for place, item in enumerate(value):
            self._number(key, item, *index, place)


def _shown(value: Any) -> str:
    """A value as messages print it: short, and in TOML's spelling."""
    text = str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


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
