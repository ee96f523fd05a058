"""How far the pose with the smallest largest distance may be off, given what is not known of the distances.

Few pairs decide such a pose, and where a little noise lets others decide it jumps: a formula for small errors about it
(that of least squares all the more) promises too much. So the pose is found again for draws of the errors
(:mod:`.smallest_common_disc`, all at once), and their distances from it are what it may be off by.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.pose.minimax import MinimaxPose, half_turn_vectors
from aadm_workbench.assembly.pose.smallest_common_disc import smallest_common_disc
from aadm_workbench.model import Array

_DRAWS = 60  # and the opposite of each: a standard deviation is then known to 8 %
_GAP = 1e-3  # share to which a squared distance has to be known: a twentieth of what the draws change it by
_LEAST_MM = 1e-6  # keeps quotients of exact points finite


def minimax_covariance(
    source: Array,
    target: Array,
    covariance: Array,
    pose: MinimaxPose,
    generator: np.random.Generator,
    limits_mm: Array | None = None,
) -> Array:
    """Covariance (3, 3) of (x, y, turn), mm and radians, about the pose.

    Parameters
    ----------
    source, target
        (n, 2) mm, as they were given to :func:`.minimax.fit_minimax`.
    covariance
        (2n, 2n) mm² of the targets less the sources, rows as x and y of one after the other.
    generator
        Source of the draws.
    limits_mm
        (n,), as they were given there; all alike where they are not named.
    """
    weights = np.ones(len(source)) if limits_mm is None else (float(np.min(limits_mm)) / limits_mm) ** 2
    centre = target.mean(axis=0)
    placed = source @ turn(pose.yaw).T + pose.shift - centre
    p, q = half_turn_vectors(placed, target - centre)
    values, vectors = np.linalg.eigh(covariance)
    drawn = generator.standard_normal((_DRAWS, len(values))) @ (np.sqrt(np.maximum(values, 0.0)) * vectors).T
    errors = np.concatenate([drawn, -drawn]).reshape(-1, len(source), 2)
    size_mm = max(float(np.hypot(*p.T).max()), _LEAST_MM)
    stretch = float(np.sqrt((q**2).sum(axis=1).mean()))
    turning = np.broadcast_to(q / stretch, errors.shape)
    found = smallest_common_disc((p - errors) / size_mm, turning, weights, start=pose.multipliers, gap=_GAP).z * (
        size_mm * np.array([1.0 / stretch, 1.0, 1.0])
    )
    # small turns, about the centre: the columns' own origin moves with them
    angle, about = 2.0 * found[:, 0], pose.shift - centre
    moved = found[:, 1:] + angle[:, None] * np.array([-about[1], about[0]])
    off = np.column_stack([moved, angle])
    return np.asarray(off.T @ off / len(off))
