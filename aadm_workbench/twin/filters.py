"""What cameras do to a depth map before they hand it out, as switches; for the depth map of any camera."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from aadm_workbench.errors import AadmError
from aadm_workbench.model import BoolArray

Depth = npt.NDArray[np.float32]
_STEP_MM = 5.0  # between neighbouring pixels: more than a tilted face or a rib makes
_LARGEST = {"edge_mask": 1.0, "rings": 3.0, "gaussian": 10.0}
_LARGEST_PX = 25.0  # of any other window: cameras offer less, and a wider one would take minutes
_ROWS_AT_ONCE = 100  # bounds the memory, not the time


@dataclass(frozen=True)
class Filters:
    """Filters of a camera, in the order in which they are applied; 0 leaves one out.

    ``edge_mask``: a pixel is dropped that is darker than this share of its brightest neighbour. ``outliers``: of the
    24 pixels around, so many must lie within ``step_mm`` of a pixel's depth, or it is dropped. ``rings``: pixels
    within so many of a depth step, or of a patch of nothing, are dropped, on both sides of it. ``fatten``: what is
    nearer grows by so many pixels over what is farther. ``gaps``: where nothing was measured, over up to so many
    pixels, it is filled in from around. ``median``: side of the window in pixels. ``gaussian``: standard deviation in
    pixels; it smooths over steps too.
    """

    edge_mask: float = 0.0
    outliers: int = 0
    rings: int = 0
    fatten: int = 0
    gaps: int = 0
    median: int = 0
    gaussian: float = 0.0
    step_mm: float = _STEP_MM


NO_FILTERS = Filters()

NAMES = tuple(field.name.replace("_", "-") for field in fields(Filters) if field.name != "step_mm")
"""What :func:`filters_of` takes, before the equals sign."""


def filters_of(words: Sequence[str]) -> Filters:
    """Filters from words such as ``rings=1`` and ``edge-mask=0.5``.

    Raises
    ------
    AadmError
        Where a word names no filter, or gives it no number that it can take.
    """
    chosen = Filters()
    for word in words:
        name, _, text = word.partition("=")
        if name not in NAMES:
            raise AadmError.because("command.twin_filter", word=word, name=name, known=tuple(NAMES))
        amount: Any = _amount(name.replace("-", "_"), word, text)
        chosen = replace(chosen, **{name.replace("-", "_"): amount})
    return chosen


def _amount(name: str, word: str, text: str) -> float:
    whole = isinstance(getattr(Filters(), name), int)
    try:
        amount: float = int(text) if whole else float(text)
    except ValueError as error:
        kind = "a whole number" if whole else "a number"
        raise AadmError.because(
            "command.twin_filter_number", word=word, name=name.replace("_", "-"), kind=kind
        ) from error
    most = 24.0 if name == "outliers" else _LARGEST.get(name, _LARGEST_PX)
    if not 0 <= amount <= most:
        raise AadmError.because("command.twin_filter_range", word=word, name=name.replace("_", "-"), most=most)
    return amount


def filtered(depth: Depth, filters: Filters, brightness: Depth | None = None) -> Depth:
    """A depth map (h, w), mm, NaN where there is nothing, as a camera with these filters hands it out.

    Parameters
    ----------
    brightness
        (h, w) of the light that the depth was read from, NaN where it was too dark; for ``edge_mask`` alone.

    Raises
    ------
    AadmError
        Where the edge mask is wanted and there is no brightness.
    """
    if filters.edge_mask:
        if brightness is None:
            raise AadmError.because("command.edge_mask_camera")
        depth = _masked(depth, brightness, filters.edge_mask)
    step = filters.step_mm
    steps: tuple[tuple[int, Callable[[Depth], Depth]], ...] = (
        (filters.outliers, lambda d: _without_outliers(d, filters.outliers, step)),
        (filters.rings, lambda d: np.where(near_steps(d, filters.rings, step), np.float32(np.nan), d)),
        (filters.fatten, lambda d: _fattened(d, filters.fatten, step)),
        (filters.gaps, lambda d: _filled(d, filters.gaps)),
        (filters.median, lambda d: _median(d, filters.median)),
    )
    for amount, apply in steps:
        if amount:
            depth = apply(depth)
    return _smoothed(depth, filters.gaussian) if filters.gaussian else depth


def near_steps(depth: Depth, rings: int, step_mm: float = _STEP_MM) -> BoolArray:
    """Pixels (h, w) within so many of a depth step or of a patch of nothing, 3 x 3 or larger.

    A single pixel without a measurement is noise and no edge.
    """
    low, high = _bounds(depth, 3)
    patch = ndimage.binary_opening(np.isnan(depth), np.ones((3, 3)))
    at_step = (high - low > step_mm) | ndimage.binary_dilation(patch, np.ones((3, 3)))
    if rings > 1:
        at_step = ndimage.binary_dilation(at_step, np.ones((3, 3)), iterations=rings - 1)
    return np.asarray(at_step)


def _bounds(depth: Depth, side: int) -> tuple[Depth, Depth]:
    """Lowest and highest depth in a window around each pixel; inf and -inf where there is none."""
    low = ndimage.minimum_filter(np.where(np.isnan(depth), np.float32(np.inf), depth), side)
    high = ndimage.maximum_filter(np.where(np.isnan(depth), np.float32(-np.inf), depth), side)
    return low, high


def _masked(depth: Depth, brightness: Depth, share: float) -> Depth:
    light = np.nan_to_num(brightness)
    return np.where(light < share * ndimage.maximum_filter(light, 3), np.float32(np.nan), depth)


def _without_outliers(depth: Depth, wanted: int, step_mm: float) -> Depth:
    rows, columns = depth.shape
    padded = np.pad(depth, 2, constant_values=np.nan)
    like = np.zeros(depth.shape, np.int8)
    for down in range(5):
        for right in range(5):
            like += np.abs(padded[down : down + rows, right : right + columns] - depth) < step_mm
    return np.where(like - 1 < wanted, np.float32(np.nan), depth)  # each pixel is like itself


def _fattened(depth: Depth, reach: int, step_mm: float) -> Depth:
    nearest, _ = _bounds(depth, 2 * reach + 1)
    covered = np.isfinite(nearest) & ~(depth - nearest <= step_mm)
    return np.where(covered, nearest, depth)


def _filled(depth: Depth, widest: int) -> Depth:
    valid = np.isfinite(depth)
    window = np.ones((widest + 1, widest + 1))
    border = widest + 1
    closed = ndimage.binary_closing(np.pad(valid, border), window)[border:-border, border:-border]
    return np.where(closed & ~valid, _blurred(depth, max(widest / 2.0, 0.7)), depth)


def _smoothed(depth: Depth, sigma: float) -> Depth:
    return np.where(np.isfinite(depth), _blurred(depth, sigma), depth)


def _blurred(depth: Depth, sigma: float) -> Depth:
    """Weighted mean of what was measured around each pixel."""
    valid = np.isfinite(depth)
    total = ndimage.gaussian_filter(np.where(valid, depth, 0.0).astype(np.float64), sigma)
    weight = ndimage.gaussian_filter(valid.astype(np.float64), sigma)
    return np.where(weight > 1e-9, total / np.maximum(weight, 1e-9), np.nan).astype(np.float32)


def _median(depth: Depth, side: int) -> Depth:
    """Median of what was measured in a window around each measured pixel; an even side is one pixel wider."""
    reach = side // 2
    padded = np.pad(depth, reach, constant_values=np.nan)
    result = np.full_like(depth, np.nan)
    for start in range(0, depth.shape[0], _ROWS_AT_ONCE):
        rows = slice(start, start + _ROWS_AT_ONCE)
        measured = np.isfinite(depth[rows])
        part = padded[start : start + measured.shape[0] + 2 * reach]
        windows = np.lib.stride_tricks.sliding_window_view(part, (2 * reach + 1, 2 * reach + 1))
        result[rows][measured] = _middle(windows[measured].reshape(int(measured.sum()), (2 * reach + 1) ** 2))
    return result


def _middle(values: Depth) -> Depth:
    """Median of each row, of what is not NaN: at least one."""
    ordered = np.sort(values, axis=1)
    count = np.isfinite(values).sum(axis=1)
    row = np.arange(len(values))
    return np.asarray((ordered[row, (count - 1) // 2] + ordered[row, count // 2]) / np.float32(2.0))
