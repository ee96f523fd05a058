"""All points of a scan around some places: what a feature is measured from, without passing over the rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.sample import Thinned
from aadm_workbench.model import Array, BoolArray, FloatArray, Plane, Scan

_LABEL_CELL_MM = 2.0
_CHUNK = 400_000
_BORNE_WITHIN_MM = 6.0  # a wall seen along falls by a few mm from pixel to pixel
_BORNE_BY = 3


@dataclass(frozen=True, eq=False)
class Neighbourhood:
    """What is seen around one place: ``points`` (n, 3) float64, in the plane's axes (x, y, height), mm.

    ``borne`` (n,) tells which points have others beside them at a like depth. The rest hang in the air, as
    pixels do that mix a near and a far surface at a depth step.
    """

    points: Array
    borne: BoolArray


def points_around(
    scan: Scan, sample: Thinned, plane: Plane, centres: Array, reach_mm: float, *, find_borne: bool = False
) -> list[Neighbourhood]:
    """Points of the full scan that are seen around some places of a plane.

    A point belongs to a place by where its line of sight crosses the plane (what is behind an edge tells
    where the edge is); without a viewpoint by its plan position.

    Parameters
    ----------
    centres
        (k, 2) mm, in the plane's axes.
    find_borne
        Whether to tell the points that hang in the air from the others; without it all count as borne.

    Returns
    -------
    list of :class:`Neighbourhood`.
    """
    if sample.pixels is not None:
        seen = seen_at(sample.points, plane, scan.viewpoint).astype(np.float32)
        return [_window(scan.points, sample, seen, plane, centre, reach_mm, find_borne) for centre in centres]
    return _gathered(scan, plane, centres, reach_mm, find_borne)


def with_places(centres: Array, places: Array, radius_mm: float) -> Array:
    """What was found (k, 2) mm, and the places (m, 2) that lie on none of it."""
    if len(centres) == 0:
        return places
    distance = np.hypot(*(places[:, None] - centres[None]).transpose(2, 0, 1)).min(axis=1)
    return np.vstack([centres, places[distance > radius_mm]])


def seen_at(points: Array, plane: Plane, viewpoint: Array | None) -> Array:
    """Where points (n, 3) of the scan frame appear on a plane, in its axes: (n, 2) mm."""
    local = in_plane(points, plane)
    if viewpoint is None:
        return local[:, :2]
    eye = in_plane(viewpoint[None], plane)[0]
    below = np.maximum(eye[2] - local[:, 2], 1e-6 * abs(eye[2]) + 1e-9)
    return np.asarray(eye[:2] + (local[:, :2] - eye[:2]) * (eye[2] / below)[:, None])


def _window(
    points: FloatArray,
    sample: Thinned,
    seen: FloatArray,
    plane: Plane,
    centre: Array,
    reach_mm: float,
    find_borne: bool,
) -> Neighbourhood:
    assert sample.pixels is not None
    about = np.abs(seen - centre.astype(np.float32))
    close = np.flatnonzero((about[:, 0] < reach_mm) & (about[:, 1] < reach_mm))
    if len(close) == 0:
        return Neighbourhood(np.empty((0, 3)), np.empty(0, bool))
    low = np.maximum(sample.pixels[close].min(axis=0) - sample.stride, 0)
    high = sample.pixels[close].max(axis=0) + sample.stride + 1
    window = points[low[0] : high[0], low[1] : high[1]]
    returned = np.isfinite(window[..., 2])
    local = in_plane(window[returned].astype(np.float64), plane)
    if not find_borne:
        return Neighbourhood(local, np.ones(len(local), bool))
    height = np.full(returned.shape, np.nan)
    height[returned] = local[:, 2]
    return Neighbourhood(local, _borne(height)[returned])


def _borne(height: Array) -> BoolArray:
    """Pixels (h, w) with enough of their eight neighbours at a like height."""
    rows, columns = height.shape
    framed = np.full((rows + 2, columns + 2), np.nan)
    framed[1:-1, 1:-1] = height
    count = np.zeros(height.shape, np.int8)
    for down in (0, 1, 2):
        for right in (0, 1, 2):
            if (down, right) != (1, 1):
                count += np.abs(framed[down : down + rows, right : right + columns] - height) < _BORNE_WITHIN_MM
    return np.asarray(count >= _BORNE_BY)


def _gathered(scan: Scan, plane: Plane, centres: Array, reach_mm: float, find_borne: bool) -> list[Neighbourhood]:
    if len(centres) == 0:
        return []
    low = centres.min(axis=0) - reach_mm - 2 * _LABEL_CELL_MM
    shape = np.ceil((centres.max(axis=0) + reach_mm - low) / _LABEL_CELL_MM).astype(int) + 2
    labels = _painted(centres - low, reach_mm, shape)
    kept_points, kept_labels = [], []
    for begin in range(0, len(scan.points), _CHUNK):
        chunk = scan.points[begin : begin + _CHUNK].astype(np.float64)
        cells = (seen_at(chunk, plane, scan.viewpoint) - low) / _LABEL_CELL_MM
        chosen = np.flatnonzero(((cells >= 0) & (cells < shape)).all(axis=1))
        label = labels[cells[chosen, 0].astype(np.intp), cells[chosen, 1].astype(np.intp)]
        kept_points.append(in_plane(chunk[chosen[label >= 0]], plane))
        kept_labels.append(label[label >= 0])
    gathered, owner = np.concatenate(kept_points), np.concatenate(kept_labels)
    parts = [gathered[owner == k] for k in range(len(centres))]
    eye = None if scan.viewpoint is None or not find_borne else in_plane(scan.viewpoint[None], plane)[0]
    return [Neighbourhood(part, _borne_in_cloud(part, eye, reach_mm)) for part in parts]


def _borne_in_cloud(local: Array, eye: Array | None, reach_mm: float) -> BoolArray:
    """The like of :func:`_borne` for points (n, 3) without pixels: neighbours by where they are seen."""
    if eye is None or len(local) < 10:
        return np.ones(len(local), bool)
    from scipy.spatial import cKDTree

    seen = eye[:2] + (local[:, :2] - eye[:2]) * (eye[2] / np.maximum(eye[2] - local[:, 2], 1e-6))[:, None]
    pitch_mm = reach_mm * np.sqrt(np.pi / len(local))
    scaled = np.column_stack([seen / (1.8 * pitch_mm), local[:, 2] / _BORNE_WITHIN_MM])
    near = cKDTree(scaled).query_ball_point(scaled, 1.0, p=np.inf, return_length=True)
    return np.asarray(near > _BORNE_BY)


def _painted(centres: Array, reach_mm: float, shape: Array) -> FloatArray:
    """Raster of labels: the index of the centre whose reach covers a cell, the nearest one where several do."""
    labels = np.full(tuple(shape), -1, np.int32)
    best = np.full(tuple(shape), np.inf)
    for k, centre in enumerate(centres):
        low = np.maximum(np.floor((centre - reach_mm) / _LABEL_CELL_MM).astype(int) - 1, 0)
        high = np.ceil((centre + reach_mm) / _LABEL_CELL_MM).astype(int) + 2
        part = (slice(low[0], high[0]), slice(low[1], high[1]))
        x = (np.arange(low[0], min(high[0], shape[0])) + 0.5) * _LABEL_CELL_MM - centre[0]
        y = (np.arange(low[1], min(high[1], shape[1])) + 0.5) * _LABEL_CELL_MM - centre[1]
        distance = np.hypot(x[:, None], y[None, :])
        nearer = (distance < best[part]) & (distance < reach_mm + 2 * _LABEL_CELL_MM)
        labels[part][nearer] = k
        best[part][nearer] = distance[nearer]
    return labels
