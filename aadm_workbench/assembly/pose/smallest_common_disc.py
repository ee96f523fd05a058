"""The smallest common size of discs that have a point in common: a convex program, solved for many at once.

Given vectors p_i + τ·q_i + t in the plane, linear in a number τ and a shift t, find the (τ, t) for which the largest
ratio |p_i + τ·q_i + t| / limit_i is smallest. In s, the square of that ratio, all constraints
w_i·|p_i + τ·q_i + t|² ≤ s with w_i = 1/limit_i² are smooth and convex, so a primal–dual interior-point method
(Boyd & Vandenberghe, Convex Optimization, 11.7) finds the optimum, and its multipliers prove how near it is.
The steps are in :mod:`.barrier`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.interior_point import squared, step, vectors
from aadm_workbench.model import Array, BoolArray

_ROUNDS = 60  # a cap: each step aims at a twelfth of the gap
_GAP = 1e-12  # share of the squared ratio: rounding leaves some 1e-13 of it


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
    level = 1.5 * best + 1e-30
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
