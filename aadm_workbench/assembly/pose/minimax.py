"""The pose in the plane with the smallest largest distance: does it go together, not how do they differ.

With unlike limits the largest ratio of distance to limit is minimised. For a turn by θ about the start, with
τ = tan(θ/2), a the source and b the target points and J the turn by 90°,

    |R(θ)a + t − b| = cos(θ/2) · |(a − b) + τ·J(a + b) + t'|,   t' = R(−θ/2)t / cos(θ/2),

so up to the factor cos(θ/2), which is 1 at the start, the problem is convex in (τ, t'). It is solved to the end
(:mod:`.discs`), the start is moved to its solution, and this is repeated until the turn is zero. There the
multipliers λ of the pairs in contact prove that no other turn is better, small or large: any pose has

    largest ratio² ≥ (r² + τ²·V) / (1 + τ²),   V = Σ λ_i·|q_i − q̄|²/limit_i²,   q = J(a + b),

and V, the spread of the pairs in contact, is far above r² unless the points differ by as much as the pattern is wide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.assembly.pose.smallest_common_disc import smallest_common_disc
from aadm_workbench.assembly.pose.upright import planar_transform, turn
from aadm_workbench.errors import AadmError
from aadm_workbench.model import Array

_ROUNDS = 12  # a cap: the turn is settled to its digits after a few, each linear in what is left
_STILL = 1e-8  # of tan(yaw/2): 0.01 µm at the ends of a column
_OTHER_STARTS = 24  # 15 degrees apart: only for patterns that no bound certifies


@dataclass(frozen=True, eq=False)
class MinimaxPose:
    """The pose with the smallest largest ratio of distance to limit.

    Parameters
    ----------
    yaw, shift
        Radians and (2,) mm: ``turn(yaw) @ source + shift`` is compared with the target.
    offsets
        (n, 2) mm: placed source minus target.
    ratio
        The largest ratio of distance to limit.
    bound
        No pose has a smaller largest ratio than this; it meets ``ratio`` within rounding.
    multipliers
        (n,) float64, sum 1: above zero for the pairs that decide.
    certified
        Whether the bound holds for every turn and not only for turns near this one.
    """

    yaw: float
    shift: Array
    offsets: Array
    ratio: float
    bound: float
    multipliers: Array
    certified: bool

    @property
    def T(self) -> Array:
        """T_target_source (4, 4)."""
        return planar_transform(self.yaw, self.shift)

    @property
    def margin(self) -> float:
        """1 minus the largest ratio: what is left of the limits, negative where no pose meets them."""
        return 1.0 - self.ratio


def fit_minimax(source: Array, target: Array, limits_mm: Array) -> MinimaxPose | NoFit:
    """Pose (dx, dy, yaw) that lays source on target points with the smallest largest ratio of distance to limit.

    Parameters
    ----------
    source, target
        (n, 2) float64, mm; row i of one belongs to row i of the other.
    limits_mm
        (n,) float64, above zero; all alike where only the distance counts.

    Returns
    -------
    MinimaxPose, or NoFit for fewer than two distinct points.
    """
    if limits_mm.shape != (len(source),) or not (limits_mm > 0).all():
        raise AadmError(f"minimax needs one limit above zero for each of the {len(source)} points")
    fit = fit_eopa_planar(source, target)
    if isinstance(fit, NoFit):
        return fit
    pose = _descend(source, target, limits_mm, fit.yaw, fit.t)
    if pose.certified:
        return pose
    middle, centre = source.mean(axis=0), target.mean(axis=0)
    for angle in np.linspace(0.0, 2.0 * np.pi, _OTHER_STARTS, endpoint=False):
        other = _descend(source, target, limits_mm, float(angle), centre - turn(float(angle)) @ middle)
        pose = other if other.ratio < pose.ratio else pose
    return pose


def half_turn_vectors(source: Array, target: Array) -> tuple[Array, Array]:
    """The vectors p = a − b and q = J(a + b), (n, 2) mm, in which a small turn of the source is linear."""
    both = source + target
    return source - target, np.stack([-both[:, 1], both[:, 0]], axis=1)


def half_turn_pose(z: Array) -> tuple[float, Array]:
    """Yaw and shift (2,) of (τ, t'_x, t'_y): θ = 2·atan τ and t = (t' + τ·J·t')/(1 + τ²)."""
    tau, shift = float(z[0]), z[1:]
    turned = np.array([shift[0] - tau * shift[1], shift[1] + tau * shift[0]])
    return 2.0 * float(np.arctan(tau)), turned / (1.0 + tau**2)


def _descend(source: Array, target: Array, limits_mm: Array, yaw: float, shift: Array) -> MinimaxPose:
    centre = target.mean(axis=0)
    goal = target - centre
    share = np.full(len(source), 1.0 / len(source))
    bound, spread = 0.0, np.inf
    for _ in range(_ROUNDS):
        placed = source @ turn(yaw).T + shift - centre
        ratio = _largest(placed - goal, limits_mm)
        if ratio * float(limits_mm.min()) < 1e-12:
            break
        p, q = half_turn_vectors(placed, goal)
        stretch = float(np.sqrt((q**2).sum(axis=1).mean())) / float(np.median(limits_mm))
        solution = smallest_common_disc(p[None] / ratio, q[None] / stretch, 1.0 / limits_mm**2, start=share)
        z = solution.z[0] * ratio * np.array([1.0 / stretch, 1.0, 1.0])
        share = solution.multipliers[0]
        bound = float(np.sqrt(solution.bound_squared[0])) * ratio
        spread = _spread(q, share / limits_mm**2)
        angle, moved = half_turn_pose(z)
        yaw, shift = yaw + angle, turn(angle) @ (shift - centre) + moved + centre
        if abs(z[0]) <= _STILL:
            break
    offsets = source @ turn(yaw).T + shift - target
    ratio = _largest(offsets, limits_mm)
    yaw = float(np.arctan2(np.sin(yaw), np.cos(yaw)))
    return MinimaxPose(yaw, shift, offsets, ratio, min(bound, ratio), share, bool(spread >= ratio**2))


def _largest(offsets: Array, limits_mm: Array) -> float:
    return float((np.hypot(*offsets.T) / limits_mm).max())


def _spread(q: Array, weights: Array) -> float:
    mean = weights @ q / weights.sum()
    return float(weights @ ((q - mean) ** 2).sum(axis=1))
