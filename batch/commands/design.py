"""List the columns, grouting sleeves and connecting rebars that a model holds.

Points are in the frame of the model, in mm; S1 is the sleeve nearest to (-x, -y) of its column, then counter-clockwise
seen from above, and R1 belongs to S1. Sleeves and rebars that belong to no column are listed as loose.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..switches import ALL_PASS, UNDECIDED, add_switches

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.design.model_design import ModelDesign, NotTaken
    from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign

    from ..shown.told import Words

_NEAR_MM = 1500.0  # of a column's axis: what stands further off belongs to none of its sides

EXAMPLE = """\
examples:
  aadm design floor3.ifc
  aadm design floor3.ifc --column C-301 --why
  aadm design floor3.ifc --column 'IfcColumn, location="3F"' --json"""

_SELECTOR = re.compile(r"^\s*!?\s*Ifc[A-Z]|=")
"""Names of columns neither begin with a class nor hold an equals sign; selectors do one or the other."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "model",
        type=Path,
        metavar="MODEL",
        help="the model: .ifc, .ifczip, .FCStd, .step, .brep, .stl, .obj, .ply or .pcd",
    )
    parser.add_argument(
        "--column", metavar="SEL", help="a Name, Tag, Mark, PieceMark, GlobalId, or a selector in IfcOpenShell's syntax"
    )
    parser.add_argument("--sleeves", metavar="SEL", help="which elements are sleeves, as in [model] of a job")
    parser.add_argument("--rebars", metavar="SEL", help="which elements are rebars, as in [model] of a job")
    parser.add_argument("--why", action="store_true", help="say why each element was taken, and what was left out")
    parser.add_argument(
        "--method",
        choices=("exact", "published"),
        default="exact",
        help="published: also by the paper's route (cloud, pass-through, mean of edge points), with the difference",
    )
    parser.add_argument(
        "--units", choices=("mm", "cm", "m", "inch", "foot"), default="mm", help="of a mesh or a cloud (default: mm)"
    )
    add_switches(parser, prints_json="the points")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a model's design; without any column the exit code is 11."""
    from aadm_workbench.inspection.as_designed import read_design, unforeseen_in

    from ..shown.published_table import published_tables
    from ..shown.terminal import say, show
    from ..shown.told import words_for

    wanted: str | None = options.column
    selector = wanted if wanted and _SELECTOR.search(wanted) else None
    with unforeseen_in(str(options.model)):
        model = read_design(
            options.model, columns=selector, sleeves=options.sleeves, rebars=options.rebars, units=options.units
        )
    columns = model.columns if wanted is None or selector else (model.column(wanted),)
    words = words_for(options, "told_design")
    if options.json:
        _print_json(model, columns, why=options.why, published=options.method == "published")
    elif not options.quiet:
        show(*_Shown(model, columns, options.why, wanted is None, words).parts())
        if options.method == "published":
            show(*published_tables(columns, words))
    if not options.quiet:
        for warning in _warnings(model, columns, words):
            say(words("told.warning", said=warning))
        if model.parse_seconds:
            say(words("parsed", model=model.source, parsed=model.parse_seconds, found=model.seconds))
    if not columns:
        nothing = words("nothing", model=options.model, holdings=words.said(model.holdings))
        say(f"aadm: {nothing}" + (words("ending", hint=words.said(model.hint)) if model.hint else ""))
    return ALL_PASS if columns else UNDECIDED


def _warnings(model: ModelDesign, columns: Sequence[ColumnDesign], words: Words) -> Iterator[str]:
    """What a person should know about the model, then about each column; with more than one it says which."""
    yield from map(words.said, model.warnings)
    for column in columns:
        for warning in map(words.said, column.warnings):
            yield words.of(column.id, warning) if len(columns) > 1 else warning


def _print_json(model: ModelDesign, columns: Sequence[ColumnDesign], *, why: bool, published: bool) -> None:
    from aadm_workbench.report.json import encode

    from ..shown.published_table import published_entries
    from ..shown.terminal import show_json

    document = {
        "model": {"source": model.source, "sha256": model.sha256, "schema": model.schema},
        "columns": [
            {
                "id": column.id,
                "global_id": column.global_id,
                "piece_mark": column.piece_mark,
                "storey": column.storey,
                "grid": column.grid,
                "names": column.names,
                "size_mm": column.size_mm,
                "T_model_column": column.T_model_column,
                "sleeves": [one.told() for one in _entries(column.sleeves, column.T_model_column, why=why)],
                "rebars": [one.told() for one in _entries(column.rebars, column.T_model_column, why=why)],
                "warnings": column.warnings,
            }
            for column in columns
        ],
        "loose": {
            "sleeves": [one.told() for one in _entries(model.loose_sleeves, None, why=why)],
            "rebars": [one.told() for one in _entries(model.loose_rebars, None, why=why)],
        },
        "warnings": model.warnings,
        **({} if columns else {"hint": model.hint}),
        **({"not_taken": [_left_out(left) for left in model.not_taken]} if why else {}),
        **({"published": published_entries(columns)} if published else {}),
    }
    show_json(encode(document))


