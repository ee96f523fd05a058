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

_REGULAR_RATIO = 0.005
"""Sides and spokes of a circle that was drawn with a handful of sides are equal but for rounded coordinates."""

_WIDEST_GAP = math.radians(60.0)  # of a circle of six corners; where fewer may draw one, theirs decides


@dataclass(frozen=True, eq=False)
class Circle:
    """A circle in space: ``centre`` (3,) mm, ``normal`` (3,) unit, of either sign."""

    centre: Array
    normal: Array
    radius_mm: float

    def moved(self, T: Array) -> Circle:
        """The circle after a motion (4, 4); where its plane is stretched to an oval, the circle of the same area."""
        A = T[:3, :3]
        normal: Array = np.linalg.solve(A.T, self.normal).astype(np.float64)
        length = float(np.linalg.norm(normal))
        factor = math.sqrt(abs(float(np.linalg.det(A))) * length)
        return Circle(A @ self.centre + T[:3, 3], normal / length, self.radius_mm * factor)


def circle_through(loop: Array, fewest: int = FEWEST_VERTICES) -> Circle | None:
    """The least-squares circle through a closed loop's vertices; None where the loop is no circle.

    Parameters
    ----------
    loop
        (n, 3) float64, mm, the vertices in order.
    fewest
        Loops of fewer vertices are none. Some exporters draw circles with four sides; of so few vertices only a
        regular polygon is taken for a circle.
    """
    if len(loop) < fewest:
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
    if max(off_mm.max(), above_mm.max()) > _ROUNDNESS_RATIO * radius_mm or _has_gap(spokes, fewest):
        return None
    if len(loop) < FEWEST_VERTICES and not _is_regular(spokes):
        return None
    return Circle(middle + x * axes[0] + y * axes[1], axes[2], radius_mm)


def _is_regular(spokes: Array) -> bool:
    radii = np.linalg.norm(spokes, axis=1)
    around = np.sort(np.arctan2(spokes[:, 1], spokes[:, 0]))
    gaps = np.diff(np.append(around, around[0] + 2.0 * math.pi))
    return bool(np.ptp(radii) < _REGULAR_RATIO * radii.mean() and np.ptp(gaps) < _REGULAR_RATIO * gaps.mean())


def _has_gap(spokes: Array, fewest: int) -> bool:
    around = np.sort(np.arctan2(spokes[:, 1], spokes[:, 0]))
    gaps = np.diff(np.append(around, around[0] + 2.0 * math.pi))
    return bool(gaps.max() > max(_WIDEST_GAP, 1.05 * 2.0 * math.pi / fewest))
