"""Round holes in a plane, found on a coarse raster of the points that lie on it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array

_EMPTY_DISC = 0.75  # of the radius: this part of a hole holds no face points
_RING = (1.15, 1.6)  # of the radius: this part around a hole holds face points
# cells of an empty disc that strays and a tape fill (a choice: ±30 % moves nothing on sound scans)
_DISC_FILL_MAX = 0.45
_RING_FILL_MIN = 0.55  # a mouth at an edge of the face has half a ring (a choice: ±30 % moves nothing on sound scans)
_MOST_FOUND = 400  # no foot has so many: they are noise, and what is further sought in it takes minutes
_EXTENT_FROM = 20_000  # points


@dataclass(frozen=True, eq=False)
class Raster:
    """Which cells of a plane hold points: ``filled`` (rows, columns) float32, 0 or 1.

    Cell (i, j) covers x from ``origin[0] + j * cell_mm`` and y from ``origin[1] + i * cell_mm``.
    """

    filled: npt.NDArray[np.float32]
    origin: Array
    cell_mm: float

    def centre_of(self, rows: npt.NDArray[np.int64], columns: npt.NDArray[np.int64]) -> Array:
        """Middle (k, 2) mm of some cells."""
        return np.asarray(self.origin + (np.column_stack([columns, rows]) + 0.5) * self.cell_mm)


def rastered(xy: Array, cell_mm: float, margin_mm: float, cells_max: int = 4_000_000) -> Raster:
    """Raster of the cells that hold any of the points (n, 2) mm, with an empty margin around them."""
    some = xy[:: len(xy) // _EXTENT_FROM + 1]
    low, high = np.percentile(some, (0.1, 99.9), axis=0)
    low, high = low - margin_mm, high + margin_mm
    cell_mm = max(cell_mm, float(np.sqrt(np.prod(high - low) / cells_max)))
    columns, rows = (np.ceil((high - low) / cell_mm)).astype(int) + 1
    x, y = (np.floor((xy[:, axis] - low[axis]) / cell_mm).astype(np.int32) for axis in (0, 1))
    inside = (x >= 0) & (x < columns) & (y >= 0) & (y < rows)
    filled = np.zeros((rows, columns), np.float32)
    filled[y[inside], x[inside]] = 1.0
    return Raster(filled, low, cell_mm)


def find_discs(raster: Raster, radius_mm: float, *, holes: bool) -> tuple[Array, Array]:
    """Places where a disc of empty cells lies in filled ones (``holes``), or the reverse.

    Returns centres (k, 2) mm, to about half a cell, and scores (k,) in 0..1, best first.
    """
    filled = raster.filled if holes else 1.0 - raster.filled
    border = 0.0 if holes else 1.0
    disc = _fill(filled, raster.cell_mm, 0.0, _EMPTY_DISC * radius_mm, border)
    ring = _fill(filled, raster.cell_mm, _RING[0] * radius_mm, _RING[1] * radius_mm, border)
    score = ring - disc
    score[(disc > _DISC_FILL_MAX) | (ring < _RING_FILL_MIN)] = 0.0
    reach = 2 * int(np.ceil(0.9 * radius_mm / raster.cell_mm)) + 1
    highest = cv2.dilate(score, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach)))
    rows, columns = np.nonzero((score >= highest) & (score > 0.2))
    return _merged(raster, score, rows, columns, radius_mm)


def _fill(
    filled: npt.NDArray[np.float32], cell_mm: float, inner_mm: float, outer_mm: float, border: float
) -> npt.NDArray[np.float32]:
    half = int(np.ceil(outer_mm / cell_mm))
    offsets = np.arange(-half, half + 1) * cell_mm
    distance = np.hypot(offsets[:, None], offsets[None, :])
    kernel = ((distance <= outer_mm) & (distance >= inner_mm)).astype(np.float32)
    kernel /= kernel.sum()
    padded = cv2.copyMakeBorder(filled, half, half, half, half, cv2.BORDER_CONSTANT, value=border)
    answer = cv2.filter2D(padded, cv2.CV_32F, kernel)[half:-half, half:-half]
    return np.ascontiguousarray(answer)


def _merged(
    raster: Raster,
    score: npt.NDArray[np.float32],
    rows: npt.NDArray[np.int64],
    columns: npt.NDArray[np.int64],
    radius_mm: float,
) -> tuple[Array, Array]:
    """One centre for each plateau of equally good cells: their mean, weighted by score."""
    order = np.argsort(-score[rows, columns], kind="stable")
    centres = raster.centre_of(rows[order], columns[order])
    scores = score[rows, columns][order].astype(np.float64)
    found: list[Array] = []
    kept: list[float] = []
    free = np.ones(len(centres), bool)
    while free.any() and len(found) < _MOST_FOUND:
        best = int(free.argmax())
        alike = (np.hypot(*(centres - centres[best]).T) < 0.8 * radius_mm) & (scores > scores[best] - 0.03)
        found.append(np.average(centres[alike], axis=0, weights=scores[alike]))
        kept.append(float(scores[best]))
        free[best] = False
        free &= np.hypot(*(centres - found[-1]).T) >= 1.2 * radius_mm
    return np.array(found).reshape(-1, 2), np.array(kept)
