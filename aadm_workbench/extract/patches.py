"""All that a scan shows around some places of a plane: what features are measured from, without passing over the rest.

A point belongs to a place by where its line of sight crosses the plane (what is behind an edge tells where the edge
is); without a viewpoint by its plan position.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from aadm_workbench.extract.circle import PlanPoints
from aadm_workbench.extract.plane import axes_on, from_plane, in_plane
from aadm_workbench.extract.sample import Thinned
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray, Plane, Scan
from aadm_workbench.model.special import median

_LABEL_CELL_MM = 2.0  # half of what a patch reaches beyond a mouth
_CHUNK = 400_000  # points at a time: 10 MB in double precision
_BORNE_WITHIN_MM = 6.0  # a wall seen along falls by a few mm from pixel to pixel
_BORNE_BY = 3  # of eight neighbours: a point on a straight edge has five on its side, one in a corner three
_HOMOGRAPHY_MIN, _HOMOGRAPHY_POINTS = 200, 4000  # eight unknowns, and lenses that bend the picture must show
_HOMOGRAPHY_WITHIN = 0.2  # of a pixel: an edge is sought to about a tenth


@dataclass(frozen=True, eq=False)
class Patches:
    """What is seen around k places: ``x``, ``y`` from the place and ``height`` over the plane, (k, n) float32, mm.

    NaN where there is no point. ``eye`` (k, 3) is the viewpoint as each place has it; None where it is unknown.
    ``columns`` is the number of pixels in a row of each patch, 0 for clouds. ``seen_x`` and ``seen_y`` (k, n) float32,
    mm, are where the lines of sight of all pixels cross the plane, also of those without a point; None for clouds.
    """

    x: FloatArray
    y: FloatArray
    height: FloatArray
    eye: Array | None
    columns: int
    seen_x: FloatArray | None = None
    seen_y: FloatArray | None = None

    def of(self, chosen: IntArray) -> Patches:
        """The patches of some places (m,)."""
        eye = None if self.eye is None else self.eye[chosen]
        seen = (None if part is None else part[chosen] for part in (self.seen_x, self.seen_y))
        return Patches(self.x[chosen], self.y[chosen], self.height[chosen], eye, self.columns, *seen)

    def raised(self, rise_mm: Array) -> Patches:
        """The patches over planes that lie so much (k,) above their own, along the normal."""
        rise = rise_mm[:, None].astype(np.float32)
        if self.eye is None:
            return replace(self, height=self.height - rise)
        eye = self.eye - np.column_stack([np.zeros((len(rise_mm), 2)), rise_mm])
        if self.seen_x is None or self.seen_y is None:
            return replace(self, height=self.height - rise, eye=eye)
        share = (rise_mm / self.eye[:, 2])[:, None].astype(np.float32)
        seen = (
            part + share * (self.eye[:, axis : axis + 1].astype(np.float32) - part)
            for axis, part in enumerate((self.seen_x, self.seen_y))
        )
        return Patches(self.x, self.y, self.height - rise, eye, self.columns, *seen)

    def borne(self, chosen: IntArray) -> BoolArray:
        """Which of some points (m,) - indices into the flattened patches - have others beside them at a like depth.

        The rest hang in the air, as pixels do that mix a near and a far surface at a depth step. Where nothing
        tells which are neighbours, all count as borne.
        """
        if self.eye is None:
            return np.ones(len(chosen), bool)
        if not self.columns:
            return self._borne_in_cloud()[chosen]
        height, last = self.height.ravel(), self.height.size - 1
        own = height[chosen]
        count = np.zeros(len(chosen), np.int8)
        for down in (-self.columns, 0, self.columns):
            for right in (-1, 0, 1):
                if down or right:
                    count += np.abs(height[np.clip(chosen + (down + right), 0, last)] - own) < _BORNE_WITHIN_MM
        return np.asarray(count >= _BORNE_BY)

    def crossings(self, chosen: IntArray, level_mm: Array | None = None) -> PlanPoints:
        """Where lines of sight cross the plane, or levels (k,) over it, to points that stand before that.

        The points are given by indices (n,) into the flattened patches.
        """
        own = PlanPoints.of(self.x, self.y, chosen)
        if self.eye is None:
            return own
        eye = self.eye.astype(np.float32)[own.owner]
        level = np.zeros(len(self.x), np.float32) if level_mm is None else level_mm.astype(np.float32)
        share = (eye[:, 2] - level[own.owner]) / np.maximum(eye[:, 2] - self.height.ravel()[chosen], np.float32(1e-6))
        x, y = (eye[:, axis] + (part - eye[:, axis]) * share for axis, part in enumerate((own.x, own.y)))
        return PlanPoints(x, y, own.owner, own.features)

    def _borne_in_cloud(self) -> BoolArray:
        from scipy.spatial import cKDTree

        assert self.eye is not None
        answer = np.ones(self.x.shape, bool)
        for k, eye in enumerate(self.eye):
            there = np.flatnonzero(np.isfinite(self.x[k]))
            if len(there) < 10:  # too few to say how close they lie
                continue
            local = np.column_stack([self.x[k, there], self.y[k, there], self.height[k, there]]).astype(np.float64)
            seen = eye[:2] + (local[:, :2] - eye[:2]) * (eye[2] / np.maximum(eye[2] - local[:, 2], 1e-6))[:, None]
            pitch_mm = float(np.sqrt(np.prod(np.ptp(seen, axis=0)) / len(local)))
            # As far as the diagonal neighbours of a square grid, and a little farther for one that is uneven.
            scaled = np.column_stack([seen / (1.8 * pitch_mm), local[:, 2] / _BORNE_WITHIN_MM])
            near = cKDTree(scaled).query_ball_point(scaled, 1.0, p=np.inf, return_length=True)
            answer[k, there] = near > _BORNE_BY
        return answer.ravel()


def patches_around(
    scan: Scan, sample: Thinned, plane: Plane, centres: Array, reach_mm: float, level_mm: Array | None = None
) -> Patches:
    """The patches around some centres (k, 2) mm, in the plane's axes, at least ``reach_mm`` to every side.

    ``level_mm`` (k,): how far over the plane what is looked for lies, where that is known: seen from aside, what lies
    higher or lower crosses the plane beside its centre.
    """
    eye, appear = None, centres
    if scan.viewpoint is not None:
        eye = in_plane(scan.viewpoint[None], plane) - np.column_stack([centres, np.zeros(len(centres))])
        if level_mm is not None:
            appear = centres - eye[:, :2] * (level_mm / np.maximum(eye[:, 2] - level_mm, 0.1 * eye[:, 2]))[:, None]
    if sample.taken is not None:
        low, high = _pixel_boxes(scan, sample, plane, appear, reach_mm)
        x, y, height = _windows(scan.points, low, high, plane, centres)
        homography = plane_of_pixel(scan, sample, plane)
        seen = (None, None) if homography is None else _crossings(homography, low, high, centres)
        return Patches(x, y, height, eye, int((high - low)[:, 1].max()), *seen)
    return Patches(*_gathered(scan, plane, centres, appear, reach_mm), eye, 0)


def with_places(centres: Array, places: Array, radius_mm: float) -> Array:
    """What was found (k, 2) mm, and the places (m, 2) that lie on none of it."""
    if len(centres) == 0:
        return places
    distance = np.hypot(*(places[:, None] - centres[None]).transpose(2, 0, 1)).min(axis=1)
    return np.vstack([centres, places[distance > radius_mm]])


def seen_at(points: FloatArray, plane: Plane, viewpoint: Array | None) -> Array:
    """Where points (n, 3) of the scan frame appear on a plane, in its axes: (n, 2) mm."""
    local = in_plane(points, plane)
    if viewpoint is None:
        return local[:, :2]
    eye = in_plane(viewpoint[None], plane)[0]
    below = np.maximum(eye[2] - local[:, 2], 1e-6 * abs(eye[2]) + 1e-9)
    return np.asarray(eye[:2] + (local[:, :2] - eye[:2]) * (eye[2] / below)[:, None])


def _pixel_boxes(
    scan: Scan, sample: Thinned, plane: Plane, centres: Array, reach_mm: float
) -> tuple[IntArray, IntArray]:
    """First (k, 2) and one past the last (k, 2) row and column of what is seen around each centre."""
    camera = scan.camera
    if camera is not None and scan.points.shape[:2] == (camera.height, camera.width) and not np.any(scan.viewpoint):
        corner = reach_mm * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])
        square = (centres[:, None] + corner).reshape(-1, 2)
        points = from_plane(np.column_stack([square, np.zeros(len(square))]), plane).reshape(-1, 4, 3)
        if (points[..., 2] > 0).all():
            rows = points[..., 1] / points[..., 2] * camera.fy + camera.cy
            columns = points[..., 0] / points[..., 2] * camera.fx + camera.cx
            pixels = np.stack([rows, columns], axis=-1)
            return _inside(np.floor(pixels.min(axis=1)), np.ceil(pixels.max(axis=1)) + 1, scan)
    return _sampled_boxes(scan, sample, plane, centres, reach_mm)


def _sampled_boxes(
    scan: Scan, sample: Thinned, plane: Plane, centres: Array, reach_mm: float
) -> tuple[IntArray, IntArray]:
    """The same for a camera that nothing is known of: from the pixels of the thinned scan."""
    seen, pixels = seen_at(sample.points, plane, scan.viewpoint), sample.pixels()
    low, high = np.zeros((2, len(centres), 2))
    for k, centre in enumerate(centres):
        about = np.abs(seen - centre)
        close = pixels[(about[:, 0] < reach_mm) & (about[:, 1] < reach_mm)]
        if len(close):
            low[k], high[k] = close.min(axis=0) - sample.stride, close.max(axis=0) + sample.stride + 1
    return _inside(low, high, scan)


def plane_of_pixel(scan: Scan, sample: Thinned, plane: Plane) -> Array | None:
    """Homography (3, 3) from (column, row) to where a pixel's line of sight crosses the plane, mm in its axes.

    A pinhole's pixels map so exactly; with other lenses it is the best fit to what was returned, and None where that
    is worse than a fifth of the distance of neighbouring pixels.
    """
    if scan.viewpoint is None or len(sample.points) < _HOMOGRAPHY_MIN:
        return None
    some = slice(None, None, len(sample.points) // _HOMOGRAPHY_POINTS + 1)
    pixels = np.asarray(sample.pixels()[some, ::-1], np.float64)
    seen = seen_at(sample.points[some], plane, scan.viewpoint)
    answer, _ = cv2.findHomography(pixels, seen, 0)
    if answer is None:
        return None
    homography, mapped = np.asarray(answer, np.float64), _mapped(np.asarray(answer, np.float64), pixels)
    beside = _mapped(homography, pixels + np.array([1.0, 0.0]))
    off, pitch_mm = np.abs(mapped - seen).max(axis=1), np.abs(beside - mapped).max(axis=1)
    return homography if median(off) < _HOMOGRAPHY_WITHIN * median(pitch_mm) else None


def _mapped(homography: Array, pixels: Array) -> Array:
    lifted = np.column_stack([pixels, np.ones(len(pixels))]) @ homography.T
    return np.asarray(lifted[:, :2] / lifted[:, 2:])


def _crossings(homography: Array, low: IntArray, high: IntArray, centres: Array) -> tuple[FloatArray, FloatArray]:
    """Crossings (k, n) float32, mm, of all pixels of the boxes about their centres; NaN in the padding."""
    height, width = (high - low).max(axis=0, initial=0)
    seen = np.full((2, len(centres), height, width), np.nan, np.float32)
    for k, (first, last) in enumerate(zip(low, high, strict=True)):
        rows, columns = np.mgrid[first[0] : last[0], first[1] : last[1]]
        at = _mapped(homography, np.column_stack([columns.ravel(), rows.ravel()])) - centres[k]
        seen[:, k, : rows.shape[0], : rows.shape[1]] = at.T.reshape(2, *rows.shape)
    x, y = seen.reshape(2, len(centres), height * width)
    return x, y


def _inside(low: Array, high: Array, scan: Scan) -> tuple[IntArray, IntArray]:
    size = np.array(scan.points.shape[:2])
    first = np.clip(low, 0, size).astype(np.int64)
    return first, np.maximum(np.clip(high, 0, size).astype(np.int64), first)


def _windows(
    points: FloatArray, low: IntArray, high: IntArray, plane: Plane, centres: Array
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pixels of boxes in the plane's axes, each (k, n) float32 about its centre; boxes are padded to one size.

    Their origin is moved before they are turned, so that single precision is enough.
    """
    axes = axes_on(plane).T.astype(np.float32)
    height, width = (high - low).max(axis=0, initial=0)
    origin = from_plane(np.column_stack([centres, np.zeros(len(centres))]), plane)
    patch = np.full((3, len(centres), height, width), np.nan, np.float32)
    for k, (first, last) in enumerate(zip(low, high, strict=True)):
        window = points[first[0] : last[0], first[1] : last[1]]
        rows, columns = window.shape[:2]
        about = (window - origin[k].astype(window.dtype)).astype(np.float32, copy=False)
        patch[:, k, :rows, :columns] = (about.reshape(-1, 3) @ axes).T.reshape(3, rows, columns)
    x, y, z = patch.reshape(3, len(centres), height * width)
    return x, y, z


