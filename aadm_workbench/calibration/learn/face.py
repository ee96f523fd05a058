"""The face of a plate as a camera sees it: noise, flatness, and a map of what it bends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.calibration.learn.capture import PlateCapture, face_axes, sight_on_plane
from aadm_workbench.calibration.plate.plate import Plate
from aadm_workbench.model import Array, Kind

_BESIDE_MM = 8.0  # of edges: what is nearer is the edge's, with three rings of pixels and what they smooth
_BLOCK = 40  # pixels: a block is 20 mm of the face, and holds a thousand points
_FEWEST = 200  # points of a block
_REJECTED = 0.003  # three of a thousand points are left out: VDI/VDE 2634 part 2
_SHARE = 0.95  # of points that a form is told of: ISO 10360-13, D95%
_FARTHEST_MM = 5.0  # from the face: what is farther is none of it, nor noise


@dataclass(frozen=True, eq=False)
class SeenFace:
    """The face in one capture.

    Parameters
    ----------
    noise_mm
        Standard deviation of single points about the mean of their block.
    flatness_mm
        Range of the distances from the plane of best fit, three of a thousand left out.
    form_95_mm
        The least range that holds 95 % of them.
    bend_mm
        (rows, columns) mean height of each block of the picture; NaN where too little was seen.
    """

    noise_mm: float
    flatness_mm: float
    form_95_mm: float
    bend_mm: Array


def seen_face(capture: PlateCapture, plate: Plate, centres: Array) -> SeenFace:
    """The face of a capture; ``centres`` (n, 2) mm are the places of its holes and pins in it."""
    height: Array = np.asarray(capture.face.height(capture.scan.points), np.float64)
    at = sight_on_plane(capture.scan, capture.face) @ face_axes(capture.face)[:2].T
    chosen = np.isfinite(height) & (np.abs(height) < _FARTHEST_MM)
    middle = centres.mean(axis=0)
    half = plate.size_mm / 2.0 - 2.0 * _BESIDE_MM
    chosen &= np.hypot(at[..., 0] - middle[0], at[..., 1] - middle[1]) < half
    for place, centre in zip(capture.place, centres, strict=True):
        one = plate.places[place]
        aside = one.diameter_mm / 2.0 + _BESIDE_MM
        # a pin hides what lies behind its whole length, and shades as much
        aside += one.z_mm * (one.kind is Kind.REBAR)
        window = capture.window(0.0, centre, aside)
        chosen[window] &= np.hypot(at[window][..., 0] - centre[0], at[window][..., 1] - centre[1]) > aside
    level = _levelled(height[chosen], at[chosen])
    levelled = np.full(height.shape, np.nan)
    levelled[chosen] = level
    bend, scatter = _blocks(levelled)
    low, high = np.quantile(level, [_REJECTED / 2.0, 1.0 - _REJECTED / 2.0])
    return SeenFace(scatter, float(high - low), _narrowest(level), bend)


def _levelled(height: Array, at: Array) -> Array:
    """Heights from their own plane of best fit."""
    design = np.column_stack([at, np.ones(len(at))])
    fitted = np.linalg.lstsq(design, height, rcond=None)[0]
    left: Array = height - design @ fitted
    return left


def _narrowest(level: Array) -> float:
    ordered = np.sort(level)
    held = int(np.ceil(_SHARE * len(ordered)))
    return float((ordered[held - 1 :] - ordered[: len(ordered) - held + 1]).min())


def _blocks(levelled: Array) -> tuple[Array, float]:
    rows, columns = (size // _BLOCK for size in levelled.shape)
    whole = levelled[: rows * _BLOCK, : columns * _BLOCK].reshape(rows, _BLOCK, columns, _BLOCK)
    blocks = whole.transpose(0, 2, 1, 3).reshape(rows, columns, -1)
    count = np.isfinite(blocks).sum(axis=2)
    enough = count >= _FEWEST
    bend = np.full((rows, columns), np.nan)
    bend[enough] = np.nanmean(blocks[enough], axis=1)
    spread = np.nanstd(blocks[enough], axis=1)
    return bend, float(np.median(spread)) if len(spread) else float("nan")
