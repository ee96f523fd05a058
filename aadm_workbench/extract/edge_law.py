"""How outline points scatter about the true edge of a hole or a disc, as likelihoods that keep to the edge.

A camera's outermost pixel on a surface lies a part of a pixel, or where it drops pixels at depth steps one
or two pixels, *behind* the edge and hardly ever before it. What does lie before it belongs to something
else: a rib of a bar, a flying pixel. The densities below have a steep flank at the edge; how many pixels are
lost moves only their tails.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.bracket import Outlines
from aadm_workbench.model import Array

_STRAY_SHARE = 0.01  # of points that follow no law at all
_STRAY_SPAN_MM = 4.0
_COARSE_MM, _FINE_MM = (0.9, 0.15), (0.2, 0.05)  # reach and step of the grids of centres


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
        own = (1.0 - self.foreign) * np.exp(-0.5 * (behind / self.width_mm) ** 2) / (2.5066 * self.width_mm)
        tail = np.exp(np.minimum(behind, 0.0) / self.stands_out_mm) / self.stands_out_mm
        foreign = self.foreign * _step(-2.0 * behind / self.width_mm) * tail
        return np.asarray(-np.log(own + foreign + _STRAY_SHARE / _STRAY_SPAN_MM))

    def slope(self, behind: Array) -> Array:
        """Derivative of :meth:`cost`."""
        return _derivative(self.cost, behind, 0.05 * self.width_mm)


def _derivative(cost: Callable[[Array], Array], at: Array, step_mm: float) -> Array:
    return np.asarray((cost(at + step_mm) - cost(at - step_mm)) / (2.0 * step_mm))


def _step(scaled: Array) -> Array:
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(scaled, -40.0, 40.0))))


def best_circles(
    outlines: list[Outlines],
    sides: list[Array],
    centres: Array,
    radius_mm: float,
    laws: tuple[RimLaw, RimLaw, BracketLaw],
) -> tuple[Array, float]:
    """Discs of one pooled radius where robust fits mislead: ribs can stand out on half of an outline.

    Half a rib makes an outline that a larger, shifted circle fits well, so the radius cannot come from all
    features alike: ribs only ever add. Each feature is fitted with a radius of its own, and the lower
    quartile of these is the radius of the core; with it each centre follows. ``sides`` holds, per feature,
    points (n, 2) of its side; ``laws`` are those of crossings beyond the edge, of rims and of sides. Returns
    centres (k, 2) and the radius, mm, to about 0.05 mm.
    """
    evidence = [
        [_thin(shape.beyond), _thin(shape.rim), _thin(side_xy)] for shape, side_xy in zip(outlines, sides, strict=True)
    ]
    radii = radius_mm + np.arange(-1.0, 1.01, 0.2)
    own = []
    for parts, centre in zip(evidence, centres, strict=True):
        near, radius = _grid(parts, centre, radii, laws, *_COARSE_MM)
        own.append(_grid(parts, near, radius + np.arange(-0.15, 0.16, 0.05), laws, *_FINE_MM)[1])
    pooled = np.array([np.percentile(own, 25.0)])
    found = []
    for parts, centre in zip(evidence, centres, strict=True):
        near, _ = _grid(parts, centre, pooled, laws, *_COARSE_MM)
        found.append(_grid(parts, near, pooled, laws, *_FINE_MM)[0])
    return np.array(found), float(pooled[0])


def _grid(
    evidence: list[Array],
    centre: Array,
    radii: Array,
    laws: tuple[RimLaw, RimLaw, BracketLaw],
    reach_mm: float,
    step_mm: float,
) -> tuple[Array, float]:
    """The most likely centre and radius on a grid around a centre."""
    step = np.arange(-reach_mm, reach_mm + 1e-9, step_mm)
    shifts = np.stack(np.meshgrid(step, step), -1).reshape(-1, 2)
    distances = [_distances(points, centre, shifts) for points in evidence]
    costs = np.zeros((len(radii), len(shifts)))
    for cost, radius in zip(costs, radii, strict=True):
        cost += laws[0].cost(distances[0] - radius).sum(axis=1)
        cost += laws[1].cost(radius - distances[1]).sum(axis=1)
        cost += laws[2].cost(radius - distances[2]).sum(axis=1)
    which, where = np.unravel_index(int(costs.argmin()), (len(radii), len(shifts)))
    return centre + shifts[where], float(radii[which])


def _thin(xy: Array) -> Array:
    return xy[:: len(xy) // 36 + 1]


def _distances(points: Array, centre: Array, shifts: Array) -> Array:
    about = points - centre
    return np.asarray(np.hypot(about[:, 0] - shifts[:, :1], about[:, 1] - shifts[:, 1:]))
