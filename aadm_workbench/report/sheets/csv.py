"""report.csv: every number with a limit, one line each, for Excel and for scripts.

Position, spacing, trial assembly and position in the building stand under each other in one table: column, question,
what was measured, value, uncertainty, limits, clause, verdict. UTF-8 with a byte order mark, for Excel takes any other
file for the system's own code page; commas and decimal points.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from aadm_workbench.model import ColumnReport, JobReport, Kind
from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.column_view import declared_up
from aadm_workbench.report.hoist import worst_first
from aadm_workbench.report.sheets.tables import (
    Cell,
    Row,
    absolute_rows,
    hoisting_rows,
    pair_rows,
    point_rows,
    spacing_rows,
)
from aadm_workbench.report.tower import TowerShown

HEADINGS = (
    "column",
    "column_verdict",
    "goes_on",
    "question",
    "item",
    "dx_mm",
    "dy_mm",
    "value_mm",
    "u_mm",
    "lower_limit_mm",
    "upper_limit_mm",
    "clause",
    "clause_source",
    "verdict",
    "clearance_mm",
    "reason",
)

SETTING_OUT = ("column", "grid", "set_as", "dx_mm", "dy_mm", "height_mm", "turn_deg", "u_mm", "against")

_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")


def write_csv(report: JobReport, path: Path) -> None:
    """Write report.csv, whole or not at all.

    Raises
    ------
    AadmError
        Where the file cannot be written.
    """
    write_atomically(path, csv_content(report, worst_first(report)))


def write_setting_out(tower: TowerShown, path: Path) -> None:
    """Write setting-out.csv, whole or not at all: where the next storey will find the bars of these columns.

    Offsets are in the axes of the plan (x to the right), of the column where it has no place in one; ``u_mm`` is k = 1.

    Raises
    ------
    AadmError
        Where the file cannot be written.
    """
    lines = (
        (line.id, line.grid, line.set_as.en, *line.offset_mm, line.height_mm, line.turn_deg, line.u_mm, line.against.en)
        for line in tower.setting_out
    )
    write_atomically(path, _content(SETTING_OUT, lines))


def csv_content(report: JobReport, columns: Iterable[ColumnReport]) -> bytes:
    """The bytes of report.csv, with these columns of the report."""
    return _content(HEADINGS, (line for column in columns for line in _lines(report, column)))


def _content(headings: Sequence[str], rows: Iterable[Row]) -> bytes:
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(headings)
    writer.writerows([_inert(cell) for cell in row] for row in rows)
    return text.getvalue().encode("utf-8-sig", errors="replace")


def _inert(cell: Cell) -> Cell:
    """A text that a spreadsheet would take for a formula gets an apostrophe, which the spreadsheet does not show."""
    return f"'{cell}" if isinstance(cell, str) and cell.lstrip(" ").startswith(_FORMULA) else cell


def _lines(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    first = (column.id, column.verdict, column.goes_on)
    lines = [
        *_of_findings(column),
        *_of_groups(report, column),
        *_of_trial(report, column),
        *_of_hoisting(report, column),
    ]
    if not lines:
        lines = [("column", "", *(None,) * 7, "", column.verdict, None, "; ".join(column.reasons))]
    for line in lines:
        yield (*first, *line)


def _of_findings(column: ColumnReport) -> Iterator[Row]:
    for finding in column.findings:
        held = "holds back" if finding.holds_back else ""
        item = " ".join(finding.about)
        yield (f"finding {finding.code}", item, *(None,) * 6, "", "", held, None, finding.text)
    up = declared_up(column)
    if up is not None:
        yield ("as_declared", up, *(None,) * 6, "", "", "", None, "labels hang on the declared up")


def _of_groups(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    for kind in Kind:
        for row in point_rows(report, column, kind):
            label, _, _, dx, dy, value, u, limit, clause, source, verdict, _, _, _, reason = row
            yield (f"{kind}_position", label, dx, dy, value, u, None, limit, clause, source, verdict, None, reason)
        for row in spacing_rows(report, column, kind):
            label, _, _, value, u, lower, upper, clause, source, verdict, reason = row
            label = str(label).replace("–", "-")
            yield (
                f"{kind}_spacing",
                label,
                None,
                None,
                value,
                u,
                lower,
                upper,
                clause,
                source,
                verdict,
                None,
                reason,
            )
    for label, dx, dy, value, u, limit, clause, source, verdict in absolute_rows(report, column):
        name = label or "all bars"
        yield ("building_position", name, dx, dy, value, u, None, limit, clause, source, verdict, None, "")


def _of_trial(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    for row in pair_rows(report, column):
        label, dx, dy, value, squares, u, limit, clause, source, room, verdict, other, reason = row
        yield ("trial_minimax", label, dx, dy, value, u, None, limit, clause, source, verdict, room, reason)
        if other is not None:
            line = (squares, None, None, limit, clause, source, other, None, "")
            yield ("trial_least_squares", label, None, None, *line)


def _of_hoisting(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    for frame in column.hoisting_frames:
        for label, dx, dy, value, u, limit, clause, source, verdict, _, reason in hoisting_rows(report, frame):
            line = (value, u, None, limit, clause, source, verdict, None, reason)
            yield (f"hoisting {frame.name}", label, dx, dy, *line)
