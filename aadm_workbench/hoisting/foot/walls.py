"""Walls of bores, seen through the mouths of a foot: which points lie on them, and what these tell."""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.pooled.evidence import spread, tukey
from aadm_workbench.hoisting.foot.mouths import NOISE_SIGMAS, MouthView
from aadm_workbench.hoisting.pattern_fit import Believed, Pattern, State, System, Terms, wall_terms
from aadm_workbench.model import Array, IntArray

WALL, PUSH = range(2)
"""Places of the bores' radius and push among the pooled unknowns."""
WALL_FEWEST = 25
"""Points of a bore: as in pooled/fit.py."""

_WALL_FROM_MM = 1.15  # chamfers end before
_WALL_MAX = 200  # points of a bore: neighbours share their errors, more of them tell no more than so many
# neighbouring wall points share their errors: standard errors are this much larger; a choice: ±30 % moves centres by
# up to 0.9 u and u by 6 %
_WALL_CORRELATION = 1.6
_LEAST_SPREAD_MM = 0.03  # no wall is smoother as a camera sees it: finer, single points would decide
_SPREAD_BELIEF = 20  # points: a spread of so few is known to a sixth


def far_wall(view: MouthView | None, state: State, k: int, noise_mm: float, band_mm: float) -> IntArray:
    """Indices of the points on the wall that the camera looks at, through the open part of the mouth."""
    if view is None:
        return np.empty(0, np.int64)
    own = state.own[k]
    about = view.points[:, :2] - own[:2] - own[2:4] * view.points[:, 2:] - (state.pooled[PUSH] + own[4]) * view.slope
    off = np.hypot(about[:, 0], about[:, 1]) - state.pooled[WALL] - own[5]
    facing = np.einsum("ij,ij->i", about, view.slope) > 0
    deep = view.points[:, 2] > max(_WALL_FROM_MM, NOISE_SIGMAS * noise_mm)
    return np.flatnonzero(facing & deep & (np.abs(off) < band_mm))


def few(walls: list[IntArray]) -> list[IntArray]:
    """Some points of each wall, for a search: which ones hangs on each before them, and all decide in the end."""
    return [wall[:: len(wall) // _WALL_MAX + 1] for wall in walls]


def system_of(
    views: list[MouthView | None], walls: list[IntArray], state: State, pattern: Pattern, believed: Believed
) -> tuple[System, float]:
    """Normal equations of walls, pattern and beliefs, and how far wall points scatter, mm."""
    system, sigma_mm = own_system(views, walls, state, believed)
    system.add_pattern(pattern, state)
    return system, sigma_mm


def own_system(
    views: list[MouthView | None], walls: list[IntArray], state: State, believed: Believed
) -> tuple[System, float]:
    """The same without the pattern: what each sleeve shows by itself."""
    system = System(len(views), len(state.pooled))
    sigma_mm = 0.1
    present = [(k, views[k], wall) for k, wall in enumerate(walls) if len(wall)]
    if present:
        owner = np.concatenate([np.full(len(wall), k) for k, _, wall in present]).astype(np.int64)
        points = np.concatenate([view.points[wall] for _, view, wall in present if view is not None])
        slope = np.concatenate([view.slope[wall] for _, view, wall in present if view is not None])
        residual, own, pooled = wall_terms(points[:, :2], points[:, 2], slope, owner, state, WALL, PUSH)
        sigma_mm = max(spread(residual), _LEAST_SPREAD_MM)
        own_mm = own_spreads(residual, owner, np.array([0.0 if v is None else v.range_mm for v in views]), sigma_mm)
        share = np.minimum(1.0, _WALL_MAX / np.bincount(owner)[owner])
        weight = share * tukey(residual / own_mm) / (_WALL_CORRELATION * own_mm) ** 2
        system.add(Terms(own, pooled, weight * residual, weight, owner))
    system.add_beliefs(believed, state)
    return system, sigma_mm


def own_spreads(residual: Array, owner: IntArray, ranges_mm: Array, pooled_mm: float) -> Array:
    """How far the wall points (n,) of each sleeve scatter, mm: those of far sleeves much more than those of near ones.

    What a sleeve's own points show is drawn towards what all show, which grows with the distance: between the
    unevenness of walls, which does not, and a camera's noise, which grows with its square.
    """
    typical_mm = float(np.median(ranges_mm[owner]))
    found = np.empty(len(residual))
    bounds = np.searchsorted(owner, np.arange(len(ranges_mm) + 1))
    for k in np.unique(owner):
        own = slice(bounds[k], bounds[k + 1])
        expected = pooled_mm * ranges_mm[k] / typical_mm
        count = min(int(bounds[k + 1] - bounds[k]), _WALL_MAX)
        variance = (count * spread(residual[own]) ** 2 + _SPREAD_BELIEF * expected**2) / (count + _SPREAD_BELIEF)
        found[own] = max(np.sqrt(variance), _LEAST_SPREAD_MM)
    return found
