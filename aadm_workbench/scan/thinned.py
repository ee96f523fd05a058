"""Fewer points of a cloud, for the eye."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, FloatArray


def thinned(points: FloatArray, most: int) -> tuple[Array, int]:
    """Every n-th measured point, at most ``most`` (m, 3) float64, and how many points were measured."""
    flat = points.reshape(-1, 3)
    measured = flat[np.isfinite(flat).all(axis=1)]
    step = max(1, -(-len(measured) // max(most, 1)))
    return measured[::step].astype(np.float64), len(measured)
