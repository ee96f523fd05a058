"""What a match shows: for each kind of column the margins of all pairs, and under them the best assignment."""

from __future__ import annotations

from collections.abc import Iterator

from rich.table import Table
from rich.text import Text

from aadm_workbench.model.across import FitCell, ShipmentGroup, ShipmentReport

from .terminal import new_table, verdict_text

_CHOSEN = "*"


def match_tables(report: ShipmentReport) -> Iterator[Table | str]:
    """Tables and lines for the terminal."""
    for group in report.groups:
        if group.columns and group.positions:
            yield _margin_table(group, turns=report.turns)
            yield ""
            yield _assignment_table(group)
            yield _summary(group)
        yield from _left_over(group)
        yield ""
    for problem in report.problems:
        yield f"{problem.id}: {'; '.join(problem.reasons)}"


def _margin_table(group: ShipmentGroup, *, turns: bool) -> Table:
    """Rows are columns, columns are bars; a margin below zero does not go on."""
    name = f"{group.piece_mark}: " if group.piece_mark else ""
    title = f"{name}margin of each column on the bars of each position"
    table = new_table("Column", *group.positions, numbers=group.positions, title=title)
    chosen = {(one.column, one.position) for one in group.assignments}
    for column, row in zip(group.columns, group.cells, strict=True):
        cells = (
            _cell(cell, (column, position) in chosen, turns=turns)
            for position, cell in zip(group.positions, row, strict=True)
        )
        table.add_row(Text(column), *cells)
    return table


def _cell(cell: FitCell, chosen: bool, *, turns: bool) -> Text:
    if cell.margin is None:
        return Text("not measured", style="yellow")
    turned = f" @{cell.turn_deg:.0f}°" if turns and round(cell.turn_deg) else ""
    mark = _CHOSEN if chosen else " "
    style = ("bold " if chosen else "") + ("green" if cell.margin >= 0.0 else "red")
    return Text(f"{cell.margin:+.2f}{turned}{mark}", style=style)


def _assignment_table(group: ShipmentGroup) -> Table:
    numbers = ("Turn", "Margin", "Largest distance")
    table = new_table("Verdict", "Column", "On the bars of", *numbers, "Reason", numbers=numbers)
    for one in group.assignments:
        distance = "" if one.max_mm is None else f"{one.max_mm:.2f} mm"
        more = len(one.reasons) - 1
        reason = (one.reasons[0] + (f" (+{more} more)" if more else "")) if one.reasons else ""
        table.add_row(
            verdict_text(one.verdict),
            Text(one.column),
            Text(one.position),
            f"{one.turn_deg:.0f}°",
            f"{one.margin:+.2f}",
            distance,
            Text(reason),
        )
    return table


def _summary(group: ShipmentGroup) -> str:
    if group.smallest_margin is None:
        return "No column was measured completely together with any bars"
    listed = "" if group.as_listed_margin is None else f"; as the job lists them {group.as_listed_margin:+.2f}"
    return f"Smallest margin {group.smallest_margin:+.2f}{listed}"


def _left_over(group: ShipmentGroup) -> Iterator[str]:
    if group.spare_columns:
        yield f"Columns without bars: {', '.join(group.spare_columns)}"
    if group.open_positions:
        yield f"Bars without a column: {', '.join(group.open_positions)}"
