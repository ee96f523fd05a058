"""Round faces of an exact solid, and the holes, tubes and bars that they bound."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.paths import Arc, Leg, Straight, joined
from aadm_workbench.design.recognise.tubes import CHAMFER_MM, Tube
from aadm_workbench.model import Array

ON_AXIS_MM = 0.01
"""Faces whose axes are nearer than this bound one hole or one bar: halves of a cylinder, chamfers, steps."""

_PARALLEL_COS = math.cos(math.radians(0.05))  # 0.05 degrees: faces of one cylinder, up to rounding
_TOUCHING_MM = 0.5  # faces of one hole end where the next begins, up to a seam
_ROUND_TURN = math.radians(350.0)
"""Faces that together go less far around their axis are fillets and slots."""

_SLIVER_MM = 0.05  # a face as narrow is left over by a cut, and bounds nothing


@dataclass(frozen=True, eq=False)
class RoundFace:
    """A face about an axis: a part of a cylinder or a cone. ``start`` and ``end`` (3,) mm on the axis; diameters there.

    ``inner`` where the material is outside it; ``turn`` is how far it goes around, radians.
    """

    start: Array
    end: Array
    start_mm: float
    end_mm: float
    turn: float
    inner: bool

    @property
    def along(self) -> Array:
        """(3,) unit."""
        way: Array = self.end - self.start
        return way / float(np.linalg.norm(way))


@dataclass(frozen=True, eq=False)
class Bend:
    """A bent part of a bar about the line through ``point`` (3,) mm along ``axis`` (3,), from ``start`` to ``end``."""

    start: Array
    end: Array
    point: Array
    axis: Array
    diameter_mm: float

    def leg(self) -> Leg:
        """The arc of the bar's own axis; of the two that join its ends, the shorter."""
        axis = self.axis / float(np.linalg.norm(self.axis))
        centre = self.point + float((self.start - self.point) @ axis) * axis
        u = self.start - centre
        v = np.cross(axis, u)
        onwards = self.end - centre
        turn = math.atan2(float(onwards @ v), float(onwards @ u))
        return Arc(centre, u, v, 0.0, turn) if abs(turn) > 1e-6 else Straight(self.start, self.end)


@dataclass(frozen=True, eq=False)
class _Segment:
    """Faces of one shape about one axis, joined: ``low`` to ``high`` mm along it, with the diameters there."""

    low: float
    high: float
    low_mm: float
    high_mm: float
    turn: float

    @property
    def length_mm(self) -> float:
        return self.high - self.low


def tubes_of(faces: Iterable[RoundFace]) -> list[Tube]:
    """Straight round bodies and holes that round faces bound.

    A bore on the axis of an outer cylinder makes it a tube; another is a hole of its own. A hole's diameter at an end
    is that of the wall behind the chamfer.
    """
    found: list[Tube] = []
    for family in _coaxial(faces):
        origin, along = family[0].start, family[0].along
        outer = _runs(_segments((face for face in family if not face.inner), origin, along))
        inner = _runs(_segments((face for face in family if face.inner), origin, along))
        for run in outer:
            bores = [bore for bore in inner if _overlap(run, bore)]
            inner = [bore for bore in inner if not any(bore is taken for taken in bores)]
            found.append(_body(run, bores, origin, along))
        found += [_hole(run, origin, along) for run in inner]
    return found


def bar_of(faces: Sequence[RoundFace], bends: Sequence[Bend]) -> Course | None:
    """The bent bar that a solid is; None where its parts do not make one course of one diameter."""
    straight = [_whole(family) for family in _coaxial(face for face in faces if not face.inner)]
    legs: list[Leg] = [Straight(start, end) for start, end, _ in straight]
    diameters = [diameter_mm for *_, diameter_mm in straight] + [bend.diameter_mm for bend in bends]
    legs += [bend.leg() for bend in bends]
    if not straight or max(diameters) - min(diameters) > 2.0 * ON_AXIS_MM:
        return None
    course = _in_order(legs)
    return Course(tuple(joined(course)), float(np.median(diameters))) if course else None


def _whole(family: Sequence[RoundFace]) -> tuple[Array, Array, float]:
    along = family[0].along
    points = np.array([point for face in family for point in (face.start, face.end)])
    level = (points - points[0]) @ along
    return points[int(level.argmin())], points[int(level.argmax())], family[0].start_mm


def _in_order(legs: Sequence[Leg]) -> list[Leg]:
    """Legs one after the other; empty where they do not make one course."""
    left = list(legs)
    course: list[Leg] = []
    ends = [end for leg in left for end in (leg.start, leg.end)]
    first = next((leg for leg in left for end in (leg.start, leg.end) if _met(end, ends) == 1), left[0])
    left = [leg for leg in left if leg is not first]
    course = [first if _met(first.start, ends) == 1 else first.reversed()]
    while left:
        reached = course[-1].end
        onward = next((leg for leg in left if _near(leg.start, reached) or _near(leg.end, reached)), None)
        if onward is None:
            return []
        left = [leg for leg in left if leg is not onward]
        course.append(onward if _near(onward.start, reached) else onward.reversed())
    return course


def _met(end: Array, ends: Sequence[Array]) -> int:
    return sum(_near(end, other) for other in ends)


def _near(first: Array, second: Array) -> bool:
    return float(np.linalg.norm(first - second)) < _TOUCHING_MM


