"""The bars as a worker sees them who stands over them: what fails is ringed, arrows say where to."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from aadm_workbench.model import ColumnReport, Kind, PointResult
from aadm_workbench.report.directions import Compass
from aadm_workbench.report.drawing.sketch import Circle, Label, Point, Polyline, Shape, Sketch, arrow
from aadm_workbench.report.pages.crew import CrewAdvice, Shift
from aadm_workbench.report.words.labels import Language

SIDE = 220.0
"""Of the drawing, in its own units; the page gives it its size."""
_MARGIN = 36.0  # about the foot: labels and arrows of its outermost points
_ARROW = 26.0  # long enough to show a direction, whatever the distance
_MOVE = 52.0  # the arrow of the whole column: twice those of bars
_TURN_RADIUS = 30.0  # of the bow that shows a turn: within the innermost bars


def crew_sketch(column: ColumnReport, advice: CrewAdvice, language: Language) -> Sketch:
    """Bars (sleeves, where no bars were scanned), seen from above, turned as the plan lies.

    Arrows are not to scale: they show where to, and the number beside them how far.
    """
    points = column.points(Kind.REBAR) or column.points(Kind.SLEEVE)
    frame = _Frame(column, points, advice.compass.turn_deg)
    shifts = {shift.label: shift for shift in advice.shifts}
    shapes = [*_outline(column, frame), *_edge_names(advice.compass, language), *_marked(points, frame, shifts)]
    if "" in shifts:
        shapes += _move(shifts[""], frame, advice.turn_deg)
    return Sketch(SIDE, SIDE, tuple(shapes))


def sleeves_from_below(column: ColumnReport) -> Sketch | None:
    """The foot as one sees it who stands below it, y upwards; None where every sleeve was measured and none fails."""
    points = column.points(Kind.SLEEVE)
    if all(point.verdict in ("pass", "not_assessed") for point in points):
        return None
    frame = _Frame(column, points, 0.0, mirrored=True)
    return Sketch(SIDE, SIDE, (*_outline(column, frame), *_marked(points, frame, {})))


def _marked(points: Sequence[PointResult], frame: _Frame, shifts: dict[str, Shift]) -> Iterator[Shape]:
    """Every point with its name; those that fail or have to be moved are ringed."""
    for point in points:
        at = frame.place(point.design_mm)
        shift = shifts.get(point.label)
        alarming = shift is not None or point.verdict in ("fail", "not_measured")
        yield from _dot(point, at)
        if alarming:
            yield Circle(at, 10.5, "ring-fail")
        yield _name(point, at, frame, shift, alarming=alarming)
        if shift is not None:
            yield from _bend(shift, at, frame)


class _Frame:
    """From the column frame, mm, to the sketch: scaled, and turned so that the plan's top is at the top."""

    def __init__(
        self, column: ColumnReport, points: Sequence[PointResult], turn_deg: float, *, mirrored: bool = False
    ) -> None:
        ends = [abs(value) for point in points for value in point.design_mm[:2]]
        reach = max([*ends, *(side / 2.0 for side in column.size_mm or ()), 1.0])
        angle = math.radians(turn_deg)
        self.cosine, self.sine = math.cos(angle), math.sin(angle)
        self.mirror = -1.0 if mirrored else 1.0
        # Turned by 45 degrees the outline is wider by that factor.
        spread = abs(self.cosine) + abs(self.sine)
        self.scale = (SIDE / 2.0 - _MARGIN) / (reach * spread)
        x, y = column.size_mm or (0.0, 0.0)
        sine, cosine = abs(self.sine), abs(self.cosine)
        self.half = ((cosine * x + sine * y) / 2.0 * self.scale, (sine * x + cosine * y) / 2.0 * self.scale)

    def place(self, mm: Sequence[float]) -> Point:
        """Where a point of the column frame lies in the sketch."""
        x, y = self.turned((mm[0], mm[1]))
        return SIDE / 2.0 + x * self.scale, SIDE / 2.0 + y * self.scale

    def turned(self, vector: Point) -> Point:
        """A direction of the column frame as the sketch shows it."""
        across = self.cosine * vector[0] - self.sine * vector[1]
        return self.mirror * across, self.sine * vector[0] + self.cosine * vector[1]


def _outline(column: ColumnReport, frame: _Frame) -> Iterator[Shape]:
    if column.size_mm is not None:
        x, y = (side / 2.0 for side in column.size_mm)
        yield Polyline(tuple(frame.place(c) for c in ((-x, -y), (x, -y), (x, y), (-x, y))), "outline", closed=True)


def _dot(point: PointResult, at: Point) -> Iterator[Shape]:
    missing = point.verdict == "not_measured"
    style = f"fill-{point.verdict}" if point.verdict in ("fail", "inconclusive", "not_measured") else "bar"
    yield Circle(at, 5.5, style)
    if missing:
        yield Label(at, "?", 9.0, bold=True)


