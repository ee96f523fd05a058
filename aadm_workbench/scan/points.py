"""From the points of a file to the points of a scan: what is no measurement, the unit, the pose, the precision."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.model import Array, BoolArray, FloatArray

HUGE_COORDINATE_MM = 1e7
"""Beyond this, float32 rounds by a millimetre: map coordinates stay float64."""

LARGEST_COORDINATE = 1e12
"""In the unit of a file: the earth's girth is 4e10 mm. What lies further off is no measurement but a fault."""


def without_return(points: FloatArray) -> BoolArray:
    """Tell which points are no measurement: not finite, out of this world, or all three coordinates exactly zero.

    Cameras write NaN, infinity or the origin where a pixel saw nothing; no surface lies in the camera's centre.

    Parameters
    ----------
    points
        (..., 3) floating, in the frame of the file.

    Returns
    -------
    BoolArray
        (...) bool.
    """
    with np.errstate(all="ignore"):
        # One sum instead of three tests: it is not finite where a term is not, and it is zero at the origin alone.
        total = np.abs(points[..., 0]) + np.abs(points[..., 1]) + np.abs(points[..., 2])
        measured: BoolArray = (total > 0.0) & (total < LARGEST_COORDINATE)
    return ~measured


def narrowed(points: Array, dtype: np.dtype[Any], mm_per_unit: float) -> FloatArray:
    """Return points in the precision of their file, unless float32 would round them by a millimetre.

    Parameters
    ----------
    points
        (..., 3) float64.
    dtype
        float32 or float64, what the file declares.
    mm_per_unit
        Millimetres in one unit of ``points``.
    """
    return points if _is_huge(points, mm_per_unit) else points.astype(dtype, copy=False)


def to_millimetres(points: FloatArray, mm_per_unit: float, T_scan_file: Array | None) -> FloatArray:
    """Move points by the pose that their file carries, then scale them to millimetres.

    Parameters
    ----------
    points
        (..., 3) floating, unit and frame of the file.
    mm_per_unit
        Millimetres in one unit of the file.
    T_scan_file
        (4, 4) float64, unit of the file; None for no motion.

    Returns
    -------
    FloatArray
        (..., 3) mm, scan frame, in the precision of ``points`` or, for huge coordinates, float64.
    """
    if T_scan_file is not None and not np.array_equal(T_scan_file, np.eye(4)):
        moved = (points.astype(np.float64) @ T_scan_file[:3, :3].T + T_scan_file[:3, 3]) * mm_per_unit
        return narrowed(moved, points.dtype, 1.0)
    if mm_per_unit == 1.0:
        return points
    if _is_huge(points, mm_per_unit):
        points = points.astype(np.float64)
    return points * points.dtype.type(mm_per_unit)


def _is_huge(points: FloatArray, mm_per_unit: float) -> bool:
    reach = np.max(np.abs(points), where=np.isfinite(points), initial=0.0)
    return bool(reach * mm_per_unit > HUGE_COORDINATE_MM)
