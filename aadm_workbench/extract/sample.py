"""A thinned scan: enough points to find things, cheap to pass over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray, Scan
from aadm_workbench.model.special import percentiles

_CELLS_MAX = 4_000_000  # 32 MB of counts
_LIKE_MM, _COMPANY, _ALONE = 10.0, 1, 4.0  # seen steeply, the side of a bar falls by so much between thinned pixels
# 36 points of a scan at 0.4 mm, thinned five times each way; more points than that tell no more
_CELL_MM, _ENOUGH = 12.0, 20_000


@dataclass(frozen=True, eq=False)
class Thinned:
    """A subset of a scan's points.

    ``points`` (m, 3) mm, in the precision of the scan; for an organised scan ``taken`` (rows, columns) tells which
    pixels of the coarser grid they are. ``stride`` is the step between pixels that were taken (1 for clouds);
    ``share`` is m over all points.
    """

    points: FloatArray
    taken: BoolArray | None
    stride: int
    share: float

    def pixels(self) -> IntArray:
        """Row and column (m, 2) of each point of an organised scan."""
        assert self.taken is not None
        return np.argwhere(self.taken) * self.stride


def in_company(sample: Thinned, height: FloatArray, chosen: BoolArray) -> BoolArray:
    """Which of the chosen points (m,) have others beside them at a like height (m,); the rest hang in the air alone."""
    at = np.flatnonzero(chosen)
    kept = np.zeros(len(height), bool)
    if sample.taken is None:
        kept[at] = _near_others(sample.points[at])
        return kept
    grid = np.full(np.add(sample.taken.shape, 2), np.nan, height.dtype)
    grid[1:-1, 1:-1][sample.taken] = height
    rows, columns = (part[at] + 1 for part in np.nonzero(sample.taken))
    beside = [(down, right) for down in (-1, 0, 1) for right in (-1, 0, 1) if down or right]
    like = sum(np.abs(grid[rows + down, columns + right] - height[at]) < _LIKE_MM for down, right in beside)
    kept[at] = np.asarray(like) >= _COMPANY
    return kept


def _near_others(points: FloatArray) -> BoolArray:
    from scipy.spatial import cKDTree

    if len(points) <= _COMPANY:
        return np.zeros(len(points), bool)
    distance = cKDTree(points).query(points, k=_COMPANY + 1)[0][:, -1]
    return np.asarray(distance < _ALONE * np.median(distance))


def thinned(scan: Scan, wanted: int, rng: np.random.Generator) -> Thinned:
    """Take about ``wanted`` finite points of a scan: a coarser pixel grid, or random points of a cloud."""
    points = scan.points
    if points.ndim == 3:
        stride = max(1, int(np.sqrt(points.shape[0] * points.shape[1] / wanted)))
        coarse = points[::stride, ::stride]
        taken = np.isfinite(coarse[..., 2])
        return Thinned(coarse[taken], taken, stride, 1.0 / stride**2)
    if len(points) <= wanted:
        return Thinned(_finite(points), None, 1, 1.0)
    chosen = rng.integers(0, len(points), wanted)
    return Thinned(_finite(points[chosen]), None, 1, wanted / len(points))


def point_pitch_mm(sample: Thinned, on_plane: FloatArray) -> float:
    """Mean distance, mm, between neighbouring points of the full scan on a surface.

    ``on_plane`` (k, 2) are the thinned points that lie on it, in its own coordinates.
    """
    if len(on_plane) < 50:  # nothing to count: what most cameras see at 1.5 m
        return 1.0
    every = len(on_plane) // _ENOUGH + 1
    filled = every * percentiles(counts_in_cells(on_plane[::every], _CELL_MM), 75)  # cells at edges are half empty
    return float(_CELL_MM * np.sqrt(sample.share / max(filled, 1.0)))


def counts_in_cells(xy: FloatArray, cell_mm: float) -> IntArray:
    """How many points (n, 2) mm each square cell holds, of the cells that hold any."""
    row, column = (((part - part.min()) / cell_mm).astype(np.int64) for part in (xy[:, 0], xy[:, 1]))
    rows, columns = int(row.max()) + 1, int(column.max()) + 1
    place = row * columns + column
    if rows * columns > _CELLS_MAX:
        return np.unique(place, return_counts=True)[1]
    counts = np.bincount(place)
    return counts[counts > 0]


def _finite(points: FloatArray) -> Array:
    kept = points[np.isfinite(points).all(axis=1)]
    return kept.astype(np.float64)
