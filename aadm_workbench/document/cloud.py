"""Clouds for the eye: coloured by how far each point lies from the design."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign, Kind


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
    # A bar after the other: FreeCAD need not bring scipy, and a table of all distances takes too much memory.
    radial_mm, nearest = np.full(len(points), np.inf), np.zeros(len(points), dtype=np.int64)
    for number, centre in enumerate(centres):
        distance_mm = np.hypot(*(points[:, :2] - centre[:2]).T)
        nearer = distance_mm < radial_mm
        radial_mm[nearer], nearest[nearer] = distance_mm[nearer], number
    outside_mm = radial_mm - radii_mm[nearest]
    above_mm = points[:, 2] - centres[nearest, 2]
    over_the_rim = (outside_mm > 0) & (above_mm > 0)
    distances: Array = np.where(over_the_rim, np.hypot(outside_mm, above_mm), np.maximum(outside_mm, above_mm))
    return distances
