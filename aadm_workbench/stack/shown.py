"""A stack plan as reports show it: what to do, the plan of each storey, the sheet for the next storey's crew."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from aadm_workbench.model import SUMMED, Verdict
from aadm_workbench.report.sheets.numbers import pose_text
from aadm_workbench.report.tower import SettingOut, ToDo, TowerShown
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.stack.drawing import in_plan_axes, stack_drawings
from aadm_workbench.stack.result import StackedColumn, StackPlan
from aadm_workbench.stack.told import advice_phrase, against, by_reason, headline, limit_reasons, member_reasons
from aadm_workbench.stack.torsor import Torsor

_VERDICTS = tuple(verdict.value for verdict in (*SUMMED, Verdict.NOT_ASSESSED))


def tower_shown(plan: StackPlan) -> TowerShown:
    """What the page of the tower and the report of a check have in common."""
    said, mood = headline(plan)
    relative = any(column.basis == "bars" for column in plan.columns)
    return TowerShown(
        said,
        mood,
        phrase("stack.relative_banner") if relative else None,
        tuple(_to_do(plan)),
        tuple(_open_ends(plan)),
        tuple(stack_drawings(plan)),
        tuple(_legend(plan)),
        tuple(_setting_out(plan.columns)),
    )


def _to_do(plan: StackPlan) -> Iterator[ToDo]:
    for column in plan.columns:
        if column.advice is not None:
            yield ToDo(column.measured.id, advice_phrase(column), f"set_pose = {pose_text(column.advice.set_pose)}")
    yield from (ToDo(names, reason) for reason, names in by_reason(plan))


def _open_ends(plan: StackPlan) -> Iterator[tuple[str, Phrase]]:
    yield from limit_reasons(plan)
    yield from ((names, reason) for reason, names in member_reasons(plan))
    yield from ((one.about, one.reason) for one in plan.not_found)


def _legend(plan: StackPlan) -> Iterable[str]:
    """The verdicts that the drawing shows."""
    shown = {(Verdict.NOT_MEASURED if one.top is None else one.top.judged.verdict).value for one in plan.columns}
    shown |= {judged.verdict.value for member in plan.members for judged in (member.span_mm, *member.seat_mm)}
    return (verdict for verdict in _VERDICTS if verdict in shown)


def _setting_out(columns: Iterable[StackedColumn]) -> Iterator[SettingOut]:
    """A line for each way in which a column may be set: as it is told now, and as it could be told."""
    for column in columns:
        if column.next_bars is not None:
            yield _line(column, column.next_bars, phrase(f"stack.set_{column.origin}"))
        if column.advice is not None and column.advice.next_bars is not None:
            yield _line(column, column.advice.next_bars, phrase("stack.set_advised"))


def _line(column: StackedColumn, bars: Torsor, set_as: Phrase) -> SettingOut:
    x, y = in_plan_axes(column, bars.values[:2]).tolist()
    return SettingOut(
        column.measured.id,
        column.measured.grid or "",
        set_as,
        (x, y),
        math.degrees(bars.values[5]),
        float(bars.values[2]),
        float(np.sqrt((bars.covariance[0, 0] + bars.covariance[1, 1]) / 2.0)),
        against(column),
    )
