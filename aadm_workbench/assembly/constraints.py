"""What a pose has to meet for every rebar to enter its sleeve, linear in a small turn and a shift.

In the half-turn coordinates of :mod:`.minimax` each limit, of a distance and of the room over the ribs alike, reads
|p + τ·q + t| ≤ limit: a disc, so that :mod:`.discs` can find the pose that keeps furthest inside all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.minimax import half_turn_pose, half_turn_vectors
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.upright import turn
from aadm_workbench.model import Array, IntArray

_SHORTEST_TURNING_MM = 1e-9


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
    """The limits of c discs, (c,) mm, their vectors (c, 2) mm and the index of the pair that each belongs to, (c,)."""

    vectors: Array
    turning: Array
    limits_mm: Array
    owner: IntArray
    start: StartPose


def start_pose(pairs: Sequence[Pair], limits_mm: Array, yaw: float, shift: Array) -> StartPose:
    """The start for poses near ``yaw`` (radians) and ``shift`` (2,) mm."""
    targets = np.array([pair.sleeve_xy for pair in pairs])
    unscaled = StartPose(yaw, shift, targets.mean(axis=0), 1.0)
    _, q = unscaled.vectors_of(np.array([pair.rebar_xy for pair in pairs]), targets)
    reach_mm = max(float(np.sqrt((q**2).sum(axis=1).mean())), _SHORTEST_TURNING_MM)
    return StartPose(yaw, shift, unscaled.origin, reach_mm / float(np.median(limits_mm)))


def pose_constraints(pairs: Sequence[Pair], limits_mm: Array, yaw: float, shift: Array) -> PoseConstraints:
    """The limits of all distances and of all clearances.

    Clearances that the limit of the distance implies are left out. A limit may be zero or below: the bar is as wide
    as its sleeve.

    Parameters
    ----------
    limits_mm
        (n,) float64, of the distance of each pair.
    yaw, shift
        Radians and (2,) mm: the pose to start from.
    """
    start = start_pose(pairs, limits_mm, yaw, shift)
    p, q = start.vectors_of(np.array([pair.rebar_xy for pair in pairs]), np.array([pair.sleeve_xy for pair in pairs]))
    vectors, turning, limits, owner = list(p), list(q), list(limits_mm), list(range(len(pairs)))
    for index, pair in enumerate(pairs):
        if pair.room_mm is None:
            continue
        for lean in leans_at(pair, yaw):
            if limits_mm[index] + float(np.hypot(*lean)) > pair.room_mm:
                vectors.append(p[index] - lean)
                turning.append(q[index])
                limits.append(pair.room_mm)
                owner.append(index)
    return PoseConstraints(np.array(vectors), np.array(turning), np.array(limits), np.array(owner), start)


def leans_at(pair: Pair, yaw: float) -> tuple[Array, Array]:
    """How far the bar's and the sleeve's axis move in the plane over the embedded length, (2,) mm each."""
    return turn(yaw) @ pair.bar_shift, pair.sleeve_shift
