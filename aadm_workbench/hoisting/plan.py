"""Where to put the camera beside the bars: what it sees of a hanging foot from a place, and how sure that will be.

Everything is geometry of the design and the lens; what it promises was compared with simulated frames. The foot is seen
at grazing incidence: from farther away more of it is in the picture, and rays cross it farther apart. A camera deeper
below the bar tops sees the foot more squarely, and bars hide more of each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.hoisting.unseen import hidden_shares
from aadm_workbench.model import Array, BoolArray, Camera, ColumnDesign, Reason

AIMED_AT_GAP_SHARE = 0.45
"""Of the gap under the foot, at which the camera is aimed, as in the scenes that the figures come from."""
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
"""Signs of x and y, counter-clockwise: each stands beside its neighbours."""
_MARGIN_PIXELS = 25.0  # half a degree beside the aim, of the reference camera (21 pixels)
_GRAZING_NONE = 0.075  # of the cosine: cameras return nothing of what they see more along than this
_HIDDEN_SHARE = 0.55  # of a bar's width behind nearer bars: the rest is too narrow to measure
# what frames of the virtual camera came to when it was made; the last as in offsets.py
_FLOOR_MM, _OF_PITCH, _NORMAL_U = 0.075, 0.022, 1.5e-4
_SHOWN_SHARE, _FEWEST_LAID = 2 / 3, 4  # a frame that shows less is not measured as a whole; three points test nothing
_OTHERWISE = Reason("hoisting.plan_otherwise")
# from the first bar: nearer no camera measures, farther none is sharp; in steps that a person can set
_DISTANCES_MM = (400.0, 3001.0, 50.0)
_BELOW_MM = (40.0, 60.0, 90.0, 120.0)  # below the tops: the reference scene's 60, and places about it


@dataclass(frozen=True)
class View:
    """One place of the camera: the corner it stands at, mm from the first bar and below the bar tops.

    ``sleeves``, ``rebars``: labels of those it can measure. ``u_mm`` is the expected standard uncertainty per axis of
    the worst sleeve that it sees over its bar, ``depth_mm`` the distances from which to which it has to measure. With
    scans from before hoisting ``u_of_all_mm`` is that of the worst of all sleeves, hidden ones too; None without, and
    where the frame shows too little of the column to be laid on them.
    """

    near: str
    distance_mm: float
    below_tops_mm: float
    sleeves: tuple[str, ...]
    rebars: tuple[str, ...]
    u_mm: float
    depth_mm: tuple[float, float]
    u_of_all_mm: float | None = None


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
    exposed_mm: float = 120.0,  # the shortest of the settings
    most_mm: float = 3000.0,  # farther away no such camera measures
    before_mm: float | None = None,
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
    before_mm
        Standard uncertainty per axis of sleeves and bars in scans from before hoisting; None where there are none.

    Returns
    -------
    The plan with the fewest frames, and every view from the first corner that sees all sleeves of interest.
    """
    wanted = tuple(sleeves) if sleeves else tuple(point.label for point in design.sleeves)
    # a lens stands above the floor, if by little
    below = [value for value in _BELOW_MM if value < exposed_mm - 15.0] or [_BELOW_MM[0]]
    distances_mm = np.arange(*_DISTANCES_MM)
    distances_mm = distances_mm[distances_mm <= most_mm]
    places = [(float(distance), depth) for distance in distances_mm for depth in below]

    def views_from(corner: tuple[int, int]) -> list[View]:
        return [_view(design, camera, corner, *place, height_mm, before_mm) for place in places]

    first = views_from(near)
    if before_mm is not None:
        return _with_before(first, wanted, wanted_u_mm)
    whole = tuple(view for view in first if set(view.sleeves).issuperset(wanted))
    good = [view for view in whole if view.u_mm <= wanted_u_mm]
    if good:
        best = max(good, key=lambda view: (len(view.rebars), -view.u_mm))
        return CameraPlan((best,), wanted, best.u_mm), whole
    by_corner = {near: first, **{corner: views_from(corner) for corner in _neighbours(near)}}
    return _two_views(by_corner, near, wanted, wanted_u_mm), whole


