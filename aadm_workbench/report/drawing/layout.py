"""Names beside points so that nothing lies on anything: each text is measured, and put where its box is free.

A name is tried near its point first, in the wanted direction and then in those beside it, then smaller, then further
away with a thin line that leads to it. What finds no place is left out; the tables have it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from aadm_workbench.report.drawing.sketch import STYLES, Label, Point, Polyline, Shape, arrowhead

_LATIN, _WIDE = 0.6, 1.05  # of the size: figures and letters of the widest usual fonts, Chinese signs with their gap
_BOLD = 1.08  # bold letters are wider by that
_HEIGHT = 0.82  # of the size: from the foot of a letter to its head
_SMALLER = (1.0, 0.85, 0.7, 0.58)  # of the wanted size; four units at the least are still read on a screen
_FURTHER = (0.0, 3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0)  # beyond the nearest place, units of the drawing
_LED = 7.0  # from there on a line leads from the point to its name
_SHORTEST_LINE = 3.0  # one that is seen to lead somewhere
# from the wanted direction, alternately to either side: twelve ways round
_TURNS_DEG = (0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)
# twice as many where a line leads: far from a point, what is free is narrow
_FINE_TURNS_DEG = (*_TURNS_DEG, 15, -15, 45, -45, 75, -75, 105, -105, 135, -135, 165, -165)
_CLEARLY = 1.0  # units: by so much nearer a name is to its point than to another, or a line leads to it
_GAP = 0.8  # units: between any two things
_BETWEEN = 2.6  # units: between two names on one line, as wide as a space of the usual size: R1 R12 is not R1R12

Box = tuple[float, float, float, float]
"""Left, low, right, high."""


def width_of_label(text: str, size: float, *, bold: bool = False) -> float:
    """At most so wide is a text in any font that it may be drawn in."""
    wide = sum(_WIDE if ord(sign) > 0x2E7F else _LATIN for sign in text)
    return wide * size * (_BOLD if bold else 1.0)


def box_of(label: Label) -> Box:
    """What a label covers."""
    wide, high = width_of_label(label.text, label.size, bold=label.bold), _HEIGHT * label.size
    left = label.at[0] - {"start": 0.0, "middle": 0.5, "end": 1.0}[label.anchor] * wide
    return left, label.at[1] - high / 2.0, left + wide, label.at[1] + high / 2.0


class Layout:
    """What is taken of a drawing of a width and a height."""

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width, height
        self._circles: list[tuple[float, float, float, float]] = []
        self._boxes: list[Box] = []
        self._lines: list[tuple[Point, Point, float]] = []

    def keep_circle(self, centre: Point, radius: float, solid: float | None = None) -> None:
        """Nothing may lie on a circle, or in it; lines that lead to names may cross what of it is but a thin ring.

        Parameters
        ----------
        solid
            Radius of what no line may cross either; the whole circle where nothing is said.
        """
        self._circles.append((*centre, radius, radius if solid is None else solid))

    def keep_path(self, path: Polyline) -> None:
        """Nothing may lie on the lines of a path and on its arrowhead; what it encloses is free."""
        half = STYLES[path.style].width / 2.0
        ends = (*path.points[1:], path.points[0]) if path.closed else path.points[1:]
        self._lines += [(start, end, half) for start, end in zip(path.points, ends, strict=False)]
        if path.head > 0.0:
            tip, left, right = arrowhead(path)
            self._lines += [(tip, left, half), (left, right, half), (right, tip, half)]

    def keep_label(self, label: Label) -> None:
        """Nothing may lie on a text that stands where it has to."""
        self._boxes.append(box_of(label))

    def beside(
        self,
        at: Point,
        text: str,
        size: float,
        radius: float,
        towards: Point,
        *,
        style: str = "text",
        bold: bool = False,
    ) -> Iterator[Shape]:
        """A name for the point at a place, beyond a radius around it, ``towards`` a direction where that is free."""
        angle = math.atan2(towards[1], towards[0])
        for smaller in _SMALLER:
            half = width_of_label(text, size * smaller, bold=bold) / 2.0, _HEIGHT * size * smaller / 2.0
            for further in _FURTHER[: 3 if smaller > _SMALLER[-1] else None]:
                for turn_deg in _FINE_TURNS_DEG if further >= _LED else _TURNS_DEG:
                    way = angle + math.radians(turn_deg)
                    x, y = _middle(at, way, radius + further, half)
                    box = (x - half[0], y - half[1], x + half[0], y + half[1])
                    if not self.is_free(box):
                        continue
                    line = self._line_to(box, at, way, radius, further)
                    if line is not None:
                        self._boxes.append(box)
                        yield from line
                        yield Label((x, y), text, round(size * smaller, 2), style, bold=bold)
                        return

    def is_free(self, box: Box) -> bool:
        """Whether a box lies within the drawing, and on nothing that is there."""
        left, low, right, high = box[0] - _GAP, box[1] - _GAP, box[2] + _GAP, box[3] + _GAP
        if left < 0.0 or low < 0.0 or right > self.width or high > self.height:
            return False
        around = (left, low, right, high)
        for x, y, radius, _ in self._circles:
            # Most are not near, which a look at their sides tells, and a call would take longer than that.
            near = left - radius < x < right + radius and low - radius < y < high + radius
            if near and _distance((x, y), around) < radius:
                return False
        wide = _BETWEEN - _GAP
        for b in self._boxes:
            if left - wide < b[2] and b[0] < right + wide and low < b[3] and b[1] < high:
                return False
        for (x0, y0), (x1, y1), half in self._lines:
            beyond = (
                (x0 < left - half and x1 < left - half)
                or (x0 > right + half and x1 > right + half)
                or (y0 < low - half and y1 < low - half)
                or (y0 > high + half and y1 > high + half)
            )
            if not beyond and _crosses((x0, y0), (x1, y1), (left - half, low - half, right + half, high + half)):
                return False
        return True

    def _line_to(self, box: Box, at: Point, way: float, radius: float, further: float) -> list[Polyline] | None:
        """The line to a name where it could be taken for another one's, else none; None where it has no place."""
        if further < _LED and self._is_told_apart(at, radius, box):
            return []
        line = Polyline(_line_to_name(at, way, radius, further), "guide")
        if further < _SHORTEST_LINE or not self._is_clear(line, at):
            return None
        self.keep_path(line)
        return [line]

    def _is_told_apart(self, at: Point, radius: float, box: Box) -> bool:
        """Whether a text at a box is taken for the name of its point: every other circle is clearly further away."""
        own = _distance(at, box) - radius + _CLEARLY
        return all((x, y) == at or not _is_nearer((x, y), box, own + other) for x, y, other, _ in self._circles)

    def _is_clear(self, line: Polyline, at: Point) -> bool:
        """Whether the line from a point to its name crosses no other point and no other name."""
        start, end = line.points
        if any(_crosses(start, end, box) for box in self._boxes):
            return False
        return all((x, y) == at or to_line((x, y), start, end) > solid for x, y, _, solid in self._circles)


