"""What a match shows: for each kind of column the margins of all pairs, and under them the best assignment."""

from __future__ import annotations

from collections.abc import Iterator

from rich.table import Table
from rich.text import Text

from aadm_workbench.model.across import FitCell, ShipmentGroup, ShipmentReport

from .terminal import new_table, verdict_text
from .told import Words

_CHOSEN = "*"


def match_tables(report: ShipmentReport, words: Words) -> Iterator[Table | str]:
    """Tables and lines for the terminal."""
    for group in report.groups:
        if group.columns and group.positions:
            yield _margin_table(group, words, turns=report.turns)
            yield ""
            yield _assignment_table(group, words)
            yield _summary(group, words)
        yield from _left_over(group, words)
        yield ""
    for problem in report.problems:
        yield words.of(problem.id, words.joined(problem.reasons))


def _margin_table(group: ShipmentGroup, words: Words, *, turns: bool) -> Table:
    """Rows are columns, columns are bars; a margin below zero does not go on."""
    title = words("title_of", mark=group.piece_mark) if group.piece_mark else words("title")
    table = new_table(words("shown.column"), *group.positions, numbers=group.positions, title=title)
    chosen = {(one.column, one.position) for one in group.assignments}
    for column, row in zip(group.columns, group.cells, strict=True):
        cells = (
            _cell(cell, (column, position) in chosen, words, turns=turns)
            for position, cell in zip(group.positions, row, strict=True)
        )
        table.add_row(Text(column), *cells)
    return table


def _cell(cell: FitCell, chosen: bool, words: Words, *, turns: bool) -> Text:
    if cell.margin is None:
        return Text(words.word("not_measured"), style="yellow")
    turned = f" @{cell.turn_deg:.0f}°" if turns and round(cell.turn_deg) else ""
    mark = _CHOSEN if chosen else " "
    style = ("bold " if chosen else "") + ("green" if cell.margin >= 0.0 else "red")
    return Text(f"{cell.margin:+.2f}{turned}{mark}", style=style)


def _assignment_table(group: ShipmentGroup, words: Words) -> Table:
    numbers = ("turn", "margin", "largest")
    table = words.table("shown.verdict", "shown.column", "on_bars", *numbers, "shown.reason", numbers=numbers)
    for one in group.assignments:
        distance = "" if one.max_mm is None else f"{one.max_mm:.2f} mm"
        more = len(one.reasons) - 1
        reason = words.said(one.reasons[0]) if one.reasons else ""
        reason += words("shown.more", number=more) if more > 0 else ""
        table.add_row(
            verdict_text(one.verdict, words.language),
            Text(one.column),
            Text(one.position),
            f"{one.turn_deg:.0f}°",
            f"{one.margin:+.2f}",
            distance,
            Text(reason),
        )
    return table


def _summary(group: ShipmentGroup, words: Words) -> str:
    if group.smallest_margin is None:
        return words("nothing")
    if group.as_listed_margin is None:
        return words("smallest", margin=group.smallest_margin)
    return words("as_listed", margin=group.smallest_margin, listed=group.as_listed_margin)


def _left_over(group: ShipmentGroup, words: Words) -> Iterator[str]:
    if group.spare_columns:
        yield words("spare", names=words.listed(group.spare_columns))
    if group.open_positions:
        yield words("open", names=words.listed(group.open_positions))
