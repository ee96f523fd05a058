"""The foot of a column seen from above: where each point should be, and a magnified arrow to where it is."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

from aadm_workbench.assembly.following import name_of
from aadm_workbench.model import ColumnReport, GroupReport, Kind
from aadm_workbench.report.drawing.layout import Layout
from aadm_workbench.report.drawing.sketch import Circle, Label, Point, Polyline, Shape, Sketch, arrow, rectangle

SIDE = 200.0
"""Width and height of the sketch, its own units."""

_MARGIN = 24.0  # about the foot: labels of its outermost points
_LIMIT_RADIUS = 15.0  # of the ring that stands for the limit: seen, and clear of its neighbours
_LIMIT_OF_PITCH = 0.42  # of the distance of neighbours: rings do not touch
_ALARM_RING = 3.0  # about a point that fails, with half of its line
_LONGEST_ARROW = 38.0  # two and a half rings: what is far beyond its limit still ends on the sketch
_KEPT = 256  # arrangements of points, and of names: a job has few designs, and few columns of each that fail
_FACTORS = (200, 100, 50, 40, 25, 20, 15, 10, 8, 5, 4, 3, 2, 1)  # magnifications that a person can divide by


@dataclass(frozen=True)
class Mark:
    """A point of a sketch: its design place and its offset, mm, column frame, and what was said of it.

    ``follows`` where it fails only because another does.
    """

    label: str
    design_mm: Point
    offset_mm: Point | None
    limit_mm: float | None
    verdict: str
    follows: bool = False

    @property
    def is_alarming(self) -> bool:
        """Whether one has to look at it."""
        return self.verdict in ("fail", "inconclusive") and not self.follows


@dataclass(frozen=True)
class FootSketch:
    """The sketch, and how many times the arrows are longer than the offsets that they show."""

    sketch: Sketch
    factor: int
    limit_mm: float | None


def group_marks(group: GroupReport, follows: Collection[str] = ()) -> list[Mark]:
    """The points of sleeves or of rebars, measured minus design; ``follows`` are labels that others let fail."""
    return [
        Mark(
            point.label,
            (point.design_mm[0], point.design_mm[1]),
            point.offset_mm,
            point.limit_mm,
            point.verdict,
            point.label in follows,
        )
        for point in group.points
    ]


def pair_marks(column: ColumnReport, follows: Collection[str] = ()) -> list[Mark]:
    """Bars against their sleeves at the pose that is shown, rebar minus sleeve, drawn at the sleeve.

    ``follows`` are pairs, ``S1/R1``, that others let fail.
    """
    places = {point.label: (point.design_mm[0], point.design_mm[1]) for point in column.points(Kind.SLEEVE)}
    return [
        Mark(pair.sleeve, places[pair.sleeve], pair.offset_mm, pair.limit_mm, pair.verdict, name_of(pair) in follows)
        for pair in column.pairs
        if pair.sleeve in places
    ]


def foot_sketch(
    marks: Sequence[Mark],
    size_mm: Sequence[float] | None,
    diameter_mm: float,
    marked: Collection[str] = (),
    *,
    from_below: bool = False,
) -> FootSketch:
    """Outline, points, rings of the limit and arrows with +y at the top, seen from above, or from below: mirrored.

    Parameters
    ----------
    size_mm
        Of the cross-section; where unknown the outline is left out.
    diameter_mm
        Of the points as they are drawn.
    marked
        Labels of the points that get a ring more.
    """
    if from_below:
        marks = [_mirrored(mark) for mark in marks]
    reach = _reach(marks, size_mm)
    scale = (SIDE - 2.0 * _MARGIN) / (2.0 * reach)
    limit_mm = next((mark.limit_mm for mark in marks if mark.limit_mm), None)
    ring = min(_LIMIT_RADIUS, _LIMIT_OF_PITCH * _pitch_mm(tuple([mark.design_mm for mark in marks])) * scale)
    factor = _factor(marks, limit_mm, scale, ring)
    below: list[Shape] = []
    if size_mm is not None:
        x, y = size_mm[0] / 2.0 * scale, size_mm[1] / 2.0 * scale
        below.append(rectangle((SIDE / 2 - x, SIDE / 2 - y), (SIDE / 2 + x, SIDE / 2 + y), "outline"))
    below += _axes(from_below=from_below)
    shapes = [*below]
    radius = max(2.2, diameter_mm / 2.0 * scale)
    places = {
        mark.label: (SIDE / 2 + mark.design_mm[0] * scale, SIDE / 2 + mark.design_mm[1] * scale) for mark in marks
    }
    reach = max(radius, ring)
    arrows = []
    for mark in marks:
        at = places[mark.label]
        shapes += _mark(mark, at, scale, factor, radius, ring)
        if mark.label in marked:
            shapes.append(Circle(at, reach + 4.5, "ring-named"))
        if mark.offset_mm is not None and math.hypot(*mark.offset_mm) * scale * factor > reach:
            arrows.append(_arrow(mark, at, scale, factor))
    names = tuple(_to_name(mark, places[mark.label], reach, marked=mark.label in marked) for mark in marks)
    shapes += _names(names, radius, tuple(below), tuple(arrows))
    shapes.sort(key=_layer)
    return FootSketch(Sketch(SIDE, SIDE, tuple(shapes)), factor, limit_mm)


class _ToName(NamedTuple):
    """A name that is to be placed: with its sign, and without; ``keep`` is the radius about it that stays free."""

    texts: tuple[str, str]
    at: Point
    keep: float
    apart: float
    alarming: bool
    failed: bool


def _to_name(mark: Mark, at: Point, reach: float, *, marked: bool) -> _ToName:
    sign = {"fail": " ✗", "inconclusive": " ?", "not_measured": " –"}.get(mark.verdict, "")
    sign = f" ({sign.strip()})" if mark.follows and sign else sign
    keep = reach + (_ALARM_RING if mark.is_alarming else 0.0)
    apart = keep + (_ALARM_RING if marked else 0.0)
    failed = mark.verdict == "fail" and not mark.follows
    return _ToName((f"{mark.label}{sign}", mark.label), at, keep, apart, mark.is_alarming, failed)


@lru_cache(_KEPT)
def _names(
    names: tuple[_ToName, ...], solid: float, below: tuple[Shape, ...], arrows: tuple[Polyline, ...]
) -> tuple[Shape, ...]:
    """Names on nothing: not on points with their rings, arrows that leave these, the outline, the axes in the corner.

    Columns of one design whose points are all well have their names in the same places. What fails chooses first.
    """
    layout = Layout(SIDE, SIDE)
    for shape in (*below, *arrows):
        if isinstance(shape, Label):
            layout.keep_label(shape)
        elif isinstance(shape, Polyline):
            layout.keep_path(shape)
    for name in names:
        layout.keep_circle(name.at, name.keep, solid)
    shapes: list[Shape] = []
    for name in sorted(names, key=lambda name: not name.alarming):
        shapes += _name(layout, name)
    return tuple(shapes)


def _name(layout: Layout, name: _ToName) -> list[Shape]:
    """Towards the middle of the foot, where no arrow of another point and no edge is; elsewhere where that is taken.

    Without its sign where there is no room for both: arrows and rings say the same.
    """
    inwards = (SIDE / 2 - name.at[0], SIDE / 2 - name.at[1])
    style = "text-fail" if name.failed else "text"
    for text in name.texts:
        shapes = list(layout.beside(name.at, text, 7.5, name.apart, inwards, style=style, bold=name.failed))
        if shapes:
            return shapes
    return []


def _arrow(mark: Mark, at: Point, scale: float, factor: int) -> Polyline:
    """From the place of the design to the magnified one that was measured."""
    x, y = mark.offset_mm or (0.0, 0.0)
    style = "follows" if mark.follows else mark.verdict
    return arrow(at, (at[0] + x * scale * factor, at[1] + y * scale * factor), style, 3.6)


def _layer(shape: Shape) -> tuple[int, str]:
    """Outline and circles lie below arrows, and these below labels; what is alike lies together."""
    if isinstance(shape, Circle):
        return 1, shape.style
    if isinstance(shape, Label):
        return 3, f"{shape.size}{shape.style}"
    return (2, shape.style) if isinstance(shape, Polyline) and not shape.closed else (0, "")


def _reach(marks: Sequence[Mark], size_mm: Sequence[float] | None) -> float:
    ends = [abs(value) for mark in marks for value in mark.design_mm] + [value / 2.0 for value in size_mm or ()]
    return max([*ends, 1.0])


@lru_cache(_KEPT)
def _pitch_mm(places: tuple[Point, ...]) -> float:
    """Smallest distance between two points, mm."""
    found = [math.dist(place, other) for k, place in enumerate(places) for other in places[k + 1 :]]
    return min((apart for apart in found if apart > 1.0), default=1000.0)


def _factor(marks: Sequence[Mark], limit_mm: float | None, scale: float, ring: float) -> int:
    """The largest round factor at which neither ring nor arrow leaves its place."""
    longest_mm = max((math.hypot(*mark.offset_mm) for mark in marks if mark.offset_mm), default=0.0)
    fits = min(
        ring / (limit_mm * scale) if limit_mm else float(_FACTORS[0]),
        _LONGEST_ARROW / (longest_mm * scale) if longest_mm else float(_FACTORS[0]),
    )
    return next((factor for factor in _FACTORS if factor <= fits), 1)


def _mirrored(mark: Mark) -> Mark:
    offset = mark.offset_mm
    mirrored = None if offset is None else (-offset[0], offset[1])
    return replace(mark, design_mm=(-mark.design_mm[0], mark.design_mm[1]), offset_mm=mirrored)


def _axes(*, from_below: bool) -> Iterator[Shape]:
    """Where x and y point, in a lower corner."""
    corner, across = (SIDE - 3.0, -1.0) if from_below else (3.0, 1.0)
    yield arrow((corner, 3.0), (corner + 13.0 * across, 3.0), "guide", 3.0)
    yield Label((corner + 16.5 * across, 3.0), "x", 7.0, "text-faint")
    yield arrow((corner, 3.0), (corner, 16.0), "guide", 3.0)
    yield Label((corner, 20.0), "y", 7.0, "text-faint")


def _mark(mark: Mark, at: Point, scale: float, factor: int, radius: float, ring: float) -> Iterator[Shape]:
    yield Circle(at, radius, "design")
    if mark.limit_mm is not None and mark.offset_mm is not None:
        yield Circle(at, mark.limit_mm * scale * factor, "limit")
    if mark.is_alarming:
        yield Circle(at, max(radius, ring) + 2.0, "ring-fail" if mark.verdict == "fail" else "ring-open")
    if mark.offset_mm is None:
        yield from _unmeasured(at, radius)
    else:
        yield _arrow(mark, at, scale, factor)


def _unmeasured(at: Point, radius: float) -> Iterator[Shape]:
    """A dashed cross: nothing is known here."""
    r = radius * 0.9
    yield Polyline(((at[0] - r, at[1] - r), (at[0] + r, at[1] + r)), "not_measured")
    yield Polyline(((at[0] - r, at[1] + r), (at[0] + r, at[1] - r)), "not_measured")
