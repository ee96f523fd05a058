"""Where a scan was asked whether the face is there: lines of sight of a camera, or cells of a cloud."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from aadm_workbench.extract.patches import plane_of_pixel
from aadm_workbench.extract.plane import from_plane, in_plane
from aadm_workbench.extract.sample import Thinned, point_pitch_mm
from aadm_workbench.model import Array, Plane, Scan

_CELL_PITCHES = 1.6  # fewer than one cell in ten of a sound face then stays empty by chance
_LOOK_MM = 60.0  # beyond the outline: what is farther away is no part of the foot
_CELLS_MAX = 4_000_000  # 4 MB: feet of 2 m at 1 mm


@dataclass(frozen=True, eq=False)
class Asked:
    """n places ``xy`` (n, 2) mm in the face's axes; ``height`` (n,) mm of what returned there, NaN for nothing."""

    xy: Array
    height: Array


Ask: TypeAlias = Callable[[Array], Asked]
"""Asks at all places of the scan that lie at (n, 2) mm, or nearest to these; none is given twice."""


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
    homography = plane_of_pixel(scan, sample, face) if sample.taken is not None else None
    if homography is not None:
        return FaceSamples(_by_lines_of_sight(scan, face, homography), pitch_mm, eye)
    # The cell of the last point ends half a cell beyond it on average, and the face half a pitch.
    wider_mm = (_CELL_PITCHES - 1.0) * pitch_mm / 2.0
    return FaceSamples(_by_cells(scan, face, band_mm, outline, pitch_mm), _CELL_PITCHES * pitch_mm, None, wider_mm)


def _by_lines_of_sight(scan: Scan, face: Plane, homography: Array) -> Ask:
    back = np.asarray(np.linalg.inv(homography), np.float64)
    rows, columns = scan.points.shape[:2]

    def ask(places: Array) -> Asked:
        at = np.rint(_through(back, places)).astype(np.int64)
        inside = (at >= 0).all(axis=1) & (at[:, 0] < columns) & (at[:, 1] < rows)
        number = np.unique(at[inside, 1] * columns + at[inside, 0])
        row, column = np.divmod(number, columns)
        xy = _through(homography, np.column_stack([column, row]).astype(np.float64))
        return Asked(xy, np.asarray(face.height(scan.points[row, column]), np.float64))

    return ask


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

    def ask(places: Array) -> Asked:
        cell = np.floor((places - low) / cell_mm).astype(np.int64)
        inside = (cell >= 0).all(axis=1) & (cell[:, 0] < columns) & (cell[:, 1] < rows)
        row, column = np.divmod(np.unique(cell[inside, 1] * columns + cell[inside, 0]), columns)
        xy: Array = low + (np.column_stack([column, row]) + 0.5) * cell_mm
        return Asked(xy, np.where(filled[row, column], 0.0, np.nan))

    return ask


def outline_on_face(corners: Array, T_scan_column: Array, face: Plane) -> Array:
    """Corners (n, 2) mm of the column frame, at the height of the foot, in the face's axes: (n, 2)."""
    lifted = np.column_stack([corners, np.zeros(len(corners))])
    return in_plane(lifted @ T_scan_column[:3, :3].T + T_scan_column[:3, 3], face)[:, :2]


def from_face(places: Array, face: Plane) -> Array:
    """Places (n, 2) mm in the face's axes as points (n, 3) mm of the scan frame."""
    return from_plane(np.column_stack([places, np.zeros(len(places))]), face)
