"""The floor seen from above: every column at its place in the model, with the sign and colour of its verdict."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, ColumnReport, GridAxis
from aadm_workbench.report.drawing.layout import Layout, box_of, width_of_label
from aadm_workbench.report.drawing.sketch import Label, Link, Point, Polyline, Shape, Sketch, rectangle
from aadm_workbench.report.words.labels import SIGN

WIDTH = 1000.0
"""Of the drawing, in its own units; the page gives it its size."""
_MARGIN = 70.0  # about the columns: tags of the axes
_EDGE = 26.0  # between the end of an axis and the edge: its name
_SMALLEST, _LARGEST = 12.0, 44.0  # of a column's square: still clicked, and not larger than its name needs
_LONGEST_NAME = 16  # letters: as wide as two squares
_SMALLEST_NAME = 5.0  # 2 mm high on A4; where that is too wide a click says the name
_HIGHEST, _OF_PAGE = 620.0, 1350.0
"""Height of the drawing: a long floor leaves room on the page, one of many columns fills it."""
_ON_ANOTHER_MM = 100.0  # no column is that thin
_CROWDED = 24.0  # between two columns: nearer, their squares touch and names have no room


@dataclass(frozen=True)
class Plan:
    """One storey, or the columns whose place is not known (``placed`` false)."""

    storey: str
    placed: bool
    sketch: Sketch


def floor_plans(
    columns: Sequence[ColumnReport],
    anchors: dict[str, str],
    axes: Sequence[GridAxis] = (),
    most_tiles: int | None = None,
) -> list[Plan]:
    """A plan for each storey, and one of tiles for columns without a place.

    Parameters
    ----------
    anchors
        Where a click on a column leads, by its id.
    axes
        Of the model's grid; without any, lines join columns that stand on one axis by their names.
    most_tiles
        In one plan: as many as fit on a page. None for all.
    """
    storeys: dict[str, list[ColumnReport]] = defaultdict(list)
    tiles = []
    for column in columns:
        if column.T_model_column is None:
            tiles.append(column)
        else:
            storeys[column.storey or ""].append(column)
    plans = [Plan(storey, True, _placed(storeys[storey], anchors, axes)) for storey in sorted(storeys)]
    step = most_tiles or max(len(tiles), 1)
    return plans + [Plan("", False, _tiles(tiles[k : k + step], anchors)) for k in range(0, len(tiles), step)]


def place_mm(T: Array) -> Point:
    """Where a column with that ``T_model_column`` stands in the plan of the model, mm."""
    return float(T[0][3]), float(T[1][3])


def grid_tags(column: ColumnReport) -> tuple[str, ...]:
    """The axes that a column stands on: ``C/3`` gives C and 3."""
    return tuple(tag for tag in (column.grid or "").split("/") if tag)


def _placed(columns: Sequence[ColumnReport], anchors: dict[str, str], axes: Sequence[GridAxis]) -> Sketch:
    places = [place_mm(column.T_model_column) for column in columns if column.T_model_column is not None]
    low = (min(x for x, _ in places), min(y for _, y in places))
    span = (max(x for x, _ in places) - low[0], max(y for _, y in places) - low[1])
    nearest_mm = _nearest_mm(places)
    widest, highest, filled = (
        (side - 2 * _MARGIN) / max(along, 1.0)
        for side, along in ((WIDTH, span[0]), (_HIGHEST, span[1]), (_OF_PAGE, span[1]))
    )
    scale = min(widest, max(highest, min(filled, _CROWDED / nearest_mm)))
    height = span[1] * scale + 2 * _MARGIN
    inset = (WIDTH - span[0] * scale) / 2.0
    at = [(inset + (x - low[0]) * scale, _MARGIN + (y - low[1]) * scale) for x, y in places]
    apart = min(WIDTH, nearest_mm * scale)
    half = min(_LARGEST, max(_SMALLEST, 0.3 * apart)) / 2.0
    frame = (WIDTH, height)

    def placed(mm: Point) -> Point:
        return inset + (mm[0] - low[0]) * scale, _MARGIN + (mm[1] - low[1]) * scale

    lines = [(axis.tag, placed(axis.start_mm), placed(axis.end_mm)) for axis in axes]
    shapes: list[Shape] = [*(_axis_lines(lines, frame) if lines else _grid_lines(columns, at))]
    for column, place in zip(columns, at, strict=True):
        shapes.append(_column(column, place, half, anchors, apart))
    return Sketch(WIDTH, height, tuple(shapes))


def _nearest_mm(places_mm: Sequence[Point]) -> float:
    """Smallest distance between two columns that do not stand on one another; infinite where there is none."""
    x, y = np.array(places_mm, dtype=float).T
    nearest = math.inf
    for k in range(len(places_mm) - 1):
        apart = np.hypot(x[k + 1 :] - x[k], y[k + 1 :] - y[k])
        nearest = min(nearest, float(np.min(apart, where=apart > _ON_ANOTHER_MM, initial=nearest)))
    return nearest


def _tiles(columns: Sequence[ColumnReport], anchors: dict[str, str]) -> Sketch:
    in_row = min(len(columns), 10)
    step = WIDTH / max(in_row, 5)
    rows = -(-len(columns) // in_row)
    height = rows * 90.0
    shapes = [
        _column(column, (step * (k % in_row + 0.5), height - 90.0 * (k // in_row) - 38.0), 20.0, anchors, step)
        for k, column in enumerate(columns)
    ]
    return Sketch(WIDTH, height, tuple(shapes))


def plan_verdict(column: ColumnReport) -> str:
    """The sign of a column in the plan: what passed but was never tried on its bars has no tick, for it must wait."""
    return "not_assessed" if column.verdict == "pass" and column.goes_on != "pass" else column.verdict


def _column(column: ColumnReport, at: Point, half: float, anchors: dict[str, str], room: float) -> Link:
    """Its square with its sign, and its name where that fits between its neighbours, which are ``room`` away."""
    verdict = plan_verdict(column)
    low, high = (at[0] - half, at[1] - half), (at[0] + half, at[1] + half)
    shapes: list[Shape] = [
        rectangle(low, high, f"fill-{verdict}"),
        Label(at, SIGN[verdict], half * 1.4, "text", bold=True),
    ]
    name = column.id if len(column.id) <= _LONGEST_NAME else f"{column.id[: _LONGEST_NAME - 1]}…"
    size = min(15.0, max(8.0, half * 0.8), 0.95 * room / width_of_label(name, 1.0, bold=True))
    if size >= _SMALLEST_NAME:
        style = "text-fail" if verdict == "fail" else "text"
        said = Label((at[0], at[1] - half - size * 0.75), name, round(size, 1), style, bold=True)
        left, foot, right, head = box_of(said)
        shapes += [rectangle((left, foot), (right, head), "paper"), said]  # axes run behind names
    return Link(anchors[column.id], column.id, tuple(shapes))


def _axis_lines(lines: Sequence[tuple[str, Point, Point]], frame: Point) -> Iterator[Shape]:
    """Axes of the model as far as they run through the drawing, their names at their ends where there is room."""
    layout = Layout(*frame)
    for tag, start, end in lines:
        ends = _within(start, end, frame)
        if ends is None:
            continue
        yield Polyline(ends, "axis")
        for near, far in (ends, ends[::-1]):
            length = math.dist(near, far) or 1.0
            away = ((near[0] - far[0]) / length, (near[1] - far[1]) / length)
            label = Label((near[0] + 12.0 * away[0], near[1] + 12.0 * away[1]), tag, 17.0, "text-faint", bold=True)
            if layout.is_free(box_of(label)):
                layout.keep_label(label)
                yield label
                break


def _within(start: Point, end: Point, frame: Point) -> tuple[Point, Point] | None:
    """The part of a line that lies in the drawing, clear of its edge (Liang and Barsky 1984); None where none does."""
    first, last = 0.0, 1.0
    for p0, p1, high in ((start[0], end[0], frame[0]), (start[1], end[1], frame[1])):
        along, low = p1 - p0, _EDGE
        if abs(along) < 1e-9:
            if not low <= p0 <= high - _EDGE:
                return None
            continue
        a, b = sorted(((low - p0) / along, (high - _EDGE - p0) / along))
        first, last = max(first, a), min(last, b)
    if first >= last:
        return None
    x, y = end[0] - start[0], end[1] - start[1]
    return (start[0] + first * x, start[1] + first * y), (start[0] + last * x, start[1] + last * y)


def _grid_lines(columns: Sequence[ColumnReport], at: Sequence[Point]) -> Iterator[Shape]:
    """A line through the columns of each axis that at least two of them stand on."""
    members: dict[str, list[Point]] = defaultdict(list)
    for column, place in zip(columns, at, strict=True):
        for tag in grid_tags(column):
            members[tag].append(place)
    for tag, places in members.items():
        first, last = _ends(places)
        length = ((last[0] - first[0]) ** 2 + (last[1] - first[1]) ** 2) ** 0.5
        if length < 1.0:
            continue
        ux, uy = (last[0] - first[0]) / length, (last[1] - first[1]) / length
        reach = 44.0
        start = (first[0] - ux * reach, first[1] - uy * reach)
        end = (last[0] + ux * reach, last[1] + uy * reach)
        yield Polyline((start, end), "axis")
        yield Label((start[0] - ux * 12.0, start[1] - uy * 12.0), tag, 17.0, "text-faint", bold=True)


def _ends(places: Sequence[Point]) -> tuple[Point, Point]:
    """The first and the last place along the axis, from the left or from below."""
    spans = [max(place[k] for place in places) - min(place[k] for place in places) for k in (0, 1)]
    along = 0 if spans[0] >= spans[1] else 1
    return min(places, key=lambda place: place[along]), max(places, key=lambda place: place[along])
