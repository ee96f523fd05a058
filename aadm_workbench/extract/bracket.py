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


@dataclass(frozen=True, eq=False)
class Outlines:
    """Edge evidence of one feature, mm, plan: in each angular bin the point next to the edge, on either side of it.

    ``rim`` (n, 2) lies on the surface, ``beyond`` (m, 2) are crossings of rays that passed it.
    """

    rim: Array
    beyond: Array


def crossings(points: Array, eye: Array, plane: Plane) -> Array:
    """Where the rays from the eye (3,) to points (n, 3) cross a plane: (n, 3) mm."""
    eye_height = float(plane.normal @ eye) - plane.offset
    share = eye_height / np.maximum(eye_height - plane.height(points), 1e-9)
    return np.asarray(eye + (points - eye) * share[:, None])


def outlined(surface: Array, beyond: Array, centre: Array, usable: BoolArray, *, hole: bool) -> Outlines:
    """Take, in each angular bin, the surface point next to the edge and the crossing next to it on the other side.

    Parameters
    ----------
    surface, beyond
        (n, 2) and (m, 2) mm: points on the surface, and crossings of rays that passed it.
    usable
        (bins,) which angular bins show an edge.
    hole
        True: the surface lies outside of the edge.
    """
    sign = 1.0 if hole else -1.0
    rim_radius, rim_at = _extreme(surface, centre, len(usable), sign)
    gap_radius, gap_at = _extreme(beyond, centre, len(usable), -sign)
    on_surface = usable & np.isfinite(rim_radius)  # where the surface itself is missing, nothing tells of its edge
    return Outlines(surface[rim_at[on_surface]], beyond[gap_at[on_surface & np.isfinite(gap_radius)]])


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
