"""A thinned scan: enough points to find things, cheap to pass over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, FloatArray, IntArray, Scan


@dataclass(frozen=True, eq=False)
class Thinned:
    """A subset of a scan's points.

    ``points`` (m, 3) float64, mm; for an organised scan ``pixels`` (m, 2) int64 holds row and column.
    ``stride`` is the step between pixels that were taken (1 for clouds); ``share`` is m over all points.
    """

    points: Array
    pixels: IntArray | None
    stride: int
    share: float


def thinned(scan: Scan, wanted: int, rng: np.random.Generator) -> Thinned:
    """Take about ``wanted`` finite points of a scan: a coarser pixel grid, or random points of a cloud."""
    points = scan.points
    if points.ndim == 3:
        stride = max(1, int(np.sqrt(points.shape[0] * points.shape[1] / wanted)))
        coarse = points[::stride, ::stride]
        rows, columns = np.nonzero(np.isfinite(coarse[..., 2]))
        pixels = np.column_stack([rows, columns]) * stride
        return Thinned(coarse[rows, columns].astype(np.float64), pixels, stride, 1.0 / stride**2)
    if len(points) <= wanted:
        return Thinned(_finite(points), None, 1, 1.0)
    chosen = rng.integers(0, len(points), wanted)
    return Thinned(_finite(points[chosen]), None, 1, wanted / len(points))


def point_pitch_mm(sample: Thinned, on_plane: Array) -> float:
    """Mean distance, mm, between neighbouring points of the full scan on a surface.

    ``on_plane`` (k, 2) are the thinned points that lie on it, in its own coordinates.
    """
    if len(on_plane) < 50:
        return 1.0
    cell = 12.0
    filled = np.percentile(counts_in_cells(on_plane, cell), 75)
    return float(cell * np.sqrt(sample.share / max(filled, 1.0)))


def counts_in_cells(xy: Array, cell_mm: float) -> IntArray:
    """How many points (n, 2) mm each square cell holds, of the cells that hold any."""
    cells = np.floor((xy - xy.min(axis=0)) / cell_mm).astype(np.int64)
    return np.unique(cells[:, 0] * (int(cells[:, 1].max()) + 1) + cells[:, 1], return_counts=True)[1]


def _finite(points: FloatArray) -> Array:
    kept = points[np.isfinite(points).all(axis=1)]
    return kept.astype(np.float64)
