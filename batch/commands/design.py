"""List the columns, grouting sleeves and connecting rebars that a model holds.

Points are in the frame of the model, in mm; S1 is the sleeve nearest to (-x, -y) of its column, then counter-clockwise
seen from above, and R1 belongs to S1. Sleeves and rebars that belong to no column are listed as loose.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..exit_codes import ALL_PASS, UNDECIDED
from ..switches import add_switches

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.design.model_design import ModelDesign
    from aadm_workbench.model import AssemblyPoint, ColumnDesign

SUMMARY = "list the sleeves and rebars of a model"
EXAMPLE = """\
examples:
  aadm design floor3.ifc
  aadm design floor3.ifc --column C-301 --why
  aadm design floor3.ifc --column 'IfcColumn, location="3F"' --json"""

_SELECTOR = re.compile(r"^\s*!?\s*Ifc[A-Z]|=")
"""Names of columns neither begin with a class nor hold an equals sign; selectors do one or the other."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument("model", type=Path, metavar="MODEL", help="the model, an .ifc file")
    parser.add_argument(
        "--column", metavar="SEL", help="a Name, Tag, PieceMark or GlobalId, or a selector in IfcOpenShell's syntax"
    )
    parser.add_argument("--sleeves", metavar="SEL", help="which elements are sleeves, as in [model] of a job")
    parser.add_argument("--rebars", metavar="SEL", help="which elements are rebars, as in [model] of a job")
    parser.add_argument("--why", action="store_true", help="say why each element was taken, and what was left out")
    add_switches(parser, prints_json="the points")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print a model's design; without any column the exit code is 11."""
    from aadm_workbench.design.read import read_model

    from ..terminal import say, show

    wanted: str | None = options.column
    selector = wanted if wanted and _SELECTOR.search(wanted) else None
    model = read_model(options.model, columns=selector, sleeves=options.sleeves, rebars=options.rebars)
    columns = model.columns if wanted is None or selector else (model.column(wanted),)
    if options.json:
        _print_json(model, columns, why=options.why)
    elif not options.quiet:
        show(*_tables(model, columns, why=options.why, loose=wanted is None))
    for warning in (*model.warnings, *(warning for column in columns for warning in column.warnings)):
        if not options.quiet:
            say(f"warning: {warning}")
    if not columns:
        say(f"aadm: {options.model} has no column with grouting sleeves in its foot; it holds {model.holdings}")
    return ALL_PASS if columns else UNDECIDED


def _print_json(model: ModelDesign, columns: Sequence[ColumnDesign], *, why: bool) -> None:
    from aadm_workbench.report.json import encode

    from ..terminal import show_json

    document: dict[str, Any] = {
        "model": {"source": model.source, "sha256": model.sha256, "schema": model.schema},
        "columns": [_column_entry(column, why=why) for column in columns],
        "loose": {
            "sleeves": [_point_entry(point, None, why=why) for point in model.loose_sleeves],
            "rebars": [_point_entry(point, None, why=why) for point in model.loose_rebars],
        },
        "warnings": list(model.warnings),
    }
    if why:
        document["not_taken"] = [
            {
                "what": left.what,
                "class": left.ifc_class,
                "global_id": left.global_id,
                "name": left.name,
                "reason": left.reason,
            }
            for left in model.not_taken
        ]
    show_json(encode(document))


def _column_entry(column: ColumnDesign, *, why: bool) -> dict[str, Any]:
    T = column.T_model_column
    return {
        "id": column.id,
        "global_id": column.global_id,
        "piece_mark": column.piece_mark,
        "storey": column.storey,
        "grid": column.grid,
        "names": list(column.names),
        "size_mm": column.size_mm,
        "T_model_column": T,
        "sleeves": [_point_entry(point, T, why=why) for point in column.sleeves],
        "rebars": [_point_entry(point, T, why=why) for point in column.rebars],
        "warnings": list(column.warnings),
    }


def _point_entry(point: AssemblyPoint, T_model_column: Any, *, why: bool) -> dict[str, Any]:
    """A point in the frame of the model."""
    centre, axis = point.centre, point.axis
    if T_model_column is not None:
        centre = T_model_column[:3, :3] @ centre + T_model_column[:3, 3]
        axis = T_model_column[:3, :3] @ axis
    entry = {
        "label": point.label,
        "global_id": point.global_id,
        "centre_mm": centre,
        "axis": axis,
        "diameter_mm": point.diameter_mm,
        "length_mm": point.length_mm,
    }
    return {**entry, "why": point.why} if why else entry


def _tables(model: ModelDesign, columns: Sequence[ColumnDesign], *, why: bool, loose: bool) -> Iterator[Table | str]:
    for column in columns:
        yield _heading(column)
        yield _point_table(
            [_point_entry(p, column.T_model_column, why=True) for p in column.sleeves + column.rebars], why
        )
        yield ""
    left_over = model.loose_sleeves + model.loose_rebars if loose else ()
    if left_over:
        yield f"Loose: {len(model.loose_sleeves)} sleeves and {len(model.loose_rebars)} rebars belong to no column"
        yield _point_table([_point_entry(point, None, why=True) for point in left_over], why)
        yield ""
    if why and model.not_taken:
        yield "Left out"
        yield _left_out_table(model)
        yield ""
    points = sum(len(column.sleeves) + len(column.rebars) for column in columns)
    yield f"{len(columns)} column{'' if len(columns) == 1 else 's'}, {points} sleeves and rebars in {model.source}"


def _heading(column: ColumnDesign) -> str:
    size = "" if column.size_mm is None else f"{column.size_mm[0]:g} x {column.size_mm[1]:g} mm"
    place = [text for text in (column.storey, column.grid, column.piece_mark, size, column.global_id) if text]
    return f"{column.id}: {', '.join(place)}" if place else column.id


def _point_table(entries: Sequence[dict[str, Any]], why: bool) -> Table:
    from rich.text import Text

    from ..terminal import new_table

    numbers = ("x mm", "y mm", "z mm", "Diameter", "Length")
    table = new_table("Point", *numbers, "GlobalId", *(["Why"] if why else []), numbers=numbers)
    for entry in entries:
        row = [
            entry["label"] or "-",
            *(f"{value:.2f}" for value in entry["centre_mm"]),
            f"{entry['diameter_mm']:g}",
            "" if entry["length_mm"] is None else f"{entry['length_mm']:g}",
            entry["global_id"] or "",
            *([entry["why"]] if why else []),
        ]
        table.add_row(*(Text(text) for text in row))
    return table


def _left_out_table(model: ModelDesign) -> Table:
    from rich.text import Text

    from ..terminal import new_table

    table = new_table("What", "Class", "GlobalId", "Name", "Reason")
    for left in model.not_taken:
        table.add_row(*(Text(text) for text in (left.what, left.ifc_class, left.global_id, left.name, left.reason)))
    return table
