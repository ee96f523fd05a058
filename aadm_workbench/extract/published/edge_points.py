"""Edge points of a flat piece of a cloud: points whose neighbours leave a wide angle empty.

Clusters of a cloud: DBSCAN of Open3D.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from aadm_workbench.model import Array, BoolArray, IntArray

REACH_OF_PITCH = 2.5  # two rings of neighbours but for the corners: single lost pixels are no gap
NEIGHBOURS = 20  # within that reach a square grid has as many
GAP_RAD = np.radians(125.0)  # a straight edge leaves 180°, a lost neighbour 90°
_CELL_OF_PITCH = 4.0  # 16 points a cell: so many hold enough to tell a full one
_ABSENT = 99.0  # a direction that sorts behind all others
_FULL_CELL = 0.6  # of the points that most cells hold; across an edge lies a cell with less


def edge_points(xy: Array, pitch_mm: float) -> IntArray:
    """Indices of the edge points among points (n, 2) mm of a plane, whose neighbours are ``pitch_mm`` apart.

    Of a point's neighbours within ``REACH_OF_PITCH`` pitches the directions are taken; where they leave a gap wider
    than ``GAP_RAD``, the surface ends there. A point without neighbours is no edge. Points of a coarse grid's cells
    that are full, like all cells around them, are passed over unasked.
    """
    if len(xy) == 0:
        return np.empty(0, np.int64)
    around, asked = _near_open_cells(xy, _CELL_OF_PITCH * pitch_mm)
    near = np.flatnonzero(around)
    candidates = np.flatnonzero(asked)
    if len(candidates) == 0:
        return np.empty(0, np.int64)
    reach_mm = REACH_OF_PITCH * pitch_mm
    tree = cKDTree(xy[near])
    distance, neighbour = tree.query(xy[candidates], k=NEIGHBOURS, distance_upper_bound=reach_mm)
    present = np.isfinite(distance) & (distance > 0)
    offset = xy[near][np.where(present, neighbour, 0)] - xy[candidates][:, None]
    direction = np.where(present, np.arctan2(offset[..., 1], offset[..., 0]), _ABSENT)
    gap = _widest_gap(np.sort(direction, axis=1), present.sum(axis=1))
    return np.asarray(candidates[gap > GAP_RAD], np.int64)


def _widest_gap(directions: Array, counts: IntArray) -> Array:
    """Widest angle (n,) between neighbours of (n, k) sorted directions, of which the first ``counts`` are present."""
    step = np.diff(directions, axis=1)
    step[np.arange(step.shape[1]) >= counts[:, None] - 1] = 0.0
    last = directions[np.arange(len(directions)), np.maximum(counts - 1, 0)]
    around = directions[:, 0] + 2.0 * np.pi - last
    return np.where(counts >= 2, np.maximum(step.max(axis=1), around), 0.0)


def _near_open_cells(xy: Array, cell_mm: float) -> tuple[BoolArray, BoolArray]:
    """Which points lie within two cells of one that is not full, and which within one cell."""
    place = np.floor((xy - xy.min(axis=0)) / cell_mm).astype(np.int64) + 2
    columns, rows = place.max(axis=0) + 3
    flat = place[:, 1] * columns + place[:, 0]
    counts = np.bincount(flat, minlength=rows * columns).reshape(rows, columns)
    open_cells = counts < _FULL_CELL * np.median(counts[counts > 0])
    once = _grown(open_cells)
    return _grown(once).ravel()[flat], once.ravel()[flat]


def _grown(cells: BoolArray) -> BoolArray:
    """Cells (rows, columns) and their eight neighbours."""
    padded = np.pad(cells, 1)
    rows, columns = cells.shape
    shifted = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    return np.asarray(np.any(shifted, axis=0))


def dbscan(open3d: Any, points: Array, neighbour_mm: float, core_points: int, at_least: float) -> list[IntArray]:
    """Indices of the points (n, 3) mm of each cluster that has ``at_least`` so many of them, in DBSCAN's order."""
    if len(points) < core_points:
        return []
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    label = np.asarray(cloud.cluster_dbscan(neighbour_mm, core_points), np.int64)
    order = np.argsort(label, kind="stable")
    counts = np.bincount(label + 1)  # the first count is that of noise, label -1
    members = np.split(order, np.cumsum(counts)[:-1])[1:]
    return [member.astype(np.int64) for member in members if len(member) >= at_least]
