"""Clouds that are a camera's picture without its rows: the pixel that each point came from, found from the points.

A camera's software measures along the rays of its pixels and often saves only what returned. Seen from the camera, x/z
and y/z of such points lie on an even grid, to the precision of the file. With the grid the pixels that returned
nothing are known again, and these tell where edges are.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, FloatArray, IntArray

_SAMPLE = 30_000  # places along a side, of which each column or row of a picture has some
_FEWEST = 2_000  # a picture with fewer points shows no component
_STEP_RANGE = (1e-4, 1e-2)  # of x/z from pixel to pixel: focal lengths of 100 to 10,000 pixels
_TANGENT_MAX = 10.0  # of the widest lens; farther out are faults
_SAME_COLUMN = 1e-5  # of x/z: what precision of files leaves between points of one column
_OFF_GRID, _ON_GRID_SHARE = 0.15, 0.98  # pixels; of the points
_OFF_PICTURE = 1.0  # pixels, median: a lens that was not straightened bends lines by more
_SIZE_MAX = 6_000  # columns or rows: structured-light cameras have 5,000 at most
_SHARED_SHARE = 0.01  # of the points may fall on a pixel that another one has
_SOUGHT_STEPS = 5  # fewer columns or rows are no picture


def on_pixels(points: FloatArray) -> FloatArray | None:
    """The points as the picture of a camera at the origin that looks along +z; None where they lie on no grid.

    Parameters
    ----------
    points
        (n, 3) floating, mm, finite.

    Returns
    -------
    FloatArray
        (h, w, 3), the same points, NaN where a pixel returned nothing.
    """
    if len(points) < _FEWEST or not (points[:, 2] > 0).all():
        return None
    with np.errstate(over="ignore"):
        across, down = (points[:, :2] / points[:, 2:].astype(np.float64)).T
    if max(np.abs(across).max(), np.abs(down).max()) > _TANGENT_MAX:
        return None
    from_columns = _grid_places(across)
    from_rows = None if from_columns is None else _grid_places(down)
    if from_columns is None or from_rows is None:
        return None
    (columns, off_columns), (rows, off_rows) = from_columns, from_rows
    # A line scanner's even steps over a flat face look like a distant camera's, too, but are more even by themselves.
    level = float(np.median(points[:, 2]))
    for axis, off in ((0, off_columns), (1, off_rows)):
        itself = _grid_places(points[:, axis].astype(np.float64) / level)
        if itself is not None and itself[1] <= off:
            return None
    width, height = int(columns.max()) + 1, int(rows.max()) + 1
    if max(width, height) > _SIZE_MAX:
        return None
    pixel = rows * width + columns
    filled = np.zeros(height * width, bool)
    filled[pixel] = True
    if len(points) - int(np.count_nonzero(filled)) > _SHARED_SHARE * len(points):
        return None
    picture = np.full((height * width, 3), np.nan, points.dtype)
    picture[pixel] = points
    return picture.reshape(height, width, 3)


def is_picture(points: FloatArray) -> bool:
    """Whether an organised cloud is the picture of a camera at the origin that looks along +z.

    Parameters
    ----------
    points
        (h, w, 3) floating, mm; NaN where a pixel returned nothing.
    """
    stride = max(1, int(np.sqrt(points.shape[0] * points.shape[1] / _SAMPLE)))
    some = points[::stride, ::stride].astype(np.float64)
    seen = np.isfinite(some).all(axis=-1)
    if np.count_nonzero(seen) < _FEWEST or not (some[seen][:, 2] > 0).all():
        return False
    tangents = some[seen][:, :2] / some[seen][:, 2:]
    if not np.abs(tangents).max() < _TANGENT_MAX:
        return False
    for axis, place in enumerate(np.nonzero(seen)[::-1]):
        step, first = np.polyfit(place * stride, tangents[:, axis], 1)
        off = np.abs((tangents[:, axis] - first) / step - place * stride) if step else np.array([np.inf])
        if not np.median(off) < _OFF_PICTURE:
            return False
    return True


def _grid_places(tangents: Array) -> tuple[IntArray, float] | None:
    """The place (n,) of each of some values on the even grid that they lie on, and how far off, in steps; or None."""
    some = np.sort(tangents[:: len(tangents) // _SAMPLE + 1])
    gaps = np.diff(some)
    between = gaps[(gaps > _SAME_COLUMN) & (gaps < _STEP_RANGE[1])]
    if len(between) < _SOUGHT_STEPS:
        return None
    step = float(np.median(between))
    if not _STEP_RANGE[0] < step < _STEP_RANGE[1]:
        return None
    # Points of a column fall into one group; groups are counted from their neighbours, so that no error adds up.
    place = np.concatenate([[0], np.cumsum(np.rint(gaps / step))])
    for _ in range(2):
        if not np.ptp(place) > _SOUGHT_STEPS:
            return None
        step, first = np.polyfit(place, some, 1)
        if not step > 0:
            return None
        place = np.rint((some - first) / step)
    if (np.abs((some - first) / step - place) > _OFF_GRID).mean() > 1.0 - _ON_GRID_SHARE:
        return None
    exact = (tangents - first) / step
    whole = np.rint(exact)
    if (np.abs(exact - whole) > _OFF_GRID).mean() > 1.0 - _ON_GRID_SHARE:
        return None
    return np.asarray(whole - whole.min(), np.int64), float(np.median(np.abs(exact - whole)))
