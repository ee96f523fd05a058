"""The bars as a worker sees them who stands over them: what fails is ringed, arrows say where to."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from aadm_workbench.assembly.following import blame_of, name_of
from aadm_workbench.model import ColumnReport, Kind, PointResult
from aadm_workbench.report.directions import SMALLEST_MM, Compass
from aadm_workbench.report.drawing.layout import Layout, to_line
from aadm_workbench.report.drawing.sketch import STYLES, Circle, Label, Point, Polyline, Shape, Sketch, arrow
from aadm_workbench.report.pages.crew import SMALLEST_TURN_DEG, CrewAdvice, Shift, to_scan_again
from aadm_workbench.report.words.labels import Language

SIDE = 220.0
"""Of the drawing, in its own units; the page gives it its size."""
_DOT, _RING = 5.5, 10.5  # radii of a point, and of the ring about one to look at, where their neighbours are far
_SIGNS = {"fail": " ✗", "inconclusive": " ?", "not_measured": " –"}  # behind a name: no colour says it alone
_CLEAR = 1.5  # between two things, lines included
_MARGIN = 36.0  # about the foot: names and arrows of its outermost points, and where its sides lead to
_NARROW = 20.0  # the same where nobody knows where its sides lead to
_ARROWS = (26.0, 23.0, 20.0, 17.0)
"""Lengths that show a direction, whatever the distance: the longest that ends before the next point."""
_MOVE = 52.0  # the arrow of the whole column: twice those of bars
_TURN_RADIUS = 30.0  # of the bow that shows a turn: within the innermost bars


def crew_sketch(column: ColumnReport, advice: CrewAdvice, language: Language) -> Sketch:
    """Bars (sleeves, where no bars were scanned), seen from above, turned as the plan lies.

    Arrows are not to scale: they show where to, and the number beside them how far. A column of which only hoisting
    frames are known has its outline, and the arrow.
    """
    points = column.points(Kind.REBAR) or column.points(Kind.SLEEVE)
    margin = _MARGIN if advice.compass.placed else _NARROW
    frame = _Frame(column, points, advice.compass.turn_deg, margin)
    shifts = {shift.label: shift for shift in advice.shifts}
    layout = Layout(SIDE, SIDE)
    shapes = [*_outline(column, frame, layout), *_edge_names(advice.compass, language, layout)]
    if "" in shifts:
        shapes += _move(shifts[""], frame, advice.turn_deg, layout)
    kind = Kind.REBAR if column.rebars else Kind.SLEEVE
    return Sketch(SIDE, SIDE, (*shapes, *_marked(points, frame, shifts, rings_of(column, kind), layout, column)))


def sleeves_from_below(column: ColumnReport) -> Sketch | None:
    """The foot as one sees it who stands below it, y upwards; None where no sleeve is to be looked at."""
    points = column.points(Kind.SLEEVE)
    rings = rings_of(column, Kind.SLEEVE)
    if not rings and all(point.verdict in ("pass", "not_assessed") for point in points):
        return None
    frame = _Frame(column, points, 0.0, _NARROW, mirrored=True)
    layout = Layout(SIDE, SIDE)
    shapes = [*_outline(column, frame, layout)]
    return Sketch(SIDE, SIDE, (*shapes, *_marked(points, frame, {}, rings, layout, column)))


def rings_of(column: ColumnReport, kind: Kind) -> dict[str, str]:
    """The sleeves or bars to look at, and the style of the ring about each.

    Those that fail by themselves or were not measured; both ends of a spacing that fails though neither of them does;
    what is to be scanned again.
    """
    group, follows = column.group(kind), {*blame_of(column).follows}
    if group is None:
        return {}
    rings = {
        point.label: "ring-fail"
        for point in group.points
        if point.verdict in ("fail", "not_measured") and point.label not in follows
    }
    failing = [one.between for one in group.spacing if one.verdict == "fail" and name_of(one) not in follows]
    ends = [label for between in failing if not rings.keys() & {*between} for label in between]
    again = to_scan_again(column) if column.verdict == "inconclusive" else ()
    known = {point.label for point in group.points}
    return (
        dict.fromkeys([label for label in again if label in known], "ring-open")
        | dict.fromkeys(ends, "ring-fail")
        | rings
    )


def _marked(
    points: Sequence[PointResult],
    frame: _Frame,
    shifts: dict[str, Shift],
    rings: dict[str, str],
    layout: Layout,
    column: ColumnReport,
) -> Iterator[Shape]:
    """Every point with its name; those to look at and those that have to be moved are ringed, and named first."""
    follows = {*blame_of(column).follows}
    alarming = {
        point.label: rings.get(point.label, "ring-fail") for point in points if point.label in {*rings, *shifts}
    }
    apart = _apart(points, frame)
    dot = min(_DOT, 0.34 * apart)
    ring = max(min(_RING, apart - dot - _CLEAR), dot + 2.0 * _CLEAR)
    places = {point.label: frame.place(point.design_mm) for point in points}
    arrows = {
        label: _arrow(shift, places[label], frame, [at for other, at in places.items() if other != label], dot)
        for label, shift in shifts.items()
        if label in places and math.hypot(*shift.vector_mm) > 0.0
    }
    for point in points:
        at = places[point.label]
        layout.keep_circle(at, ring + STYLES["ring-fail"].width / 2.0 if point.label in alarming else dot)
        yield from _dot(point, at, dot, follows=point.label in follows and point.label not in alarming)
        if point.label in alarming:
            yield Circle(at, ring, alarming[point.label])
    for drawn in arrows.values():
        layout.keep_path(drawn)
    for label, drawn in arrows.items():
        yield drawn
        yield from _length(drawn, math.hypot(*shifts[label].vector_mm), layout)
    for point in sorted(points, key=lambda point: point.label not in alarming):
        named = point.label in alarming
        sign = "" if point.label in follows and not named else _SIGNS.get(point.verdict, "")
        yield from _name(f"{point.label}{sign}", places[point.label], layout, ring if named else dot, alarming=named)


def _apart(points: Sequence[PointResult], frame: _Frame) -> float:
    """Smallest distance of two points in the sketch."""
    places = [frame.place(point.design_mm) for point in points]
    found = [math.dist(place, other) for k, place in enumerate(places) for other in places[k + 1 :]]
    return min((apart for apart in found if apart > 1.0), default=SIDE)


class _Frame:
    """From the column frame, mm, to the sketch: scaled, and turned so that the plan's top is at the top."""

    def __init__(
        self,
        column: ColumnReport,
        points: Sequence[PointResult],
        turn_deg: float,
        margin: float,
        *,
        mirrored: bool = False,
    ) -> None:
        ends = [abs(value) for point in points for value in point.design_mm[:2]]
        reach = max([*ends, *(side / 2.0 for side in column.size_mm or ()), 1.0])
        angle = math.radians(turn_deg)
        self.cosine, self.sine = math.cos(angle), math.sin(angle)
        self.mirror = -1.0 if mirrored else 1.0
        # Turned by 45 degrees the outline is wider by that factor.
        spread = abs(self.cosine) + abs(self.sine)
        self.scale = (SIDE / 2.0 - margin) / (reach * spread)
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


