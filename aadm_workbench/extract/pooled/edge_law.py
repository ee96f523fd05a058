"""How outline points scatter about the true edge of a hole or a disc, as likelihoods that keep to the edge.

A camera's outermost pixel on a surface lies a part of a pixel, or where it drops pixels at depth steps one
or two pixels, *behind* the edge and hardly ever before it. What does lie before it belongs to something
else: a rib of a bar, a flying pixel. The densities below have a steep flank at the edge; how many pixels are
lost moves only their tails.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array

_STRAY_SHARE = 0.01  # of points that follow no law at all
_STRAY_SPAN_MM = 4.0  # as far as rims are looked for beyond a mouth: within it strays lie anywhere


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
        own = (1.0 - self.foreign) * np.exp(-0.5 * (behind / self.width_mm) ** 2) / (2.5066 * self.width_mm)
        step = _step(-2.0 * behind / self.width_mm)
        tail = np.exp(np.minimum(behind, 0.0) / self.stands_out_mm) / self.stands_out_mm
        return own, self.foreign * step * tail, step


def _step(scaled: Array) -> Array:
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(scaled, -40.0, 40.0))))
