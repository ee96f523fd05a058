"""Upright round walls of a cloud: the cylinder through the points of each, and where it ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.flat_circle import plane_across
from aadm_workbench.model import Array

PER_MM = 4.0
"""A slab is so thick that a wall shows about so many points on each mm of its outline."""


# of the slabs in which rings are looked for: thin enough for a bar's end, thick enough to hold a ring
THICKNESS_MM = (10.0, 100.0)


OFF_WALL_MM = 0.6  # points are sampled on facets, and rounded: a choice, not tuned since


OFF_WALL_RATIO = 0.03  # of the radius: facets of a circle of 13 sides or more lie within it


FEWEST_ON_RING = 12  # a circle of 12 sides, its corners alone


_ON_FACE_MM = 3.0  # about a level: points of a face, and of what is a chamfer's width behind it


_FACE_WIDTH_MM = 15.0  # around a mouth: less than the cover of a sleeve


_FACE_MM = 0.2  # of one level: noise and rounding of a model's cloud


_FEWEST_ON_FACE = 4  # of one level, at a mouth


@dataclass(frozen=True, eq=False)
class Ring:
    """A round outline in one slab: ``centre`` (2,) mm and ``radius_mm``; whether concrete is drawn around it there."""

    slab: int
    centre: Array
    radius_mm: float
    inside: bool


@dataclass(frozen=True, eq=False)
class Wall:
    """An upright round wall: its axis from ``start`` to ``end`` (3,) mm."""

    start: Array
    end: Array
    diameter_mm: float
    inside: bool


def wall_of(points: Array, family: Sequence[Ring], slabs: Sequence[Array]) -> Wall | None:
    """The cylinder through all points of a wall, and where it ends: at the face around it, or the disk on it."""
    radius_mm = float(np.median([ring.radius_mm for ring in family]))
    centre = np.median([ring.centre for ring in family], axis=0)
    width_mm = radius_mm + 2.0 * _FACE_WIDTH_MM
    points = near_axis(points, centre, width_mm)
    shown = np.concatenate([near_axis(slabs[ring.slab], centre, width_mm) for ring in family])
    foot = np.array([*centre, float(shown[:, 2].mean())])
    axis = np.array([0.0, 0.0, 1.0])
    reach_mm = OFF_WALL_MM + OFF_WALL_RATIO * radius_mm
    for _ in range(6):
        near = shown[np.abs(_off_axis(shown, foot, axis) - radius_mm) < reach_mm]
        if len(near) < FEWEST_ON_RING:
            return None
        foot, axis, radius_mm = _better(near, foot, axis, radius_mm)
    inside = sum(ring.inside for ring in family) == len(family)
    on_wall = points[np.abs(_off_axis(points, foot, axis) - radius_mm) < reach_mm]
    level = (on_wall - foot) @ axis
    slab_mm = PER_MM * THICKNESS_MM[1]
    first, last = (float(((slabs[ring.slab] - foot) @ axis).mean()) for ring in (family[0], family[-1]))
    level = level[(level > first - slab_mm) & (level < last + slab_mm)]
    low, high = _run(np.sort(level), (first + last) / 2.0)
    along = [_end(points, foot, axis, radius_mm, level_mm, inside=inside) for level_mm in (low, high)]
    return Wall(foot + along[0] * axis, foot + along[1] * axis, 2.0 * radius_mm, inside)


def near_axis(points: Array, centre: Array, width_mm: float) -> Array:
    """Points (n, 3) mm in an upright square about a centre (2,) mm."""
    kept: Array = points[(np.abs(points[:, :2] - centre) < width_mm).all(axis=1)]
    return kept


def _off_axis(points: Array, foot: Array, axis: Array) -> Array:
    spokes = points - foot
    off: Array = np.linalg.norm(spokes - (spokes @ axis)[:, np.newaxis] * axis, axis=1)
    return off


def _better(points: Array, foot: Array, axis: Array, radius_mm: float) -> tuple[Array, Array, float]:
    """One Gauss-Newton step of the least-squares cylinder: two shifts, two leans, the radius."""
    spokes = points - foot
    level = spokes @ axis
    across = spokes - level[:, np.newaxis] * axis
    distance_mm = np.maximum(np.linalg.norm(across, axis=1), 1e-9)
    out = across / distance_mm[:, np.newaxis]
    u, v = plane_across(axis)
    matrix = np.column_stack([-out @ u, -out @ v, -(out @ u) * level, -(out @ v) * level, -np.ones(len(points))])
    step, *_ = np.linalg.lstsq(matrix, radius_mm - distance_mm, rcond=None)
    axis = axis + step[2] * u + step[3] * v
    return foot + step[0] * u + step[1] * v, axis / np.linalg.norm(axis), radius_mm + float(step[4])


def _run(levels: Array, start_mm: float) -> tuple[float, float]:
    """Where sorted heights go on without a gap, around one of them."""
    step_mm = max(10.0, 20.0 * float(np.ptp(levels)) / max(len(levels), 1))
    cuts = np.flatnonzero(np.diff(levels) > step_mm)
    lows = [float(levels[0]), *(float(levels[cut + 1]) for cut in cuts)]
    highs = [*(float(levels[cut]) for cut in cuts), float(levels[-1])]
    inside = [(low, high) for low, high in zip(lows, highs, strict=True) if low <= start_mm <= high]
    return inside[0] if inside else max(zip(lows, highs, strict=True), key=lambda run: run[1] - run[0])


def _end(points: Array, foot: Array, axis: Array, radius_mm: float, level_mm: float, *, inside: bool) -> float:
    """Height of a wall's end: that of the face around a hole, of the disk that ends a bar, else of its last point."""
    level = (points - foot) @ axis
    near = np.abs(level - level_mm) < _ON_FACE_MM
    off_mm = _off_axis(points[near], foot, axis)
    reach_mm = OFF_WALL_MM + OFF_WALL_RATIO * radius_mm
    around = (off_mm > radius_mm + reach_mm) & (off_mm < radius_mm + _FACE_WIDTH_MM)
    return _crowded(level[near][around if inside else off_mm < radius_mm - reach_mm], level_mm)


def _crowded(levels: Array, otherwise_mm: float) -> float:
    """The height at which most points lie: walls near by lie at all heights, a face at one."""
    levels = np.sort(levels)
    last = np.searchsorted(levels, levels + _FACE_MM, side="right")
    crowd = last - np.arange(len(levels))
    if not len(crowd) or crowd.max() < _FEWEST_ON_FACE:
        return otherwise_mm
    begin = int(crowd.argmax())
    return float(np.median(levels[begin : last[begin]]))
