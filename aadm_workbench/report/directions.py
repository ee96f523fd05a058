"""Directions in a worker's words: towards grid axis D, towards the top of the plan, towards the side of bars R4 to R7.

A vector of the column frame is told in the best words that the report allows: axes of the model's grid, or as the
columns of the report show how they run, else the directions of the plan where the model places the column, else the
sides of the column, named by the bars that stand there.
"""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from aadm_workbench.design.recognise.pattern import side_labels
from aadm_workbench.model import Array, ColumnReport, GridAxis, JobReport
from aadm_workbench.report.drawing.plan import grid_tags, place_mm
from aadm_workbench.report.drawing.sketch import Point
from aadm_workbench.report.words.labels import Phrase

SMALLEST_MM = 0.05
"""A component below this is left out: it would print as 0.0 mm."""

_PARALLEL_SINE = 0.5  # 30 degrees: axes of a grid that are closer point a person the same way
_AGREEING = 0.95  # of the length of a sum of units: those of one side, within 18 degrees
_APART_MM = 1.0  # axes that are nearer are one, drawn twice
_SNAP_DEG = 6.0  # what a person cannot tell from along the axis
_TAG = re.compile(r"(\d+)|(\D+)")


class Heading(NamedTuple):
    """A direction (2,) unit in the column frame, and what people call the way along it and against it."""

    unit: Point
    along: Phrase
    against: Phrase


@dataclass(frozen=True)
class Compass:
    """Two directions that any vector of the column frame is told in.

    Parameters
    ----------
    headings
        Not parallel.
    turn_deg
        By how much the column frame is turned against the plan, counter-clockwise; 0 where that is not known.
    placed
        Whether the model says how the column stands in the plan.
    """

    headings: tuple[Heading, Heading]
    turn_deg: float
    placed: bool

    def parts(self, vector_mm: Sequence[float]) -> list[tuple[float, Phrase]]:
        """How far to go, mm, each time in a direction; the parts add up to the vector."""
        (ax, ay), (bx, by) = self.headings[0].unit, self.headings[1].unit
        x, y = vector_mm
        determinant = ax * by - ay * bx
        shares = ((x * by - y * bx) / determinant, (ax * y - ay * x) / determinant)
        return [
            (abs(share), heading.along if share > 0.0 else heading.against)
            for share, heading in zip(shares, self.headings, strict=True)
            if abs(share) >= SMALLEST_MM
        ]

    def in_words(self, vector_mm: Sequence[float]) -> Phrase:
        """``3.8 mm towards grid 4 and 3.2 mm towards grid E``; empty where nothing is left to move."""
        parts = self.parts(vector_mm)
        return Phrase(
            " and ".join(f"{length:.1f} mm {way.en}" for length, way in parts),
            "，".join(f"{way.zh} {length:.1f} mm" for length, way in parts),
        )


@dataclass(frozen=True, eq=False)
class Grid:
    """How the axes of a floor run: those of the model's grid; without one, where its columns stand by their names.

    ``crossings`` are places of columns by the two axes that each stands on, ``counting`` the mean directions in which
    letters and numbers count up, as far as the columns show them.
    """

    axes: tuple[GridAxis, ...]
    crossings: Mapping[tuple[str, ...], Point]
    counting: tuple[Point | None, Point | None]

    @classmethod
    def of(cls, columns: Iterable[ColumnReport], axes: Sequence[GridAxis] = ()) -> Grid:
        """What columns and the axes of their model show."""
        crossings = {
            tags: place_mm(column.T_model_column)
            for column in columns
            if column.T_model_column is not None and len(tags := grid_tags(column)) == 2
        }
        counting = (_counting_up(crossings, 0), _counting_up(crossings, 1))
        return cls(tuple(axes), crossings, counting)


@lru_cache(maxsize=1)
def grid_of(report: JobReport) -> Grid:
    """The grid of a report; of a thousand columns it is found once."""
    return Grid.of(report.columns, report.grid)


def compass_of(grid: Grid, column: ColumnReport) -> Compass:
    """How directions at one of the columns of a floor are called."""
    if column.T_model_column is None:
        return Compass(_by_sides(column), 0.0, placed=False)
    T = column.T_model_column
    turn = math.atan2(T[1][0], T[0][0])
    families = _axis_headings(grid.axes, T) or _grid_headings(grid, column, T)
    plan = (
        Heading((1.0, 0.0), _plan("right", "右"), _plan("left", "左")),
        Heading((0.0, 1.0), _plan("top", "上"), _plan("bottom", "下")),
    )
    chosen = _two(families, plan)
    first, second = (heading._replace(unit=_turned(heading.unit, -turn)) for heading in chosen)
    return Compass((first, second), math.degrees(turn), placed=True)


def _two(families: list[Heading], plan: tuple[Heading, Heading]) -> tuple[Heading, Heading]:
    """The grid's directions, filled up with the direction of the plan that is least parallel to them."""
    if len(families) >= 2:
        return families[0], families[1]
    if not families:
        return plan
    across = min(plan, key=lambda heading: abs(_dot(heading.unit, families[0].unit)))
    return families[0], across


def _plan(en: str, zh: str) -> Phrase:
    return Phrase(f"towards the {en} of the plan", f"向平面图{zh}方")


