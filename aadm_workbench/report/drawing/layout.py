"""Names beside points so that nothing lies on anything: each text is measured, and put where its box is free.

A name is tried near its point first, in the wanted direction and then in those beside it, then smaller, then further
away with a thin line that leads to it. What finds no place is left out; the tables have it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from aadm_workbench.report.drawing.sketch import Label, Point, Polyline, Shape

_LATIN, _WIDE = 0.6, 1.05  # of the size: figures and letters of the widest usual fonts, Chinese signs with their gap
_BOLD = 1.08  # bold letters are wider by that
_HEIGHT = 0.82  # of the size: from the foot of a letter to its head
_SMALLER = (1.0, 0.85, 0.7, 0.58)  # of the wanted size; four units at the least are still read on a screen
_FURTHER = (0.0, 3.0, 7.0, 12.0, 18.0, 26.0)  # beyond the nearest place, units of the drawing
_LED = 7.0  # from there on a line leads from the point to its name
# from the wanted direction, alternately to either side: twelve ways round
_TURNS_DEG = (0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)
_GAP = 0.8  # units: between any two things

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
        self._circles: list[tuple[float, float, float]] = []
        self._boxes: list[Box] = []
        self._lines: list[tuple[Point, Point]] = []

    def keep_circle(self, centre: Point, radius: float) -> None:
        """Nothing may lie on a circle, or in it."""
        self._circles.append((*centre, radius))

    def keep_line(self, start: Point, end: Point) -> None:
        """Nothing may lie on a line."""
        self._lines.append((start, end))

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
            for further in _FURTHER[: 3 if smaller > _SMALLER[-1] else None]:
                for turn_deg in _TURNS_DEG:
                    way = angle + math.radians(turn_deg)
                    label = _at(at, way, radius + further, text, size * smaller, style, bold=bold)
                    if self.is_free(box_of(label)):
                        yield from self._put(label, at, way, radius, further)
                        return

    def is_free(self, box: Box) -> bool:
        """Whether a box lies within the drawing, and on nothing that is there."""
        left, low, right, high = box[0] - _GAP, box[1] - _GAP, box[2] + _GAP, box[3] + _GAP
        if left < 0.0 or low < 0.0 or right > self.width or high > self.height:
            return False
        for x, y, radius in self._circles:
            dx, dy = x - min(max(x, left), right), y - min(max(y, low), high)
            if dx * dx + dy * dy < radius * radius:
                return False
        if any(left < b[2] and b[0] < right and low < b[3] and b[1] < high for b in self._boxes):
            return False
        return not any(_crosses(start, end, (left, low, right, high)) for start, end in self._lines)

    def _put(self, label: Label, at: Point, way: float, radius: float, further: float) -> Iterator[Shape]:
        self._boxes.append(box_of(label))
        if further >= _LED:
            ends = [(at[0] + math.cos(way) * r, at[1] + math.sin(way) * r) for r in (radius, radius + further)]
            self.keep_line(*ends)
            yield Polyline(tuple(ends), "guide")
        yield label


def _at(at: Point, way: float, apart: float, text: str, size: float, style: str, *, bold: bool) -> Label:
    """A label whose box begins so far from a point, in a direction."""
    wide, high = width_of_label(text, size, bold=bold) / 2.0, _HEIGHT * size / 2.0
    x, y = math.cos(way), math.sin(way)
    # From the middle of a box to its edge in that direction.
    reach = min(wide / abs(x) if abs(x) > 1e-9 else math.inf, high / abs(y) if abs(y) > 1e-9 else math.inf)
    reach = min(reach, math.hypot(wide, high))
    distance = apart + reach + 2.0 * _GAP
    return Label((at[0] + x * distance, at[1] + y * distance), text, round(size, 2), style, bold=bold)


def _crosses(start: Point, end: Point, box: Box) -> bool:
    """Whether a line passes through a box (Liang and Barsky 1984)."""
    first, last = 0.0, 1.0
    for p0, p1, low, high in ((start[0], end[0], box[0], box[2]), (start[1], end[1], box[1], box[3])):
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