def _with_before(views: list[View], wanted: tuple[str, ...], wanted_u_mm: float) -> tuple[CameraPlan, tuple[View, ...]]:
    """One frame: the scans from before hoisting speak for what it does not show, once it lays them on each other."""
    known = tuple(view for view in views if view.u_of_all_mm is not None)
    best = min(known, key=lambda view: view.u_of_all_mm or 0.0, default=None)
    if best is None:
        return CameraPlan((), (), None, Reason("hoisting.plan_short_lens")), known
    if (best.u_of_all_mm or 0.0) > wanted_u_mm:
        reason = Reason("hoisting.plan_known", wanted_u_mm=wanted_u_mm)
        return CameraPlan((best,), wanted, best.u_of_all_mm, reason), known
    return CameraPlan((best,), wanted, best.u_of_all_mm), known


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
        return CameraPlan((), (), None, Reason("hoisting.plan_none", wanted_u_mm=wanted_u_mm, otherwise=_OTHERWISE))
    lacking = [label for label in wanted if label not in best.seen]
    if lacking:
        reason = Reason("hoisting.plan_two", lacking=lacking, wanted_u_mm=wanted_u_mm)
        return CameraPlan(best.views, best.seen, best.u_mm, reason)
    return best


def _neighbours(near: tuple[int, int]) -> tuple[tuple[int, int], tuple[int, int]]:
    place = CORNERS.index(near)
    return CORNERS[(place + 1) % 4], CORNERS[(place - 1) % 4]


def _view(
    design: ColumnDesign,
    camera: Camera,
    near: tuple[int, int],
    distance_mm: float,
    below_mm: float,
    height_mm: float,
    before_mm: float | None,
) -> View:
    sleeves, rebars = (np.array([p.centre[:2] for p in points]) for points in (design.sleeves, design.rebars))
    radius_mm = design.sleeves[0].diameter_mm / 2
    diagonal = np.array(near) / np.sqrt(2.0)
    eye = np.array([*(diagonal * (float((rebars @ diagonal).max()) + distance_mm)), -below_mm])
    axes = _looking(eye, np.array([0.0, 0.0, AIMED_AT_GAP_SHARE * height_mm]))
    mouths = np.column_stack([sleeves, np.full(len(sleeves), height_mm)])
    about = mouths - eye
    grazing = about[:, 2] / np.linalg.norm(about, axis=1)
    shown = _in_picture(mouths, eye, axes, camera, radius_mm)
    seen = shown & (grazing > _GRAZING_NONE)
    # as much of a side as shows a bar
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
        u_of_all_mm=None if before_mm is None else _u_of_all(sleeves, rebars, seen, bars, shown, u, before_mm),
    )


def _u_of_all(
    sleeves: Array, rebars: Array, seen: BoolArray, bars: BoolArray, shown: BoolArray, u: Array, before_mm: float
) -> float | None:
    """Of the worst pair, where the seen points lay the scans from before hoisting on the frame; None for too few."""
    if shown.mean() < _SHOWN_SHARE or min(seen.sum(), bars.sum()) < _FEWEST_LAID:
        return None
    of_bars = np.full(len(rebars), _FLOOR_MM)
    return float(np.sqrt((_laid(sleeves, seen, u, before_mm) + _laid(rebars, bars, of_bars, before_mm)).max()))


def _laid(places: Array, seen: BoolArray, u: Array, before_mm: float) -> Array:
    """Variance (k,) mm² per axis of points known from before, laid by the seen ones, which are known from both."""
    about = places - places[seen].mean(axis=0)
    weight = 1.0 / (u[seen] ** 2 + before_mm**2)
    turning = 1.0 / float((weight * (about[seen] ** 2).sum(axis=1)).sum())
    told = before_mm**2 + 1.0 / weight.sum() + turning * (about**2).sum(axis=1) / 2.0
    return np.asarray(np.where(seen, 1.0 / (1.0 / told + 1.0 / u**2), told))


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
