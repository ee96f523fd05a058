"""Courses of bars: where the axis of each bar of an element runs, from whatever its solids are.

Bars drawn as facets: where their axes run, from their two round ends.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.design.recognise.circles import Circle
from aadm_workbench.design.recognise.paths import Leg, Straight, joined
from aadm_workbench.design.recognise.rims import area_mm2, pieces_of, round_ends
from aadm_workbench.design.recognise.shapes import Mesh, Shape, SweptDisk, scale_across
from aadm_workbench.design.recognise.tubes import tubes
from aadm_workbench.model import Array

_TOUCHING_MM = 1.0  # pieces of one bar end where the next begins: drawn by hand or rounded
_TOUCHING_RATIO = 0.3
"""Pieces of one bar whose ends are nearer than this part of their diameter go on into each other."""

_HOLLOW_RATIO = 0.3  # bore over outer radius: a thread or a centre hole is narrower, a tube wider
_ONE_SIZE_MM = 0.1  # sizes of bars are whole millimetres; facets and rounding take less than this

_ON_WALL_RATIO = 0.02  # of the radius: corners are on the circle, up to rounding and a taper
_ONE_LEVEL_MM = 0.05  # rounding of a level
_FEWEST_SIDES = 4  # FreeCAD draws circles with four

FacetedBar = tuple[tuple[Leg, ...], float, float]
"""Legs, diameter mm and length mm of a bar."""


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


def faceted_bars(mesh: Mesh) -> list[FacetedBar]:
    """Every piece of a mesh that is a round bar with two ends; bends are cut short between its straight ends."""
    return [bar for piece in pieces_of(mesh) if (bar := _bar(piece)) is not None]


def _bar(piece: Mesh) -> FacetedBar | None:
    ends = round_ends(piece, _FEWEST_SIDES)
    if len(ends) != 2 or abs(ends[0][0].radius_mm - ends[1][0].radius_mm) > _ON_WALL_RATIO * ends[0][0].radius_mm:
        return None
    first, second = ends[0][0], ends[1][0]
    diameter_mm = first.radius_mm + second.radius_mm
    way = second.centre - first.centre
    across_mm = np.linalg.norm(way - float(way @ first.normal) * first.normal)
    if across_mm < _ON_WALL_RATIO * first.radius_mm + _ONE_LEVEL_MM:
        return (Straight(first.centre, second.centre),), diameter_mm, float(np.linalg.norm(way))
    inner = [_inner_end(piece.vertices, circle, len(outline)) for circle, outline, _ in ends]
    legs: list[Leg] = [Straight(first.centre, inner[0])]
    if np.linalg.norm(inner[1] - inner[0]) > _ONE_LEVEL_MM:
        legs.append(Straight(inner[0], inner[1]))
    legs.append(Straight(inner[1], second.centre))
    return tuple(joined(legs)), diameter_mm, _length(piece, ends)


def _inner_end(vertices: Array, end: Circle, sides: int) -> Array:
    """Where the straight part that begins at an end goes over into a bend: the last whole ring on its cylinder."""
    spokes = vertices - end.centre
    depth_mm = spokes @ end.normal
    off_axis_mm = np.linalg.norm(spokes - depth_mm[:, np.newaxis] * end.normal, axis=1)
    on_wall = np.abs(off_axis_mm - end.radius_mm) < _ON_WALL_RATIO * end.radius_mm
    levels = np.sort(depth_mm[on_wall])
    first = np.searchsorted(levels, levels - _ONE_LEVEL_MM)
    last = np.searchsorted(levels, levels + _ONE_LEVEL_MM)
    whole = levels[last - first >= 0.9 * sides]
    inside_mm = float(whole[np.abs(whole).argmax()]) if len(whole) else 0.0
    inner: Array = end.centre + inside_mm * end.normal
    return inner


def _length(piece: Mesh, ends: Sequence[tuple[Circle, Array, bool]]) -> float:
    """Length of a bar's axis: the area of its wall over its girth (Pappus)."""
    girths_mm = [float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).sum()) for _, rim, _ in ends]
    caps_mm2 = sum(_area(rim) for _, rim, closed in ends if closed)
    return (area_mm2(piece) - caps_mm2) / float(np.mean(girths_mm))


def _area(outline: Array) -> float:
    local = outline - outline.mean(axis=0)
    return float(np.linalg.norm(np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)) / 2.0)