def _line_to_name(at: Point, way: float, radius: float, further: float) -> tuple[Point, Point]:
    """From the edge of a point to the box of its name."""
    x, y = math.cos(way), math.sin(way)
    return (at[0] + x * radius, at[1] + y * radius), (at[0] + x * (radius + further), at[1] + y * (radius + further))


def _distance(at: Point, box: Box) -> float:
    """From a place to a box; 0 within it."""
    x, y = at
    left, low, right, high = box
    across = left - x if x < left else max(0.0, x - right)
    up = low - y if y < low else max(0.0, y - high)
    return math.hypot(across, up)


def _is_nearer(at: Point, box: Box, apart: float) -> bool:
    """Whether a place is nearer to a box than that; most are not, which a look at its sides tells."""
    x, y = at
    if x <= box[0] - apart or x >= box[2] + apart or y <= box[1] - apart or y >= box[3] + apart:
        return False
    return _distance(at, box) < apart


def to_line(at: Point, start: Point, end: Point) -> float:
    """From a place to a line between two others."""
    along = (end[0] - start[0], end[1] - start[1])
    square = along[0] ** 2 + along[1] ** 2 or 1.0
    share = ((at[0] - start[0]) * along[0] + (at[1] - start[1]) * along[1]) / square
    share = min(max(share, 0.0), 1.0)
    return math.dist(at, (start[0] + share * along[0], start[1] + share * along[1]))


def _middle(at: Point, way: float, apart: float, half: Point) -> Point:
    """Of a box of half a width and height that begins so far from a point, in a direction."""
    wide, high = half
    x, y = math.cos(way), math.sin(way)
    # From the middle of a box to its edge in that direction.
    reach = min(wide / abs(x) if abs(x) > 1e-9 else math.inf, high / abs(y) if abs(y) > 1e-9 else math.inf)
    distance = apart + min(reach, math.hypot(wide, high)) + 2.0 * _GAP
    return at[0] + x * distance, at[1] + y * distance


def _crosses(start: Point, end: Point, box: Box) -> bool:
    """Whether a line passes through a box (Liang and Barsky 1984)."""
    (x0, y0), (x1, y1) = start, end
    if max(x0, x1) < box[0] or min(x0, x1) > box[2] or max(y0, y1) < box[1] or min(y0, y1) > box[3]:
        return False  # most of them
    first, last = 0.0, 1.0
    for p0, p1, low, high in ((x0, x1, box[0], box[2]), (y0, y1, box[1], box[3])):
        along = p1 - p0
        if abs(along) < 1e-9:
            if not low <= p0 <= high:
                return False
            continue
        a, b = sorted(((low - p0) / along, (high - p0) / along))
        first, last = max(first, a), min(last, b)
        if first > last:
            return False
    return True
