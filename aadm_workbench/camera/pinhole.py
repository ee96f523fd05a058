"""The intrinsics of a camera, from the points on its own pixels."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, Camera, FloatArray

_BESIDE_PX = 0.05  # of a picture that was straightened, points lie on their rays to the precision of float32
_FEWEST = 500  # points that tell four numbers well, flying ones among them
_SAMPLE = 20_000  # points: a fit to more is no better
_LONGEST_PX = 1e5  # a longer focal length is that of parallel rays, which is no camera's


def camera_of(points: FloatArray) -> Camera | None:
    """Return the pinhole camera whose pixels points lie on; None where they lie on no such camera's.

    Parameters
    ----------
    points
        (h, w, 3) floating, mm, camera frame; NaN where there is no return.
    """
    height, width = points.shape[:2]
    rows, columns = np.nonzero(np.isfinite(points).all(axis=-1) & (points[..., 2] > 0))
    every = max(1, len(rows) // _SAMPLE)
    rows, columns = rows[::every], columns[::every]
    if len(rows) < _FEWEST:
        return None
    x, y, z = points[rows, columns].astype(np.float64).T
    across, down = _line(columns.astype(np.float64), x / z), _line(rows.astype(np.float64), y / z)
    if across is None or down is None:
        return None
    (fx, cx), (fy, cy) = across, down
    inside = 0.0 < cx < width and 0.0 < cy < height
    return Camera(fx, fy, cx, cy, width, height) if inside else None


def _line(pixels: Array, tangents: Array) -> tuple[float, float] | None:
    """Focal length and centre, in pixels, of tangents (x - c) / f; None where they lie on no line."""
    if np.ptp(pixels) == 0 or np.ptp(tangents) == 0:
        return None
    step, first = np.polyfit(pixels, tangents, 1)
    if not step > 1.0 / _LONGEST_PX:
        return None
    beside_px = np.abs((tangents - first) / step - pixels)
    return (1.0 / step, -first / step) if beside_px.max() <= _BESIDE_PX else None
