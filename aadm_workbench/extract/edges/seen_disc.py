"""The disc in which lines of sight find a surface, or find none: mouths of sleeves, tops of bars.

Each line of sight either returned a point of the surface or did not; the chance of it rises over the edge as a
logistic step whose width is the camera's. Centres are each feature's own, radius and width are shared by all. Nothing
is assumed of how many pixels a camera drops or adds at an edge: that moves the radius. What it does unlike on two
sides of a mouth moves the centres, see :mod:`~aadm_workbench.extract.edges.edge_shift`.

Where every line of sight of a patch crosses the surface that a feature lies in, also where it returned nothing. A pixel
without a return tells as much about an edge as one with: there was no surface that the camera accepts. An organised
scan knows its pixels; a cloud does not, and has no such lines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, BoolArray, FloatArray
from aadm_workbench.model.special import median

_FOREIGN = 0.03  # share of lines that find what the geometry does not tell: flying pixels, random losses
_ZONE_PITCHES, _ZONE_MM = 5.0, 1.0  # about the edge: farther away a line tells nothing
_WIDTH_START, _WIDTH_LIMITS = 0.4, (0.05, 3.0)  # of the pitch
_STEP_MAX_MM = 0.3  # first centres are right to about a millimetre: a longer step leaves the zone in which lines tell
_ROUNDS, _SETTLED_MM = 14, 2e-3  # enough for four millimetres of steps; a tenth of what the best camera errs by
_BEHIND_PITCHES, _FOUND_MIN = (3.0, 6.0), 0.2  # where a surface is whole, whatever happens at its edge
_NOWHERE_MM = 1e3  # of padding; it has no weight
_JUST_SOLVABLE = 1e-3  # 1/mm²: a belief of ± 30 mm, which holds nothing but the arithmetic


@dataclass(frozen=True, eq=False)
class SeenDiscs:
    """Of k features: ``centre`` (k, 2) and their ``covariance`` (k, 2, 2) mm² from counting lines alone.

    ``radius`` mm and ``width`` mm of the step are shared by all.
    """

    centre: Array
    covariance: Array
    radius: float
    width: float


def seen_discs(
    lines: SightLines, on: BoolArray, centre: Array, radius_mm: float, pitch_mm: float, side: float
) -> SeenDiscs:
    """Fit discs to where lines of sight find the surface.

    Parameters
    ----------
    on
        (k, n): which lines returned a point of the surface.
    centre
        (k, 2) mm, first centres, to about a millimetre.
    side
        +1 where the surface lies outside of the disc (mouths), -1 where it is the disc (tops).
    """
    zone = _zone(lines, on, centre, radius_mm, pitch_mm)
    found = _found_share(lines, on, centre, radius_mm, pitch_mm, side)
    fit = _Fit(centre.copy(), radius_mm, _WIDTH_START * pitch_mm, side)
    narrowest, widest = (limit * pitch_mm for limit in _WIDTH_LIMITS)
    for _ in range(_ROUNDS):
        own, shared = _Equations(zone, fit, found).step()
        own, shared = np.clip(own, -_STEP_MAX_MM, _STEP_MAX_MM), np.clip(shared, -_STEP_MAX_MM, _STEP_MAX_MM)
        width = min(max(fit.width + float(shared[1]), narrowest), widest)
        fit = _Fit(fit.centre + own, fit.radius + float(shared[0]), width, side)
        if max(np.abs(own).max(initial=0.0), abs(float(shared[0]))) < _SETTLED_MM:
            break
    return SeenDiscs(fit.centre, _Equations(zone, fit, found).covariance(), fit.radius, fit.width)


@dataclass(frozen=True, eq=False)
class _Zone:
    """Lines near each edge as rows (k, m): crossings, which are there, and 1 for those that found the surface."""

    x: Array
    y: Array
    there: BoolArray
    on: Array


@dataclass(frozen=True, eq=False)
class _Fit:
    centre: Array
    radius: float
    width: float
    side: float


class _Equations:
    """Fisher's scoring of all lines: each feature's own unknowns (x, y) against what all share (radius, width)."""

    def __init__(self, zone: _Zone, fit: _Fit, found: float) -> None:
        about_x, about_y = zone.x - fit.centre[:, :1], zone.y - fit.centre[:, 1:]
        distance = np.maximum(np.sqrt(about_x * about_x + about_y * about_y), 1e-9)
        scaled = fit.side * (distance - fit.radius) / fit.width
        step = 1.0 / (1.0 + np.exp(-np.clip(scaled, -40.0, 40.0)))  # beyond, single precision knows 0 and 1 alone
        chance = _FOREIGN + (found - _FOREIGN) * step
        rise = (found - _FOREIGN) * step * (1.0 - step)
        spread = chance * (1.0 - chance)
        information = np.where(zone.there, rise * rise / spread, 0.0)
        pull = np.where(zone.there, (zone.on - chance) / spread * rise, 0.0)
        to_own = -fit.side / fit.width * np.stack([about_x / distance, about_y / distance])
        to_shared = np.stack([np.full_like(scaled, -fit.side / fit.width), -scaled / fit.width])
        own = np.einsum("akn,kn,bkn->kab", to_own, information, to_own) + _JUST_SOLVABLE * np.eye(2)
        cross = np.einsum("akn,kn,bkn->kab", to_own, information, to_shared)
        shared = np.einsum("akn,kn,bkn->ab", to_shared, information, to_shared) + _JUST_SOLVABLE * np.eye(2)
        self._own_gradient = np.einsum("akn,kn->ka", to_own, pull)
        self._shared_gradient = np.einsum("akn,kn->a", to_shared, pull)
        self._inverse = np.linalg.inv(own)
        self._across = self._inverse @ cross
        self._reduced = shared - np.einsum("kia,kib->ab", cross, self._across)

    def step(self) -> tuple[Array, Array]:
        """Steps of the centres (k, 2) and of radius and width (2,), mm."""
        left = self._shared_gradient - np.einsum("kia,ki->a", self._across, self._own_gradient)
        shared = np.linalg.solve(self._reduced, left)
        own = np.einsum("kab,kb->ka", self._inverse, self._own_gradient) - self._across @ shared
        return own, shared

    def covariance(self) -> Array:
        """Covariance (k, 2, 2) mm² of the centres."""
        return np.asarray(self._inverse + self._across @ np.linalg.inv(self._reduced) @ self._across.transpose(0, 2, 1))


def _found_share(
    lines: SightLines, on: BoolArray, centre: Array, radius_mm: float, pitch_mm: float, side: float
) -> float:
    """Share of the lines behind the edge that find the surface: a camera may lose half of its points anywhere."""
    behind = side * (_distance(lines, centre) - radius_mm) / pitch_mm
    within = (behind > _BEHIND_PITCHES[0]) & (behind < _BEHIND_PITCHES[1])
    share = (on & within).sum(axis=1) / np.maximum(within.sum(axis=1), 1)
    return float(np.clip(median(share), _FOUND_MIN, 1.0 - _FOREIGN))


def _distance(lines: SightLines, centre: Array) -> FloatArray:
    x, y = lines.x - centre[:, :1].astype(np.float32), lines.y - centre[:, 1:].astype(np.float32)
    return np.asarray(np.sqrt(x * x + y * y))


def _zone(lines: SightLines, on: BoolArray, centre: Array, radius_mm: float, pitch_mm: float) -> _Zone:
    off = np.abs(_distance(lines, centre) - np.float32(radius_mm))
    near = off < _ZONE_PITCHES * pitch_mm + _ZONE_MM
    longest = int(near.sum(axis=1).max(initial=0))
    order = np.argsort(~near, axis=1, kind="stable")[:, :longest]
    there = np.take_along_axis(near, order, axis=1)
    x, y, found = (np.take_along_axis(part, order, axis=1).astype(np.float64) for part in (lines.x, lines.y, on))
    return _Zone(np.where(there, x, _NOWHERE_MM), np.where(there, y, _NOWHERE_MM), there, found)


@dataclass(frozen=True, eq=False)
class SightLines:
    """Crossings ``x``, ``y`` (k, n) mm, about each feature's place, with the feature's own surface.

    ``height`` (k, n) mm is that of the return over the surface, NaN where there is none; ``slope`` (k, 2) how far the
    lines run in the plan per mm of depth at the feature, away from the camera's foot point.
    """

    x: FloatArray
    y: FloatArray
    height: FloatArray
    slope: Array

    def of(self, features: BoolArray) -> SightLines:
        """Those of some of the features (k,)."""
        return SightLines(self.x[features], self.y[features], self.height[features], self.slope[features])


def sight_lines_on_face(patches: Patches) -> SightLines | None:
    """Crossings with the plane that the patches lie in; None for clouds, whose lost pixels nobody knows."""
    if patches.seen_x is None or patches.seen_y is None or patches.eye is None:
        return None
    return SightLines(patches.seen_x, patches.seen_y, patches.height, slopes_of(patches.eye))


def points_alone(patches: Patches) -> SightLines:
    """The points of a cloud as lines of sight square to the face that all found something: what was lost is unknown."""
    return SightLines(patches.x, patches.y, patches.height, np.zeros((len(patches.x), 2)))


def sight_lines_on_tops(patches: Patches, normal: Array, offset: Array, height: FloatArray) -> SightLines | None:
    """Crossings with planes of their own: ``normal`` (k, 3), ``offset`` (k,) mm; ``height`` (k, n) over them."""
    if patches.seen_x is None or patches.seen_y is None or patches.eye is None:
        return None
    eye = patches.eye.astype(np.float32)
    tilt, level = normal.astype(np.float32), offset.astype(np.float32)
    over = np.einsum("ki,ki->k", tilt, eye) - level
    falling_x, falling_y = patches.seen_x - eye[:, :1], patches.seen_y - eye[:, 1:2]
    fall = falling_x * tilt[:, :1] + falling_y * tilt[:, 1:2] - eye[:, 2:] * tilt[:, 2:]
    share = -over[:, None] / np.where(np.abs(fall) < 1e-6, np.float32(-1e-6), fall)
    return SightLines(eye[:, :1] + falling_x * share, eye[:, 1:2] + falling_y * share, height, slopes_of(patches.eye))


def slopes_of(eye: Array) -> Array:
    """Slope (k, 2) of the line of sight at each place: from the foot point of the eye (k, 3) to the place."""
    return np.asarray(-eye[:, :2] / np.maximum(np.abs(eye[:, 2:]), 1e-9))
