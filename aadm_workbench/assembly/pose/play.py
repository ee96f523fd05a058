"""The play as an instrument: of all poses in which a column keeps every limit, the one nearest to the grid.

From the pose of the trial the column may be displaced by δ = (dx, dy, yaw): each gap between a bar and its sleeve at s
then is its vector less δ's move of s, and has to stay within its radius. The poses that do form a convex set, up to
second order of the yaw. Each radius is made smaller by what the measurement may be wrong, so that all of them hold
with the probability that a pass asks for; a gap that is beyond its smaller radius at the trial's pose already may stay
as it is there, and not grow.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize
from scipy.stats import norm

from aadm_workbench.assembly.decision import PASS_PROBABILITY
from aadm_workbench.model import Array, BestPair, PairResult

_STEPS_BACK = 40
"""Halvings of the way back to the trial's pose where rounding left a limit by a hair: to a millionth of a millionth."""

_MOST_ITERATIONS = 200
"""Of the solver; three unknowns need about ten."""

_ROUNDING_MM = 1e-9
"""By which a gap may be longer than its radius: rounding."""


@dataclass(frozen=True, eq=False)
class Gap:
    """A distance that has to stay within a radius: ``vector`` (2,) mm, ``radius_mm``, ``u_mm`` per axis.

    ``is_of_centres`` tells the distance of the centres from the rooms of the axes.
    """

    vector: Array
    radius_mm: float
    u_mm: float
    is_of_centres: bool = False


def pair_gaps(pair: PairResult, leans: Sequence[Array | None], length_mm: float | None) -> Iterator[Gap]:
    """What of a pair must stay within limits: its centres, and its axes at both ends of the embedded length.

    Parameters
    ----------
    pair
        At the pose from which the column is to be displaced.
    leans
        How far the axes of bar and sleeve move in the plan, (2,), for each mm along the column; where one is not
        known, no point may move further than the room that is left.
    length_mm
        The embedded length of the bar.
    """
    offset, u_mm = np.array(pair.offset_mm), pair.u_mm or 0.0
    if pair.limit_mm is not None:
        yield Gap(offset, pair.limit_mm, u_mm, is_of_centres=True)
    if pair.clearance_mm is None:
        return
    allowance_mm = pair.allowance_mm if isinstance(pair, BestPair) else None
    u_room_mm = (pair.u_room_mm if isinstance(pair, BestPair) else None) or u_mm
    if allowance_mm is None or length_mm is None or any(lean is None for lean in leans):
        yield Gap(np.zeros(2), pair.clearance_mm, u_room_mm)
        return
    yield from (Gap(offset - length_mm * lean, allowance_mm, u_room_mm) for lean in leans if lean is not None)


@dataclass(frozen=True, eq=False)
class PlayLimits:
    """All gaps of a column: vectors (c, 2) mm, sleeves' places (c, 2) mm, and the radii (c,) mm that hold for them."""

    vectors: Array
    places: Array
    radii: Array

    def room(self, planar: Array) -> Array:
        """(c,) mm² left in each gap after a displacement (3,) of the column from the trial's pose; negative: broken."""
        return np.asarray(self.radii**2 - (self.gaps(planar) ** 2).sum(axis=1))

    def gaps(self, planar: Array) -> Array:
        """The gaps (c, 2) mm after a displacement: bars as seen from the displaced column, less the sleeves."""
        cosine, sine = np.cos(planar[2]), np.sin(planar[2])
        bars = self.places + self.vectors - planar[:2]
        return np.asarray(bars @ np.array([[cosine, -sine], [sine, cosine]]) - self.places)

    def keeps(self, planar: Array) -> bool:
        """Whether no limit is broken."""
        lengths = np.sqrt((self.gaps(planar) ** 2).sum(axis=1))
        return bool(np.all(lengths <= self.radii + _ROUNDING_MM))


def play_limits(rows: Sequence[tuple[Gap, Array]]) -> PlayLimits | None:
    """The limits of a column's play; None where nothing limits it, or its trial breaks one.

    Parameters
    ----------
    rows
        Gaps, each with the place (2,) mm of its sleeve in the column.
    """
    if not rows:
        return None
    vectors, places = np.array([gap.vector for gap, _ in rows]), np.array([place for _, place in rows])
    lengths = np.sqrt((vectors**2).sum(axis=1))
    full = np.array([gap.radius_mm for gap, _ in rows])
    if np.any(lengths > full + _ROUNDING_MM):
        return None
    # Together they may fail as often as one alone: Bonferroni.
    sigmas = float(norm.isf((1.0 - PASS_PROBABILITY) / len(rows)))
    guarded = full - sigmas * np.array([gap.u_mm for gap, _ in rows])
    return PlayLimits(vectors, places, np.minimum(np.maximum(guarded, lengths), full))


def nearest_to(limits: PlayLimits, wanted: Array, lever_mm: float) -> Array:
    """The displacement (3,) from the trial's pose, within all limits, that is nearest to a wanted one (3,).

    Parameters
    ----------
    wanted
        dx, dy mm and yaw radians, column frame.
    lever_mm
        What a radian of yaw counts for, mm: how far from the axis it moves things.
    """
    scale = np.array([1.0, 1.0, lever_mm])
    if limits.keeps(wanted):
        return wanted
    found = minimize(
        lambda z: float(((z - wanted * scale) ** 2).sum()),
        np.zeros(3),
        jac=lambda z: 2.0 * (z - wanted * scale),
        constraints={"type": "ineq", "fun": lambda z: limits.room(z / scale)},
        method="SLSQP",
        options={"maxiter": _MOST_ITERATIONS, "ftol": 1e-10},
    )
    return within(limits, found.x / scale)


def within(limits: PlayLimits, planar: Array) -> Array:
    """A displacement (3,), or where it breaks a limit the furthest on the way to it that does not."""
    if limits.keeps(planar):
        return planar
    low, high = 0.0, 1.0
    for _ in range(_STEPS_BACK):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if limits.keeps(middle * planar) else (low, middle)
    return np.asarray(low * planar)
