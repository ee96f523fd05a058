"""Circles through points of a plane, and the plane across an axis."""

from __future__ import annotations

import math

import numpy as np

from aadm_workbench.model import Array


def plane_across(axis: Array) -> Array:
    """Two unit vectors (2, 3) at right angles to an axis (3,) and to each other."""
    _, _, rows = np.linalg.svd(axis[np.newaxis, :])
    found: Array = rows[1:]
    return found


def flat_circle(flat: Array) -> tuple[Array, float]:
    """Centre (2,) and radius of the least-squares circle through points (n, 2), n at least 3.

    The algebraic fit |p|² = 2 c·p + k: exact where the points lie on a circle, as those of a drawn one do.
    """
    middle = flat.mean(axis=0)
    local = flat - middle
    matrix = np.column_stack([2.0 * local, np.ones(len(local))])
    (x, y, constant), *_ = np.linalg.lstsq(matrix, (local**2).sum(axis=1), rcond=None)
    return middle + np.array([x, y]), math.sqrt(max(float(constant + x * x + y * y), 0.0))


def widest_gap(spokes: Array) -> float:
    """Widest angle, radians, between neighbours among directions (n, 2)."""
    around = np.sort(np.arctan2(spokes[:, 1], spokes[:, 0]))
    return float(np.diff(np.append(around, around[0] + 2.0 * math.pi)).max())