def _left_out(left: NotTaken) -> dict[str, str | float | Array | None]:
    """An element that was left out; ``centre_mm`` is the upper end of a bar, the mouth of a sleeve."""
    names = ("what", "ifc_class", "global_id", "name", "point", "diameter_mm", "length_mm", "reason")
    called = {"ifc_class": "class", "point": "centre_mm"}
    return {called.get(name, name): getattr(left, name) for name in names}


@dataclass(frozen=True, eq=False)
class _Entry:
    """A point in the frame of the model."""

    label: str
    global_id: str | None
    centre_mm: Array
    axis: Array
    diameter_mm: float
    length_mm: float | None
    object: str | None
    why: str | None

    def told(self) -> dict[str, str | float | Array | None]:
        """What ``--json`` says of it; nothing of an object that there is not, or that nobody asked for."""
        return {name: value for name, value in vars(self).items() if value is not None or name not in ("object", "why")}


def _entries(points: Sequence[AssemblyPoint], T_model_column: Array | None, *, why: bool) -> list[_Entry]:
    """Points in the frame of the model."""
    found = []
    for point in points:
        centre, axis = point.centre, point.axis
        if T_model_column is not None:
            centre = T_model_column[:3, :3] @ centre + T_model_column[:3, 3]
            axis = T_model_column[:3, :3] @ axis
        named = (point.label, point.global_id, centre, axis, point.diameter_mm, point.length_mm, point.object_name)
        found.append(_Entry(*named, point.why if why else None))
    return found


@dataclass(frozen=True)
class _Shown:
    """Columns of a model for people; ``loose`` where what belongs to no column is shown, too."""

    model: ModelDesign
    columns: Sequence[ColumnDesign]
    why: bool
    loose: bool
    words: Words

    def parts(self) -> Iterator[Table | str]:
        model, words = self.model, self.words
        for column in self.columns:
            yield _heading(column)
            yield self._points(_entries(column.sleeves + column.rebars, column.T_model_column, why=self.why))
            yield ""
        left_over = model.loose_sleeves + model.loose_rebars if self.loose else ()
        if left_over:
            yield words("loose", sleeves=len(model.loose_sleeves), rebars=len(model.loose_rebars))
            yield self._points(_entries(left_over, None, why=self.why))
            yield ""
        left_out = [left for left in model.not_taken if self.loose or not _of_another(left, self.columns)]
        if self.why and left_out:
            yield words("left_out")
            yield self._left_out(left_out)
            yield ""
        points = sum(len(column.sleeves) + len(column.rebars) for column in self.columns)
        yield words.counted("columns", len(self.columns), points=points, model=model.source)

    def _points(self, entries: Sequence[_Entry]) -> Table | str:
        words = self.words
        numbers = [words(name) for name in ("x", "y", "z", "diameter", "length")]
        rows = [
            [
                entry.label or "-",
                *(f"{value:.2f}" for value in entry.centre_mm),
                f"{entry.diameter_mm:g}",
                "" if entry.length_mm is None else f"{entry.length_mm:g}",
                entry.global_id or "",
                *([words.said(entry.why or "")] if self.why else []),
            ]
            for entry in entries
        ]
        last = [words("ui.global_id"), *([words("why")] if self.why else [])]
        return _table([words("ui.point"), *numbers, *last], rows, numbers)

    def _left_out(self, left_out: Sequence[NotTaken]) -> Table | str:
        words = self.words
        rows = [
            [words(f"told.{left.what}"), left.ifc_class, left.global_id, left.name, words.said(left.reason)]
            for left in left_out
        ]
        return _table([words(name) for name in ("what", "class", "ui.global_id", "name", "shown.reason")], rows)


def _of_another(left: NotTaken, columns: Sequence[ColumnDesign]) -> bool:
    """Whether what was left out is of no account for the columns that are shown: a column itself, or far from them."""
    if left.what == "column" or left.point is None:
        return left.what == "column"
    x, y = float(left.point[0]), float(left.point[1])
    feet = [column.T_model_column for column in columns if column.T_model_column is not None]
    return bool(feet) and min(math.hypot(x - T[0, 3], y - T[1, 3]) for T in feet) > _NEAR_MM


def _heading(column: ColumnDesign) -> str:
    size = "" if column.size_mm is None else f"{column.size_mm[0]:g} x {column.size_mm[1]:g} mm"
    place = [text for text in (column.storey, column.grid, column.piece_mark, size, column.global_id) if text]
    return f"{column.id}: {', '.join(place)}" if place else column.id


def _table(headings: Sequence[str], rows: Sequence[Sequence[str]], numbers: Sequence[str] = ()) -> Table | str:
    """A table for a terminal; for a file or a pipe the same as plain lines, which a floor of columns needs fast."""
    from rich.cells import cell_len
    from rich.text import Text

    from ..shown.terminal import new_table

    if sys.stdout.isatty():
        table = new_table(*headings, numbers=tuple(numbers))
        for row in rows:
            table.add_row(*(Text(text) for text in row))
        return table
    lines = [list(headings), *([text.replace("\n", " ") for text in row] for row in rows)]
    widths = [max(cell_len(line[place]) for line in lines) for place in range(len(headings))]

    def padded(line: Sequence[str], place: int) -> str:
        blank = " " * (widths[place] - cell_len(line[place]))
        return blank + line[place] if headings[place] in numbers else line[place] + blank

    return "\n".join("  ".join(padded(line, place) for place in range(len(headings))).rstrip() for line in lines)
