"""Where a scan was asked whether the face is there: lines of sight of a camera, or cells of a cloud.

What a camera leaves out at the rims of mouths in the same face, whose bores are known.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from aadm_workbench.extract.patches import plane_of_pixel
from aadm_workbench.extract.plane import from_plane, in_plane
from aadm_workbench.extract.sample import Thinned, point_pitch_mm
from aadm_workbench.model import Array, BoolArray, IntArray, Plane, Scan
from aadm_workbench.model.special import distinct

_CELL_PITCHES = 1.6  # fewer than one cell in ten of a sound face then stays empty by chance
_LOOK_MM = 60.0  # beyond the outline: what is farther away is no part of the foot
_LINES_OF_SIGHT = 1500  # of a pinhole eight numbers are sought; of other lenses it is asked how far they are off
_CELLS_MAX = 4_000_000  # 4 MB: feet of 2 m at 1 mm


@dataclass(frozen=True, eq=False)
class Asked:
    """n places ``xy`` (n, 2) mm in the face's axes; ``height`` (n,) mm of what returned there, NaN for nothing."""

    xy: Array
    height: Array


@dataclass(frozen=True, eq=False)
class Area:
    """A rectangle on the face, mm in its axes: ``half_mm`` to both sides of ``middle`` (2,) along ``along`` (2,).

    And ``reach_mm`` to both sides across; of places along and across, each so many-th (``every``) is asked.
    """

    middle: Array
    along: Array
    half_mm: float
    reach_mm: float
    every: tuple[int, int] = (1, 1)


Ask: TypeAlias = Callable[[Area], Asked]
"""Asks at places of the scan in an area, and at some about it; none is given twice."""


@dataclass(frozen=True, eq=False)
class FaceSamples:
    """What can be asked of a face; places are ``pitch_mm`` apart.

    ``slope_at`` gives how far the lines of sight run in the plan per mm of depth at places (n, 2): (n, 2), zero where
    nobody knows from where the scan was taken. ``wider_mm`` is by how much a face looks wider at each edge for the way
    in which it is asked.
    """

    ask: Ask
    pitch_mm: float
    eye: Array | None
    wider_mm: float = 0.0

    def slope_at(self, places: Array) -> Array:
        """Slopes (n, 2), mm per mm, away from the camera's foot point."""
        if self.eye is None:
            return np.zeros_like(places)
        return np.asarray((places - self.eye[:2]) / abs(float(self.eye[2])))


def face_samples(scan: Scan, sample: Thinned, face: Plane, band_mm: float, outline: Array) -> FaceSamples | None:
    """The face as it can be asked for within some cm of an outline (n, 2) mm; None where too few points lie on it."""
    local = in_plane(sample.points, face)
    local = local[np.abs(local[:, 2]) < band_mm, :2]
    if len(local) < 50:  # as many as a plane needs
        return None
    pitch_mm = point_pitch_mm(sample, local)
    eye = None if scan.viewpoint is None else in_plane(scan.viewpoint[None], face)[0]
    homography = plane_of_pixel(scan, _sparser(sample), face)
    if homography is not None:
        return FaceSamples(_by_lines_of_sight(scan, face, homography), pitch_mm, eye)
    # The cell of the last point ends half a cell beyond it on average, and the face half a pitch.
    wider_mm = (_CELL_PITCHES - 1.0) * pitch_mm / 2.0
    return FaceSamples(_by_cells(scan, face, band_mm, outline, pitch_mm), _CELL_PITCHES * pitch_mm, None, wider_mm)


def _sparser(sample: Thinned) -> Thinned:
    """Fewer pixels of a thinned scan: where lines of sight of a pinhole run, a thousand tell as well as all."""
    if sample.taken is None:
        return sample
    chosen = np.zeros_like(sample.taken)
    every = int(np.sqrt(len(sample.points) / _LINES_OF_SIGHT)) + 1
    chosen[::every, ::every] = sample.taken[::every, ::every]
    return replace(sample, points=sample.points[chosen[sample.taken]], taken=chosen)


def _by_lines_of_sight(scan: Scan, face: Plane, homography: Array) -> Ask:
    back = np.asarray(np.linalg.inv(homography), np.float64)

    def ask(area: Area) -> Asked:
        row, column = _pixels_in(area, back, scan.points.shape[:2])
        right, down = column.astype(np.float64), row.astype(np.float64)
        x, y, w = (one * right + other * down + rest for one, other, rest in homography.tolist())
        return Asked(np.column_stack([x / w, y / w]), np.asarray(face.height(scan.points[row, column]), np.float64))

    return ask


