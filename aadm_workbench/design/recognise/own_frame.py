"""The directions that a body runs in: those of its placement where its edges agree, else those of its edges."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.design.elements import Solid
from aadm_workbench.model import Array

_PARALLEL_COS = float(np.cos(np.radians(0.1)))  # 0.1 degrees: directions of edges, up to rounding
_UP = np.array([0.0, 0.0, 1.0])
_SQUARE_SINE = 0.01  # 0.6 degrees: what is square to the axis, up to a slope that is drawn by hand


def own_frame(T_model_element: Array, solids: Sequence[Solid]) -> Array:
    """The frame (4, 4) that a body was drawn in.

    Imported bodies often stand turned under a placement that is not: then z is the direction of their long edges that
    is nearest to upright, and x that of the edges across, within 45 degrees of the placement's x.
    """
    edges = _straight(solids)
    length_mm = np.linalg.norm(edges, axis=1)
    total_mm = float(length_mm.sum())
    if total_mm <= 0.0:
        return T_model_element
    directions = edges / length_mm[:, np.newaxis]
    z = _strongest(directions, length_mm * (0.5 + np.abs(directions @ _UP)))
    across = np.abs(directions @ z) < _SQUARE_SINE
    x = _strongest(directions[across], length_mm[across]) if across.any() else T_model_element[:3, 0]
    if all(np.abs(T_model_element[:3, :3].T @ side).max() > _PARALLEL_COS for side in (z, x)):
        return T_model_element
    return _frame(T_model_element, z if float(z @ _UP) >= 0.0 else -z, x)


def _straight(solids: Sequence[Solid]) -> Array:
    """(n, 3) mm, the straight edges of bodies as vectors; none without length."""
    vectors = np.array([line[1] - line[0] for solid in solids for line in solid.edges if len(line) == 2])
    vectors = vectors.reshape(-1, 3)
    kept: Array = vectors[np.linalg.norm(vectors, axis=1) > 0.0]
    return kept


def _strongest(directions: Array, weight: Array) -> Array:
    """The direction that the greatest weight of edges has, of either sign."""
    longest = np.argsort(-weight, kind="stable")[:50]
    shares = [float(weight[np.abs(directions @ directions[k]) > _PARALLEL_COS].sum()) for k in longest]
    found: Array = directions[longest[int(np.argmax(shares))]]
    return found


def _frame(T_model_element: Array, z: Array, x: Array) -> Array:
    """A right-handed frame with z and about x, turned by quarters to be near the placement's x."""
    x = x - float(x @ z) * z
    x = x / np.linalg.norm(x)
    quarters = [x, np.cross(z, x), -x, -np.cross(z, x)]
    x = max(quarters, key=lambda side: float(side @ T_model_element[:3, 0]))
    T = T_model_element.copy()
    T[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    return T
