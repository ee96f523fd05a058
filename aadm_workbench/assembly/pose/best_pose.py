"""The pose that leaves most of what is allowed: of the distances, and of the room over the ribs, each of its own.

It is the pose with the smallest largest ratio of a gap to its limit (:mod:`.minimax`), taken over the gaps of the
centres and of the axes at both ends of the embedded length. Where it leaves nothing, no pose
does.

What a pose has to meet for every rebar to enter its sleeve: distances of points, each within its limit.

A pair gives up to three of them. The centres must keep the limit of the distance; and over the embedded length the axes
must keep the room over the ribs, at the mouth and at the bar's top, which holds in between as well:

    mouth:  |bar − its shift − sleeve| ≤ room        top:  |bar − (sleeve + its shift)| ≤ room

In the half-turn coordinates of :mod:`.minimax` each reads |p + τ·q + t| ≤ limit: a disc, so that
:mod:`.smallest_common_disc` can find the pose that keeps furthest inside all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.eopa import NoFit, turn
from aadm_workbench.assembly.pose.minimax import fit_minimax, half_turn_pose, half_turn_vectors
from aadm_workbench.model import Array, IntArray
from aadm_workbench.model.special import median

WITHIN = 1.0 + 1e-9
"""A largest ratio up to this is within its limits: rounding."""

SMALLEST_LIMIT_MM = 0.01
"""Stands for a room of zero or below, where a pose is still wanted."""

_SHORTEST_TURNING_MM = 1e-9  # keeps a division: points that all coincide turn into nothing

_CERTAIN_SIGMAS = 5.0
"""A room that holds with so many standard uncertainties to spare, whatever the pose, is left out."""


@dataclass(frozen=True, eq=False)
class BestFit:
    """The best pose, radians and (2,) mm of bars onto sleeves, and its gaps.

    ``ratio`` is the largest ratio of a gap to its limit, infinite where a bar is as wide as its sleeve; ``multipliers``
    (n,) say how much each pair decides, with the sum 1, and ``gap_multipliers`` (c,) each of its gaps.
    """

    yaw: float
    shift: Array
    ratio: float
    multipliers: Array
    gaps: Gaps
    gap_multipliers: Array

    @property
    def margin(self) -> float | None:
        """1 minus the largest ratio: negative where no pose meets all limits; None where a bar has no room at all."""
        return 1.0 - self.ratio if np.isfinite(self.ratio) else None

    @property
    def exists(self) -> bool:
        """Whether by value alone a pose meets all limits."""
        return self.ratio <= WITHIN


def fit_best_pose(pairs: Sequence[Pair], limits_mm: Array) -> BestFit | NoFit:
    """The pose with the largest margin of distances and rooms.

    Parameters
    ----------
    limits_mm
        (n,) float64, above zero, of the distance of each pair.
    """
    gaps = gaps_of(pairs, limits_mm)
    hopeless = gaps.limits_mm <= 0.0
    fit = fit_minimax(gaps.source, gaps.target, np.maximum(gaps.limits_mm, SMALLEST_LIMIT_MM))
    if isinstance(fit, NoFit):
        return fit
    multipliers = np.zeros(len(pairs))
    np.add.at(multipliers, gaps.owner, fit.multipliers)
    ratio = float("inf") if hopeless.any() else fit.ratio
    return BestFit(fit.yaw, fit.shift, ratio, multipliers, gaps, fit.multipliers)


class Part(IntEnum):
    """Where a distance is taken."""

    CENTRES = 0
    MOUTH = 1
    TOP = 2


@dataclass(frozen=True, eq=False)
class Gaps:
    """Points of the bars, ``source`` (c, 2) mm, that must come within ``limits_mm`` (c,) of ``target`` (c, 2) mm.

    ``owner`` (c,) is the index of the pair that each belongs to, ``part`` (c,) its :class:`Part`. A limit may be zero
    or below: the bar is as wide as its sleeve.
    """

    source: Array
    target: Array
    limits_mm: Array
    owner: IntArray
    part: IntArray


@dataclass(frozen=True, eq=False)
class StartPose:
    """The pose from which small turns are counted, radians and (2,) mm, about ``origin`` (2,) mm.

    Turns are given in units of 1/``stretch``, so that a turn and a shift of 1 move the bars about alike.
    """

    yaw: float
    shift: Array
    origin: Array
    stretch: float

    def vectors_of(self, source: Array, target: Array) -> tuple[Array, Array]:
        """Vectors p and their change q with the turn, (c, 2) mm each, for bars (c, 2) and targets (c, 2)."""
        placed = source @ turn(self.yaw).T + self.shift
        p, q = half_turn_vectors(placed - self.origin, target - self.origin)
        return p, q / self.stretch

    def pose(self, z: Array) -> tuple[float, Array]:
        """Yaw and shift (2,) mm, of bars onto sleeves, that z = (τ, t_x, t_y) stands for."""
        angle, moved = half_turn_pose(z * np.array([1.0 / self.stretch, 1.0, 1.0]))
        shift = turn(angle) @ (self.shift - self.origin) + moved + self.origin
        return self.yaw + angle, np.asarray(shift)


@dataclass(frozen=True, eq=False)
class PoseConstraints:
    """The limits of c discs, (c,) mm, their vectors (c, 2) mm and the pair and part that each belongs to, (c,)."""

    vectors: Array
    turning: Array
    limits_mm: Array
    owner: IntArray
    part: IntArray
    start: StartPose


def start_pose(pairs: Sequence[Pair], limits_mm: Array, yaw: float, shift: Array) -> StartPose:
    """The start for poses near ``yaw`` (radians) and ``shift`` (2,) mm."""
    targets = np.array([pair.sleeve_xy for pair in pairs])
    unscaled = StartPose(yaw, shift, targets.mean(axis=0), 1.0)
    _, q = unscaled.vectors_of(np.array([pair.rebar_xy for pair in pairs]), targets)
    reach_mm = max(float(np.sqrt((q**2).sum(axis=1).mean())), _SHORTEST_TURNING_MM)
    return StartPose(yaw, shift, unscaled.origin, reach_mm / float(median(limits_mm)))


def gaps_of(pairs: Sequence[Pair], limits_mm: Array) -> Gaps:
    """All distances that have a limit: of the centres, and of the axes at both ends of the embedded length.

    Rooms that the limit of the distance implies, with their uncertainties, are left out.

    Parameters
    ----------
    limits_mm
        (n,) float64, of the distance of each pair.
    """
    rows = [
        (pair.rebar_xy, pair.sleeve_xy, float(limit_mm), index, Part.CENTRES)
        for index, (pair, limit_mm) in enumerate(zip(pairs, limits_mm, strict=True))
    ]
    for index, pair in enumerate(pairs):
        if pair.room_mm is None:
            continue
        if _takes_room(pair, float(limits_mm[index]), pair.bar_shift, pair.bar_shift_covariance):
            rows.append((pair.rebar_xy - pair.bar_shift, pair.sleeve_xy, pair.room_mm, index, Part.MOUTH))
        if _takes_room(pair, float(limits_mm[index]), pair.sleeve_shift, pair.sleeve_shift_covariance):
            rows.append((pair.rebar_xy, pair.sleeve_xy + pair.sleeve_shift, pair.room_mm, index, Part.TOP))
    source, target, limits, owner, part = zip(*rows, strict=True)
    return Gaps(np.array(source), np.array(target), np.array(limits), np.array(owner), np.array(part))


def _takes_room(pair: Pair, limit_mm: float, shift: Array, covariance: Array | None) -> bool:
    """Whether the room may be too small where the distance is at its limit and the axis moves by that shift."""
    u_mm = 0.0 if covariance is None else float(np.sqrt(max(np.linalg.eigvalsh(covariance)[-1], 0.0)))
    needed_mm = limit_mm + float(np.hypot(*shift)) + _CERTAIN_SIGMAS * (u_mm + pair.room_u_mm)
    return needed_mm > (pair.room_mm or 0.0)


def pose_constraints(pairs: Sequence[Pair], limits_mm: Array, yaw: float, shift: Array) -> PoseConstraints:
    """The limits of all distances and of all clearances, as discs.

    Parameters
    ----------
    limits_mm
        (n,) float64, of the distance of each pair.
    yaw, shift
        Radians and (2,) mm: the pose to start from.
    """
    start, gaps = start_pose(pairs, limits_mm, yaw, shift), gaps_of(pairs, limits_mm)
    vectors, turning = start.vectors_of(gaps.source, gaps.target)
    return PoseConstraints(vectors, turning, gaps.limits_mm, gaps.owner, gaps.part, start)


def leans_at(pair: Pair, yaw: float) -> tuple[Array, Array]:
    """How far the bar's and the sleeve's axis move in the plane over the embedded length, (2,) mm each."""
    return turn(yaw) @ pair.bar_shift, pair.sleeve_shift
