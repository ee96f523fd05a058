"""Coordinates out of binary records of fixed length, as PLY, PCD and their like store them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from aadm_workbench.model import FloatArray, Reason
from aadm_workbench.scan.file import ScanFile

Axes = Sequence[tuple[int, "np.dtype[Any]"]]
"""Byte offset within a record, and type, of x, y and z."""


def coordinate_dtype(dtypes: Sequence[np.dtype[Any]]) -> np.dtype[Any]:
    """Return the smallest of float32 and float64 that holds all values of these types without loss (int64 aside)."""
    return np.result_type(np.float32, *(dtype.newbyteorder("=") for dtype in dtypes))


def check_room(file: ScanFile, start: int, count: int, smallest_record_bytes: int, room_bytes: int) -> None:
    """Check, before anything is allocated, that a file can hold the points that its header announces.

    Parameters
    ----------
    file
        The file, for the message.
    start
        Byte offset of the first record in the file.
    count
        Points by the header.
    smallest_record_bytes
        What one record takes at least.
    room_bytes
        What there is from ``start`` on.

    Raises
    ------
    ScanError
        Where the header announces no point, or more than there is room for.
    """
    if count == 0:
        raise file.wrong(Reason("points.no_records"))
    if count * smallest_record_bytes > room_bytes:
        found = max(room_bytes, 0) // smallest_record_bytes
        raise file.wrong(
            Reason(
                "points.records_short",
                count=count,
                record_bytes=smallest_record_bytes,
                start=start,
                size_bytes=len(file.content),
                found=found,
            )
        )


def gather(content: bytes, start: int, count: int, step_bytes: int, axes: Axes) -> FloatArray:
    """Return the coordinates of records that stand ``step_bytes`` apart.

    Parameters
    ----------
    content
        The bytes; room was checked before (:func:`check_room`).
    start
        Byte offset of the first record.
    count
        Number of records.
    step_bytes
        Length of one record.
    axes
        Where x, y and z stand in a record.

    Returns
    -------
    FloatArray
        (count, 3) float32 or float64, native byte order, unit of the file.
    """
    offsets = [offset for offset, _ in axes]
    dtypes = [dtype for _, dtype in axes]
    target = coordinate_dtype(dtypes)
    first, size = dtypes[0], dtypes[0].itemsize
    if all(dtype == first for dtype in dtypes) and offsets == [offsets[0] + k * size for k in range(3)]:
        side_by_side = np.ndarray((count, 3), first, content, start + offsets[0], (step_bytes, size))
        return np.array(side_by_side, dtype=target, order="C")
    points = np.empty((count, 3), target)
    for axis, (offset, dtype) in enumerate(axes):
        points[:, axis] = np.ndarray((count,), dtype, content, start + offset, (step_bytes,))
    return points
