"""The face of a foot in a scan: the plane with the mouths in it, and how far the concrete lies before and behind it.

Feet are roughened by order (6 mm and more, washed or with keys): then the face is a layer and no plane, and only what
reaches through the layer is a hole.

Round holes in a plane, found on a coarse raster of the points that lie on it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from aadm_workbench.extract.patches import Patches
from aadm_workbench.extract.plane import facing, find_planes, in_plane, refined_plane
from aadm_workbench.extract.sample import Thinned, point_pitch_mm
from aadm_workbench.model import Array, FloatArray, Plane, Scan
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import median, percentiles

FACE_BAND_MM = 1.5
"""About the plane of a face that is smooth."""

RIM_DEPTH_MM = 2.5
"""A chamfer ends less far behind the face."""

_LAYER_MM = 12.0  # what is roughened lies within, what stands before a foot or far behind does not
_OUTER_PERCENT = 4.0, 96.0  # of heights: what lies outside may be outliers
_ROUGH_MM, _ROUGH_NOISES = 3.0, 8.0  # rings and splashes of grout are thinner; noise alone comes to 3.5
_MARGIN_MM = 1.0  # beyond the layer, noise of the camera
_EVERY = 16  # points, for a look at the layer: it has thousands
_ROUGH_INLIER_MM = 3.0  # half of the 6 mm that feet are roughened by (GB/T 51231)
_RING_MM = 1.0, 3.0  # beyond a mouth's edge: there the sleeve's own ring ends, or the concrete begins
_RISE_MM = 1.0, 5.0  # of rings before the face, from where on it counts

_EMPTY_DISC = 0.75  # of the radius: this part of a hole holds no face points
_RING = (1.15, 1.6)  # of the radius: this part around a hole holds face points
# cells of an empty disc that strays and a tape fill (a choice: ±30 % moves nothing on sound scans)
_DISC_FILL_MAX = 0.45
_RING_FILL_MIN = 0.55  # a mouth at an edge of the face has half a ring (a choice: ±30 % moves nothing on sound scans)
_MOST_FOUND = 400  # no foot has so many: they are noise, and what is further sought in it takes minutes
_MOST_CELLS = 4_000_000  # 16 MB, whatever the points are said to reach over
_EXTENT_FROM = 20_000  # points


@dataclass(frozen=True, eq=False)
class FootFace:
    """``plane``; what lies between ``low_mm`` (negative: inside of the foot) and ``high_mm`` over it is the face.

    ``rough``: it is a layer; ``flat``: neither that, nor do rings stand out of it.
    """

    plane: Plane
    low_mm: float = -RIM_DEPTH_MM
    high_mm: float = FACE_BAND_MM
    rough: bool = False
    flat: bool = True


def faces_with_holes(
    scan: Scan, sample: Thinned, radius_mm: float, rng: np.random.Generator, *, may_be_rough: bool = True
) -> Iterator[tuple[FootFace, Array, float]]:
    """The largest planes, largest first; of each the centres (k, 2) mm of its holes of a radius, and its points' pitch.

    A wall behind a foot may be larger, and its noise may leave holes, too: which is the foot, its mouths tell.
    """
    noise_mm = _noise_mm(scan)
    for plane in find_planes(sample.points, rng, 3):
        plane = plane if scan.viewpoint is None else facing(plane, scan.viewpoint)
        face = _layer(plane, sample, noise_mm) if may_be_rough else FootFace(plane)
        local = in_plane(sample.points[_on_face(sample, face)], face.plane)[:, :2]
        pitch_mm = point_pitch_mm(sample, local)
        spacing_mm = pitch_mm / np.sqrt(sample.share)
        # Twelve cells to a radius place a mouth well enough to begin; finer than the points lie, cells would be empty.
        raster = rastered(local, max(radius_mm / 12, 1.3 * spacing_mm), 3 * radius_mm)
        centres, _ = find_discs(raster, radius_mm, holes=True)
        yield face, centres, pitch_mm


def _on_face(sample: Thinned, face: FootFace) -> Array:
    height = face.plane.height(sample.points)
    low_mm, high_mm = (face.low_mm, face.high_mm) if face.rough else (-FACE_BAND_MM, _RISE_MM[1])
    return np.asarray((height > low_mm) & (height < high_mm))


def _layer(plane: Plane, sample: Thinned, noise_mm: float) -> FootFace:
    some = sample.points[::_EVERY]
    low, high = _outer(plane, some)
    if high - low < max(_ROUGH_MM, _ROUGH_NOISES * noise_mm):
        return FootFace(plane)
    middle = refined_plane(some, plane, _ROUGH_INLIER_MM)
    low, high = _outer(middle, some)
    return FootFace(
        middle, min(-RIM_DEPTH_MM, low - _MARGIN_MM), max(FACE_BAND_MM, high + _MARGIN_MM), rough=True, flat=False
    )


def _outer(plane: Plane, points: FloatArray) -> tuple[float, float]:
    height = plane.height(points)
    layer = height[np.abs(height) < _LAYER_MM]
    if not len(layer):
        return 0.0, 0.0
    low, high = percentiles(layer, _OUTER_PERCENT)
    return float(low), float(high)


def _noise_mm(scan: Scan) -> float:
    """Of heights of neighbouring pixels against each other; 0 for clouds, whose neighbours nobody knows."""
    if not scan.organised:
        return 0.0
    depth = scan.points[:: 4 * _EVERY, :, 2]
    bend = np.abs(depth[:, :-2] - 2.0 * depth[:, 1:-1] + depth[:, 2:])
    bend = bend[np.isfinite(bend)]
    return float(TO_SIGMA * median(bend) / np.sqrt(6.0)) if len(bend) else 0.0  # 6 = 1² + 2² + 1²


def level_with_rings(patches: Patches, radius_mm: float) -> tuple[Patches, bool]:
    """Patches about mouths whose rings stand out of the face, each as if the ring's own end was it; and if any does."""
    squares = patches.x * patches.x + patches.y * patches.y
    low, high = ((radius_mm + part) ** 2 for part in _RING_MM)
    at = np.flatnonzero((squares > low) & (squares < high))
    height, owner = patches.height.ravel()[at], at // patches.x.shape[1]
    rise = np.zeros(len(patches.x))
    for k in np.flatnonzero(np.bincount(owner[height > _RISE_MM[0]], minlength=len(rise))).tolist():
        about = height[owner == k]
        rise[k] = median(about[np.abs(about) < _RISE_MM[1]])
    rise[~(rise >= _RISE_MM[0])] = 0.0
    return (patches.raised(rise), True) if rise.any() else (patches, False)


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


