"""Search for every way in which measured points lie on a design pattern in the plane.

Poses are proposed by pairs of measured points laid on pairs of design points of the same length, scored on a
raster, refined by least absolute distances, and counted as different where turn or place differ. Least absolute
distances, cut off at the gate, make a missing point, an extra one and one that is far off cost alike in all poses:
a single bad point cannot make a wrong turn better than the right one.

How well a placement explains what was measured: what competing placements of one scan are compared by. Sleeves and bars
are built with a scatter that nobody knows beforehand, and single ones may be far off. So the deviations follow
Student's law in the plane, and its width is taken from the deviations themselves, with a prior: a fit that is perfect
by chance, of four points, say, is no proof.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.model import Array, IntArray
from aadm_workbench.model.special import distinct

GATE_MM = 20.0
"""A measured point belongs to a design point within this distance: 15 mm of error and the pose's own share."""

PAIR_LENGTH_MM = 10.0
"""Measured and design distance of a pair that proposes a pose may differ by this."""

_BASE_PAIRS = 40  # each point stands in several, so that some pairs hold no bad one: a choice, not tuned since
_KEPT_COARSE = 512  # of the cheapest proposals: a choice, not tuned since
_KEPT_FINE = 96  # of the best that differ: a choice, not tuned since
_REFINED = 6  # rounds: a choice, not tuned since
_SAME_TURN_RAD = np.deg2rad(1.5)  # moves a bar 300 mm from the middle by as much as the next number
_SAME_PLACE_MM = 8.0  # closer than any two features of a pattern
_SMALLEST_DISTANCE_MM = 0.5  # keeps the weight of a point that is hit: nearer than this all are as good

_CELL_MM = 4.0  # half the step in which placements are told apart (placements.py)
_CELLS_PER_SIDE = 128  # 16,000 cells: bounds the memory

DISTINCT_LOG_RATIO = 7.0
"""Another placement is ruled out where the deviations make it a thousand times (e⁷) less likely than the best one."""

CONTRADICTS_LOG_RATIO = 9.0
"""What is declared is contradicted where another placement is eight thousand times (e⁹) more likely.

More than for choosing freely: a declaration is evidence too, and of sound scans not one in a thousand may be refused.
"""

USUAL_SCATTER_MM = 0.7
"""Per axis: with it 98 % of the points keep their 2 mm (T/CCES 30-2022, 4.3.3); the prior of the width."""

_FREEDOM = 3.0  # of Student's law: one point in a hundred lies beyond six widths
_PRIOR_WEIGHT = 2.0  # the prior counts as one point does
_LEAST_SCATTER_MM = 0.1  # below it lies what scans can tell
# mm, 13 % apart: to 12 mm, beyond which nothing belongs to a place
_WIDTHS_MM = np.geomspace(_LEAST_SCATTER_MM, 12.0, 40)


@dataclass(frozen=True, eq=False)
class PlanarPlacement:
    """One way to lay measured on design points in the plane.

    Parameters
    ----------
    yaw, shift
        Radians and (2,) mm: ``turn(yaw) @ measured + shift`` is in the design's frame.
    matched
        (m,) int64, for each design point the measured one that lies there, −1 for none.
    deviations_mm
        (m,) of each design point to the measured one, the gate where there is none.
    """

    yaw: float
    shift: Array
    matched: IntArray
    deviations_mm: Array

    @property
    def cost_mm(self) -> float:
        """Sum over the design points of the distance, cut off at the gate."""
        return float(self.deviations_mm.sum())

    @property
    def found(self) -> int:
        """How many design points have a measured one."""
        return int((self.matched >= 0).sum())


def search_placements(measured: Array, design: Array) -> list[PlanarPlacement]:
    """Every distinct placement of measured (n, 2) on design (m, 2) points, mm, the cheapest first.

    Neither is a mirror ever tried: both must be seen from the same side.
    """
    gate_mm = _gate(design)
    middle, centre = measured.mean(axis=0), design.mean(axis=0)
    source, target = measured - middle, design - centre
    raster = NearestRaster.of(target, gate_mm)
    yaw, shift = _propose(source, target)
    if not len(yaw):
        return []
    yaw, shift = _keep_cheapest(source, raster, yaw, shift, _KEPT_COARSE, distinct=False)
    for _ in range(3):
        nearest, distance = raster.look_up(_apply(source, yaw, shift))
        yaw, shift = _fit_batch(source, target[nearest], _absolute_weights(distance, gate_mm))
    yaw, shift = _keep_cheapest(source, raster, yaw, shift, _KEPT_FINE, distinct=True)
    placements = _refine(source, target, yaw, shift, gate_mm)
    # Rounded, so that what is equal but for the last digits keeps its order on every machine.
    ordered = sorted(placements, key=lambda found: (round(found.cost_mm, 6), abs(found.yaw), found.yaw))
    return [_uncentred(found, middle, centre) for found in _distinct(ordered)]


