"""Clouds for the eye: thinned, and coloured by how far each point lies from the design."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, FloatArray, Kind


def thinned(points: FloatArray, most: int) -> tuple[Array, int]:
    """Every n-th measured point, at most ``most`` (m, 3) float64, and how many points were measured."""
    flat = points.reshape(-1, 3)
    measured = flat[np.isfinite(flat).all(axis=1)]
    step = max(1, -(-len(measured) // max(most, 1)))
    return measured[::step].astype(np.float64), len(measured)


def distance_from_design(points: Array, design: ColumnDesign, kind: Kind) -> Array:
    """Distance (n,) mm of points (n, 3), column frame, from what the design has there.

    Sleeves: signed height over the foot face, positive into the column. Bars: signed distance from the core of the
    nearest bar, side or top, positive outside.
    """
    if kind is Kind.SLEEVE or not design.rebars:
        heights: Array = points[:, 2]
        return heights
    return _from_bars(points, design.rebars)


def _from_bars(points: Array, bars: Sequence[AssemblyPoint]) -> Array:
    centres = np.array([bar.centre for bar in bars])
    radii_mm = np.array([bar.diameter_mm for bar in bars]) / 2.0
    from scipy.spatial import cKDTree

    radial_mm, nearest = cKDTree(centres[:, :2]).query(points[:, :2])
    outside_mm = radial_mm - radii_mm[nearest]
    above_mm = points[:, 2] - centres[nearest, 2]
    over_the_rim = (outside_mm > 0) & (above_mm > 0)
    distances: Array = np.where(over_the_rim, np.hypot(outside_mm, above_mm), np.maximum(outside_mm, above_mm))
    return distances
