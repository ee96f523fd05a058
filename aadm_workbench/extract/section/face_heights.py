"""How flat a face is: median heights in cells over its plane, in the column frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.sample import Thinned
from aadm_workbench.model import Array, Plane
from aadm_workbench.model.scatter import OF_MEDIAN, TO_SIGMA

_CELLS = 12  # along the longer side: cells of 50 mm on a foot of 600 mm, as under a straightedge
_FEWEST = 12  # points of a cell: its median is then known to a third of the camera's noise
_OUTER_SHARE = 0.02  # of cells left out at both ends: a splash of grout is no unevenness of the face
_EDGE_MM = 4.0  # from the section's edges and mouths: there cameras bend surfaces
_BAND_MM = 8.0  # twice what a face may be uneven by; what is farther off is no face
_WARP_U_MM = 0.06  # of the camera, between far parts of its picture: half of what makers state at a metre


@dataclass(frozen=True, eq=False)
class FaceHeights:
    """``heights_mm`` (rows from −y, columns from −x) over the plane, outwards, NaN where nothing was seen.

    ``range_mm`` is between the highest and the lowest of them, without the outermost, ``u_mm`` its uncertainty.
    """

    cell_mm: float
    origin_mm: Array
    heights_mm: Array
    range_mm: float
    u_mm: float


def face_heights(
    sample: Thinned, face: Plane, T_column_scan: Array, low: Array, high: Array, mouths: Array, radius_mm: float
) -> FaceHeights | None:
    """Heights of the face between two corners (2,) mm of the column frame, but for mouths (k, 2); None: too few."""
    height = face.height(sample.points)
    near = np.abs(height) < _BAND_MM
    points, height = sample.points[near].astype(np.float64), np.asarray(height[near], np.float64)
    xy = (points @ T_column_scan[:3, :3].T + T_column_scan[:3, 3])[:, :2]
    kept = ((xy > low + _EDGE_MM) & (xy < high - _EDGE_MM)).all(axis=1)
    for mouth in mouths:
        kept &= np.hypot(*(xy - mouth).T) > radius_mm + _EDGE_MM
    xy, height = xy[kept], height[kept]
    cell_mm = float((high - low).max()) / _CELLS
    columns, rows = np.ceil((high - low) / cell_mm).astype(int)
    at = np.floor((xy - low) / cell_mm).astype(int)
    number = at[:, 1] * columns + at[:, 0]
    order = np.argsort(number, kind="stable")
    bounds = np.searchsorted(number[order], np.arange(rows * columns + 1))
    grid, scatter = np.full(rows * columns, np.nan), []
    for cell in range(rows * columns):
        own = height[order[bounds[cell] : bounds[cell + 1]]]
        if len(own) >= _FEWEST:
            grid[cell] = np.median(own)
            scatter.append(TO_SIGMA * float(np.median(np.abs(own - grid[cell]))) * OF_MEDIAN / np.sqrt(len(own)))
    seen = np.isfinite(grid)
    if seen.sum() < rows * columns / 2:
        return None
    grid -= _leaning(grid.reshape(rows, columns)).ravel()
    ends = np.quantile(grid[seen], [_OUTER_SHARE, 1.0 - _OUTER_SHARE])
    u_mm = float(np.sqrt(2.0 * (np.median(scatter) ** 2 + _WARP_U_MM**2)))
    return FaceHeights(cell_mm, low, grid.reshape(rows, columns), float(ends[1] - ends[0]), u_mm)


def _leaning(grid: Array) -> Array:
    """The plane through a grid by least squares: flatness is against the face's own plane."""
    rows, columns = np.mgrid[: grid.shape[0], : grid.shape[1]]
    terms = np.column_stack([np.ones(grid.size), rows.ravel(), columns.ravel()])
    seen = np.isfinite(grid.ravel())
    found = np.linalg.lstsq(terms[seen], grid.ravel()[seen], rcond=None)[0]
    return np.asarray((terms @ found).reshape(grid.shape))
