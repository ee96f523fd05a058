"""How flat a face is: median heights in cells over its plane, in the column frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.sample import Thinned
from aadm_workbench.model import Array, IntArray, Plane
from aadm_workbench.model.scatter import OF_MEDIAN, TO_SIGMA

_CELLS = 12  # along the longer side: cells of 50 mm on a foot of 600 mm, as under a straightedge
_FEWEST = 12  # points of a cell: its median is then known to a third of the camera's noise
_OUTER_SHARE = 0.02  # of cells left out at both ends: a splash of grout is no unevenness of the face
_STRAY = 3.0  # of the scatter about a surface: what is farther off is a splash or a pit
_EDGE_MM = 4.0  # from the section's edges and mouths: there cameras bend surfaces
_BAND_MM = 8.0  # twice what a face may be uneven by; what is farther off is no face
_WARP_U_MM = 0.06  # of the camera, between far parts of its picture: half of what makers state at a metre


@dataclass(frozen=True, eq=False)
class FaceHeights:
    """``heights_mm`` (rows from −y, columns from −x) over the plane, outwards, NaN where nothing was seen.

    ``range_mm`` is between the highest and the lowest of them, without the outermost, or, where that is more, of the
    bow and the twist that all of them together have, out to the corners; ``u_mm`` its uncertainty.
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
    over = face.height(sample.points)
    near = np.abs(over) < _BAND_MM
    points = sample.points[near].astype(np.float64)
    height = np.asarray(over[near], np.float64)
    xy = (points @ T_column_scan[:3, :3].T + T_column_scan[:3, 3])[:, :2]
    kept = ((xy > low + _EDGE_MM) & (xy < high - _EDGE_MM)).all(axis=1)
    for mouth in mouths:
        apart = xy - mouth
        kept &= np.einsum("nk,nk->n", apart, apart) > (radius_mm + _EDGE_MM) ** 2
    xy, height = xy[kept], height[kept]
    cell_mm = float((high - low).max()) / _CELLS
    columns, rows = np.ceil((high - low) / cell_mm).astype(int)
    at = np.floor((xy - low) / cell_mm).astype(int)
    grid, count = _medians(at[:, 1] * columns + at[:, 0], height, rows * columns)
    seen = np.isfinite(grid)
    if seen.sum() < rows * columns / 2:
        return None
    noise_mm = TO_SIGMA * float(np.nanmedian(np.abs(height - grid[at[:, 1] * columns + at[:, 0]])))
    cell_u_mm = OF_MEDIAN * noise_mm / float(np.sqrt(np.median(count[seen])))
    grid -= _leaning(grid.reshape(rows, columns)).ravel()
    ends = np.quantile(grid[seen], [_OUTER_SHARE, 1.0 - _OUTER_SHARE])
    range_mm = max(float(ends[1] - ends[0]), _bent_mm(grid.reshape(rows, columns), (high - low) / cell_mm))
    u_mm = float(np.sqrt(2.0 * (cell_u_mm**2 + _WARP_U_MM**2)))
    return FaceHeights(cell_mm, low, grid.reshape(rows, columns), range_mm, u_mm)


def _medians(cell: IntArray, height: Array, cells: int) -> tuple[Array, IntArray]:
    """Median height (cells,) of the points of each cell, NaN where they are too few, and how many they are."""
    # One key for both, cell after cell: heights lie within the band.
    order = np.argsort(cell * (3.0 * _BAND_MM) + height)
    count = np.bincount(cell, minlength=cells)
    begin = np.cumsum(count) - count
    enough = count >= _FEWEST
    lower, upper = (begin + (count - 1) // 2)[enough], (begin + count // 2)[enough]
    grid = np.full(cells, np.nan)
    grid[enough] = (height[order[lower]] + height[order[upper]]) / 2.0
    return grid, count


def _leaning(grid: Array) -> Array:
    """The plane through a grid by least squares: flatness is against the face's own plane."""
    rows, columns = np.mgrid[: grid.shape[0], : grid.shape[1]]
    terms = np.column_stack([np.ones(grid.size), rows.ravel(), columns.ravel()])
    seen = np.isfinite(grid.ravel())
    found = np.linalg.lstsq(terms[seen], grid.ravel()[seen], rcond=None)[0]
    return np.asarray((terms @ found).reshape(grid.shape))


def _bent_mm(grid: Array, sides: Array) -> float:
    """Range, mm, over a whole face of ``sides`` (2,) cells of the surface of second order that its cells lie on.

    Cells end before the corners, where a face that is bowed or twisted is farthest off.
    """
    rows, columns = np.mgrid[: grid.shape[0], : grid.shape[1]] + 0.5
    seen = np.isfinite(grid)
    terms, heights = _second_order(columns[seen], rows[seen]), grid[seen]
    kept = np.ones(len(heights), bool)
    for _ in range(2):
        found = np.linalg.lstsq(terms[kept], heights[kept], rcond=None)[0]
        off = np.abs(heights - terms @ found)
        kept = off < _STRAY * TO_SIGMA * np.median(off) + _WARP_U_MM
    x, y = np.meshgrid(np.linspace(0.0, sides[0], _CELLS + 1), np.linspace(0.0, sides[1], _CELLS + 1))
    return float(np.ptp(_second_order(x.ravel(), y.ravel()) @ found))


def _second_order(x: Array, y: Array) -> Array:
    return np.column_stack([np.ones_like(x), x, y, x * x, x * y, y * y])