def _name(point: PointResult, at: Point, frame: _Frame, shift: Shift | None, *, alarming: bool) -> Label:
    """Outside of the pattern, where no arrow of the column stands; on the other side where the bar's own arrow does."""
    outwards = (at[0] - SIDE / 2.0, at[1] - SIDE / 2.0)
    straight = (math.copysign(1.0, outwards[0]), 0.0)
    if abs(outwards[1]) > abs(outwards[0]):
        straight = (0.0, math.copysign(1.0, outwards[1]))
    if shift is not None:
        x, y = frame.turned(shift.vector_mm)
        if x * straight[0] + y * straight[1] > 0.0:
            straight = (-straight[0], -straight[1])
    apart = _apart(at, straight, frame, 19.0 if alarming else 13.5)
    place = (at[0] + straight[0] * apart, at[1] + straight[1] * apart)
    return Label(place, point.label, 11.0 if alarming else 9.0, "text-fail" if alarming else "text", bold=alarming)


def _apart(at: Point, straight: Point, frame: _Frame, least: float) -> float:
    """How far from its point a name stands: beyond the outline where that is near, so that no line runs through it."""
    axis = 0 if straight[0] else 1
    to_edge = frame.half[axis] - straight[axis] * (at[axis] - SIDE / 2.0)
    return max(least, to_edge + (12.0 if axis == 0 else 8.0)) if 0.0 < to_edge < 24.0 else least


def _bend(shift: Shift, at: Point, frame: _Frame) -> Iterator[Shape]:
    x, y = frame.turned(shift.vector_mm)
    length = math.hypot(x, y)
    if length > 0.0:
        end = (at[0] + x / length * _ARROW, at[1] + y / length * _ARROW)
        yield arrow(at, end, "move", 9.0)
        beyond = (at[0] + x / length * (_ARROW + 9.0), at[1] + y / length * (_ARROW + 9.0))
        yield Label(beyond, f"{length:.1f} mm", 10.0, "text-move", bold=True)


def _move(shift: Shift, frame: _Frame, turn_deg: float) -> Iterator[Shape]:
    x, y = frame.turned(shift.vector_mm)
    length = math.hypot(x, y)
    middle = (SIDE / 2.0, SIDE / 2.0)
    if length >= 0.05:
        end = (middle[0] + x / length * _MOVE, middle[1] + y / length * _MOVE)
        yield arrow(middle, end, "move", 16.0)
        beside = (middle[0] + 0.55 * x / length * _MOVE, middle[1] + 0.55 * y / length * _MOVE)
        across = (-y / length * 15.0, x / length * 15.0)
        yield Label((beside[0] + across[0], beside[1] + across[1]), f"{length:.1f} mm", 13.0, "text-move", bold=True)
    if abs(turn_deg) >= 0.005:
        yield from _turn(middle, turn_deg)


def _turn(middle: Point, turn_deg: float) -> Iterator[Shape]:
    """A bow round the middle in the sense of the turn."""
    first, last = (200.0, 320.0) if turn_deg > 0.0 else (340.0, 220.0)
    steps = 16
    bow = [math.radians(first + (last - first) * step / steps) for step in range(steps + 1)]
    points = tuple((middle[0] + _TURN_RADIUS * math.cos(a), middle[1] + _TURN_RADIUS * math.sin(a)) for a in bow)
    yield Polyline(points[:-1], "move")
    yield Polyline(points[-3:], "move", head=13.0)
    yield Label((middle[0], middle[1] - _TURN_RADIUS - 13.0), f"{abs(turn_deg):.2f}°", 13.0, "text-move", bold=True)


def _edge_names(compass: Compass, language: Language) -> Iterator[Shape]:
    """At the four sides, where they lead to: grid axes or the sides of the plan."""
    if not compass.placed:
        return
    cosine, sine = math.cos(math.radians(compass.turn_deg)), math.sin(math.radians(compass.turn_deg))
    for heading in compass.headings:
        x, y = heading.unit
        way = (cosine * x - sine * y, sine * x + cosine * y)
        for sign, name in ((1.0, heading.along), (-1.0, heading.against)):
            ux, uy = sign * way[0], sign * way[1]
            at = (SIDE / 2.0 + ux * (SIDE / 2.0 - 16.0), SIDE / 2.0 + uy * (SIDE / 2.0 - 8.0))
            said = name.in_language(language)
            if abs(ux) > abs(uy):
                words = said.split(" ") if language == "en" else [said]
                yield from _stacked(at, words)
            else:
                yield Label(at, said, 8.0, "text-faint", bold=True)


def _stacked(at: Point, words: list[str]) -> Iterator[Shape]:
    """Words below each other, for the narrow sides."""
    lines = [words[0]] if len(words) == 1 else [words[0], " ".join(words[1:3]), " ".join(words[3:])]
    kept = [line for line in lines if line]
    for k, line in enumerate(kept):
        yield Label((at[0], at[1] + 9.0 * ((len(kept) - 1) / 2.0 - k)), line, 8.0, "text-faint", bold=True)
