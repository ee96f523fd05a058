"""Where bars stand in a scan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.foot_face import find_discs, rastered
from aadm_workbench.extract.plane import axes_on, find_planes
from aadm_workbench.extract.sample import Thinned, counts_in_cells, in_company
from aadm_workbench.model import Array, BoolArray, FloatArray, Plane
from aadm_workbench.model.special import median_of_known, percentiles

_FLOOR_SHARE = 0.2  # of the points: less is no floor
_FLOOR_COVERED, _ENOUGH = 0.6, 20_000  # of the floor beside bars; points that tell that: a choice, not tuned since
# higher than a rough floor and what lies on it; the shortest connecting bars stick out several times as far
ABOVE_FLOOR_MM = 15.0
"""What does not stand so far out of the floor is no connecting bar."""
_TOP_COUNT_MIN = 20  # points of the thinned scan: fewer are no top
_FILLED = 1.2  # spacings: cells that are so large hold a point each
_TOP_MM = 8.0  # a cut of 15 degrees over a 28 mm bar
_HIGH = 0.9  # of the points of a disc lie lower than its top


@dataclass(frozen=True, eq=False)
class Standing:
    """Bars that stand in a scan, seen along ``vertical`` (3,): their plan positions ``centres`` (k, 2) mm.

    ``floor`` is the plane they stick out of; None where the scan does not show it. ``level_mm`` is the height
    of most tops along the vertical.
    """

    vertical: Array
    floor: Plane | None
    centres: Array
    level_mm: float


def find_standing(
    sample: Thinned, radius_mm: float, viewpoint: Array | None, rng: np.random.Generator
) -> Standing | None:
    """Find upright discs of a radius: above the floor, or without one along the direction of the view."""
    best: Standing | None = None
    for floor in _floors(sample, viewpoint, radius_mm, rng):
        height = floor.height(sample.points)
        above = sample.points[in_company(sample, height, height > ABOVE_FLOOR_MM)]
        centres = _discs(above, floor.normal, radius_mm)
        if len(centres) and (best is None or len(centres) > len(best.centres)):
            best = Standing(floor.normal, floor, centres, _level(above, floor.normal, centres, radius_mm))
    if best is not None:
        return best
    return standing_along(sample, _towards(sample, viewpoint), radius_mm)


def standing_along(sample: Thinned, vertical: Array, radius_mm: float) -> Standing | None:
    """Find upright discs of a radius along a given vertical (3,), without a floor."""
    centres = _discs(sample.points, vertical, radius_mm)
    if len(centres) == 0:
        return None
    return Standing(vertical, None, centres, _level(sample.points, vertical, centres, radius_mm))


def _level(points: FloatArray, vertical: Array, centres: Array, radius_mm: float) -> float:
    """Height of the tops: the median over the discs."""
    return median_of_known(top_heights(points, vertical, centres, radius_mm))


def top_heights(points: FloatArray, vertical: Array, centres: Array, radius_mm: float) -> Array:
    """Height (k,) mm along the vertical of what each disc holds, a high quantile; NaN where nothing lies in it."""
    local = points @ axes_on(Plane(vertical, 0.0)).T.astype(points.dtype)
    x, y, heights = local.T
    tops = np.full(len(centres), np.nan)
    for k, centre in enumerate(centres.astype(points.dtype)):
        # Four fifths of the radius: what flies at the edge of a top is no part of it.
        inside = heights[(x - centre[0]) ** 2 + (y - centre[1]) ** 2 < (0.8 * radius_mm) ** 2]
        if len(inside):
            place = int(_HIGH * (len(inside) - 1))
            tops[k] = np.partition(inside, place)[place]
    return tops


def _floors(sample: Thinned, viewpoint: Array | None, radius_mm: float, rng: np.random.Generator) -> list[Plane]:
    floors = []
    for plane in find_planes(sample.points, rng, 2):
        on_plane = np.abs(plane.height(sample.points)) < 3.0
        if on_plane.mean() < _FLOOR_SHARE or _covered(sample.points[on_plane], plane, radius_mm) < _FLOOR_COVERED:
            continue
        towards = plane.normal @ viewpoint - plane.offset if viewpoint is not None else None
        if towards is None or towards >= 0:
            floors.append(plane)
        if towards is None or towards < 0:
            floors.append(Plane(-plane.normal, -plane.offset, plane.residual_mm))
    return floors


def _covered(points: FloatArray, plane: Plane, cell_mm: float) -> float:
    """Share of the rectangle about points (n, 3) of a plane in which they lie: tops of bars leave most of it empty."""
    some = points[:: len(points) // _ENOUGH + 1] @ axes_on(plane)[:2].T.astype(points.dtype)
    sides_mm = np.ptp(percentiles(some, (1.0, 99.0)), axis=0)  # one stray in a hundred stretches nothing
    return float(len(counts_in_cells(some, cell_mm)) * cell_mm**2 / max(float(np.prod(sides_mm + cell_mm)), 1e-9))


def _towards(sample: Thinned, viewpoint: Array | None) -> Array:
    """Direction from the scan to where it was taken from: the best guess of "up" without a floor."""
    if viewpoint is None:
        return np.array([0.0, 0.0, -1.0])
    direction = viewpoint - np.median(sample.points, axis=0)
    forward = np.array([0.0, 0.0, -1.0])
    if np.allclose(viewpoint, 0.0):
        return forward
    return np.asarray(direction / np.linalg.norm(direction))


def _discs(points: FloatArray, vertical: Array, radius_mm: float) -> Array:
    if len(points) < _TOP_COUNT_MIN:
        return np.empty((0, 2))
    local = points @ axes_on(Plane(vertical, 0.0)).T
    plan = local[:, :2]
    # Ten cells to a radius place a disc well enough to begin; finer than the points lie, cells would be empty.
    cell_mm = max(radius_mm / 10, _FILLED * _spacing(plan, radius_mm))
    found = find_discs(rastered(plan, cell_mm, 3 * radius_mm), radius_mm, holes=False)[0]
    top_spacing_mm = _spacing(plan[_is_on_top(local, radius_mm)], radius_mm)
    if cell_mm > top_spacing_mm:
        return found
    wide = find_discs(rastered(plan, _FILLED * top_spacing_mm, 3 * radius_mm), radius_mm, holes=False)[0]
    return wide if len(wide) > len(found) else found


def _is_on_top(local: Array, radius_mm: float) -> BoolArray:
    """Which points (n, 3) lie near the highest of their cell of the plan: seen from aside, sides crowd in the plan."""
    cell = np.floor((local[:, :2] - local[:, :2].min(axis=0)) / radius_mm).astype(np.int64)
    place = np.unique(cell[:, 0] * (int(cell[:, 1].max()) + 1) + cell[:, 1], return_inverse=True)[1]
    highest = np.full(int(place.max()) + 1, -np.inf)
    np.maximum.at(highest, place, local[:, 2])
    return np.asarray(local[:, 2] > highest[place] - _TOP_MM)


def _spacing(plan: Array, radius_mm: float) -> float:
    """Typical distance of neighbours in the plan where it is well filled."""
    filled = float(percentiles(counts_in_cells(plan, radius_mm), 80))  # most cells hold a part of a top alone
    return float(radius_mm / np.sqrt(max(filled, 1.0)))
