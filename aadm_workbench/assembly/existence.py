"""How likely it is that a pose exists at all in which every rebar enters its sleeve, given the uncertainties.

Not the product over the pairs: at one fixed pose a pair may fail that another pose would save, and all pairs move
together. The true centres are drawn from their covariances; for each draw it is decided whether a pose meets all
limits, distances and clearances over the ribs alike, which is a convex question (:mod:`.discs`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.constraints import pose_constraints
from aadm_workbench.assembly.discs import smallest_common_disc
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.model import Array

SAMPLES = 2000


def probability_of_a_pose(
    pairs: Sequence[Pair],
    limits_mm: Array,
    yaw: float,
    shift: Array,
    generator: np.random.Generator,
    samples: int = SAMPLES,
) -> float | None:
    """Probability that some pose meets all limits; None where a covariance is missing.

    Parameters
    ----------
    limits_mm
        (n,) float64, of the distance of each pair.
    yaw, shift
        Radians and (2,) mm: the pose to start from, the minimax pose of the measured centres.
    generator
        Source of the draws; the same generator in the same state gives the same result.
    """
    covariances = [pair.covariance for pair in pairs if pair.covariance is not None]
    if len(covariances) < len(pairs):
        return None
    found = pose_constraints(pairs, limits_mm, yaw, shift)
    if (found.limits_mm <= 0.0).any():
        return 0.0
    noise = np.einsum(
        "nij,knj->kni", _roots(np.array(covariances)), generator.standard_normal((samples, len(pairs), 2))
    )
    p = found.vectors[None] + noise[:, found.owner]
    q = np.broadcast_to(found.turning, p.shape)
    solution = smallest_common_disc(p, q, 1.0 / found.limits_mm**2, decide_at=1.0)
    return float((solution.ratio_squared <= 1.0).mean())


def pose_exists(pairs: Sequence[Pair], limits_mm: Array, yaw: float, shift: Array) -> bool:
    """Whether some pose near the given one meets all limits and clearances at the measured centres."""
    found = pose_constraints(pairs, limits_mm, yaw, shift)
    if (found.limits_mm <= 0.0).any():
        return False
    weights = 1.0 / found.limits_mm**2
    solution = smallest_common_disc(found.vectors[None], found.turning[None], weights, decide_at=1.0)
    return bool(solution.ratio_squared[0] <= 1.0)


def _roots(covariances: Array) -> Array:
    """Matrices (n, 2, 2) whose product with standard normal numbers has these covariances, also singular ones."""
    values, axes = np.linalg.eigh(covariances)
    return np.asarray(axes * np.sqrt(np.maximum(values, 0.0))[:, None, :])
