"""Edges held from both sides: the last point on a surface, and the first ray that passes it.

Where the camera's position is known, a point *behind* a surface tells as much about the surface's edge as a
point on it: the ray to it crossed the surface's plane where there is no surface. Pixels lost at the depth
step widen the bracket between the two and do not shift it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import bins_of
from aadm_workbench.model import Array, BoolArray, IntArray, Plane

_WIDEST_PITCHES = 4.0
_OVERLAP_PITCHES = 0.7


@dataclass(frozen=True, eq=False)
class Outlines:
    """Edge evidence of one feature, mm, plan: brackets where both sides are known, else rim points alone.

    ``middle`` (n, 2) and ``half_width`` (n,) of the brackets; ``rim`` (m, 2).
    """

    middle: Array
    half_width: Array
    rim: Array


def crossings(points: Array, eye: Array, plane: Plane) -> Array:
    """Where the rays from the eye (3,) to points (n, 3) cross a plane: (n, 3) mm."""
    eye_height = float(plane.normal @ eye) - plane.offset
    share = eye_height / np.maximum(eye_height - plane.height(points), 1e-9)
    return np.asarray(eye + (points - eye) * share[:, None])


def bracketed(
    surface: Array, beyond: Array, centre: Array, usable: BoolArray, pitch_mm: float, *, hole: bool
) -> Outlines:
    """Pair, in each angular bin, the surface point next to the edge with the crossing next to it on the other side.

    Parameters
    ----------
    surface, beyond
        (n, 2) and (m, 2) mm: points on the surface, and crossings of rays that passed it.
    usable
        (bins,) which angular bins show an edge.
    hole
        True: the surface lies outside of the edge.
    """
    sign, bins = (1.0 if hole else -1.0), len(usable)
    rim_radius, rim_at = _extreme(surface, centre, bins, sign)
    gap_radius, _ = _extreme(beyond, centre, bins, -sign)
    has_rim = np.isfinite(rim_radius) & usable
    both = has_rim & np.isfinite(gap_radius)
    width = np.full(bins, np.inf)
    width[both] = sign * (rim_radius[both] - gap_radius[both])
    paired = (width > -_OVERLAP_PITCHES * pitch_mm) & (width < _WIDEST_PITCHES * pitch_mm)
    middle = 0.5 * (rim_radius + gap_radius)[paired]
    direction = _directions(surface, rim_at, centre, paired)
    alone = has_rim & ~paired
    return Outlines(
        centre + direction * middle[:, None],
        0.5 * np.abs(width[paired]),
        surface[rim_at[alone]],
    )


def _extreme(xy: Array, centre: Array, bins: int, sign: float) -> tuple[Array, IntArray]:
    """Per bin the smallest (sign +1) or largest (-1) radius, infinite where there is none, and its index."""
    about = xy - centre
    radius = np.hypot(about[:, 0], about[:, 1])
    place = bins_of(about, bins)
    order = np.lexsort((sign * radius, place))
    first = np.ones(len(order), bool)
    first[1:] = place[order[1:]] != place[order[:-1]]
    chosen = order[first]
    extreme = np.full(bins, np.inf)
    index = np.zeros(bins, np.int64)
    extreme[place[chosen]] = radius[chosen]
    index[place[chosen]] = chosen
    return extreme, index


def _directions(xy: Array, index: IntArray, centre: Array, wanted: BoolArray) -> Array:
    about = xy[index[wanted]] - centre if wanted.any() else np.empty((0, 2))
    length = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
    return np.asarray(about / length[:, None])
