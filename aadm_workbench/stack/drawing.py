"""The floor seen from above: arrows at the tops of columns, beams in the colour of what becomes of their seats."""

from __future__ import annotations

import math
import unicodedata
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, Verdict, worst
from aadm_workbench.report.drawing.sketch import Label, Point, Polyline, Shape, Sketch, arrow, rectangle
from aadm_workbench.report.tower import TowerPlan
from aadm_workbench.report.words.labels import SIGN
from aadm_workbench.stack.result import StackedColumn, StackedMember, StackPlan

WIDTH = 1000.0
"""Of the drawing, in its own units; the page gives it its size."""
_MARGIN, _HIGHEST = 80.0, 640.0  # about the columns, for arrows and names; of the drawing
_LONGEST = 62.0  # of an arrow: within the margin, and longer than the square of its column
_HALF_COLUMN, _HALF_BEAM = 15.0, 5.0  # squares that hold a sign; beams that are told from axes
_NAME_SIZE = 13.0  # of letters, as in the plan of the report
_ROUND = (1.0, 2.0, 5.0)  # factors of a scale that people can divide by
_SMALLEST_MM = 0.05  # prints as 0.1


def stack_drawings(plan: StackPlan) -> list[TowerPlan]:
    """A drawing for each storey that has columns with a place in the model."""
    storeys: dict[str, list[StackedColumn]] = defaultdict(list)
    for column in plan.columns:
        if column.measured.T_model_column is not None:
            storeys[column.measured.storey or ""].append(column)
    return [_drawing(storey, storeys[storey], plan.members) for storey in sorted(storeys)]


def top_in_plan(column: StackedColumn) -> Array | None:
    """How the top stands off, (2,) mm in the axes of the model; None where it is not predicted."""
    if column.top is None or column.measured.T_model_column is None:
        return None
    return in_plan_axes(column, np.array(column.top.offset_mm))


def in_plan_axes(column: StackedColumn, vector: Array) -> Array:
    """A displacement (2,) of a column in the axes of the plan; in its own where it has no place in one."""
    T = column.measured.T_model_column
    return vector if T is None else np.asarray(T[:2, :2] @ vector)


def _drawing(storey: str, columns: Sequence[StackedColumn], members: Sequence[StackedMember]) -> TowerPlan:
    own = {column.measured.id for column in columns}
    beams = [member for member in members if own & {end for end in member.ends if end}]
    places = [T[:2, 3] for one in columns if (T := one.measured.T_model_column) is not None]
    frame = _Frame.of(np.array([*places, *(end[:2] for member in beams for end in member.points_mm)]))
    longest_mm = max((float(np.hypot(*top)) for one in columns if (top := top_in_plan(one)) is not None), default=0.0)
    times = _round_down(_LONGEST / max(longest_mm, _SMALLEST_MM) / frame.scale)
    shapes: list[Shape] = []
    for member in beams:
        shapes += _beam(member, frame)
    for column in columns:
        shapes += _column(column, frame, times)
    return TowerPlan(storey, times, Sketch(WIDTH, frame.height, tuple(shapes)))


@dataclass(frozen=True, eq=False)
class _Frame:
    """From the plan of the model, mm, to the drawing."""

    low: Array
    scale: float
    inset: float
    height: float

    @classmethod
    def of(cls, places: Array) -> _Frame:
        low, span = places.min(axis=0), np.ptp(places, axis=0)
        scale = min((WIDTH - 2 * _MARGIN) / max(span[0], 1.0), (_HIGHEST - 2 * _MARGIN) / max(span[1], 1.0))
        scale = min(float(scale), 0.25)  # a single column is not drawn larger than a floor
        return cls(low, scale, (WIDTH - float(span[0]) * scale) / 2.0, float(span[1]) * scale + 2 * _MARGIN)

    def at(self, place: Array) -> Point:
        x, y = (place[:2] - self.low) * self.scale
        return self.inset + float(x), _MARGIN + float(y)


def _beam(member: StackedMember, frame: _Frame) -> Iterator[Shape]:
    counted = [judged.verdict for judged in (member.span_mm, *member.seat_mm)]
    known = [one for one in counted if one is not Verdict.NOT_ASSESSED]
    verdict = worst(known) if known else Verdict.NOT_ASSESSED
    (x0, y0), (x1, y1) = (frame.at(end) for end in member.points_mm)
    length = math.hypot(x1 - x0, y1 - y0) or 1.0
    nx, ny = -(y1 - y0) / length * _HALF_BEAM, (x1 - x0) / length * _HALF_BEAM
    corners = ((x0 - nx, y0 - ny), (x1 - nx, y1 - ny), (x1 + nx, y1 + ny), (x0 + nx, y0 + ny))
    yield Polyline(corners, f"fill-{verdict.value}", closed=True)
    said = "" if member.span_mm.value is None else f" {member.span_mm.value:+.1f}"
    level = abs(ny) > abs(nx)
    at = ((x0 + x1) / 2.0 + (0.0 if level else 10.0), (y0 + y1) / 2.0 + (15.0 if level else 0.0))
    yield Label(at, f"{SIGN[verdict.value]} {_short(member.id)}{said}", 12.0, "text", "middle" if level else "start")


def _column(column: StackedColumn, frame: _Frame, times: int) -> Iterator[Shape]:
    assert column.measured.T_model_column is not None
    x, y = frame.at(column.measured.T_model_column[:2, 3])
    verdict = (Verdict.NOT_MEASURED if column.top is None else column.top.judged.verdict).value
    yield rectangle((x - _HALF_COLUMN, y - _HALF_COLUMN), (x + _HALF_COLUMN, y + _HALF_COLUMN), f"fill-{verdict}")
    top = top_in_plan(column)
    if top is None:
        yield Label((x, y), SIGN[verdict], 17.0, "text", bold=True)
    elif np.hypot(*top) >= _SMALLEST_MM:
        dx, dy = top * times * frame.scale
        # Dashed where it says nothing of the grid.
        style = "not_measured" if column.basis == "bars" else "move"
        yield arrow((x, y), (x + float(dx), y + float(dy)), style, 12.0)
    off = "" if column.top is None or column.top.judged.value is None else f" {column.top.judged.value:.1f}"
    name = f"{_short(column.measured.id)}{off}"
    # Beside the beams that come from below, and within the drawing.
    at = (max(x - _HALF_COLUMN + 2.0, _reach(name, _NAME_SIZE)), y - _HALF_COLUMN - 11.0)
    yield Label(at, name, _NAME_SIZE, "text", "end", bold=True)


def _reach(text: str, size: float) -> float:
    """How wide a text is drawn at most: Chinese signs fill their square, others two thirds of it."""
    return size * sum(1.0 if unicodedata.east_asian_width(sign) in "WF" else 0.67 for sign in text)


def _short(name: str) -> str:
    return name if len(name) <= 16 else f"{name[:15]}…"


def _round_down(times: float) -> int:
    """The largest of 1, 2, 5, 10, 20 … that is not above a number; at least 1."""
    if times < 1.0:
        return 1
    power = 10.0 ** math.floor(math.log10(times))
    return int(max(step * power for step in _ROUND if step * power <= times))