def _axis_headings(axes: Sequence[GridAxis], T: Array) -> list[Heading]:
    """For each family of axes the direction across them, from the column to the next one, model frame."""
    found: list[Heading] = []
    for family in ("u", "v", "w"):
        lines = [_Line(axis, place_mm(T)) for axis in axes if axis.family == family and axis.start_mm != axis.end_mm]
        if not lines:
            continue
        own = min(lines, key=lambda line: (abs(line.ahead_mm), line.tag))
        unit = own.across
        if any(abs(_cross(unit, other.unit)) < _PARALLEL_SINE for other in found):
            continue
        offsets = sorted((line.ahead_mm * math.copysign(1.0, _dot(line.across, unit)), line.tag) for line in lines)
        after = next((tag for ahead_mm, tag in offsets if ahead_mm > own.ahead_mm + _APART_MM), None)
        before = next((tag for ahead_mm, tag in reversed(offsets) if ahead_mm < own.ahead_mm - _APART_MM), None)
        if after is not None or before is not None:
            found.append(Heading(_snapped(unit, T), _towards(after, before), _towards(before, after)))
    return found


class _Line:
    """A grid axis seen from a place: its direction across, and how far ahead in that direction it runs, mm."""

    def __init__(self, axis: GridAxis, place: Point) -> None:
        (x0, y0), (x1, y1) = axis.start_mm, axis.end_mm
        length = math.hypot(x1 - x0, y1 - y0)
        self.tag = axis.tag
        self.across = (-(y1 - y0) / length, (x1 - x0) / length)
        self.ahead_mm = _dot((x0 - place[0], y0 - place[1]), self.across)


def _grid_headings(grid: Grid, column: ColumnReport, T: Array) -> list[Heading]:
    """For letters and for numbers of the grid, the direction in which they count up, model frame."""
    own = grid_tags(column)
    if len(own) != 2:
        return []
    found: list[Heading] = []
    for family in (0, 1):
        unit = grid.counting[family]
        if unit is None or any(abs(_cross(unit, other.unit)) < _PARALLEL_SINE for other in found):
            continue
        known = sorted({tags[family] for tags in grid.crossings}, key=_order)
        after = next((tag for tag in known if _order(tag) > _order(own[family])), None)
        before = next((tag for tag in reversed(known) if _order(tag) < _order(own[family])), None)
        unit = _snapped(unit, T)
        found.append(Heading(unit, _towards(after, before), _towards(before, after)))
    return found


def _counting_up(crossings: Mapping[tuple[str, ...], Point], family: int) -> Point | None:
    """Mean direction from a crossing to the next of the same other axis; None where there is none, or they differ."""
    lines: dict[str, list[tuple[str, Point]]] = defaultdict(list)
    for tags, place in crossings.items():
        lines[tags[1 - family]].append((tags[family], place))
    units = []
    for line in lines.values():
        line.sort(key=lambda item: _order(item[0]))
        for (_, start), (_, end) in pairwise(line):
            length = math.hypot(end[0] - start[0], end[1] - start[1])
            if length > 1.0:
                units.append(((end[0] - start[0]) / length, (end[1] - start[1]) / length))
    if not units:
        return None
    x, y = sum(unit[0] for unit in units), sum(unit[1] for unit in units)
    length = math.hypot(x, y)
    return (x / length, y / length) if length > _AGREEING * len(units) else None


def _snapped(unit: Point, T: Array) -> Point:
    """The side of the column that a direction runs along, where it does: columns stand beside their axes, too."""
    sides = [(sign * float(T[0][k]), sign * float(T[1][k])) for k in (0, 1) for sign in (1.0, -1.0)]
    nearest = max(sides, key=lambda side: _dot(side, unit))
    return nearest if _dot(nearest, unit) > math.cos(math.radians(_SNAP_DEG)) else unit


def _towards(ahead: str | None, behind: str | None) -> Phrase:
    """Grid axes are named; beyond the last one only the way back has a name."""
    if ahead is not None:
        return Phrase(f"towards grid {ahead}", f"向 {ahead} 轴")
    return Phrase(f"away from grid {behind}", f"远离 {behind} 轴")


def _by_sides(column: ColumnReport) -> tuple[Heading, Heading]:
    """The sides of the column, named by the bars that stand there."""
    points = next((group.points for group in (column.rebars, column.sleeves) if group is not None), ())
    places = {point.label: (point.design_mm[0], point.design_mm[1]) for point in points}
    names = {
        side: side_name(places, unit)
        for side, unit in (("+x", (1.0, 0.0)), ("-x", (-1.0, 0.0)), ("+y", (0.0, 1.0)), ("-y", (0.0, -1.0)))
    }
    return Heading((1.0, 0.0), names["+x"], names["-x"]), Heading((0.0, 1.0), names["+y"], names["-y"])


_SKETCH = {
    (1.0, 0.0): Phrase("right in the sketch", "图中右侧"),
    (-1.0, 0.0): Phrase("left in the sketch", "图中左侧"),
    (0.0, 1.0): Phrase("top of the sketch", "图中上方"),
    (0.0, -1.0): Phrase("bottom of the sketch", "图中下方"),
}


def side_name(places: Mapping[str, Point], unit: Point) -> Phrase:
    """``towards the side of R4 to R7 (right in the sketch)``."""
    where = _SKETCH[unit]
    ends = side_labels(places, unit)
    if ends is None:
        return Phrase(f"towards the {where.en}", f"向{where.zh}")
    first, last = ends
    return Phrase(f"towards the side of {first} to {last} ({where.en})", f"向 {first} 至 {last} 一侧（{where.zh}）")


def _order(tag: str) -> tuple[tuple[int, int, str], ...]:
    """1, 2, 10, A, B, AA: as people count."""
    return tuple((int(digits or -1), len(rest), rest) for digits, rest in _TAG.findall(tag))


def _turned(vector: Point, angle: float) -> Point:
    cosine, sine = math.cos(angle), math.sin(angle)
    return cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1]


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return float(a[0] * b[0] + a[1] * b[1])


def _cross(a: Point, b: Point) -> float:
    return a[0] * b[1] - a[1] * b[0]
