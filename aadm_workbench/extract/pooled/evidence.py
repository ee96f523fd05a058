"""What tells where a feature is, and how far each point of it lies from where a state of the fit would have it.

The evidence of k features stands in arrays with a row for each, padded to the longest: ``seen`` tells which
entries count.

How outline points scatter about the true edge of a hole or a disc, as likelihoods that keep to the edge. A camera's
outermost pixel on a surface lies a part of a pixel, or where it drops pixels at depth steps one or two pixels, *behind*
the edge and hardly ever before it. What does lie before it belongs to something else: a rib of a bar, a flying pixel.
The densities below have a steep flank at the edge; how many pixels are lost moves only their tails.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.model import Array, BoolArray
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import median

WALL_CORRELATION = 2.5
"""Neighbouring wall points share their errors: standard errors are this much larger."""

_TUKEY = 4.0  # standard deviations: of normal errors 91 % of the information is kept
# less than any camera's noise; what is taken where fewer points than that are seen
_SPREAD_MIN_MM, _SPREAD_UNKNOWN_MM, _FEWEST = 0.02, 0.3, 5

_STRAY_SHARE = 0.01  # of points that follow no law at all
_STRAY_SPAN_MM = 4.0  # as far as rims are looked for beyond a mouth: within it strays lie anywhere


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

    def of(self, features: BoolArray) -> Walls:
        """Those of some of the features (k,)."""
        return replace(
            self, xy=self.xy[features], depth=self.depth[features], slope=self.slope[features], seen=self.seen[features]
        )


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
    return TO_SIGMA * float(median(np.abs(residual - median(residual))))


def tukey(scaled: Array) -> Array:
    """Weights of Tukey's biweight for residuals in standard deviations, of any shape."""
    return np.asarray(np.maximum(1.0 - (scaled / _TUKEY) ** 2, 0.0) ** 2)


@dataclass(frozen=True)
class RimLaw:
    """Points known from one side, with x mm behind the edge (negative: before it).

    ``f(x) = (1 - q) S(x/s) exp(-max(x, 0)/t)/t + q S(-x/s) exp(min(x, 0)/h)/h + stray`` where S is the logistic
    step, s a small part of the ``pitch_mm``, t the ``tail_mm`` (one for all points, or (n,)), and q the share
    of ``foreign`` points, which stand out by about h = ``stands_out_mm``.
    """

    pitch_mm: float
    tail_mm: float | Array
    foreign: float
    stands_out_mm: float = 0.5
    softness: float = 0.05

    @property
    def softness_mm(self) -> float:
        """Half width of the flank."""
        return self.softness * self.pitch_mm

    def cost(self, behind: Array) -> Array:
        """Negative log density of distances (...,) mm behind the edge."""
        step = _step(behind / self.softness_mm)
        density = self._own(behind, step) + self._standing_out(behind, step) + _STRAY_SHARE / _STRAY_SPAN_MM
        return np.asarray(-np.log(density))

    def slope(self, behind: Array) -> Array:
        """Derivative of :meth:`cost`."""
        step = _step(behind / self.softness_mm)
        own, foreign = self._own(behind, step), self._standing_out(behind, step)
        rise = (1.0 - step) / self.softness_mm - (behind > 0) / self.tail_mm
        fall = (behind < 0) / self.stands_out_mm - step / self.softness_mm
        return np.asarray(-(own * rise + foreign * fall) / (own + foreign + _STRAY_SHARE / _STRAY_SPAN_MM))

    def _own(self, behind: Array, step: Array) -> Array:
        tail = np.exp(-np.maximum(behind, 0.0) / self.tail_mm) / self.tail_mm
        return np.asarray((1.0 - self.foreign) * step * tail)

    def _standing_out(self, behind: Array, step: Array) -> Array:
        tail = np.exp(np.minimum(behind, 0.0) / self.stands_out_mm) / self.stands_out_mm
        return np.asarray(self.foreign * (1.0 - step) * tail)


@dataclass(frozen=True)
class BracketLaw:
    """Points held from both sides, with x mm behind the edge: normal about it, but for those that stand out."""

    width_mm: float
    foreign: float
    stands_out_mm: float = 0.5

    @property
    def softness_mm(self) -> float:
        """Half width of the flank."""
        return self.width_mm

    def cost(self, behind: Array) -> Array:
        """Negative log density of distances (...,) mm behind the edge."""
        own, foreign, _ = self._densities(behind)
        return np.asarray(-np.log(own + foreign + _STRAY_SHARE / _STRAY_SPAN_MM))

    def slope(self, behind: Array) -> Array:
        """Derivative of :meth:`cost`."""
        own, foreign, step = self._densities(behind)
        rise = -own * behind / self.width_mm**2
        fall = foreign * ((behind < 0) / self.stands_out_mm - 2.0 / self.width_mm * (1.0 - step))
        return np.asarray(-(rise + fall) / (own + foreign + _STRAY_SHARE / _STRAY_SPAN_MM))

    def _densities(self, behind: Array) -> tuple[Array, Array, Array]:
        own = (1.0 - self.foreign) * np.exp(-0.5 * (behind / self.width_mm) ** 2) / (2.5066 * self.width_mm)  # √(2π)
        step = _step(-2.0 * behind / self.width_mm)
        tail = np.exp(np.minimum(behind, 0.0) / self.stands_out_mm) / self.stands_out_mm
        return own, self.foreign * step * tail, step


def _step(scaled: Array) -> Array:
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(scaled, -40.0, 40.0))))  # beyond, it is 0 or 1 to 1e-17