def _pixels_in(area: Area, back: Array, shape: tuple[int, ...]) -> tuple[IntArray, IntArray]:
    """Rows and columns (n,) of pixels: of each line of pixels that crosses an area those about its middle line."""
    across = np.array([-area.along[1], area.along[0]])
    begin, end = _through(back, area.middle + area.half_mm * np.array([[-1.0], [1.0]]) * area.along)
    aside = np.abs(np.subtract(*_through(back, area.middle + area.reach_mm * np.array([[-1.0], [1.0]]) * across))) / 2.0
    main = int(np.argmax(np.abs(end - begin)))  # 0: the area runs along rows
    run = end[main] - begin[main]
    slope = (end[1 - main] - begin[1 - main]) / run
    reach = aside[1 - main] + abs(slope) * aside[main] + 1.0
    first, last = sorted((begin[main], end[main]))
    line = np.arange(max(int(np.floor(first)), 0), min(int(np.ceil(last)), shape[1 - main] - 1) + 1, area.every[0])
    middle = np.rint(begin[1 - main] + slope * (line - begin[main])).astype(np.int64)
    beside = middle + np.arange(-int(reach), int(reach) + 1, area.every[1])[:, None]
    inside = (beside >= 0) & (beside < shape[main])
    lines = np.broadcast_to(line, beside.shape)[inside]
    return (beside[inside], lines) if main == 0 else (lines, beside[inside])


def _through(homography: Array, places: Array) -> Array:
    lifted = np.column_stack([places, np.ones(len(places))]) @ homography.T
    return np.asarray(lifted[:, :2] / lifted[:, 2:])


def _by_cells(scan: Scan, face: Plane, band_mm: float, outline: Array, pitch_mm: float) -> Ask:
    """A cloud on a raster: a cell with a point of the face in it is face."""
    low = outline.min(axis=0) - _LOOK_MM
    size = np.ptp(outline, axis=0) + 2.0 * _LOOK_MM
    cell_mm = max(_CELL_PITCHES * pitch_mm, float(np.sqrt(np.prod(size) / _CELLS_MAX)))
    columns, rows = np.ceil(size / cell_mm).astype(np.int64) + 1
    filled = np.zeros((rows, columns), bool)
    points = scan.points.reshape(-1, 3)
    points = points[np.abs(face.height(points)) < band_mm]
    at = np.floor((in_plane(points, face)[:, :2] - low) / cell_mm).astype(np.int64)
    at = at[(at >= 0).all(axis=1) & (at[:, 0] < columns) & (at[:, 1] < rows)]
    filled[at[:, 1], at[:, 0]] = True

    def ask(area: Area) -> Asked:
        cell = np.floor((_grid(area, cell_mm) - low) / cell_mm).astype(np.int64)
        inside = (cell >= 0).all(axis=1) & (cell[:, 0] < columns) & (cell[:, 1] < rows)
        row, column = np.divmod(distinct(cell[inside, 1] * columns + cell[inside, 0]), columns)
        xy: Array = low + (np.column_stack([column, row]) + 0.5) * cell_mm
        return Asked(xy, np.where(filled[row, column], 0.0, np.nan))

    return ask


def _grid(area: Area, step_mm: float) -> Array:
    """Places (n, 2) mm in an area."""
    across = np.array([-area.along[1], area.along[0]])
    along_mm, across_mm = (step_mm * many for many in area.every)
    # Half a step more than the reach: so that its end is among them.
    s, d = np.meshgrid(
        np.arange(-area.half_mm, area.half_mm + along_mm, along_mm),
        np.arange(-area.reach_mm - across_mm, area.reach_mm + across_mm + across_mm / 2.0, across_mm),
    )
    return np.asarray(area.middle + np.outer(s.ravel(), area.along) + np.outer(d.ravel(), across))


def outline_on_face(corners: Array, T_scan_column: Array, face: Plane) -> Array:
    """Corners (n, 2) mm of the column frame, at the height of the foot, in the face's axes: (n, 2)."""
    lifted = np.column_stack([corners, np.zeros(len(corners))])
    return in_plane(lifted @ T_scan_column[:3, :3].T + T_scan_column[:3, 3], face)[:, :2]


