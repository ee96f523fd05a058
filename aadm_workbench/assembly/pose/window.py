"""How far a rigid pose can move from where it is before some pair exceeds its limit.

The set of permitted poses is convex in the half-turn coordinates of :mod:`.minimax`, up to the factor cos(θ/2).
Its ends in x, y and turn are found by the barrier method, started inside; the factor and the coordinates are
brought up to date at each solution, so that the ends are those of the true set.
"""

from __future__ import annotations

import math

import numpy as np

from aadm_workbench.assembly.pose.minimax import half_turn_pose, half_turn_vectors
from aadm_workbench.model import Array, PoseWindow

_UPDATES = 2  # a small turn is nearly linear: the second ends in the first's digits
_REDUCTIONS = 8  # pulls of 1 to 10⁷: an end is then known to a millionth of the window
_NEWTON_STEPS = 12  # a cap: each pull begins where the last one ended


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
    stretch = float(np.sqrt((q**2).sum(axis=1).mean())) / float(np.median(limits_mm))
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