def _gathered(
    scan: Scan, plane: Plane, centres: Array, appear: Array, reach_mm: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The same for clouds, each (k, n) float32, padded to the longest; ``appear`` (k, 2) is where each is seen."""
    low = appear.min(axis=0) - reach_mm - 2 * _LABEL_CELL_MM
    shape = np.ceil((appear.max(axis=0) + reach_mm - low) / _LABEL_CELL_MM).astype(int) + 2
    labels = _painted(appear - low, reach_mm, shape)
    kept_points, kept_labels = [], []
    for begin in range(0, len(scan.points), _CHUNK):
        chunk = scan.points[begin : begin + _CHUNK].astype(np.float64)
        cells = (seen_at(chunk, plane, scan.viewpoint) - low) / _LABEL_CELL_MM
        chosen = np.flatnonzero(((cells >= 0) & (cells < shape)).all(axis=1))
        label = labels[cells[chosen, 0].astype(np.intp), cells[chosen, 1].astype(np.intp)]
        kept_points.append(in_plane(chunk[chosen[label >= 0]], plane))
        kept_labels.append(label[label >= 0])
    gathered, owner = np.concatenate(kept_points), np.concatenate(kept_labels)
    order = np.argsort(owner, kind="stable")
    gathered, owner = gathered[order], owner[order]
    gathered[:, :2] -= centres[owner]
    counts = np.bincount(owner, minlength=len(centres))
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    patch = np.full((3, len(centres), int(counts.max(initial=0))), np.nan, np.float32)
    patch[:, owner, rank] = gathered.T
    return patch[0], patch[1], patch[2]


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
