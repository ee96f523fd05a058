"""A foot whose face is no plane: bowed or twisted in its mould by some millimetres.

Seen along, a face that is a millimetre higher than its plane is crossed by a ray millimetres farther. So how the face
bends is told by all its points together, by three numbers, and each mouth lies on the plane that touches the bent face
there.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from aadm_workbench.hoisting.foot.face import FootFace, level_terms
from aadm_workbench.hoisting.foot.mouths import window_over
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.model import Array
from aadm_workbench.model.measured import TO_SIGMA

# to begin with: half of what faces of the sites of this product's scenes bend by, about their middle plane
_BENT_MM = 4.0
_ROUNDS, _BAND_SIGMAS = 4, 3.5  # until the band is that of the scatter, as in foot/face.py
_RIM_MM = 2.0  # beyond chamfers
_FEWEST = 500  # points: six unknowns are then known to a twentieth of the scatter
# a face that bends by less is taken for a plane, one that bends by three times as much wholly for a bent one: what the
# warp of a camera (0.05 mm) bends a plane by is a quarter of it
_FLAT_MM = 0.12
_PIXELS = 60_000  # of the windows: two of three look into mouths, past the foot, or are lost


def bent_face(frame: HoistingFrame, face: FootFace, radius_mm: float) -> FootFace:
    """The face with how it bends, its axes turned to the plane that lies in it; ``radius_mm`` is that of its mouths."""
    points = _of_face(frame, face, radius_mm)
    fitted = _fitted(points, float(np.hypot(*face.mouths.T).max()))
    if fitted is None:
        return face
    level, off, residual_mm = fitted
    # seen flat, walls of mouths may outnumber the face: what they bend has fewer points close to it than the plane
    near_mm = _BAND_SIGMAS * min(residual_mm, face.residual_mm)
    if (np.abs(off) < near_mm).sum() <= (np.abs(points[:, 2]) < near_mm).sum():
        return face
    at_mouths = level_terms(face.mouths)
    # the plane of a bent face is that of its mouths: what is left is how it bends
    plane = np.linalg.lstsq(at_mouths[:, :3], at_mouths @ level, rcond=None)[0]
    bend = level - np.append(plane, np.zeros(3))
    bend_mm = float(np.std(at_mouths @ bend))
    share = bend_mm**4 / (bend_mm**4 + _FLAT_MM**4)
    height, slope_x, slope_y = (share * plane).tolist()
    normal = np.array([-slope_x, -slope_y, 1.0]) / np.sqrt(1.0 + slope_x**2 + slope_y**2)
    axes = face.along(normal).axes
    origin = face.origin + height * face.axes[2]
    moved = replace(face, axes=axes, origin=origin, bend=share * bend, bend_mm=share * bend_mm)
    mouths = moved.local(face.to_frame(np.column_stack([face.mouths, np.zeros(len(face.mouths))])))[:, :2]
    residual_mm = share * residual_mm + (1.0 - share) * face.residual_mm
    return replace(moved, mouths=mouths, residual_mm=residual_mm)


def _of_face(frame: HoistingFrame, face: FootFace, radius_mm: float) -> Array:
    """Points (n, 3) mm of the face between and about its mouths, in its axes, and what lies near it."""
    rows, columns = window_over(frame, face, face.mouths, radius_mm)
    step = max(1, int(np.sqrt((rows.stop - rows.start) * (columns.stop - columns.start) / _PIXELS)))
    points = frame.points[rows.start : rows.stop : step, columns.start : columns.stop : step].reshape(-1, 3)
    local = face.local(points[np.isfinite(points[:, 2])].astype(np.float64))
    local = local[np.abs(local[:, 2]) < 2.0 * _BENT_MM]
    clear = np.ones(len(local), bool)
    for mouth in face.mouths:
        clear &= np.hypot(*(local[:, :2] - mouth).T) > radius_mm + _RIM_MM
    return np.asarray(local[clear])


def _fitted(points: Array, reach_mm: float) -> tuple[Array, Array, float] | None:
    """Height, slopes and curvatures (6,) of a face about its axes; how far off points (n, 3) lie, and scatter, mm."""
    scale = np.array([1.0, *(2 * [reach_mm]), *(3 * [reach_mm**2])])
    system = level_terms(points[:, :2]) / scale
    off, level, band_mm = points[:, 2], np.zeros(6), _BENT_MM
    for _ in range(_ROUNDS):
        near = np.abs(off) < band_mm
        if near.sum() < _FEWEST:
            return None
        level = np.linalg.lstsq(system[near], points[near, 2], rcond=None)[0]
        off = points[:, 2] - system @ level
        band_mm = min(band_mm, max(_BAND_SIGMAS * TO_SIGMA * float(np.median(np.abs(off[near]))), 0.1))
    return level / scale, off, TO_SIGMA * float(np.median(np.abs(off[np.abs(off) < band_mm])))