def from_face(places: Array, face: Plane) -> Array:
    """Places (n, 2) mm in the face's axes as points (n, 3) mm of the scan frame."""
    return from_plane(np.column_stack([places, np.zeros(len(places))]), face)


_WITHIN_SHARE = 0.5  # of the strip on the side of the face: how densely it is found there
_FOUND_MIN, _FLUSH_MAX = 0.25, 0.15  # thinner is no face; denser is something that goes on beyond the edge
_RIMS = 3  # mouths nearest to an edge: some are plugged, or cut by the picture
_FEWEST_PLACES = 50  # a share, or a scatter, of fewer is no measure
_RIM_SECTOR = np.radians(50.0)  # of a rim about the direction of an edge
_RIM_REACH_MM = 6.0  # as of edges; less than half a mouth
_RING_PITCHES = 0.5  # wide: a third of a rim then has some twenty places in each, and an end is known to a quarter
_RING_SHARE = 0.12  # of how densely the face is found: cameras that lose pixels at steps by chance keep half of them


@dataclass(frozen=True, eq=False)
class KnownMouths:
    """Mouths in the same face: ``centres`` (k, 2) mm in its axes, ``radii`` (k,) mm of their bores."""

    centres: Array
    radii: Array


def taken_in(samples: FaceSamples, place: Array, normal: Array, band_mm: float) -> float:
    """How far, mm, beyond an edge at a place (2,) lines of sight still find the wall behind it within the band."""
    return band_mm * max(-float(samples.slope_at(place) @ normal), 0.0)


def lost_at_rim(samples: FaceSamples, mouths: KnownMouths, normal: Array, band_mm: float) -> float | None:
    """How far, mm, before the rim of a mouth that ends it towards a direction the face is lost altogether.

    That of the outermost mouth with enough of a rim; None where there is none. What a camera loses at edges by chance
    is seen at the edge itself, and is no matter of this.
    """
    for number in np.argsort(-mouths.centres @ normal, kind="stable")[:_RIMS]:
        centre, radius = mouths.centres[number], float(mouths.radii[number])
        end = _rim_end(samples, centre, radius, normal, band_mm)
        if end is not None:
            taken_mm = taken_in(samples, centre - radius * normal, normal, band_mm)
            return max(end - radius + taken_mm - _RING_PITCHES * samples.pitch_mm / 2.0, 0.0)
    return None


def _rim_end(samples: FaceSamples, centre: Array, radius_mm: float, normal: Array, band_mm: float) -> float | None:
    """Distance from the centre of the last returns before a rim, in the sector that ends it towards ``normal``."""
    reach_mm = min(_RIM_REACH_MM, 0.45 * radius_mm)  # clear of the middle, which belongs to no side
    half_mm = (radius_mm + reach_mm) / 2.0
    across = np.array([-normal[1], normal[0]])
    asked = samples.ask(Area(centre - half_mm * normal, across, 2.0 * half_mm, half_mm))
    about = asked.xy - centre
    wanted = _in_sector(about, radius_mm, reach_mm, normal)
    distance, on = np.hypot(*about[wanted].T), np.abs(asked.height[wanted]) < band_mm
    if len(on) < _FEWEST_PLACES:
        return None
    found = on[distance > radius_mm + _WITHIN_SHARE * reach_mm].mean()
    stray = on[distance < radius_mm - _WITHIN_SHARE * reach_mm].mean()
    if found < _FOUND_MIN or stray > _FLUSH_MAX:
        return None
    ring_mm = _RING_PITCHES * samples.pitch_mm
    ring = ((distance - radius_mm + reach_mm) / ring_mm).astype(int)
    asked_of, found_of = np.bincount(ring), np.bincount(ring, on)
    dense = found_of > _RING_SHARE * found * np.maximum(asked_of, 1)
    inward = np.flatnonzero(~dense)
    # The innermost ring from which on the face goes on outwards.
    first = 0 if len(inward) == 0 else int(inward[-1]) + 1
    return float(radius_mm - reach_mm + first * ring_mm)


def _in_sector(about: Array, radius_mm: float, reach_mm: float, normal: Array) -> BoolArray:
    distance = np.hypot(*about.T)
    near = np.abs(distance - radius_mm) < reach_mm
    return np.asarray(near & (-about @ normal > np.cos(_RIM_SECTOR) * distance))