def _gate(design: Array) -> float:
    gaps = np.hypot(*(design[:, None] - design[None]).transpose(2, 0, 1))
    np.fill_diagonal(gaps, np.inf)
    return min(GATE_MM, 0.45 * float(gaps.min()))  # less than half way to the next, so that none claims two


def _propose(source: Array, target: Array) -> tuple[Array, Array]:
    """Poses (k,), (k, 2) that lay some pair of measured points on some ordered pair of design points."""
    first, second = _base_pairs(source)
    i, j = np.nonzero(~np.eye(len(target), dtype=bool))
    edge, wanted = source[second] - source[first], target[j] - target[i]
    mismatch = np.abs(np.hypot(*edge.T)[:, None] - np.hypot(*wanted.T))
    pair, goal = np.nonzero(mismatch <= PAIR_LENGTH_MM)
    yaw = np.arctan2(*wanted[goal, ::-1].T) - np.arctan2(*edge[pair, ::-1].T)
    middles = 0.5 * (source[first] + source[second])[pair], 0.5 * (target[i] + target[j])[goal]
    return yaw, middles[1] - _turned(middles[0][:, None], yaw)[:, 0]


def _base_pairs(source: Array) -> tuple[IntArray, IntArray]:
    """Up to 40 pairs of measured points, long ones but spread over all points, so that some hold no bad point."""
    first, second = np.triu_indices(len(source), 1)
    lengths = np.hypot(*(source[first] - source[second]).T)
    order = np.argsort(-lengths, kind="stable")[: max(1, (3 * len(first) + 3) // 4)]
    chosen = order[distinct(np.linspace(0, len(order) - 1, _BASE_PAIRS).astype(int))]
    return first[chosen], second[chosen]


def _keep_cheapest(
    source: Array, raster: NearestRaster, yaw: Array, shift: Array, count: int, *, distinct: bool
) -> tuple[Array, Array]:
    """The ``count`` cheapest poses on the raster, one for each cell of turn and place."""
    cost = raster.look_up(_apply(source, yaw, shift))[1].sum(axis=1)
    order = np.argsort(cost, kind="stable")
    # Finer than what the next step brings together; the first look keeps one of each 8 mm that a gate is wide.
    cell = (np.deg2rad(0.5), 1.0) if distinct else (np.deg2rad(2.0), 8.0)
    keys = np.column_stack(
        [np.round(np.sin(yaw) / cell[0]), np.round(np.cos(yaw) / cell[0]), np.round(shift / cell[1])]
    )
    _, first = np.unique(keys[order], axis=0, return_index=True)
    kept = order[np.sort(first)[:count]]
    return yaw[kept], shift[kept]


def _refine(source: Array, target: Array, yaw: Array, shift: Array, gate_mm: float) -> list[PlanarPlacement]:
    for _ in range(_REFINED):
        nearest, distance, mutual = _mutual_nearest(_apply(source, yaw, shift), target, gate_mm)
        weights = np.where(mutual, _absolute_weights(distance, gate_mm), 0.0)
        enough = mutual.sum(axis=1) >= 2
        yaw, shift, nearest, weights = yaw[enough], shift[enough], nearest[enough], weights[enough]
        yaw, shift = _fit_batch(source, target[nearest], weights)
    nearest, distance, mutual = _mutual_nearest(_apply(source, yaw, shift), target, gate_mm)
    found = []
    for k in range(len(yaw)):
        matched = np.full(len(target), -1, dtype=np.int64)
        which = np.flatnonzero(mutual[k])
        matched[nearest[k, which]] = which
        deviations_mm = np.full(len(target), gate_mm)
        deviations_mm[nearest[k, which]] = distance[k, which]
        found.append(PlanarPlacement(float(yaw[k]), shift[k], matched, deviations_mm))
    return found


def _mutual_nearest(placed: Array, target: Array, gate_mm: float) -> tuple[IntArray, Array, Array]:
    """For points (k, n, 2): nearest design point, its distance, and whether it is within the gate and both agree."""
    distances = np.hypot(placed[:, :, None, 0] - target[:, 0], placed[:, :, None, 1] - target[:, 1])
    nearest, back = distances.argmin(axis=2), distances.argmin(axis=1)
    distance = np.take_along_axis(distances, nearest[:, :, None], axis=2)[:, :, 0]
    agree = np.take_along_axis(back, nearest, axis=1) == np.arange(placed.shape[1])
    return nearest, distance, agree & (distance <= gate_mm)


def _absolute_weights(distance: Array, gate_mm: float) -> Array:
    """Weights (…) that turn least squares into least absolute distances; none beyond the gate."""
    return np.where(distance < gate_mm, 1.0 / np.maximum(distance, _SMALLEST_DISTANCE_MM), 1e-12)


def _fit_batch(source: Array, targets: Array, weights: Array) -> tuple[Array, Array]:
    """Weighted planar EOPA of source (n, 2) onto targets (k, n, 2): yaw (k,), shift (k, 2)."""
    share = weights / weights.sum(axis=1, keepdims=True)
    middle, centre = share @ source, np.einsum("kn,knd->kd", share, targets)
    a, b = source[None] - middle[:, None], targets - centre[:, None]
    along = np.einsum("kn,knd->k", share, a * b)
    across = np.einsum("kn,kn->k", share, a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
    yaw = np.arctan2(across, along)
    return yaw, centre - _turned(middle[:, None], yaw)[:, 0]


def _apply(points: Array, yaw: Array, shift: Array) -> Array:
    return _turned(points[None], yaw) + shift[:, None]


def _turned(points: Array, yaw: Array) -> Array:
    """Points (k or 1, n, 2) turned by yaw (k,), (k, n, 2)."""
    cosine, sine = np.cos(yaw)[:, None], np.sin(yaw)[:, None]
    x, y = points[..., 0], points[..., 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def _distinct(ordered: list[PlanarPlacement]) -> list[PlanarPlacement]:
    """The first of those that differ in turn and place by less than is told apart."""
    yaw = np.array([found.yaw for found in ordered])
    shift = np.array([found.shift for found in ordered]).reshape(-1, 2)
    kept: list[int] = []
    for k in range(len(ordered)):
        turned = np.abs((yaw[k] - yaw[kept] + np.pi) % (2.0 * np.pi) - np.pi) < _SAME_TURN_RAD
        if not (turned & (np.hypot(*(shift[k] - shift[kept]).T) < _SAME_PLACE_MM)).any():
            kept.append(k)
    return [ordered[k] for k in kept]


def _uncentred(found: PlanarPlacement, middle: Array, centre: Array) -> PlanarPlacement:
    shift = found.shift + centre - _turned(middle[None, None], np.array([found.yaw]))[0, 0]
    return replace(found, shift=shift)


@dataclass(frozen=True, eq=False)
class NearestRaster:
    """A raster of the plane: in each cell the nearest design point and its distance, cut off at the gate.

    Parameters
    ----------
    origin
        (2,) mm, corner of the raster.
    nearest
        (rows, columns) int64, index of the nearest design point.
    distance_mm
        (rows, columns) float64, from the middle of the cell, at most ``gate_mm``.
    """

    origin: Array
    cell_mm: float
    gate_mm: float
    nearest: IntArray
    distance_mm: Array

    @classmethod
    def of(cls, design: Array, gate_mm: float) -> NearestRaster:
        """Raster of design points (m, 2) mm and everything within ``gate_mm`` of their bounding box."""
        low, high = design.min(axis=0) - gate_mm, design.max(axis=0) + gate_mm
        cell_mm = max(_CELL_MM, float((high - low).max()) / _CELLS_PER_SIDE)
        # One more cell all round is at the gate's distance: what falls outside is clipped into it.
        origin = low - cell_mm
        columns, rows = (int(np.ceil(extent / cell_mm)) + 2 for extent in high - low)
        x = origin[0] + (np.arange(columns) + 0.5) * cell_mm
        y = origin[1] + (np.arange(rows) + 0.5) * cell_mm
        squared = (x[None, :, None] - design[:, 0]) ** 2 + (y[:, None, None] - design[:, 1]) ** 2
        nearest = squared.argmin(axis=2)
        distance = np.minimum(np.sqrt(squared.min(axis=2)), gate_mm)
        return cls(origin, cell_mm, gate_mm, nearest, distance)

    def look_up(self, points: Array) -> tuple[IntArray, Array]:
        """Nearest design point and distance (both of shape (...)), for points (..., 2) mm."""
        cells = np.floor((points - self.origin) / self.cell_mm).astype(np.int64)
        column = np.clip(cells[..., 0], 0, self.nearest.shape[1] - 1)
        row = np.clip(cells[..., 1], 0, self.nearest.shape[0] - 1)
        return self.nearest[row, column], self.distance_mm[row, column]


def log_likelihood(radial_mm: Array) -> float:
    """Logarithm of the likelihood of radial deviations (m,) mm, at the width that suits them best.

    Only differences of it mean something, and only between placements of the same number of points: one that a
    placement leaves without a measured point counts as being as far off as a point may be.
    """
    squared = _WIDTHS_MM[:, None] ** 2
    excess = np.log1p(np.asarray(radial_mm, dtype=np.float64) ** 2 / (_FREEDOM * squared)).sum(axis=1)
    widths = np.log(squared[:, 0])
    prior = 0.5 * _PRIOR_WEIGHT * (widths + USUAL_SCATTER_MM**2 / squared[:, 0])
    return float(np.max(-len(radial_mm) * widths - 0.5 * (_FREEDOM + 2.0) * excess - prior))