def _coaxial(faces: Iterable[RoundFace]) -> list[list[RoundFace]]:
    families: list[list[RoundFace]] = []
    for face in faces:
        home = next((family for family in families if _on_axis(family[0], face)), None)
        if home is None:
            families.append([face])
        else:
            home.append(face)
    return families


def _on_axis(first: RoundFace, second: RoundFace) -> bool:
    along = first.along
    if abs(float(along @ second.along)) < _PARALLEL_COS:
        return False
    apart = np.array([second.start - first.start, second.end - first.start])
    across = apart - (apart @ along)[:, np.newaxis] * along
    return bool(np.linalg.norm(across, axis=1).max() < ON_AXIS_MM)


def _segments(faces: Iterable[RoundFace], origin: Array, along: Array) -> list[_Segment]:
    """Parts of one cylinder or cone joined into one; what does not go around is left out."""
    joined_up: list[_Segment] = []
    for face in faces:
        ends = sorted(
            [(float((face.start - origin) @ along), face.start_mm), (float((face.end - origin) @ along), face.end_mm)]
        )
        new = _Segment(ends[0][0], ends[1][0], ends[0][1], ends[1][1], face.turn)
        same = next((old for old in joined_up if _one_wall(old, new)), None)
        if same is not None:
            joined_up.remove(same)
            new = _Segment(same.low, same.high, same.low_mm, same.high_mm, same.turn + new.turn)
        joined_up.append(new)
    stacked = _stacked(joined_up)
    return sorted((part for part in stacked if part.turn > _ROUND_TURN), key=lambda part: part.low)


def _one_wall(first: _Segment, second: _Segment) -> bool:
    """Whether two parts lie side by side around the axis, at one height."""
    ends_mm = (first.low - second.low, first.high - second.high)
    widths_mm = (first.low_mm - second.low_mm, first.high_mm - second.high_mm)
    return max(map(abs, ends_mm)) < _TOUCHING_MM and max(map(abs, widths_mm)) < 2.0 * ON_AXIS_MM


def _stacked(parts: Sequence[_Segment]) -> list[_Segment]:
    """Parts of one cylinder that are cut at different heights (by a vent, by a seam) as one over their whole length."""
    whole = [part for part in parts if part.turn > _ROUND_TURN]
    left = [part for part in parts if part.turn <= _ROUND_TURN]
    while left:
        first = left[0]
        alike = [
            part
            for part in left
            if abs(part.low_mm - first.low_mm) < 2.0 * ON_AXIS_MM
            and abs(part.high_mm - first.high_mm) < 2.0 * ON_AXIS_MM
        ]
        left = [part for part in left if not any(part is member for member in alike)]
        low, high = min(part.low for part in alike), max(part.high for part in alike)
        # By its area a wall that goes all around fills its height; the cuts of vents take little of it.
        turn = sum(part.turn * part.length_mm for part in alike) / max(high - low, _SLIVER_MM)
        whole.append(_Segment(low, high, first.low_mm, first.high_mm, turn))
    return whole


def _runs(parts: Sequence[_Segment]) -> list[list[_Segment]]:
    """Segments that touch, from end to end."""
    runs: list[list[_Segment]] = []
    for part in parts:
        if runs and part.low - max(other.high for other in runs[-1]) < _TOUCHING_MM:
            runs[-1].append(part)
        else:
            runs.append([part])
    return runs


def _overlap(first: Sequence[_Segment], second: Sequence[_Segment]) -> bool:
    low = max(first[0].low, second[0].low)
    high = min(max(part.high for part in first), max(part.high for part in second))
    return high - low > _SLIVER_MM


def _body(outer: Sequence[_Segment], bores: Sequence[Sequence[_Segment]], origin: Array, along: Array) -> Tube:
    low, high = outer[0].low, max(part.high for part in outer)
    at_low = next((run for run in bores if run[0].low - low < _TOUCHING_MM), None)
    at_high = next((run for run in bores if high - max(part.high for part in run) < _TOUCHING_MM), None)
    widest_mm = max(max(part.low_mm, part.high_mm) for part in outer)
    bore_mm = (None if at_low is None else _mouths_mm(at_low)[0], None if at_high is None else _mouths_mm(at_high)[1])
    return Tube(origin + low * along, origin + high * along, widest_mm, bore_mm)


def _hole(run: Sequence[_Segment], origin: Array, along: Array) -> Tube:
    low, high = run[0].low, max(part.high for part in run)
    return Tube(origin + low * along, origin + high * along, None, _mouths_mm(run))


def _mouths_mm(run: Sequence[_Segment]) -> tuple[float, float]:
    """Diameters of a hole at its lower and upper end, behind a chamfer."""
    walls = [part for part in run if _is_wall(part)]
    lowest, highest = run[0], max(run, key=lambda part: part.high)
    return (
        walls[0].low_mm if walls and not _is_wall(lowest) else lowest.low_mm,
        walls[-1].high_mm if walls and not _is_wall(highest) else highest.high_mm,
    )


def _is_wall(part: _Segment) -> bool:
    """Whether a part is the sleeve's wall: a cylinder, or a cone too long for a chamfer."""
    tapers = abs(part.low_mm - part.high_mm) > ON_AXIS_MM
    return part.length_mm > (CHAMFER_MM if tapers else _SLIVER_MM)