def rastered(xy: Array, cell_mm: float, margin_mm: float) -> Raster:
    """Raster of the cells that hold any of the points (n, 2) mm, with an empty margin around them.

    Cells grow where there would be too many.
    """
    some = xy[:: len(xy) // _EXTENT_FROM + 1]
    low, high = percentiles(some, (0.1, 99.9))  # one stray in a thousand stretches nothing
    low, high = low - margin_mm, high + margin_mm
    cell_mm = max(cell_mm, float(np.sqrt(np.prod(high - low) / _MOST_CELLS)))
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
    # One place within nearly a radius: discs that lie closer would overlap.
    reach = 2 * int(np.ceil(0.9 * radius_mm / raster.cell_mm)) + 1
    highest = cv2.dilate(score, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach)))
    rows, columns = np.nonzero((score >= highest) & (score > 0.2))  # less is the grain of the raster itself
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
        # Of a plateau: nearer than another disc could be, and within what single cells change of a score.
        alike = (np.hypot(*(centres - centres[best]).T) < 0.8 * radius_mm) & (scores > scores[best] - 0.03)
        found.append(np.average(centres[alike], axis=0, weights=scores[alike]))
        kept.append(float(scores[best]))
        free[best] = False
        free &= np.hypot(*(centres - found[-1]).T) >= 1.2 * radius_mm  # others would overlap it
    return np.array(found).reshape(-1, 2), np.array(kept)
