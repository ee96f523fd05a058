"""A stack plan for the terminal: columns, beams, what to set otherwise, and what was not found."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from rich.text import Text

from aadm_workbench.stack.told import advice_phrase, by_reason

from .terminal import in_words, new_table, verdict_text

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.stack.result import Judged, StackedColumn, StackedMember, StackPlan, Top

_AGAINST = {"control_points": "the grid", "storey_below": "the grid, through {below}", "bars": "its own bars"}


def stack_tables(plan: StackPlan) -> Iterator[Table | str]:
    """Tables and lines, the most important first."""
    yield _columns(plan)
    if plan.members:
        yield _members(plan)
    if plan.neighbours:
        yield _neighbours(plan)
    for column in plan.columns:
        if column.advice is not None:
            yield f"{column.measured.id}: set it {advice_phrase(column).en}"
    yield from (f"{names}: {reason.en}" for reason, names in by_reason(plan))
    for member in plan.members:
        yield from (f"{member.id}: {reason.en}" for reason in member.reasons)
    yield from (f"{one.about}: {one.reason.en}" for one in plan.not_found)


def _columns(plan: StackPlan) -> Table:
    numbers = ("Foot dx, dy", "Turn", "Top dx, dy", "Off", "u")
    table = new_table("Column", "Against", *numbers, "Verdict", numbers=numbers)
    for column in plan.columns:
        against = _AGAINST[column.basis].format(below=column.below)
        table.add_row(Text(column.measured.id), Text(against), *_foot(column), *_top(column.top))
    return table


def _foot(column: StackedColumn) -> tuple[str, str]:
    if column.placed is None:
        return "–", "–"
    x, y = column.placed.values[:2]
    return f"{x:+.2f}, {y:+.2f} mm", f"{math.degrees(column.placed.values[5]):+.3f}°"


def _top(top: Top | None) -> tuple[str | Text, ...]:
    if top is None:
        return "–", "–", "", "not predicted"
    x, y = top.offset_mm
    off = "" if top.judged.value is None else f"{top.judged.value:.2f} mm"
    return f"{x:+.2f}, {y:+.2f} mm", off, f"{top.u_mm:.2f} mm", verdict_text(top.judged.verdict)


def _members(plan: StackPlan) -> Table:
    numbers = ("Span", "u", "Seats", "Skew", "Fall")
    table = new_table("Beam", "On columns", *numbers, "Verdict", numbers=numbers)
    for member in plan.members:
        table.add_row(Text(member.id), Text(" – ".join(end or "?" for end in member.ends)), *_cells(member))
    return table


def _cells(member: StackedMember) -> tuple[str | Text, ...]:
    span = member.span_mm
    return (
        _mm(span),
        "" if span.u is None else f"{span.u:.2f} mm",
        ", ".join(map(_mm, member.seat_mm)),
        "–" if member.skew_deg.value is None else f"{member.skew_deg.value:+.3f}°",
        _mm(member.level_mm),
        verdict_text(member.verdict),
    )


def _mm(judged: Judged) -> str:
    return "–" if judged.value is None else f"{judged.value:+.2f} mm"


def _neighbours(plan: StackPlan) -> Table:
    table = new_table("Column", "Beams", "Not flush by", "u", "Verdict", numbers=("Not flush by", "u"))
    for pair in plan.neighbours:
        flush = pair.flush_mm
        u = "" if flush.u is None else f"{flush.u:.2f} mm"
        table.add_row(Text(pair.column), Text(" and ".join(pair.members)), _mm(flush), u, in_words(flush.verdict))
    return table
