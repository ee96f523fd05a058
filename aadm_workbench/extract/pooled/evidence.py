"""What tells where a feature is, and how far each point of it lies from where a state of the fit would have it.

The evidence of k features stands in arrays with a row for each, padded to the longest: ``seen`` tells which
entries count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.pooled.edge_law import BracketLaw, RimLaw
from aadm_workbench.model import Array, BoolArray

WALL_CORRELATION = 2.5
"""Neighbouring wall points share their errors: standard errors are this much larger."""

_TUKEY = 4.0  # standard deviations: of normal errors 91 % of the information is kept
# less than any camera's noise; what is taken where fewer points than that are seen
_SPREAD_MIN_MM, _SPREAD_UNKNOWN_MM, _FEWEST = 0.02, 0.3, 5


@dataclass(frozen=True, eq=False)
class Rims:
    """Outline points known from one side only: ``xy`` (k, m, 2) mm, and which of them are there, ``seen`` (k, m).

    ``side`` is +1 where points lie outside of the true edge (holes), -1 where inside (discs).
    """

    xy: Array
    seen: BoolArray
    side: float
    law: RimLaw


@dataclass(frozen=True, eq=False)
class Walls:
    """Points of a bore or a bar's side: ``xy`` (k, m, 2) mm, ``depth`` (k, m) mm along the axis from the centre.

    ``slope`` (k, m, 2): how far the line of sight moves in the plan per mm of depth. ``law``: how the points of
    a bar's side (``side`` -1) or of a ribbed bore (+1) scatter.
    """

    xy: Array
    depth: Array
    slope: Array
    seen: BoolArray
    law: BracketLaw
    side: float = -1.0


class EdgeTerms:
    """Residuals (k, m) mm of outline points, their pull on the radius, and their Jacobian (k, 3, m): x, y, radius."""

    def __init__(self, rims: Rims, centre: Array, own_radius: Array, pooled_radius: float) -> None:
        about = rims.xy - centre[:, None]
        x, y = about[..., 0], about[..., 1]
        distance = np.maximum(np.sqrt(x * x + y * y), 1e-9)
        self.residual = distance - (pooled_radius + own_radius)[:, None]
        self.jacobian = np.empty((len(centre), 3, x.shape[1]))
        np.divide(-x, distance, out=self.jacobian[:, 0])
        np.divide(-y, distance, out=self.jacobian[:, 1])
        self.jacobian[:, 2] = -1.0
        self.pull = np.where(rims.seen, rims.side * rims.law.slope(rims.side * self.residual), 0.0)
        self._softness_mm = rims.law.softness_mm

    @property
    def bend(self) -> Array:
        """Curvature (k, m) of the cost for a step: that of a parabola with this pull."""
        return np.asarray(np.abs(self.pull) / np.maximum(np.abs(self.residual), self._softness_mm))

    @property
    def knowledge(self) -> Array:
        """What each point tells (k, m), 1/mm²."""
        return self.pull**2


class WallTerms:
    """Residuals (k, m) mm of wall points and their Jacobian (k, 6, m): x, y, lean x, lean y, push, radius."""

    def __init__(self, walls: Walls, own: Array, pooled_radius: float, pooled_push: float) -> None:
        depth, slope = walls.depth, walls.slope
        push = (pooled_push + own[:, 4])[:, None]
        x = walls.xy[..., 0] - own[:, 0:1] - own[:, 2:3] * depth - push * slope[..., 0]
        y = walls.xy[..., 1] - own[:, 1:2] - own[:, 3:4] * depth - push * slope[..., 1]
        distance = np.maximum(np.sqrt(x * x + y * y), 1e-9)
        self._seen = walls.seen
        self.residual = distance - (pooled_radius + own[:, 5])[:, None]
        self.jacobian = np.empty((len(own), own.shape[1], x.shape[1]))
        first, second = self.jacobian[:, 0], self.jacobian[:, 1]
        np.divide(-x, distance, out=first)
        np.divide(-y, distance, out=second)
        np.multiply(first, depth, out=self.jacobian[:, 2])
        np.multiply(second, depth, out=self.jacobian[:, 3])
        self.jacobian[:, 4] = first * slope[..., 0] + second * slope[..., 1]
        self.jacobian[:, 5] = -1.0
        pull = walls.side * walls.law.slope(walls.side * self.residual) / WALL_CORRELATION**2
        self.pull = np.where(walls.seen, pull, 0.0)
        self._softness_mm = walls.law.softness_mm

    @property
    def bend(self) -> Array:
        """Curvature (k, m) of the cost for a step: that of a parabola with this pull."""
        return np.asarray(np.abs(self.pull) / np.maximum(np.abs(self.residual), self._softness_mm))

    @property
    def knowledge(self) -> Array:
        """What each point tells (k, m), 1/mm², neighbours sharing their errors."""
        return self.pull**2 * WALL_CORRELATION**2

    @property
    def spread_mm(self) -> float:
        """Robust standard deviation of the residuals."""
        return max(spread(self.residual[self._seen]), _SPREAD_MIN_MM)

    def robust_weight(self) -> Array:
        """Tukey's weight (k, m) over the variance of each point, 1/mm²; zero for what does not belong to the wall."""
        spread_mm = self.spread_mm
        weight = np.where(self._seen, tukey(self.residual / spread_mm), 0.0)
        return np.asarray(weight / (WALL_CORRELATION * spread_mm) ** 2)


def spread(residual: Array) -> float:
    """Robust standard deviation, mm, of residuals (n,) about their median."""
    if len(residual) < _FEWEST:
        return _SPREAD_UNKNOWN_MM
    return 1.4826 * float(np.median(np.abs(residual - np.median(residual))))


def tukey(scaled: Array) -> Array:
    """Weights of Tukey's biweight for residuals in standard deviations, of any shape."""
    return np.asarray(np.maximum(1.0 - (scaled / _TUKEY) ** 2, 0.0) ** 2)