def _outline(column: ColumnReport, frame: _Frame, layout: Layout) -> Iterator[Shape]:
    if column.size_mm is not None:
        x, y = (side / 2.0 for side in column.size_mm)
        corners = ((-x, -y), (x, -y), (x, y), (-x, y))
        outline = Polyline(tuple(frame.place(corner) for corner in corners), "outline", closed=True)
        layout.keep_path(outline)
        yield outline


def _dot(point: PointResult, at: Point, radius: float, *, follows: bool) -> Iterator[Shape]:
    """What fails only because another does is drawn as any bar: nothing is to be done about it."""
    missing = point.verdict == "not_measured"
    shown = point.verdict in ("fail", "inconclusive", "not_measured") and not follows
    yield Circle(at, radius, f"fill-{point.verdict}" if shown else "bar")
    if missing:
        yield Label(at, "?", 1.6 * radius, bold=True)


def _name(text: str, at: Point, layout: Layout, radius: float, *, alarming: bool) -> Iterator[Shape]:
    """Straight towards the middle, where no edge is; elsewhere where that is taken."""
    x, y = SIDE / 2.0 - at[0], SIDE / 2.0 - at[1]
    straight = (0.0, math.copysign(1.0, y)) if abs(y) > abs(x) else (math.copysign(1.0, x), 0.0)
    radius, size = (radius + 0.7, 11.0) if alarming else (radius, 9.0)
    style = "text-fail" if alarming else "text"
    yield from layout.beside(at, text, size, radius, straight, style=style, bold=alarming)


