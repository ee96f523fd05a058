"""Points of several features in the plan, one feature after the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class PlanPoints:
    """Points ``x``, ``y`` (n,) mm, each about the place of its feature: ``owner`` (n,), sorted, of so many features."""

    x: FloatArray
    y: FloatArray
    owner: IntArray
    features: int

    @classmethod
    def of(cls, x: FloatArray, y: FloatArray, chosen: IntArray) -> PlanPoints:
        """Some entries (n,) - indices into the flattened arrays - of x and y (k, m)."""
        return cls(x.ravel()[chosen], y.ravel()[chosen], chosen // x.shape[1], len(x))

    def where(self, wanted: BoolArray) -> PlanPoints:
        """Some of the points (n,)."""
        return PlanPoints(self.x[wanted], self.y[wanted], self.owner[wanted], self.features)

    def distance(self, centre: Array) -> FloatArray:
        """Distance (n,) mm of each point from the centre (k, 2) of its feature."""
        x, y = self._about(centre)
        return np.asarray(np.sqrt(x * x + y * y))

    def bins(self, centre: Array, bins: int) -> IntArray:
        """Angular bin (n,) of each point about the centre (k, 2) of its feature."""
        x, y = self._about(centre)
        turn = np.arctan2(y, x) * (0.5 / np.pi) + 0.5
        return np.minimum((turn * bins).astype(np.int64), bins - 1)

    def _about(self, centre: Array) -> tuple[FloatArray, FloatArray]:
        x, y = np.ascontiguousarray(centre.T, self.x.dtype)
        return self.x - x[self.owner], self.y - y[self.owner]

    def counted(self, wanted: BoolArray) -> IntArray:
        """How many of some points each feature has (k,)."""
        return np.bincount(self.owner[wanted], minlength=self.features)


def thinned_rows(owner: IntArray, features: int, count_max: int) -> IntArray:
    """Which of the points of each feature (sorted owners (n,)) to take, evenly, so that none has more than so many."""
    counts = np.bincount(owner, minlength=features)
    return np.flatnonzero(ranks(owner, features) % (counts // count_max + 1)[owner] == 0)


def ranks(owner: IntArray, features: int) -> IntArray:
    """Place (n,) of each point among those of its feature (sorted owners (n,))."""
    counts = np.bincount(owner, minlength=features)
    return np.asarray(np.arange(len(owner)) - (np.cumsum(counts) - counts)[owner])


def in_rows(values: FloatArray, owner: IntArray, features: int) -> tuple[Array, BoolArray]:
    """Values (n, ...) with sorted owners (n,) as rows (k, m, ...) float64, zero-padded, and which are there (k, m)."""
    place = ranks(owner, features)
    longest = int(place.max(initial=-1)) + 1
    rows = np.zeros((features, longest, *values.shape[1:]))
    seen = np.zeros((features, longest), bool)
    rows[owner, place] = values
    seen[owner, place] = True
    return rows, seen
