"""The largest slack that a pose leaves to all gaps of a column, for many columns at once.

A second way to the truth, that shares no formula with the code which is judged: turns are small, so that the gaps are
linear in the pose; the largest of all excesses is replaced by the logarithm of the sum of their exponentials, which is
smooth and convex, and Newton's method follows its minimum while it is made sharper. What is left of the smoothing is
less than a micrometre; a turn by a milliradian is linear to 0.1 µm.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array

_SHARPNESS = tuple(3.0 * 4.0**k for k in range(8))
"""1/mm: from one that sees all gaps to one that sees only the largest; the last is 20 µm⁻¹·10⁻³ times ln 36."""

_NEWTON_STEPS = 6
_HALVINGS = 5
_KINK_MM = 1e-6
_RIDGE = 1e-9


def margins_mm(source: Array, target: Array, limits_mm: Array) -> Array:
    """Slack (k,) mm of the best pose of each of k columns.

    Parameters
    ----------
    source, target
        (k, c, 2) float64, mm: points that are turned and moved together, and where each of them should come.
    limits_mm
        (k, c) float64: how far apart the two may stay; a limit may be below zero.
    """
    reach = np.abs(source).max(axis=(1, 2))[:, None, None]
    turning = np.stack([-source[..., 1], source[..., 0]], axis=2) / reach
    gap = source - target
    pose = np.zeros((len(gap), 3))
    best = _largest(gap, turning, limits_mm, pose)
    for sharpness in _SHARPNESS:
        for _ in range(_NEWTON_STEPS):
            pose = _newton(gap, turning, limits_mm, pose, sharpness)
            best = np.minimum(best, _largest(gap, turning, limits_mm, pose))
    return -best


def _lengths(gap: Array, turning: Array, pose: Array) -> tuple[Array, Array]:
    vectors = gap + pose[:, None, :1] * turning + pose[:, None, 1:]
    return vectors, np.sqrt((vectors**2).sum(axis=2) + _KINK_MM**2)


def _largest(gap: Array, turning: Array, limits_mm: Array, pose: Array) -> Array:
    return np.asarray((_lengths(gap, turning, pose)[1] - limits_mm).max(axis=1))


def _smooth(gap: Array, turning: Array, limits_mm: Array, pose: Array, sharpness: float) -> Array:
    excess = _lengths(gap, turning, pose)[1] - limits_mm
    top = excess.max(axis=1, keepdims=True)
    return np.asarray(top[:, 0] + np.log(np.exp(sharpness * (excess - top)).sum(axis=1)) / sharpness)


def _newton(gap: Array, turning: Array, limits_mm: Array, pose: Array, sharpness: float) -> Array:
    """One Newton step of k problems, (k, 3), each shortened until it descends."""
    vectors, lengths = _lengths(gap, turning, pose)
    excess = lengths - limits_mm
    share = np.exp(sharpness * (excess - excess.max(axis=1, keepdims=True)))
    share /= share.sum(axis=1, keepdims=True)
    unit = vectors / lengths[..., None]
    slopes = np.concatenate([(unit * turning).sum(axis=2, keepdims=True), unit], axis=2)
    across = np.stack([-unit[..., 1], unit[..., 0]], axis=2)
    bends = np.concatenate([(across * turning).sum(axis=2, keepdims=True), across], axis=2)
    gradient = np.einsum("kc,kci->ki", share, slopes)
    hessian = np.einsum("kc,kci,kcj->kij", share / lengths, bends, bends)
    hessian += sharpness * np.einsum("kc,kci,kcj->kij", share, slopes, slopes)
    hessian += _RIDGE * np.eye(3) - sharpness * gradient[:, :, None] * gradient[:, None, :]
    move = -np.linalg.solve(hessian, gradient[:, :, None])[:, :, 0]
    before, length = _smooth(gap, turning, limits_mm, pose, sharpness), np.ones(len(pose))
    for _ in range(_HALVINGS):
        worse = _smooth(gap, turning, limits_mm, pose + length[:, None] * move, sharpness) > before
        if not worse.any():
            break
        length[worse] *= 0.25
    worse = _smooth(gap, turning, limits_mm, pose + length[:, None] * move, sharpness) > before
    return np.asarray(pose + np.where(worse, 0.0, length)[:, None] * move)
