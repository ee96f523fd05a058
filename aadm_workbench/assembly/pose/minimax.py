"""The pose in the plane with the smallest largest distance: does it go together, not how do they differ.

With unlike limits the largest ratio of distance to limit is minimised. For a turn by θ about the start, with
τ = tan(θ/2), a the source and b the target points and J the turn by 90°,

    |R(θ)a + t − b| = cos(θ/2) · |(a − b) + τ·J(a + b) + t'|,   t' = R(−θ/2)t / cos(θ/2),

so up to the factor cos(θ/2), which is 1 at the start, the problem is convex in (τ, t'). It is solved to the end
(:mod:`.smallest_common_disc`), the start is moved to its solution, and this is repeated until the turn is zero. There
the multipliers λ of the pairs in contact prove that no other turn is better, small or large: any pose has

    largest ratio² ≥ (r² + τ²·V) / (1 + τ²),   V = Σ λ_i·|q_i − q̄|²/limit_i²,   q = J(a + b),

and V, the spread of the pairs in contact, is far above r² unless the points differ by as much as the pattern is wide.

How far a rigid pose can move from where it is before some pair exceeds its limit. The set of permitted poses is convex
in the half-turn coordinates of :mod:`.minimax`, up to the factor cos(θ/2). Its ends in x, y and turn are found by the
barrier method, started inside; the factor and the coordinates are brought up to date at each solution, so that the ends
are those of the true set.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar, planar_transform, turn
from aadm_workbench.assembly.pose.smallest_common_disc import smallest_common_disc
from aadm_workbench.errors import AadmError
from aadm_workbench.model import Array, PoseWindow
from aadm_workbench.model.special import median

_ROUNDS = 12  # a cap: the turn is settled to its digits after a few, each linear in what is left
_STILL = 1e-8  # of tan(yaw/2): 0.01 µm at the ends of a column
_OTHER_STARTS = 24  # 15 degrees apart: only for patterns that no bound certifies

_UPDATES = 2  # a small turn is nearly linear: the second ends in the first's digits
_REDUCTIONS = 8  # pulls of 1 to 10⁷: an end is then known to a millionth of the window
_NEWTON_STEPS = 12  # a cap: each pull begins where the last one ended


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
        raise AadmError.because("assembly.minimax_limits", count=len(source))
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
        stretch = float(np.sqrt((q**2).sum(axis=1).mean())) / float(median(limits_mm))
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


def find_window(source: Array, target: Array, limits_mm: Array) -> PoseWindow | None:
    """Ranges of dx, dy and yaw of the source within which some pose meets all limits.

    Parameters
    ----------
    source, target
        (n, 2) float64, mm, row by row, at a pose that meets all limits with room to spare; displacements are
        counted from it: turned by yaw about the origin, then moved by dx, dy.
    limits_mm
        (n,) float64, above zero.

    Returns
    -------
    PoseWindow, or None where the given pose does not lie inside all limits.
    """
    p, q = half_turn_vectors(source, target)
    weights = 1.0 / limits_mm**2
    if float((weights * (p**2).sum(axis=1)).max()) >= 1.0 - 1e-9:
        return None
    stretch = float(np.sqrt((q**2).sum(axis=1).mean())) / float(median(limits_mm))
    q = q / stretch
    goals = np.array([[0.0, side, 0.0] for side in (-1, 1)] + [[0.0, 0.0, side] for side in (-1, 1)])
    goals = np.concatenate([goals, [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]])
    slopes, growth, z = goals.copy(), np.ones(len(goals)), np.zeros((len(goals), 3))
    for _ in range(_UPDATES):
        z = _furthest(p, q, weights, slopes, growth)
        tau = z[:, 0] / stretch
        growth = 1.0 + tau**2
        slopes = _slopes(goals, z, tau, stretch)
    ends = [half_turn_pose(row * np.array([1.0 / stretch, 1.0, 1.0])) for row in z]
    x, y = ([float(ends[first + side][1][axis]) for side in (0, 1)] for axis, first in ((0, 0), (1, 2)))
    yaw = [math.degrees(ends[index][0]) for index in (4, 5)]
    return PoseWindow((x[0], x[1]), (y[0], y[1]), (yaw[0], yaw[1]))


def _slopes(goals: Array, z: Array, tau: Array, stretch: float) -> Array:
    """Gradients (6, 3) of dx, dy and yaw by the half-turn coordinates, at the present ends."""
    slopes = goals.copy()
    along_x, along_y = goals[:, 1], goals[:, 2]
    slopes[:, 1] = along_x + tau * along_y
    slopes[:, 2] = along_y - tau * along_x
    turned = along_y * z[:, 1] - along_x * z[:, 2]
    slopes[:, 0] += turned / stretch
    return slopes


def _furthest(p: Array, q: Array, weights: Array, slopes: Array, growth: Array) -> Array:
    """Points z (k, 3) furthest along ``slopes`` where weights·|p + τ·q + t|² ≤ growth (k,), n constraints each."""
    z = np.zeros((len(slopes), 3))
    columns = np.zeros((len(q), 2, 3))
    columns[:, :, 0] = q
    columns[:, 0, 1] = columns[:, 1, 2] = 1.0
    curvature = (2.0 * weights[:, None, None] * (columns.transpose(0, 2, 1) @ columns)).reshape(-1, 9)
    pull = 1.0
    for _ in range(_REDUCTIONS):
        for _ in range(_NEWTON_STEPS):
            if not _newton(p, q, weights, curvature, slopes * pull, growth, z):
                break
        pull *= 10.0
    return z


def _newton(p: Array, q: Array, weights: Array, curvature: Array, slopes: Array, growth: Array, z: Array) -> bool:
    """One damped Newton step, in place, on −slope·z − Σ log(growth − value_i); False where it hardly moves."""
    e = p + z[:, None, :1] * q + z[:, None, 1:]
    slack = growth[:, None] - weights * (e**2).sum(axis=2)
    gradient = 2.0 * weights[:, None] * np.concatenate([(q * e).sum(axis=2, keepdims=True), e], axis=2)
    scaled = gradient / slack[:, :, None]
    hessian = scaled.transpose(0, 2, 1) @ scaled + ((1.0 / slack) @ curvature).reshape(-1, 3, 3)
    downhill = slopes - scaled.sum(axis=1)
    step = np.linalg.solve(hessian, downhill[:, :, None])[:, :, 0]
    decrement = np.sqrt(np.maximum((step * downhill).sum(axis=1), 0.0))
    # The damped step of a self-concordant barrier never leaves the set; near the centre it is a full one.
    z += step / np.where(decrement < 0.25, 1.0, 1.0 + decrement)[:, None]
    return bool(decrement.max() > 1e-6)