def _arrow(shift: Shift, at: Point, frame: _Frame, others: Sequence[Point], dot: float) -> Polyline:
    """Where to a bar is bent; over its neighbour only where this is nearer than any arrow is long."""
    x, y = frame.turned(shift.vector_mm)
    whole = math.hypot(x, y) or 1.0
    ends = [(at[0] + x / whole * length, at[1] + y / whole * length) for length in _ARROWS]
    free = (end for end in ends if all(to_line(other, at, end) > dot + 2.0 * _CLEAR for other in others))
    return arrow(at, next(free, ends[0]), "move", 9.0)


def _length(drawn: Polyline, mm: float, layout: Layout) -> Iterator[Shape]:
    """How far, at the tip of the arrow; beside it where there is no room."""
    at, end = drawn.points
    x, y = end[0] - at[0], end[1] - at[1]
    for ahead in ((x, y), (-y, x), (y, -x)):
        shapes = list(layout.beside(end, f"{mm:.1f} mm", 10.0, 2.0, ahead, style="text-move", bold=True))
        if shapes:
            yield from shapes
            return


def _move(shift: Shift, frame: _Frame, turn_deg: float, layout: Layout) -> Iterator[Shape]:
    x, y = frame.turned(shift.vector_mm)
    length = math.hypot(x, y)
    middle = (SIDE / 2.0, SIDE / 2.0)
    if length >= SMALLEST_MM:
        end = (middle[0] + x / length * _MOVE, middle[1] + y / length * _MOVE)
        drawn = arrow(middle, end, "move", 16.0)
        layout.keep_path(drawn)
        yield drawn
        half = (middle[0] + 0.55 * x / length * _MOVE, middle[1] + 0.55 * y / length * _MOVE)
        across = (-y / length, x / length)
        yield from layout.beside(half, f"{length:.1f} mm", 13.0, 5.0, across, style="text-move", bold=True)
    if abs(turn_deg) >= SMALLEST_TURN_DEG:
        layout.keep_circle(middle, _TURN_RADIUS)
        yield from _turn(middle, turn_deg, layout)


def _turn(middle: Point, turn_deg: float, layout: Layout) -> Iterator[Shape]:
    """A bow round the middle in the sense of the turn."""
    first, last = (200.0, 320.0) if turn_deg > 0.0 else (340.0, 220.0)
    steps = 16
    bow = [math.radians(first + (last - first) * step / steps) for step in range(steps + 1)]
    points = tuple((middle[0] + _TURN_RADIUS * math.cos(a), middle[1] + _TURN_RADIUS * math.sin(a)) for a in bow)
    yield Polyline(points[:-1], "move")
    yield Polyline(points[-3:], "move", head=13.0)
    said = f"{abs(turn_deg):.2f}°"
    yield from layout.beside(middle, said, 13.0, _TURN_RADIUS + 2.0, (0.0, -1.0), style="text-move", bold=True)


def _edge_names(compass: Compass, language: Language, layout: Layout) -> Iterator[Label]:
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
            # Words below each other on the narrow sides.
            lines = [said] if abs(ux) <= abs(uy) else _stacked(said)
            for k, line in enumerate(lines):
                y = at[1] + 9.0 * ((len(lines) - 1) / 2.0 - k)
                label = Label((at[0], y), line, 8.0, "text-faint", bold=True)
                layout.keep_label(label)
                yield label


def _stacked(said: str) -> list[str]:
    """A direction in short lines: ``towards``, ``grid D``."""
    words = said.split(" ")
    lines = [words[0], " ".join(words[1:3]), " ".join(words[3:])]
    return [line for line in lines if line]
