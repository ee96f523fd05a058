"""What the camera sees of each sleeve of a hanging foot: rays through its mouth, the face around it, its far wall.

A camera beside the bars looks along the face. A ray that ends behind the face passed through a mouth wherever it ended:
it is known to lie inside, whatever the wall's returns are worth. A ray that ends on the face lies outside. Between them
runs the edge: on the far side without any step in depth, on the near side with one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.model import Array, BoolArray, IntArray

_MARGIN_MM = 7.0  # about a mouth: the face is counted up to 6.5 mm beyond the rim (hoisting/foot/fit.py)
NOISE_SIGMAS = 3.0
"""A point this many standard deviations behind the face is behind it: one in 740 of the face's own is farther."""
SECTORS = 24
"""Of a mouth, 15 degrees each: a tape or a clump of mortar covers some of them, and leaves the others whole."""
_PITCH_PIXELS = 400  # of a window: from one to the next a pitch changes by less than a hundredth
_COVERED_SHARE = 0.2  # of the rays of a sector: pixels that fly are fewer; a choice: ±30 % moves nothing on sound scans


@dataclass(frozen=True, eq=False)
class _Level:
    """The plane that touches a face at one of its mouths, ``about`` (2,) mm; heights are counted from it."""

    height_mm: float
    slopes: Array
    about: Array

    def above(self, points: Array) -> Array:
        """Points (..., 3) mm in the axes of the face, with their heights above that plane."""
        height = points[..., 2] - self.height_mm - (points[..., :2] - self.about) @ self.slopes
        return np.concatenate([points[..., :2], height[..., None]], axis=-1)

    def turned(self, directions: Array) -> Array:
        """The same of directions (..., 3)."""
        climb = directions[..., 2] - directions[..., :2] @ self.slopes
        return np.concatenate([directions[..., :2], climb[..., None]], axis=-1)


@dataclass(frozen=True, eq=False)
class MouthView:
    """One mouth in the axes of the face, mm; heights are those above the face there.

    Parameters
    ----------
    points
        (n, 3): what returned.
    crossing
        (n, 2): where the rays of these points cross the face.
    slope
        (n, 2): how far a point moves in the plan per mm along its ray.
    rays
        (m, 2): where all rays cross the face, those that returned nothing too.
    pixel
        (2, 2): columns are how far the crossing moves from row to row, and from column to column.
    range_mm
        How far the mouth is from the camera.
    """

    points: Array
    crossing: Array
    slope: Array
    rays: Array
    pixel: Array
    range_mm: float

    def radial_pitch(self, outward: Array) -> Array:
        """Width (n,) mm of a pixel along directions (n, 2)."""
        return np.asarray(np.abs(outward @ self.pixel).sum(axis=1))


def view_mouth(frame: HoistingFrame, face: FootFace, centre: Array, radius_mm: float) -> MouthView | None:
    """All rays around one mouth; None where it is out of the picture."""
    window = window_about(frame, face, centre, radius_mm)
    if window is None:
        return None
    rows, columns = window
    level = _Level(*face.level(centre), centre)
    eye = level.above(face.eye)
    rays = level.turned(frame.rays(rows, columns) @ face.axes.T)
    upward = rays[..., 2] > 1e-6
    reach = np.where(upward, -eye[2] / np.where(upward, rays[..., 2], 1.0), np.nan)
    crossing = eye[:2] + rays[..., :2] * reach[..., None]
    points = level.above(face.local(frame.points[rows, columns].astype(np.float64)))
    within = np.hypot(crossing[..., 0] - centre[0], crossing[..., 1] - centre[1]) < radius_mm + _MARGIN_MM
    if not within.any():
        return None
    pixel = _pixel(crossing, within)
    returned = within & np.isfinite(points[..., 2])
    chosen = points[returned]
    # A point's own ray and not its pixel's: a cloud that was laid on an image is up to half a pixel beside it.
    direction = chosen - eye
    passing = eye[:2] - direction[:, :2] * (eye[2] / direction[:, 2])[:, None]
    slope = direction[:, :2] / np.linalg.norm(direction, axis=1)[:, None]
    range_mm = float(np.linalg.norm(eye - np.append(centre, 0.0)))
    return MouthView(chosen, passing, slope, crossing[within], pixel, range_mm)


