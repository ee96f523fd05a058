"""Outlines of holes and discs: of each feature and each angular bin about it, the one point next to the edge.

Where the camera's position is known, a point *behind* a surface tells as much about the surface's edge as a
point on it: the ray to it crossed the surface's plane where there is no surface. Pixels lost at the depth
step widen the bracket between the two and do not shift it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.plan_points import PlanPoints
from aadm_workbench.model import Array, BoolArray

# six to a quarter of the smallest circle; half a degree, which is finer than pixels on mouths of up to 50 mm
_FEWEST_BINS, _MOST_BINS = 24, 720


@dataclass(frozen=True, eq=False)
class Outlines:
    """Of k features, per angular bin: the point ``xy`` (k, bins, 2) mm, float64, and whether there is one, ``seen``."""

    xy: Array
    seen: BoolArray

    @property
    def coverage(self) -> Array:
        """Share (k,) of each circle's bins that hold a point."""
        return np.asarray(self.seen.mean(axis=1))

    @property
    def bins(self) -> int:
        """Number of bins of a circle."""
        return int(self.seen.shape[1])

    def distance(self, centre: Array) -> Array:
        """Distance (k, bins) mm of each point from the centre (k, 2) of its feature."""
        about = self.xy - centre[:, None]
        return np.asarray(np.sqrt(about[..., 0] ** 2 + about[..., 1] ** 2))

    def only(self, wanted: BoolArray) -> Outlines:
        """The same with fewer bins (k, bins)."""
        return Outlines(self.xy, self.seen & wanted)

    def of(self, features: BoolArray) -> Outlines:
        """The outlines of some of the features (k,)."""
        return Outlines(self.xy[features], self.seen[features])


def bins_for(radius_mm: float, pitch_mm: float) -> int:
    """About one bin for each point on a circle."""
    return int(np.clip(2 * np.pi * radius_mm / pitch_mm, _FEWEST_BINS, _MOST_BINS))


def outlines(points: PlanPoints, centre: Array, bins: int, *, innermost: bool) -> Outlines:
    """Take, of the points in each bin about a feature's centre (k, 2), the one nearest to it, or the farthest one."""
    radius = points.distance(centre)
    cell = points.owner * bins + points.bins(centre, bins)
    extreme = np.full(points.features * bins, np.inf if innermost else -np.inf, radius.dtype)
    (np.minimum if innermost else np.maximum).at(extreme, cell, radius)
    chosen = np.flatnonzero(radius == extreme[cell])
    xy = np.zeros((len(extreme), 2))
    xy[cell[chosen], 0], xy[cell[chosen], 1] = points.x[chosen], points.y[chosen]
    return Outlines(xy.reshape(-1, bins, 2), np.isfinite(extreme).reshape(-1, bins))
