"""The smallest common size of discs that have a point in common: a convex program, solved for many at once.

Given vectors p_i + τ·q_i + t in the plane, linear in a number τ and a shift t, find the (τ, t) for which the largest
ratio |p_i + τ·q_i + t| / limit_i is smallest. In s, the square of that ratio, all constraints
w_i·|p_i + τ·q_i + t|² ≤ s with w_i = 1/limit_i² are smooth and convex, so a primal–dual interior-point method
(Boyd & Vandenberghe, Convex Optimization, 11.7) finds the optimum, and its multipliers prove how near it is.

One step of the interior-point method that finds the smallest common size of discs with a common point. Minimised is s
under w_i·|p_i + τ·q_i + t|² ≤ s. The direction is the primal–dual Newton direction; its length is chosen on the barrier
function s − μ·Σ log(s − value_i), in which the best level s is found for each point.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray

_ROUNDS = 60  # a cap: each step aims at a twelfth of the gap
_GAP = 1e-12  # share of the squared ratio: rounding leaves some 1e-13 of it

# of the gap that is left, which a step aims at: well below it, and not at once at the rim; a choice, not tuned since
_CENTRING = 0.08
_STEP = 0.99  # of the way to where a multiplier would vanish
_LEVEL_ROUNDS = 3  # Newton on one number, which doubles its digits in each
_HALVINGS = 10  # a step a thousandth as long that still does not descend is none
_SMALLEST_AIM = 1e-12  # the gap at which discs.py ends
_SMALLEST_SLACK = 1e-15  # a few units of the last place of a double
_RIDGE = 1e-13  # of the trace: some hundred units of the last place


@dataclass(frozen=True, eq=False)
class DiscSolution:
    """Optimum of k problems: ``z`` (k, 3) is (τ, t_x, t_y), ``ratio_squared`` (k,) what it reaches.

    ``multipliers`` (k, n) sum to one; ``bound_squared`` (k,) is the lower bound that they prove.
    """

    z: Array
    ratio_squared: Array
    multipliers: Array
    bound_squared: Array


def smallest_common_disc(
    p: Array,
    q: Array,
    weights: Array,
    *,
    decide_at: float | None = None,
    start: Array | None = None,
    gap: float = _GAP,
) -> DiscSolution:
    """Minimise the largest w_i·|p_i + τ·q_i + t|² over τ and t.

    Parameters
    ----------
    p, q
        (k, n, 2) float64; of like magnitude, for the sake of the arithmetic.
    weights
        (n,) float64, above zero, or (k, n) where those of the problems differ.
    decide_at
        Only whether the optimum of each problem is below or above this is wanted: then a problem is left as soon
        as its value or its bound says so.
    start
        (n,) multipliers of a problem like these; by default all are equal.
    gap
        A problem is left once its value is proven to be within this share of the smallest.
    """
    weights = np.broadcast_to(weights, p.shape[:2])
    z = np.zeros((len(p), 3))
    first = np.ones(p.shape[1]) if start is None else np.maximum(start, 1e-6)
    multipliers = np.tile(first / first.sum(), (len(p), 1))
    best, best_z = _largest(p, q, weights, z), z.copy()
    bound = proven_bound(p, q, weights, multipliers)
    level = 1.5 * best + 1e-30  # above the best by half, and above nothing where that is nothing
    open_ = np.flatnonzero(_undecided(best, bound, decide_at, gap))
    for _ in range(_ROUNDS):
        if not len(open_):
            break
        pk, qk, wk, zk, level_k, lam = (v[open_] for v in (p, q, weights, z, level, multipliers))
        step(pk, qk, wk, zk, level_k, lam, bound[open_])
        z[open_], level[open_], multipliers[open_] = zk, level_k, lam
        reached = _largest(pk, qk, wk, zk)
        better = reached < best[open_]
        best[open_[better]], best_z[open_[better]] = reached[better], zk[better]
        bound[open_] = np.maximum(bound[open_], proven_bound(pk, qk, wk, lam))
        open_ = open_[_undecided(best[open_], bound[open_], decide_at, gap)]
    share = multipliers / multipliers.sum(axis=1, keepdims=True)
    return DiscSolution(best_z, best, share, np.minimum(bound, best))


def _undecided(best: Array, bound: Array, decide_at: float | None, gap: float) -> BoolArray:
    undecided = best - bound > gap * best
    if decide_at is not None:
        undecided &= (best > decide_at) & (bound <= decide_at)
    return np.asarray(undecided)


def _largest(p: Array, q: Array, weights: Array, z: Array) -> Array:
    return np.asarray((weights * squared(vectors(p, q, z))).max(axis=1))


def proven_bound(p: Array, q: Array, weights: Array, multipliers: Array) -> Array:
    """Lower bound (k,) that the multipliers prove: no largest value is below the smallest weighted mean."""
    share = multipliers / multipliers.sum(axis=1, keepdims=True) * weights
    total = share.sum(axis=1)
    mean_p, mean_q = (np.einsum("kn,knd->kd", share, v) / total[:, None] for v in (p, q))
    centred_p, centred_q = p - mean_p[:, None], q - mean_q[:, None]
    pp = np.einsum("kn,knd,knd->k", share, centred_p, centred_p)
    pq = np.einsum("kn,knd,knd->k", share, centred_p, centred_q)
    qq = np.einsum("kn,knd,knd->k", share, centred_q, centred_q)
    return np.asarray(pp - pq**2 / np.maximum(qq, 1e-300))


def vectors(p: Array, q: Array, z: Array) -> Array:
    """Vectors p + τ·q + t, (k, n, 2), for z = (τ, t_x, t_y), (k, 3)."""
    return p + z[:, None, :1] * q + z[:, None, 1:]


def squared(e: Array) -> Array:
    """Squared lengths (k, n) of vectors (k, n, 2)."""
    return np.asarray(e[..., 0] ** 2 + e[..., 1] ** 2)


def step(p: Array, q: Array, weights: Array, z: Array, level: Array, lam: Array, bound: Array) -> None:
    """One primal–dual Newton step of k problems, in place on z (k, 3), the level s (k,) and the multipliers (k, n).

    ``bound`` (k,) is the best lower bound known, ``weights`` is (k, n); the other arguments are those of
    :func:`~aadm_workbench.assembly.pose.smallest_common_disc.smallest_common_disc`.
    """
    e = vectors(p, q, z)
    value = weights * squared(e)
    # Rounding may leave nothing of a slack that is tiny by right.
    slack = np.maximum(level[:, None] - value, _SMALLEST_SLACK * level[:, None])
    # Aimed at what the bound leaves open, not at the products: a step may centre long before it is near.
    mu = _CENTRING * np.maximum(level - bound, _SMALLEST_AIM * level) / lam.shape[1]
    turned = (q * e).sum(axis=2, keepdims=True)
    gradient = np.concatenate([turned, e], axis=2) * (2.0 * weights[:, :, None])
    move, raised = _direction(q, gradient, lam, slack, mu, weights)
    along = (gradient @ move[:, :, None])[:, :, 0]
    change = mu[:, None] / slack - lam + lam / slack * (along - raised[:, None])
    curved = weights * squared(move[:, None, :1] * q + move[:, None, 1:])
    longest = np.minimum(_STEP * _positive(lam, change), 1.0)
    length, level[:], descends = _line_search(value, along, curved, level, mu, longest)
    z += length[:, None] * move
    # A direction that does not descend comes from stray multipliers: those of the barrier itself set it right.
    ends = level[:, None] - value - length[:, None] * along - length[:, None] ** 2 * curved
    lam[:] = np.where(descends[:, None], lam + length[:, None] * change, mu[:, None] / ends)


def _direction(q: Array, gradient: Array, lam: Array, slack: Array, mu: Array, weights: Array) -> tuple[Array, Array]:
    """Newton direction of z (k, 3) and of the level (k,)."""
    stiffness = lam / slack
    by_level = np.concatenate([gradient, np.full((*stiffness.shape, 1), -1.0)], axis=2)
    hessian = by_level.transpose(0, 2, 1) @ (stiffness[:, :, None] * by_level)
    _add_curvature(hessian, q, lam * weights)
    push = mu[:, None] / slack
    right = -(push[:, None, :] @ by_level)[:, 0]
    right[:, 3] -= 1.0
    move = _solved(hessian, right)
    return move[:, :3], move[:, 3]


def _solved(hessian: Array, right: Array) -> Array:
    """Solutions (k, 4); where rounding has left a matrix without an inverse, of one that is a hair stiffer."""
    try:
        return np.asarray(np.linalg.solve(hessian, right[:, :, None])[:, :, 0])
    except np.linalg.LinAlgError:
        stiffer = _RIDGE * np.maximum(np.trace(hessian, axis1=1, axis2=2), _SMALLEST_SLACK)
        return np.asarray(np.linalg.solve(hessian + stiffer[:, None, None] * np.eye(4), right[:, :, None])[:, :, 0])


def _line_search(
    value: Array, along: Array, curved: Array, level: Array, mu: Array, length: Array
) -> tuple[Array, Array, BoolArray]:
    """Step lengths (k,) that do not raise the barrier function, the levels there, and whether there was one."""
    before, _ = _barrier(value, mu)
    for _ in range(_HALVINGS):
        a = length[:, None]
        after, level = _barrier(value + a * along + a**2 * curved, mu)
        descends = after <= before + 1e-14 * np.abs(before)
        if descends.all():
            break
        length = np.where(descends, length, 0.5 * length)
    length = np.where(descends, length, 0.0)
    a = length[:, None]
    return length, _barrier(value + a * along + a**2 * curved, mu)[1] if not descends.all() else level, descends


def _barrier(value: Array, mu: Array) -> tuple[Array, Array]:
    """Smallest s − μ·Σ log(s − value_i) over s, (k,), and the level s (k,) at which Σ μ/(s − value_i) is one."""
    top = value.max(axis=1)
    # A step that leads far away is tried, too: beside its values the aim may be less than their last place.
    least = top * (1.0 + _SMALLEST_SLACK)
    level = np.maximum(top + mu, least)
    for _ in range(_LEVEL_ROUNDS):
        inverse = mu[:, None] / (level[:, None] - value)
        # Newton's on the reciprocal of the sum, which is linear in s wherever the largest values are alike.
        total = inverse.sum(axis=1)
        level = np.maximum(level + total * (total - 1.0) * mu / (inverse * inverse).sum(axis=1), least)
    return level - mu * np.log((level[:, None] - value) / mu[:, None]).sum(axis=1), level


def _add_curvature(hessian: Array, q: Array, pull: Array) -> None:
    """Add Σ λ_i·∇²f_i, the curvature of the squared lengths, to (k, 4, 4)."""
    hessian[:, 0, 0] += 2.0 * (pull * squared(q)).sum(axis=1)
    mixed = 2.0 * (pull[:, None, :] @ q)[:, 0]
    hessian[:, 0, 1:3] += mixed
    hessian[:, 1:3, 0] += mixed
    total = 2.0 * pull.sum(axis=1)
    hessian[:, 1, 1] += total
    hessian[:, 2, 2] += total


def _positive(lam: Array, change: Array) -> Array:
    """Longest step (k,) that keeps the multipliers above zero."""
    return np.asarray(np.where(change < 0.0, -lam / np.minimum(change, -1e-300), np.inf).min(axis=1))