def window_about(frame: HoistingFrame, face: FootFace, centre: Array, radius_mm: float) -> tuple[slice, slice] | None:
    """Rows and columns whose rays cross the face about a mouth."""
    reach = radius_mm + _MARGIN_MM
    turn = np.linspace(0.0, 2 * np.pi, 16, endpoint=False)
    ring = np.column_stack([centre[0] + reach * np.cos(turn), centre[1] + reach * np.sin(turn), np.zeros(16)])
    around = face.to_frame(ring)
    if (around[:, 2] <= 1.0).any():
        return None
    pixels = frame.pixels_of(around)
    low = np.floor(pixels.min(axis=0)).astype(int)
    high = np.ceil(pixels.max(axis=0)).astype(int) + 1
    height, width = frame.shape
    low, high = np.maximum(low, 0), np.minimum(high, [width, height])
    if (high - low < 3).any():
        return None
    return slice(low[1], high[1]), slice(low[0], high[0])


def window_over(frame: HoistingFrame, face: FootFace, centres: Array, radius_mm: float) -> tuple[slice, slice]:
    """Rows and columns that hold all mouths (k, 2) mm that are in the picture."""
    windows = [window_about(frame, face, centre, radius_mm) for centre in centres]
    known = [window for window in windows if window is not None]
    if not known:
        return slice(0, 0), slice(0, 0)
    rows, columns = (slice(min(w[k].start for w in known), max(w[k].stop for w in known)) for k in (0, 1))
    return rows, columns


def _pixel(crossing: Array, within: BoolArray) -> Array:
    """How far the crossing moves from row to row and from column to column, at the middle of a window."""
    nth = max(1, int(np.sqrt(within.size / _PITCH_PIXELS)))
    down = (crossing[1::nth, ::nth] - crossing[:-1:nth, ::nth])[within[1::nth, ::nth] & within[:-1:nth, ::nth]]
    right = (crossing[::nth, 1::nth] - crossing[::nth, :-1:nth])[within[::nth, 1::nth] & within[::nth, :-1:nth]]
    steps = [np.median(step, axis=0) if len(step) else np.full(2, 1.0) for step in (down, right)]
    return np.column_stack(steps)


def sector_of(about: Array) -> IntArray:
    """Sector (n,) of a mouth in which points (n, 2) about its centre lie."""
    turn = np.arctan2(about[:, 1], about[:, 0]) / (2 * np.pi) + 0.5
    return np.asarray((turn * SECTORS).astype(np.int64) % SECTORS)


def open_sectors(view: MouthView, centre: Array, radius_mm: float, noise_mm: float) -> BoolArray:
    """Which sectors (24,) of a mouth let rays through up to the rim."""
    about = view.crossing - centre
    distance = np.hypot(about[:, 0], about[:, 1])
    outward = about / np.maximum(distance, 1e-9)[:, None]
    # clear of chamfers, and of the pixel on the edge
    inner = radius_mm - np.maximum(1.5, 1.3 * view.radial_pitch(outward))
    # the middle tells nothing of what covers the rim
    within = (distance < inner) & (distance > 0.3 * radius_mm)
    stopped = within & (view.points[:, 2] < NOISE_SIGMAS * noise_mm)
    passed = within & (view.points[:, 2] > NOISE_SIGMAS * noise_mm)
    sector = sector_of(about)
    closed = np.bincount(sector[stopped], minlength=SECTORS)
    open_ = np.bincount(sector[passed], minlength=SECTORS)
    covered = (closed >= 2) & (closed > _COVERED_SHARE * (closed + open_))
    covered = covered | np.roll(covered, 1) | np.roll(covered, -1)
    covered = covered | np.roll(covered, 1) | np.roll(covered, -1)
    return np.asarray(~covered)
