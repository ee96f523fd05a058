"""Points of a plane as a binary image, and the pitch of points that decides its pixel size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array, Scan

_PIXELS_MAX = 40_000_000  # 40 MB: at 0.4 mm a pixel 2.5 m each way
_PITCH_CELL_POINTS_MIN = 4.0  # in a cell of half a radius: with fewer, an outline has no more than 25 points


@dataclass(frozen=True, eq=False)
class BinaryImage:
    """Which pixels hold a point: ``filled`` (rows, columns) uint8, 255 or 0.

    Pixel (row i, column j) is the square of side ``pixel_mm`` whose middle is ``origin + pixel_mm * (j, i)``.
    """

    filled: npt.NDArray[np.uint8]
    origin: Array
    pixel_mm: float

    def millimetres(self, pixels: Array) -> Array:
        """Plane coordinates (n, 2) mm of image positions (n, 2) as (column, row)."""
        return np.asarray(self.origin + self.pixel_mm * pixels)


def binary_image(xy: Array, pixel_mm: float, margin_mm: float) -> BinaryImage:
    """Scale points (n, 2) mm linearly into an image of their bounding range, black, and mark each as white.

    The margin around the range lets circles lie at its edge. An image that would be too large gets larger pixels.
    """
    low, high = xy.min(axis=0) - margin_mm, xy.max(axis=0) + margin_mm
    pixel_mm = max(pixel_mm, float(np.sqrt(np.prod(high - low) / _PIXELS_MAX)))
    place = np.rint((xy - low) / pixel_mm).astype(np.intp)
    columns, rows = np.ceil((high - low) / pixel_mm).astype(int) + 1
    filled = np.zeros((rows, columns), np.uint8)
    filled[place[:, 1], place[:, 0]] = 255
    return BinaryImage(filled, low, pixel_mm)


def pitch_mm(scan: Scan, z_range_mm: tuple[float, float] | None, radius_mm: float) -> float | None:
    """Typical distance, mm, between neighbouring points of a scan, seen along z, whose z lies in a range.

    Organised: median distance of neighbours in a row. Cloud: from the number of points in cells that are full;
    None where there are too few points to tell.
    """
    points = scan.points
    low, high = (-np.inf, np.inf) if z_range_mm is None else z_range_mm
    if points.ndim == 3:
        inside = (points[..., 2] >= low) & (points[..., 2] <= high)
        pairs = inside[:, 1:] & inside[:, :-1]
        if not pairs.any():
            return None
        step = (points[:, 1:] - points[:, :-1])[pairs]
        return float(np.median(np.hypot(step[:, 0], step[:, 1])))
    inside = (points[:, 2] >= low) & (points[:, 2] <= high)
    return _pitch_of_cloud(points[inside, :2].astype(np.float64), radius_mm / 2)


def _pitch_of_cloud(xy: Array, cell_mm: float) -> float | None:
    if len(xy) == 0:
        return None
    cells = np.floor((xy - xy.min(axis=0)) / cell_mm).astype(np.int64)
    counts = np.bincount(cells[:, 0] * (int(cells[:, 1].max()) + 1) + cells[:, 1])
    full = float(np.percentile(counts[counts > 0], 75))  # cells at edges and in mouths are half empty
    return cell_mm / float(np.sqrt(full)) if full >= _PITCH_CELL_POINTS_MIN else None
