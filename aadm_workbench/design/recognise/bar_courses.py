"""Courses of bars: where the axis of each bar of an element runs, from whatever its solids are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.design.recognise.faceted_bars import faceted_bars
from aadm_workbench.design.recognise.paths import Leg, Straight, joined
from aadm_workbench.design.recognise.shapes import Mesh, Shape, SweptDisk, scale_across
from aadm_workbench.design.recognise.tubes import tubes
from aadm_workbench.model import Array

_TOUCHING_MM = 1.0  # pieces of one bar end where the next begins: drawn by hand or rounded
_TOUCHING_RATIO = 0.3
"""Pieces of one bar whose ends are nearer than this part of their diameter go on into each other."""

_HOLLOW_RATIO = 0.3  # bore over outer radius: a thread or a centre hole is narrower, a tube wider
_ONE_SIZE_MM = 0.1  # sizes of bars are whole millimetres; facets and rounding take less than this


@dataclass(frozen=True, eq=False)
class Course:
    """The axis of a bar, mm: its ``legs`` in order, none of no length.

    ``hollow`` where it is a pipe. ``length_mm`` is that of its legs, unless its bends were not drawn as arcs.
    """

    legs: tuple[Leg, ...]
    diameter_mm: float
    hollow: bool = False
    drawn_length_mm: float | None = None

    @property
    def length_mm(self) -> float:
        """Along the axis, from end to end."""
        return sum(leg.length_mm for leg in self.legs) if self.drawn_length_mm is None else self.drawn_length_mm

    @property
    def points(self) -> Array:
        """(n, 3) mm, along the axis."""
        return np.vstack([leg.points for leg in self.legs])

    def moved(self, T: Array) -> Course:
        """The same after a motion (4, 4)."""
        factor = scale_across(T, self.legs[0].points[1] - self.legs[0].points[0])
        length_mm = None if self.drawn_length_mm is None else factor * self.drawn_length_mm
        return Course(tuple(leg.moved(T) for leg in self.legs), factor * self.diameter_mm, self.hollow, length_mm)


def courses(shape: Shape) -> list[Course]:
    """The bars, or the pieces of bars, that one solid is."""
    if isinstance(shape, SweptDisk):
        legs = tuple(joined(shape.legs))
        hollow = (shape.inner_radius_mm or 0.0) > _HOLLOW_RATIO * shape.radius_mm
        return [Course(legs, 2.0 * shape.radius_mm, hollow)] if legs else []
    found = [
        Course(
            (Straight(tube.start, tube.end),),
            tube.outer_mm,
            any((bore or 0.0) > _HOLLOW_RATIO * tube.outer_mm for bore in tube.bore_mm),
        )
        for tube in tubes(shape)
        if tube.outer_mm is not None
    ]
    if found or not isinstance(shape, Mesh):
        return found
    return [Course(legs, diameter_mm, False, length_mm) for legs, diameter_mm, length_mm in faceted_bars(shape)]


def whole_bars(pieces: Iterable[Course]) -> list[Course]:
    """Bars from their pieces: exporters draw the legs and bends of one bar as solids of their own."""
    left = list(pieces)
    if len(left) < 2:
        return left
    whole: list[Course] = []
    while left:
        course = left.pop(0)
        for _ in range(2):
            while (index := _continuation(course, left)) is not None:
                course = _joined(course, left.pop(index))
            course = _reversed(course)
        whole.append(course)
    return whole


def _continuation(course: Course, others: Sequence[Course]) -> int | None:
    """Number of the piece that begins or ends where a course ends."""
    if not others or _is_closed(course):
        return None
    end = course.legs[-1].end
    ends = np.array([(other.legs[0].start, other.legs[-1].end) for other in others])
    apart_mm = np.linalg.norm(ends - end, axis=2).min(axis=1)
    reach_mm = max(_TOUCHING_MM, _TOUCHING_RATIO * course.diameter_mm)
    for index in np.flatnonzero(apart_mm < reach_mm).tolist():
        other = others[index]
        alike = abs(other.diameter_mm - course.diameter_mm) < _ONE_SIZE_MM and other.hollow == course.hollow
        if alike and not _is_closed(other):
            return int(index)
    return None


def _is_closed(course: Course) -> bool:
    return bool(np.linalg.norm(course.legs[0].start - course.legs[-1].end) < _TOUCHING_MM)


def _joined(course: Course, onwards: Course) -> Course:
    end = course.legs[-1].end
    if np.linalg.norm(onwards.legs[0].start - end) > np.linalg.norm(onwards.legs[-1].end - end):
        onwards = _reversed(onwards)
    length_mm = None
    if course.drawn_length_mm is not None or onwards.drawn_length_mm is not None:
        length_mm = course.length_mm + onwards.length_mm
    return replace(course, legs=tuple(joined([*course.legs, *onwards.legs])), drawn_length_mm=length_mm)


def _reversed(course: Course) -> Course:
    return replace(course, legs=tuple(leg.reversed() for leg in reversed(course.legs)))
