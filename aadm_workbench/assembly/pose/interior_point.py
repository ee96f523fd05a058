"""One step of the interior-point method that finds the smallest common size of discs with a common point.

Minimised is s under w_i·|p_i + τ·q_i + t|² ≤ s. The direction is the primal–dual Newton direction; its length is
chosen on the barrier function s − μ·Σ log(s − value_i), in which the best level s is found for each point.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, BoolArray

# of the gap that is left, which a step aims at: well below it, and not at once at the rim; a choice, not tuned since
_CENTRING = 0.08
_STEP = 0.99  # of the way to where a multiplier would vanish
_LEVEL_ROUNDS = 3  # Newton on one number, which doubles its digits in each
_HALVINGS = 10  # a step a thousandth as long that still does not descend is none
_SMALLEST_AIM = 1e-12  # the gap at which discs.py ends
_SMALLEST_SLACK = 1e-15  # a few units of the last place of a double
_RIDGE = 1e-13  # of the trace: some hundred units of the last place


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
