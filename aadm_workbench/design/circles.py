"""Circles through the vertices of a closed loop in space."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array

FEWEST_VERTICES = 8
"""Fewer make a nut or a beam's outline, not a drawn circle."""

_ROUNDNESS_RATIO = 0.02
"""Vertices of a drawn circle are off it by no more than this part of its radius (coordinates rounded to 0.1 mm)."""

_WIDEST_GAP = math.radians(60.0)


@dataclass(frozen=True, eq=False)
class Circle:
    """A circle in space: ``centre`` (3,) mm, ``normal`` (3,) unit, of either sign."""

    centre: Array
    normal: Array
    radius_mm: float

    def moved(self, T: Array) -> Circle:
        """The circle after a motion (4, 4), which may scale alike in all directions."""
        normal = T[:3, :3] @ self.normal
        length = float(np.linalg.norm(normal))
        return Circle(T[:3, :3] @ self.centre + T[:3, 3], normal / length, self.radius_mm * length)


def circle_through(loop: Array) -> Circle | None:
    """The least-squares circle through a closed loop's vertices; None where the loop is no circle.

    Parameters
    ----------
    loop
        (n, 3) float64, mm, the vertices in order.
    """
    if len(loop) < FEWEST_VERTICES:
        return None
    middle = loop.mean(axis=0)
    centred = loop - middle
    _, _, axes = np.linalg.svd(centred, full_matrices=False)
    flat = centred @ axes[:2].T
    # Algebraic fit |p|² = 2 c·p + k: exact where the vertices lie on the circle, as those of a drawn one do.
    design = np.column_stack([2.0 * flat, np.ones(len(flat))])
    (x, y, constant), *_ = np.linalg.lstsq(design, (flat**2).sum(axis=1), rcond=None)
    radius_mm = math.sqrt(max(constant + x * x + y * y, 0.0))
    spokes = flat - (x, y)
    off_mm = np.abs(np.linalg.norm(spokes, axis=1) - radius_mm)
    above_mm = np.abs(centred @ axes[2])
    if max(off_mm.max(), above_mm.max()) > _ROUNDNESS_RATIO * radius_mm or _has_gap(spokes):
        return None
    return Circle(middle + x * axes[0] + y * axes[1], axes[2], radius_mm)


def _has_gap(spokes: Array) -> bool:
    around = np.sort(np.arctan2(spokes[:, 1], spokes[:, 0]))
    gaps = np.diff(np.append(around, around[0] + 2.0 * math.pi))
    return bool(gaps.max() > _WIDEST_GAP)
