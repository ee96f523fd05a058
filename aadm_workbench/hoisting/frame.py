"""A hoisting frame as an image of rays: every pixel a ray through the eye, with the point that it returned.

The foot of a hanging column is seen at grazing incidence, so *where a ray passes* tells more of an edge than where
points lie. Depth maps are such images already. Of an organised cloud without intrinsics the lens follows from the
points; a cloud without rows and columns is laid on the image of a lens that would have seen it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.model import OPENGL_AXES, Array, BoolArray, FloatArray, Reason, Scan

_SAMPLE = 20_000  # points: enough for the two numbers of a lens along each side, and for quantiles
# median: a pinhole's pixels are off by rounding alone; lenses that bend the picture more need intrinsics
_LENS_MISFIT_PIXELS = 2.0
_FEWEST_POINTS = 500  # of the 80,000 that are looked at: what shows less shows no column
_WIDEST_TANGENT = 3.0  # 72 degrees to either side: no such camera sees wider
_RASTER_PIXELS = 2_500_000  # about a picture of 1920 × 1200


@dataclass(frozen=True, eq=False)
class HoistingFrame:
    """Points (h, w, 3) in mm, in the axes of a pinhole camera at the origin; NaN where a ray returned nothing.

    ``T_scan_frame`` (4, 4) leads back to the scan frame. ``lens`` holds (fx, fy, cx, cy) in pixels.
    """

    points: FloatArray
    lens: tuple[float, float, float, float]
    T_scan_frame: Array

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.points.shape[0], self.points.shape[1]

    def pixels_of(self, points: Array) -> Array:
        """Pixels (n, 2) as (column, row) at which points (n, 3) with z > 0 appear."""
        fx, fy, cx, cy = self.lens
        return np.column_stack([points[:, 0] / points[:, 2] * fx + cx, points[:, 1] / points[:, 2] * fy + cy])

    def rays(self, rows: slice, columns: slice) -> Array:
        """Directions (h, w, 3) with z = 1 of the pixels of a window."""
        fx, fy, cx, cy = self.lens
        height, width = self.shape
        u = (np.arange(width)[columns] - cx) / fx
        v = (np.arange(height)[rows] - cy) / fy
        return np.stack([*np.broadcast_arrays(u[None, :], v[:, None]), np.ones((len(v), len(u)))], axis=-1)

    def to_scan(self, points: Array) -> Array:
        """Points (n, 3) mm in the scan frame."""
        return np.asarray(points @ self.T_scan_frame[:3, :3].T + self.T_scan_frame[:3, 3])


@dataclass(frozen=True, eq=False)
class LocalAxes:
    """Axes of a part in the frame: ``axes`` (3, 3) rows are x, y and z, ``origin`` (3,) mm is their origin.

    ``local = (p - origin) @ axes.T`` for points p of the frame.
    """

    axes: Array
    origin: Array

    @property
    def eye(self) -> Array:
        """The camera (3,), mm, in these axes."""
        return np.asarray(self.axes @ -self.origin)

    def local(self, points: Array) -> Array:
        """Points (..., 3) of the frame in these axes."""
        return np.asarray((points - self.origin) @ self.axes.T)

    def to_frame(self, local: Array) -> Array:
        """The inverse of :meth:`local`."""
        return np.asarray(local @ self.axes + self.origin)

    def along(self, z: Array) -> LocalAxes:
        """The axes turned the shortest way so that their z is the unit vector (3,) z, given in these axes."""
        x = np.array([1.0, 0.0, 0.0]) - z[0] * z
        x /= np.linalg.norm(x)
        return LocalAxes(np.vstack([x, np.cross(z, x), z]) @ self.axes, self.origin)


@dataclass(frozen=True)
class NoFrame:
    """Why a scan cannot be looked at as an image of rays."""

    reason: str


def frame_of(scan: Scan) -> HoistingFrame | NoFrame:
    """The scan as an image of rays.

    Parameters
    ----------
    scan
        Points in mm, scan frame. Without camera and viewpoint a cloud counts as seen from the origin of its frame
        where it lies on one side of it, as the clouds of structured-light cameras do.

    Returns
    -------
    HoistingFrame, whose ``T_scan_frame`` leads to the coordinates of the scan's file, or NoFrame with the reason.
    """
    frame = _rays_of(scan)
    if isinstance(frame, NoFrame) or scan.axes != OPENGL_AXES:
        return frame
    T_file_scan = np.eye(4)
    T_file_scan[:3, :3] = scan.R_file_scan
    return replace(frame, T_scan_frame=T_file_scan @ frame.T_scan_frame)


def _rays_of(scan: Scan) -> HoistingFrame | NoFrame:
    if scan.camera is not None and scan.organised:
        camera = scan.camera
        return HoistingFrame(scan.points, (camera.fx, camera.fy, camera.cx, camera.cy), np.eye(4))
    sample, pixels = _sampled(scan.points)
    if len(sample) < _FEWEST_POINTS:
        return NoFrame(Reason("hoisting.empty"))
    eye = np.zeros(3) if scan.viewpoint is None else np.asarray(scan.viewpoint, np.float64)
    if pixels is not None and not eye.any():
        lens = _lens_of(sample, pixels)
        if lens is not None:
            return HoistingFrame(scan.points, lens, np.eye(4))
    rotation = _facing_along(sample - eye)
    if rotation is None:
        return NoFrame(Reason("hoisting.no_viewpoint"))
    return _laid_out(scan, eye, rotation)


def _sampled(points: FloatArray) -> tuple[Array, Array | None]:
    """Finite points (n, 3) spread over the scan, and of an organised one their (column, row)."""
    flat = points.reshape(-1, 3)
    index = np.arange(0, len(flat), max(1, len(flat) // (4 * _SAMPLE)))
    index = index[np.isfinite(flat[index]).all(axis=1)]
    pixels = None
    if points.ndim == 3:
        pixels = np.column_stack([index % points.shape[1], index // points.shape[1]]).astype(np.float64)
    return flat[index].astype(np.float64), pixels


def _lens_of(sample: Array, pixels: Array) -> tuple[float, float, float, float] | None:
    """The pinhole lens of an organised cloud; None where its pixels do not follow one."""
    ahead = sample[:, 2] > 0
    # one point in a hundred may be astray
    if ahead.mean() < 0.99:
        return None
    lens = []
    for axis in (0, 1):
        slope = sample[ahead, axis] / sample[ahead, 2]
        system = np.column_stack([slope, np.ones(len(slope))])
        (focal, centre), *_ = np.linalg.lstsq(system, pixels[ahead, axis], rcond=None)
        if np.median(np.abs(system @ [focal, centre] - pixels[ahead, axis])) > _LENS_MISFIT_PIXELS or abs(focal) < 1.0:
            return None
        lens += [float(focal), float(centre)]
    return lens[0], lens[2], lens[1], lens[3]


def _facing_along(about_eye: Array) -> Array | None:
    """Rotation (3, 3), rows x, y, z of a camera at the eye that has points (n, 3) in its view; None if none has."""
    distance = np.linalg.norm(about_eye, axis=1)
    seen = about_eye[distance > 1e-6] / distance[distance > 1e-6, None]
    forward = np.median(seen, axis=0)
    if np.linalg.norm(forward) < 0.5:
        return None
    forward /= np.linalg.norm(forward)
    # what looks ahead by so much looks through a camera's own axes
    if forward[2] > np.cos(np.radians(30.0)):
        forward = np.array([0.0, 0.0, 1.0])  # a cloud in camera axes keeps them
    tangent = np.tan(np.arccos(np.clip(np.quantile(seen @ forward, 0.01), -1.0, 1.0)))
    if not 0.0 < tangent < _WIDEST_TANGENT:
        return None
    # 26 degrees from straight along y, where there is no down in the picture
    down = np.array([0.0, 1.0, 0.0]) if abs(forward[1]) < 0.9 else np.array([0.0, 0.0, -1.0])
    right = np.cross(down, forward)
    right /= np.linalg.norm(right)
    return np.vstack([right, np.cross(forward, right), forward])


def _laid_out(scan: Scan, eye: Array, rotation: Array) -> HoistingFrame:
    """A cloud on the image of a lens with about as many pixels as it has points; the nearest point wins a pixel."""
    flat = scan.points.reshape(-1, 3)
    local = ((flat - eye.astype(flat.dtype)) @ rotation.T.astype(flat.dtype)).astype(np.float32)
    local = local[np.isfinite(local).all(axis=1) & (local[:, 2] > 0)]
    plan = local[:, :2] / local[:, 2:]
    # one in a thousand may fly
    low, high = np.quantile(plan[:: max(1, len(plan) // _SAMPLE)], [0.001, 0.999], axis=0)
    kept = _within(plan, low - 0.01, high + 0.01)
    local, plan = local[kept], plan[kept]
    focal = _focal_of(plan, low, high)
    pixels = np.rint((plan - (low - 0.01)) * focal).astype(np.int64)
    columns, rows = pixels.max(axis=0) + 1
    image = np.full((rows, columns, 3), np.nan, np.float32)
    order = np.argsort(-local[:, 2], kind="stable")
    image[pixels[order, 1], pixels[order, 0]] = local[order]
    # The rays are those of the points, not of the pixels' middles: half a pixel at most between them.
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation.T, eye
    return HoistingFrame(image, (focal, focal, *(-(low - 0.01) * focal)), pose)


def _within(plan: FloatArray, low: Array, high: Array) -> BoolArray:
    return np.asarray(((plan > low) & (plan < high)).all(axis=1))


def _focal_of(plan: FloatArray, low: Array, high: Array) -> float:
    """Focal length, pixels, of an image whose pixels are as dense as the points in the fullest part of the view."""
    # cells along the longer side: of some pixels each
    cells = np.floor((plan - low) / (high - low).max() * 200.0).astype(np.int64)
    # more than cells: no two share a number
    counts = np.unique(cells[:, 0] * 100_003 + cells[:, 1], return_counts=True)[1]
    full = float(np.percentile(counts, 90))
    # the cells from above
    focal = 200.0 * np.sqrt(full) / float((high - low).max())
    # with the margin of 0.01 at either side
    largest = np.sqrt(_RASTER_PIXELS / float(np.prod(high - low + 0.02)))
    return float(min(focal, largest))
