"""Straight round bodies and holes in a model's solids: what a sleeve, or a bar of facets, can be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.design.recognise.circles import FEWEST_VERTICES, Circle
from aadm_workbench.design.recognise.paths import Straight, joined, length_of
from aadm_workbench.design.recognise.rims import Rim, rims
from aadm_workbench.design.recognise.shapes import (
    Cut,
    HalfSpace,
    Loop,
    Mesh,
    Prism,
    Shape,
    SweptDisk,
    Turned,
    as_turned,
    radius_at,
    scale_across,
)
from aadm_workbench.model import Array

_ON_AXIS_MM = 0.5
"""Circles whose centres are off a common axis by less are turned about it."""

CHAMFER_MM = 20.0
"""A cone at a mouth that is shorter is a chamfer or a lead-in; a longer one is the sleeve itself."""

_ONE_LEVEL_MM = 0.5  # ends at one level, up to rounding and a seam
_SAME_DIAMETER_MM = 0.05  # rims of one bore, up to rounding
_PARALLEL_COS = np.cos(np.radians(1.0))  # 1 degree: parts of one tube, up to facets


@dataclass(frozen=True, eq=False)
class Tube:
    """A straight round body, hollow or not, or a round hole.

    ``start`` and ``end`` (3,) mm are the ends of its axis. ``outer_mm`` is its outer diameter, None for a hole;
    ``bore_mm`` the inner diameters at start and end, None where there is no bore.
    """

    start: Array
    end: Array
    outer_mm: float | None
    bore_mm: tuple[float | None, float | None]

    @property
    def length_mm(self) -> float:
        """Of its axis."""
        return length_of(self.end - self.start)

    @property
    def is_hole(self) -> bool:
        """Whether it is a hole in something else, and no body of its own."""
        return self.outer_mm is None

    def upwards(self, up: Array) -> Tube:
        """The same tube, its start the lower end along ``up`` (3,)."""
        if float((self.end - self.start) @ up) >= 0.0:
            return self
        return Tube(self.end, self.start, self.outer_mm, self.bore_mm[::-1])


def moved(tube: Tube, T: Array) -> Tube:
    """A tube after a motion (4, 4), which may scale along the axis by another factor than across."""
    ends = np.array([tube.start, tube.end]) @ T[:3, :3].T + T[:3, 3]
    factor = scale_across(T, tube.end - tube.start)
    outer_mm = None if tube.outer_mm is None else factor * tube.outer_mm
    bore_mm = [None if bore is None else factor * bore for bore in tube.bore_mm]
    return Tube(ends[0], ends[1], outer_mm, (bore_mm[0], bore_mm[1]))


def stacked(found: Sequence[Tube]) -> list[Tube]:
    """Tubes with those that follow each other on one axis made one: sleeves are drawn in sections."""
    left, whole = list(found), []
    while left:
        tube = left.pop(0)
        while (after := next((other for other in left if _follows(tube, other)), None)) is not None:
            left = [other for other in left if other is not after]
            tube = _prolonged(tube, after)
        whole.append(tube)
    return whole


def _follows(tube: Tube, other: Tube) -> bool:
    """Whether one ends where the other begins, both bodies or both holes, on one axis."""
    if tube.is_hole != other.is_hole or min(tube.length_mm, other.length_mm) < _ONE_LEVEL_MM:
        return False
    along, onwards = (each.end - each.start for each in (tube, other))
    parallel = abs(float(along @ onwards)) > _PARALLEL_COS * tube.length_mm * other.length_mm
    ends = np.array([[np.linalg.norm(a - b) for b in (other.start, other.end)] for a in (tube.start, tube.end)])
    # What lies inside the other shares an end with it too.
    apart_mm = max(np.linalg.norm(a - b) for a in (tube.start, tube.end) for b in (other.start, other.end))
    beyond = bool(apart_mm > max(tube.length_mm, other.length_mm) + _ONE_LEVEL_MM)
    return parallel and bool(ends.min() < _ONE_LEVEL_MM) and beyond


def _prolonged(tube: Tube, other: Tube) -> Tube:
    if min(np.linalg.norm(tube.start - p) for p in (other.start, other.end)) < _ONE_LEVEL_MM:
        tube = Tube(tube.end, tube.start, tube.outer_mm, tube.bore_mm[::-1])
    if np.linalg.norm(other.end - tube.end) < np.linalg.norm(other.start - tube.end):
        other = Tube(other.end, other.start, other.outer_mm, other.bore_mm[::-1])
    outer_mm = None if tube.outer_mm is None or other.outer_mm is None else max(tube.outer_mm, other.outer_mm)
    return Tube(tube.start, other.end, outer_mm, (tube.bore_mm[0], other.bore_mm[1]))


def tubes(shape: Shape, fewest: int = FEWEST_VERTICES) -> list[Tube]:
    """All straight round bodies and holes of one solid; where it is of facets, those of at least ``fewest`` sides."""
    match shape:
        case SweptDisk():
            return _of_swept_disk(shape)
        case Prism():
            return _of_prism(shape)
        case Turned():
            return _of_turned(shape)
        case Mesh():
            return _of_mesh(shape, fewest)
        case Cut():
            return _of_cut(shape, fewest)
        case HalfSpace():
            return []


def _of_swept_disk(disk: SweptDisk) -> list[Tube]:
    legs = joined(disk.legs)
    if len(legs) != 1 or not isinstance(legs[0], Straight):
        return []
    bore_mm = None if disk.inner_radius_mm is None else 2.0 * disk.inner_radius_mm
    return [Tube(legs[0].start, legs[0].end, 2.0 * disk.radius_mm, (bore_mm, bore_mm))]


def _of_prism(prism: Prism) -> list[Tube]:
    holes = [_swept(hole.circle, prism.sweep, is_hole=True) for hole in _round(prism.holes)]
    if prism.outer.circle is None:
        return holes
    body = _swept(prism.outer.circle, prism.sweep, is_hole=False)
    for hole in [hole for hole in holes if _off_axis(body, hole.start) < _ON_AXIS_MM]:
        body = replace(body, bore_mm=hole.bore_mm)
        holes.remove(hole)
    return [body, *holes]


def _round(loops: Iterable[Loop]) -> list[Loop]:
    return [loop for loop in loops if loop.circle is not None]


def _swept(circle: Circle | None, sweep: Array, *, is_hole: bool) -> Tube:
    assert circle is not None
    diameter_mm = 2.0 * circle.radius_mm
    bore_mm = diameter_mm if is_hole else None
    return Tube(circle.centre, circle.centre + sweep, None if is_hole else diameter_mm, (bore_mm, bore_mm))


def _of_turned(turned: Turned) -> list[Tube]:
    radius, height = turned.outline_rz.T
    low, high = float(height.min()), float(height.max())
    ends = [radius[np.abs(height - level) < _ONE_LEVEL_MM] for level in (low, high)]
    bore_mm = tuple(
        _behind_chamfer(2.0 * float(found.min()), 2.0 * radius, np.abs(height - level))
        if found.min() > _ONE_LEVEL_MM
        else None
        for found, level in zip(ends, (low, high), strict=True)
    )
    return [
        Tube(
            turned.origin + low * turned.axis,
            turned.origin + high * turned.axis,
            2.0 * float(max(found.max() for found in ends)),
            (bore_mm[0], bore_mm[1]),
        )
    ]


def _of_mesh(mesh: Mesh, fewest: int) -> list[Tube]:
    left = rims(mesh, fewest)
    found = []
    while left:
        first = left[0]
        family = [rim for rim in left if _coaxial(first.circle, rim.circle)]
        left = [rim for rim in left if not any(rim is member for member in family)]
        found += _between_ends(family, first.circle.normal, mesh.vertices)
    return found


def _coaxial(first: Circle, second: Circle) -> bool:
    apart = second.centre - first.centre
    across_mm = np.linalg.norm(apart - float(apart @ first.normal) * first.normal)
    # The rims of short bodies fix their axis badly, so the way between centres may lean with the normals.
    reach_mm = _ON_AXIS_MM + 0.02 * float(np.linalg.norm(apart))
    return bool(abs(float(first.normal @ second.normal)) > _PARALLEL_COS and across_mm < reach_mm)


def _between_ends(family: Sequence[Rim], normal: Array, vertices: Array) -> list[Tube]:
    """The tube between the outermost rims of one axis; none where all rims lie in one plane."""
    reference = family[0].circle.centre
    level = np.array([float((rim.circle.centre - reference) @ normal) for rim in family])
    if np.ptp(level) < _ONE_LEVEL_MM:
        return []
    ends = [
        [rim for rim, height in zip(family, level, strict=True) if abs(height - end) < _ONE_LEVEL_MM]
        for end in (level.min(), level.max())
    ]
    outer_mm, bores = zip(*(_diameters(end) for end in ends), strict=True)
    # A hole ends in the concrete, where its bottom is a disk that has no bore around it.
    if outer_mm[0] is None and bores[1] is None:
        outer_mm, bores = (None, None), (bores[0], outer_mm[1])
    elif outer_mm[1] is None and bores[0] is None:
        outer_mm, bores = (None, None), (outer_mm[0], bores[1])
    widest = [diameter for diameter in outer_mm if diameter is not None]
    start, end = (np.mean([rim.circle.centre for rim in rims_there], axis=0) for rims_there in ends)
    behind = [
        _behind_chamfer_of_facets(bore, centre, normal, vertices)
        for bore, centre in zip(bores, (start, end), strict=True)
    ]
    return [Tube(start, end, max(widest, default=None), (behind[0], behind[1]))]


def _behind_chamfer_of_facets(mouth_mm: float | None, centre: Array, normal: Array, vertices: Array) -> float | None:
    if mouth_mm is None:
        return None
    spokes = vertices - centre
    height = spokes @ normal
    diameters_mm = 2.0 * np.linalg.norm(spokes - np.outer(height, normal), axis=1)
    return _behind_chamfer(mouth_mm, diameters_mm, np.abs(height), FEWEST_VERTICES)


def _behind_chamfer(mouth_mm: float, diameters_mm: Array, behind_mm: Array, fewest: int = 1) -> float:
    """The bore behind the chamfer of a mouth.

    ``diameters_mm`` (n,) and ``behind_mm`` (n,) say of each corner how far from the axis and behind the mouth it is;
    at least ``fewest`` of them make a rim.
    """
    near = (behind_mm < CHAMFER_MM) & (diameters_mm > mouth_mm - 2.0 * CHAMFER_MM) & (diameters_mm > _ONE_LEVEL_MM)
    narrower = np.sort(diameters_mm[near & (diameters_mm < mouth_mm - _SAME_DIAMETER_MM)])
    rims_mm = narrower[: len(narrower) - fewest + 1]
    whole = narrower[fewest - 1 :] - rims_mm < _SAME_DIAMETER_MM
    return float(rims_mm[whole][0]) if whole.any() else mouth_mm


def _diameters(end: Sequence[Rim]) -> tuple[float | None, float | None]:
    """Outer and inner diameter at one end of a faceted tube, mm."""
    holes = [2.0 * rim.circle.radius_mm for rim in end if rim.hole]
    outlines = [2.0 * rim.circle.radius_mm for rim in end if not rim.hole]
    if not holes and max(outlines) - min(outlines) > _ONE_LEVEL_MM:
        return max(outlines), min(outlines)
    bore_mm = max(holes, default=None)
    wider = [diameter for diameter in outlines if bore_mm is None or diameter > bore_mm + _ONE_LEVEL_MM]
    return max(wider, default=None), bore_mm


def _of_cut(cut: Cut, fewest: int) -> list[Tube]:
    found = tubes(cut.body, fewest)
    if isinstance(cut.tool, HalfSpace):
        return [_shortened(tube, cut.tool) for tube in found]
    cone = as_turned(cut.tool)
    for hole in [_as_hole(tube) for tube in tubes(cut.tool, fewest)] if cone is None else [_turned_hole(cone)]:
        around = next((tube for tube in found if tube.outer_mm and _off_axis(tube, hole.start) < _ON_AXIS_MM), None)
        if around is None:
            found.append(hole)
        else:
            found = [_bored(tube, hole, cone) if tube is around else tube for tube in found]
    return found


def _as_hole(tube: Tube) -> Tube:
    return replace(tube, outer_mm=None, bore_mm=(tube.outer_mm or tube.bore_mm[0], tube.outer_mm or tube.bore_mm[1]))


def _turned_hole(cone: Turned) -> Tube:
    """The hole that a turned solid leaves, with its diameters at both ends."""
    low, high = float(cone.outline_rz[:, 1].min()), float(cone.outline_rz[:, 1].max())
    bore_mm = [2.0 * (radius_at(cone, level) or 0.0) for level in (low, high)]
    return Tube(cone.origin + low * cone.axis, cone.origin + high * cone.axis, None, (bore_mm[0], bore_mm[1]))


def _bored(tube: Tube, hole: Tube, cone: Turned | None = None) -> Tube:
    """A tube with the bore that a hole on its axis makes, at the ends that the hole reaches.

    Of a cone the bore is that where the tube ends, which may be anywhere along it.
    """
    along = (tube.end - tube.start) / tube.length_mm
    reach = sorted((float((hole.start - tube.start) @ along), float((hole.end - tube.start) @ along)))
    at_start = hole.bore_mm[0] if reach[0] < _ONE_LEVEL_MM else tube.bore_mm[0]
    at_end = hole.bore_mm[1] if reach[1] > tube.length_mm - _ONE_LEVEL_MM else tube.bore_mm[1]
    if cone is not None:
        widths = [radius_at(cone, float((end - cone.origin) @ cone.axis)) for end in (tube.start, tube.end)]
        at_start = at_start if widths[0] is None else 2.0 * widths[0]
        at_end = at_end if widths[1] is None else 2.0 * widths[1]
    return replace(tube, bore_mm=(at_start, at_end))


def _shortened(tube: Tube, away: HalfSpace) -> Tube:
    """A tube's axis as a plane leaves it; a plane that reaches only so far sideways may have missed it."""
    if away.bounded:
        return tube
    depth_mm = [float((point - away.point) @ away.towards) for point in (tube.start, tube.end)]
    if min(depth_mm) >= 0.0 or max(depth_mm) <= 0.0:
        return tube
    meeting = tube.start + depth_mm[0] / (depth_mm[0] - depth_mm[1]) * (tube.end - tube.start)
    return replace(tube, start=meeting) if depth_mm[0] > 0.0 else replace(tube, end=meeting)


def _off_axis(tube: Tube, point: Array) -> float:
    along = (tube.end - tube.start) / tube.length_mm
    spoke = point - tube.start
    return float(np.linalg.norm(spoke - float(spoke @ along) * along))
