"""Nearest design point of any place in the plane, looked up in a raster: fast enough to try thousands of poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, IntArray

_CELL_MM = 4.0  # half the step in which placements are told apart (placements.py)
_CELLS_PER_SIDE = 128  # 16,000 cells: bounds the memory


@dataclass(frozen=True, eq=False)
class NearestRaster:
    """A raster of the plane: in each cell the nearest design point and its distance, cut off at the gate.

    Parameters
    ----------
    origin
        (2,) mm, corner of the raster.
    nearest
        (rows, columns) int64, index of the nearest design point.
    distance_mm
        (rows, columns) float64, from the middle of the cell, at most ``gate_mm``.
    """

    origin: Array
    cell_mm: float
    gate_mm: float
    nearest: IntArray
    distance_mm: Array

    @classmethod
    def of(cls, design: Array, gate_mm: float) -> NearestRaster:
        """Raster of design points (m, 2) mm and everything within ``gate_mm`` of their bounding box."""
        low, high = design.min(axis=0) - gate_mm, design.max(axis=0) + gate_mm
        cell_mm = max(_CELL_MM, float((high - low).max()) / _CELLS_PER_SIDE)
        # One more cell all round is at the gate's distance: what falls outside is clipped into it.
        origin = low - cell_mm
        columns, rows = (int(np.ceil(extent / cell_mm)) + 2 for extent in high - low)
        x = origin[0] + (np.arange(columns) + 0.5) * cell_mm
        y = origin[1] + (np.arange(rows) + 0.5) * cell_mm
        squared = (x[None, :, None] - design[:, 0]) ** 2 + (y[:, None, None] - design[:, 1]) ** 2
        nearest = squared.argmin(axis=2)
        distance = np.minimum(np.sqrt(squared.min(axis=2)), gate_mm)
        return cls(origin, cell_mm, gate_mm, nearest, distance)

    def look_up(self, points: Array) -> tuple[IntArray, Array]:
        """Nearest design point and distance (both of shape (...)), for points (..., 2) mm."""
        cells = np.floor((points - self.origin) / self.cell_mm).astype(np.int64)
        column = np.clip(cells[..., 0], 0, self.nearest.shape[1] - 1)
        row = np.clip(cells[..., 1], 0, self.nearest.shape[0] - 1)
        return self.nearest[row, column], self.distance_mm[row, column]
