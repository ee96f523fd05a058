"""Where to put the camera beside the bars: what it sees of a hanging foot from a place, and how sure that will be.

Everything is geometry of the design and the lens; what it promises was compared with simulated frames. The foot is seen
at grazing incidence: from farther away more of it is in the picture, and rays cross it farther apart. A camera deeper
below the bar tops sees the foot more squarely, and bars hide more of each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.hoisting_hidden import hidden_shares
from aadm_workbench.model import Array, BoolArray, Camera, ColumnDesign

AIMED_AT_GAP_SHARE = 0.45
"""Of the gap under the foot, at which the camera is aimed, as in the scenes that the figures come from."""
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
"""Signs of x and y, counter-clockwise: each stands beside its neighbours."""
_MARGIN_PIXELS = 25.0  # half a degree beside the aim, of the reference camera (21 pixels)
_GRAZING_NONE = 0.075  # of the cosine: cameras return nothing of what they see more along than this
_HIDDEN_SHARE = 0.55  # of a bar's width behind nearer bars: the rest is too narrow to measure
# what frames of the virtual camera came to when it was made; the last as in hoisting_pairs.py
_FLOOR_MM, _OF_PITCH, _NORMAL_U = 0.075, 0.022, 1.5e-4
# from the first bar: nearer no camera measures, farther none is sharp; in steps that a person can set
_DISTANCES_MM = (400.0, 3001.0, 50.0)
_BELOW_MM = (40.0, 60.0, 90.0, 120.0)  # below the tops: the reference scene's 60, and places about it


@dataclass(frozen=True)
class View:
    """One place of the camera: the corner it stands at, mm from the first bar and below the bar tops.

    ``sleeves``, ``rebars``: labels of those it can measure. ``u_mm`` is the expected standard uncertainty per axis of
    the worst sleeve that it sees over its bar, ``depth_mm`` the distances from which to which it has to measure.
    """

    near: str
    distance_mm: float
    below_tops_mm: float
    sleeves: tuple[str, ...]
    rebars: tuple[str, ...]
    u_mm: float
    depth_mm: tuple[float, float]


@dataclass(frozen=True)
class CameraPlan:
    """Views that together see all sleeves asked for, the best plan first; ``reason`` where there is none."""

    views: tuple[View, ...]
    seen: tuple[str, ...]
    u_mm: float | None
    reason: str = ""


def plan_camera(
    design: ColumnDesign,
    camera: Camera,
    *,
    height_mm: float,
    wanted_u_mm: float,
    near: tuple[int, int] = (-1, -1),
    sleeves: Sequence[str] | None = None,
    exposed_mm: float = 120.0,
    most_mm: float = 3000.0,
) -> tuple[CameraPlan, tuple[View, ...]]:
    """Plan the frames for a column.

    Parameters
    ----------
    height_mm
        Height of the foot above the bar tops while it is measured.
    wanted_u_mm
        Standard uncertainty per axis that the worst pair must stay below.
    near
        Corner of the bars at which the camera can stand; a second frame is taken from a neighbouring corner.
    sleeves
        Labels of the sleeves of interest; all by default.
    exposed_mm
        How far bars stick out of the floor: the camera stands above it.
    most_mm
        The farthest place, from the first bar, that there is room for.

    Returns
    -------
    The plan with the fewest frames, and every view from the first corner that sees all sleeves of interest.
    """
    wanted = tuple(sleeves) if sleeves else tuple(point.label for point in design.sleeves)
    below = [value for value in _BELOW_MM if value < exposed_mm - 15.0] or [_BELOW_MM[0]]
    distances_mm = np.arange(*_DISTANCES_MM)
    distances_mm = distances_mm[distances_mm <= most_mm]
    by_corner = {
        corner: [
            _view(design, camera, corner, float(distance), depth, height_mm)
            for distance in distances_mm
            for depth in below
        ]
        for corner in (near, *_neighbours(near))
    }
    whole = tuple(view for view in by_corner[near] if set(view.sleeves).issuperset(wanted))
    good = [view for view in whole if view.u_mm <= wanted_u_mm]
    if good:
        best = max(good, key=lambda view: (len(view.rebars), -view.u_mm))
        return CameraPlan((best,), wanted, best.u_mm), whole
    return _two_views(by_corner, near, wanted, wanted_u_mm), whole


def _two_views(
    by_corner: dict[tuple[int, int], list[View]], near: tuple[int, int], wanted: tuple[str, ...], wanted_u_mm: float
) -> CameraPlan:
    """Two frames, from two corners, that share the sleeves of interest among them."""
    firsts = [view for view in by_corner[near] if view.u_mm <= wanted_u_mm and len(view.sleeves) >= 3]
    best: CameraPlan | None = None
    for corner in _neighbours(near):
        for second in by_corner[corner]:
            if second.u_mm > wanted_u_mm or len(second.sleeves) < 3:
                continue
            for first in firsts:
                seen = tuple(label for label in wanted if label in first.sleeves or label in second.sleeves)
                u_mm = max(first.u_mm, second.u_mm)
                if best is None or (len(seen), -u_mm) > (len(best.seen), -(best.u_mm or 0.0)):
                    best = CameraPlan((first, second), seen, u_mm)
    if best is None:
        return CameraPlan((), (), None, f"no place gives u = {wanted_u_mm:g} mm: take a larger u, or a longer lens")
    lacking = [label for label in wanted if label not in best.seen]
    if lacking:
        reason = f"two frames do not see {', '.join(lacking)} at u = {wanted_u_mm:g} mm"
        return CameraPlan(best.views, best.seen, best.u_mm, reason)
    return best


def _neighbours(near: tuple[int, int]) -> tuple[tuple[int, int], tuple[int, int]]:
    place = CORNERS.index(near)
    return CORNERS[(place + 1) % 4], CORNERS[(place - 1) % 4]


def _view(
    design: ColumnDesign, camera: Camera, near: tuple[int, int], distance_mm: float, below_mm: float, height_mm: float
) -> View:
    sleeves, rebars = (np.array([p.centre[:2] for p in points]) for points in (design.sleeves, design.rebars))
    radius_mm = design.sleeves[0].diameter_mm / 2
    diagonal = np.array(near) / np.sqrt(2.0)
    eye = np.array([*(diagonal * (float((rebars @ diagonal).max()) + distance_mm)), -below_mm])
    axes = _looking(eye, np.array([0.0, 0.0, AIMED_AT_GAP_SHARE * height_mm]))
    mouths = np.column_stack([sleeves, np.full(len(sleeves), height_mm)])
    about = mouths - eye
    grazing = about[:, 2] / np.linalg.norm(about, axis=1)
    seen = _in_picture(mouths, eye, axes, camera, radius_mm) & (grazing > _GRAZING_NONE)
    tops = np.column_stack([rebars, np.full(len(rebars), -15.0)])
    bars = _in_picture(tops, eye, axes, camera, design.rebars[0].diameter_mm / 2)
    bars &= hidden_shares(rebars, eye[:2], design.rebars[0].diameter_mm / 2) < _HIDDEN_SHARE
    depth = np.concatenate([about[seen], tops[bars] - eye]) @ axes[2] if seen.any() or bars.any() else np.zeros(1)
    pitch_mm = about @ axes[2] / camera.fy / np.maximum(grazing, 1e-3)
    u = np.sqrt(_FLOOR_MM**2 + (_OF_PITCH * pitch_mm) ** 2 + (_NORMAL_U * height_mm) ** 2)
    return View(
        near="".join(f"{'+' if sign > 0 else '-'}{axis}" for sign, axis in zip(near, "xy", strict=True)),
        distance_mm=distance_mm,
        below_tops_mm=below_mm,
        sleeves=tuple(p.label for p, ok in zip(design.sleeves, seen, strict=True) if ok),
        rebars=tuple(p.label for p, ok in zip(design.rebars, bars, strict=True) if ok),
        u_mm=float(u[seen].max()) if seen.any() else float("inf"),
        depth_mm=(float(depth.min()), float(depth.max())),
    )


def _looking(eye: Array, target: Array) -> Array:
    """Axes (3, 3) of a camera at the eye: rows x right, y down, z forward."""
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    return np.vstack([right, np.cross(forward, right), forward])


def _in_picture(points: Array, eye: Array, axes: Array, camera: Camera, radius_mm: float) -> BoolArray:
    local = (points - eye) @ axes.T
    reach = radius_mm / local[:, 2]
    u = local[:, 0] / local[:, 2] * camera.fx + camera.cx
    v = local[:, 1] / local[:, 2] * camera.fy + camera.cy
    across = reach * camera.fx + _MARGIN_PIXELS
    inside = (u > across) & (u < camera.width - across) & (v > _MARGIN_PIXELS) & (v < camera.height - _MARGIN_PIXELS)
    return np.asarray(inside & (local[:, 2] > 0.0))
