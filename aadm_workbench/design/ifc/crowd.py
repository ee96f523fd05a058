"""Points of a model by place: a floor has ten thousands, a column looks at a dozen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from aadm_workbench.model import Array, IntArray

_SLACK_MM = 1.0
"""Rounding of map coordinates, with room: who asks looks himself at what is near."""


@dataclass(frozen=True, eq=False)
class Crowd:
    """Points (n, 3) mm, model frame, kept in order along the longer side of their plan."""

    points: Array

    @classmethod
    def of(cls, points: Sequence[Array]) -> Crowd:
        """Of points (3,) mm in a list."""
        return cls(np.array(points, dtype=np.float64).reshape(-1, 3))

    @cached_property
    def _axis(self) -> int:
        return int(np.argmax(np.ptp(self.points[:, :2], axis=0))) if len(self.points) else 0

    @cached_property
    def _order(self) -> IntArray:
        return np.argsort(self.points[:, self._axis], kind="stable")

    @cached_property
    def _along(self) -> Array:
        return np.asarray(self.points[self._order, self._axis])

    @cached_property
    def _corners(self) -> Array:
        return np.array([self.points.min(axis=0), self.points.max(axis=0)])

    def near(self, middle: Array, reach_mm: float) -> IntArray:
        """Numbers, rising, of all points within ``reach_mm`` of ``middle`` (3,), and of some that are not."""
        at = float(middle[self._axis])
        reach_mm += _SLACK_MM
        first, last = np.searchsorted(self._along, [at - reach_mm, at + reach_mm])
        return np.sort(self._order[first:last])

    def about(self, origin: Array, axis: Array, reach_mm: float) -> IntArray:
        """Of all points so far from a line through ``origin`` (3,) along ``axis`` (3,), unit, and of some others."""
        if not len(self.points):
            return np.zeros(0, dtype=np.int64)
        # A line that leans leaves its place in the plan by as much as the farthest point lies along it.
        farthest_mm = float(np.linalg.norm(np.abs(self._corners - origin).max(axis=0)))
        return self.near(origin, reach_mm + abs(float(axis[self._axis])) * farthest_mm)
