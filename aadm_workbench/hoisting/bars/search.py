"""Bars under a hanging foot, as round columns of points: a first centre for each that shows its front.

They stand about square to the foot, so seen along its normal the points of one bar fall on an arc. What is level, or
flies, fills a place at one height only; a bar fills it at many.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np

from aadm_workbench.extract.plane import refined_plane
from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.model import Array, IntArray, Plane

_SAMPLE_PIXELS = 130_000  # every fourth row and column of 1920 × 1200
_FITTED_MAX = 250  # of a bar's front: for a first centre more tell no more
_GAP_MM = 12.0  # what hangs down less from the foot belongs to it
_SLICE_MM = 8.0  # of height: five rows of the sample
_SLICES_MIN = 3  # a bar fills its place over 16 mm of height at least; what is level, or flies, does not
_CELL_MM = 3.0  # twice the distance of neighbours in the sample: no bar falls apart, and none grows into the next one
_POINTS_MIN = 20  # of the sample: a bar shows hundreds, fewer carry no circle
# well below the tops, level within centimetres, and seen over a column's width (a choice: ±30 % moves nothing on
# sound scans)
_FLOOR_BELOW_MM, _FLOOR_BAND_MM, _FLOOR_SPAN_MM = 50.0, 20.0, 150.0
# a plane that most of what is low lies on, within 3.6 degrees of square to the bars (a choice: ±30 % moves nothing on
# sound scans)
_FLOOR_POINTS_MIN, _FLOOR_SHARE, _FLOOR_COSINE = 150, 0.6, 0.998
_MISFIT_MM = 1.2  # ribs stand out by 0.9 mm, noise comes on top
_FITTING_SHARE = 0.7  # of its points (a choice: ±30 % moves nothing on sound scans)
_FRONT_SHARE = 0.6  # of the diameter that must be seen of a bar's front


@dataclass(frozen=True, eq=False)
class SeenBars:
    """Bars (k): ``centres`` (k, 2) mm at the height of their ``tops`` (k,) mm, in the axes of the foot face.

    ``vertical`` (3,) is their common direction there; ``floor`` (3,) the normal of the floor that they stand in, None
    where too little of it is seen. ``below`` tells whether anything at all is seen below the foot.
    """

    centres: Array
    tops: Array
    vertical: Array
    below: bool
    floor: Array | None = None


def find_bars(frame: HoistingFrame, face: FootFace, diameter_mm: float, reach_mm: float) -> SeenBars:
    """Find what stands like bars of one diameter below a foot, within ``reach_mm`` of its middle as seen from above."""
    rows, columns = frame.shape
    stride = max(1, int(np.sqrt(rows * columns / _SAMPLE_PIXELS)))
    coarse = frame.points[::stride, ::stride]
    coarse = coarse[np.isfinite(coarse[..., 2])]
    local = (coarse - face.origin.astype(np.float32)) @ face.axes.T.astype(np.float32)
    near = (local[:, 2] < -_GAP_MM) & (np.hypot(local[:, 0], local[:, 1]) < reach_mm)
    standing: Array = local[near].astype(np.float64)
    if len(standing) < _POINTS_MIN:
        return _none(below=False)
    bars = [_front(standing[member], face.eye, diameter_mm / 2) for member in _upright(standing)]
    found = [bar for bar in bars if bar is not None]
    if not found:
        return _none(below=True)
    lean = np.median([slope for _, slope, _ in found], axis=0)
    vertical = np.array([*lean, 1.0]) / np.linalg.norm([*lean, 1.0])
    centres, tops = np.array([bar[0] for bar in found]), np.array([bar[2] for bar in found])
    floor = _floor(standing, centres, float(np.median(tops)), vertical, diameter_mm)
    return SeenBars(centres, tops, vertical, True, floor)


def _floor(points: Array, centres: Array, top_mm: float, vertical: Array, diameter_mm: float) -> Array | None:
    """Normal (3,) of the floor under the bars, in the axes of the foot face."""
    low = points[points[:, 2] < top_mm - _FLOOR_BELOW_MM]
    apart = np.hypot(*(low[:, None, :2] - centres[None]).transpose(2, 0, 1)).min(axis=1)
    # beside a bar's own points and what flies about it
    low = low[apart > 1.5 * diameter_mm]
    if len(low) < _FLOOR_POINTS_MIN:
        return None
    height = low @ vertical
    level_mm = float(np.median(height))
    plane = refined_plane(low[np.abs(height - level_mm) < _FLOOR_BAND_MM], Plane(vertical, level_mm))
    on_floor = np.abs(plane.height(low)) < max(4.0 * plane.residual_mm, 0.5)
    spans = np.ptp(low[on_floor, :2], axis=0) if on_floor.any() else np.zeros(2)
    if on_floor.mean() < _FLOOR_SHARE or spans.min() < _FLOOR_SPAN_MM or plane.normal @ vertical < _FLOOR_COSINE:
        return None
    return plane.normal


def _none(*, below: bool) -> SeenBars:
    return SeenBars(np.empty((0, 2)), np.empty(0), np.array([0.0, 0.0, 1.0]), below)


def _upright(local: Array) -> list[IntArray]:
    """Indices of the points of each thing that fills its place at many heights."""
    low = local.min(axis=0)
    cell = np.floor((local[:, :2] - low[:2]) / _CELL_MM).astype(np.int64)
    level = np.floor((local[:, 2] - low[2]) / _SLICE_MM).astype(np.int64)
    columns, rows = cell.max(axis=0) + 1
    place = cell[:, 1] * columns + cell[:, 0]
    once = np.unique(place * (int(level.max()) + 1) + level)
    levels = np.bincount(once // (int(level.max()) + 1), minlength=rows * columns).reshape(rows, columns)
    tall = (levels >= _SLICES_MIN).astype(np.uint8)
    count, labels = cv2.connectedComponents(tall, connectivity=8)
    owner = labels[cell[:, 1], cell[:, 0]]
    order = np.argsort(owner, kind="stable")
    bounds = np.searchsorted(owner[order], np.arange(1, count + 1))
    members = [order[begin:end] for begin, end in pairwise(bounds)]
    return [member for member in members if len(member) >= _POINTS_MIN]


def _front(points: Array, eye: Array, radius_mm: float) -> tuple[Array, Array, float] | None:
    """Centre (2,) mm at the top, lean (2,) and top of a bar whose front is seen; None for anything else."""
    points = points[:: len(points) // _FITTED_MAX + 1]
    xy = points[:, :2]
    # one point in a hundred may fly
    top_mm = float(np.quantile(points[:, 2], 0.99))
    away = np.median(xy, axis=0) - eye[:2]
    away /= np.linalg.norm(away)
    across = np.array([-away[1], away[0]])
    # one in fifty at either side may fly
    side = np.quantile(xy @ across, [0.02, 0.98])
    # 3 mm of ribs, noise and mixed pixels at either side
    if not _FRONT_SHARE * 2 * radius_mm < side[1] - side[0] < 2 * radius_mm + 6.0:
        return None
    # where its front is nearest, but for the twentieth that may fly before it
    start = across * side.mean() + away * (float(np.quantile(xy @ away, 0.05)) + radius_mm)
    found = np.array([*start, 0.0, 0.0])
    up = (points[:, 2] - top_mm)[:, None]
    for _ in range(8):
        about = xy - found[:2] - found[2:] * up
        distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
        residual = distance - radius_mm
        outward = about / distance[:, None]
        jacobian = np.hstack([outward, outward * up])
        weight = 1.0 / (1.0 + (residual / _MISFIT_MM) ** 2)
        normal = (jacobian * weight[:, None]).T @ jacobian + np.diag([1e-3, 1e-3, 1e3, 1e3])
        found = found + np.linalg.solve(normal, jacobian.T @ (weight * residual) - [0.0, 0.0, *(1e3 * found[2:])])
    fitting = np.abs(np.hypot(*(xy - found[:2] - found[2:] * up).T) - radius_mm) < _MISFIT_MM
    if fitting.mean() < _FITTING_SHARE:
        return None
    # as above
    return found[:2], found[2:], float(np.quantile(points[fitting, 2], 0.99))
