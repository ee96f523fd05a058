"""What the top of each bar shows: the plane it was cut in, the outline of the cut, and points of the bar's side.

How the side of a bar leans, roughly: what decides which points are looked at, not what is measured from them.

What burrs on the tops of bars may hide: an outline that is pushed out on one side stands beside its core.

Shears leave a burr b·cos⁺(θ) on one side. The circle through it is larger by b/π and stands b/2 beside the core. Ribs
are much the same on all bars of a group, so that the larger circle shows; to which side the burr is, it does not.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.extract.circle import (
    Outlines,
    PlanPoints,
    bins_for,
    circles_through,
    in_rows,
    outlines,
    settled_centres,
    thinned_rows,
)
from aadm_workbench.extract.own_tops import TopPlanes, top_planes
from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray
from aadm_workbench.model.special import median

REACH_MM = 14.0
"""How far around a bar points are taken, beyond its nominal radius."""

TOP_BAND_MM, BENT_TOP_BAND_MM = 0.3, 1.5
"""How near to its plane a point is on a top; where surfaces bend at their edges, a narrow band would lose one side."""

_TOP_BAND_SIGMAS = 4.0  # of a top's own points one in 16,000 is farther off
_OUTLINE_ZONE, _OUTLINE_BEYOND_MM = 0.3, 3.0  # of the radius; beyond it
# a rib of 0.9 mm and a pixel or two at 1 m; what lies beyond is another surface (a choice: ±30 % moves centres by
# less than 0.1 u)
_RIM_BEYOND_MM = 2.5
# of the density of the disc, in a ring beyond the ribs; of the radius (a choice: ±30 % changes what is found)
_GOES_ON_SHARE, _GOES_ON_RING, _GOES_ON_DISC = 0.3, (1.25, 1.5), 0.9
# a face about a hole is farther before what is seen through it than a slanted cut rises; sectors of a ring beyond the
# hole that show it: beside a bar stand a few things, not one all round; of the points that would fill one
_SUNK_MM, _SUNK_RING, _SECTORS, _SUNK_SECTORS, _SUNK_SHARE = 10.0, (1.1, 2.2), 12, 8, 0.15
_COVERAGE_MIN = 0.5  # half of a circle still holds its centre both ways
_PITCH_MAX = 0.2  # of the radius: 80 points on a top; on fewer anything passes for round
_PASSED_FROM, _PASSED_BEYOND_MM = 0.75, 6.0  # of the radius; beyond it: so far about the edge rays tell where it is
_SIDE_DEPTH_MM = (0.8, 60.0)  # below a burr; 60 mm tell the lean to 7 mrad (docs/method.md, 2.3)
_SIDE_BAND_MM = (-1.2, 1.8)  # about the nominal radius: ribs stand out
_SIDE_POINTS_MAX = 350  # of a side, evenly taken: neighbours share their errors, more of them tell little

LEAN_MAX = float(np.radians(4.5))
"""What is looked for each way: 60 mm of side then move by 5 mm, nearly the room beside a bar in its patch."""

_LEANS = np.linspace(-LEAN_MAX, LEAN_MAX, 13)  # steps of 0.75 degrees move the end of a side by half of its band
_EACH = np.stack(np.meshgrid(_LEANS, _LEANS), axis=-1).reshape(-1, 2).astype(np.float32)  # 13 × 13 leans, mm per mm
_TRIED = _EACH[np.argsort((_EACH**2).sum(axis=1), kind="stable")]
_SIDE_MM, _HALF_MM = 0.3, 1.5  # about the nominal radius: cores are a little smaller, ribs stand out by 1.5 mm
_POINTS_MAX = 150  # of a side, for a choice in steps of 0.75 degrees
_MORE, _MORE_POINTS = 1.1, 8.0  # ribs, strays and strips of a few points win less by another lean


@dataclass(frozen=True, eq=False)
class Tops:
    """Evidence of k bars, mm, each about its own place ``place`` (k, 2) in plan axes whose z is the bars' vertical.

    ``normal`` (k, 3), ``offset`` (k,) and ``residual_mm`` (k,) are the planes of the cuts; ``pitch_mm`` (k,) the
    distance of neighbouring points on them; ``centre`` (k, 2) first centres. ``rims`` lie on the cut, ``beyond`` are
    crossings of rays that passed it. ``side_xy`` (k, m, 2) and ``side_depth`` (k, m) are points of the bars' sides,
    those that are there ``side_seen`` (k, m). ``kept`` are the numbers (k,) of their patches.
    """

    kept: IntArray
    place: Array
    normal: Array
    offset: Array
    residual_mm: Array
    pitch_mm: Array
    centre: Array
    rims: Outlines
    beyond: Outlines
    side_xy: Array
    side_depth: Array
    side_seen: BoolArray


def tops_in(
    patches: Patches,
    places: Array,
    radius_mm: float,
    rng: np.random.Generator,
    others_mm: tuple[float, ...] = (),
    beside: Array | None = None,
    planes: TopPlanes | None = None,
    band_mm: float = TOP_BAND_MM,
) -> Tops:
    """The tops of upright bars of a radius among patches around places (k, 2) mm, but for those of other radii.

    ``beside`` (n, 3) mm, in the same axes: points of the whole scan, where each point belongs to one patch alone.
    ``planes`` where they are known; what lies within ``band_mm`` of one, or within its noise, is on the top.
    """
    planes = top_planes(patches, radius_mm, rng) if planes is None else planes
    height = planes.height(patches)
    bands_mm = np.maximum(_TOP_BAND_SIGMAS * planes.residual_mm, band_mm).astype(np.float32)[:, None]
    on_top = (np.abs(height) < bands_mm) & planes.found[:, None]
    pitch_mm = np.sqrt(np.pi * radius_mm**2 / np.maximum(on_top.sum(axis=1), 1))
    bins = bins_for(radius_mm, float(median(pitch_mm[planes.found])) if planes.found.any() else radius_mm)
    top = PlanPoints.of(patches.x, patches.y, np.flatnonzero(on_top))
    zone_mm = _OUTLINE_ZONE * radius_mm, radius_mm + _OUTLINE_BEYOND_MM
    start = np.zeros((len(places), 2))
    centre, other = settled_centres(top, start, radius_mm, bins, zone_mm, innermost=False, others_mm=others_mm)
    rims = outlines(top.where(top.distance(centre) < radius_mm + _RIM_BEYOND_MM), centre, bins, innermost=False)
    around = top if beside is None else _at_the_height_of(beside, places, planes, bands_mm[:, 0], radius_mm)
    kept = planes.found & ~other & ~_goes_on(around, centre, radius_mm) & (rims.coverage >= _COVERAGE_MIN)
    kept &= (pitch_mm < _PITCH_MAX * radius_mm) & ~_is_sunk(patches, planes, height, centre, radius_mm, pitch_mm)
    passed = _passed(patches, planes, height < -bands_mm, centre, radius_mm)
    beyond = outlines(passed, centre, bins, innermost=True).only(rims.seen)  # no surface: nothing tells of its edge
    side_xy, side_depth, side_seen = _sides(patches, height, centre, radius_mm, kept)
    return Tops(
        np.flatnonzero(kept),
        places[kept],
        planes.normal[kept],
        planes.offset[kept],
        planes.residual_mm[kept],
        pitch_mm[kept],
        centre[kept],
        rims.of(kept),
        beyond.of(kept),
        side_xy,
        side_depth,
        side_seen,
    )


def _at_the_height_of(
    beside: Array, places: Array, planes: TopPlanes, band_mm: FloatArray, radius_mm: float
) -> PlanPoints:
    """The points of a scan around each place that lie in the plane of its top."""
    reach_mm = 2.0 * _GOES_ON_RING[1] * radius_mm
    order = np.argsort(beside[:, 0])
    ordered = beside[order]
    first, last = (np.searchsorted(ordered[:, 0], places[:, 0] + side * reach_mm) for side in (-1.0, 1.0))
    parts = []
    for k, (begin, end) in enumerate(zip(first.tolist(), last.tolist(), strict=True)):
        near = ordered[begin:end] - [*places[k], 0.0]
        near = near[np.abs(near[:, 1]) < reach_mm]
        parts.append(near[np.abs(near @ planes.normal[k] - planes.offset[k]) < band_mm[k], :2])
    owner = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    x, y = np.concatenate(parts).T
    return PlanPoints(x, y, owner, len(parts))


def _goes_on(top: PlanPoints, centre: Array, radius_mm: float) -> BoolArray:
    """Where (k,) the surface goes on around where a top should end: a floor or a plate, no bar."""
    radius = top.distance(centre) / radius_mm
    low, high = _GOES_ON_RING
    disc = top.counted(radius < _GOES_ON_DISC) / _GOES_ON_DISC**2
    around = top.counted((radius > low) & (radius < high)) / (high**2 - low**2)
    return np.asarray(around > _GOES_ON_SHARE * disc)


def _is_sunk(
    patches: Patches, planes: TopPlanes, height: FloatArray, centre: Array, radius_mm: float, pitch_mm: Array
) -> BoolArray:
    """Where (k,) surfaces stand before a top all round it: that is the end of a hole, seen through it."""
    at = np.flatnonzero((height > _SUNK_MM) & planes.found[:, None])
    around = patches.crossings(at, planes.offset)
    (low, high), radius = _SUNK_RING, around.distance(centre) / radius_mm
    around = around.where((radius > low) & (radius < high))
    counts = np.bincount(around.owner * _SECTORS + around.bins(centre, _SECTORS), minlength=_SECTORS * len(centre))
    expected = np.pi * (high**2 - low**2) * (radius_mm / pitch_mm) ** 2 / _SECTORS
    shown = counts.reshape(-1, _SECTORS) > _SUNK_SHARE * expected[:, None]
    return np.asarray(shown.sum(axis=1) >= _SUNK_SECTORS)


def _passed(patches: Patches, planes: TopPlanes, behind: BoolArray, centre: Array, radius_mm: float) -> PlanPoints:
    """Where rays that passed a top, and ended on something behind it, crossed its plane."""
    if patches.eye is None:
        nothing = np.zeros(0, np.int64)
        return PlanPoints.of(patches.x, patches.y, nothing)
    at = np.flatnonzero(behind & planes.found[:, None])
    owner = at // patches.x.shape[1]
    x, y, z = (part.ravel()[at] for part in (patches.x, patches.y, patches.height))
    eye, normal = patches.eye.astype(np.float32), planes.normal.astype(np.float32)
    offset = planes.offset.astype(np.float32)
    over = np.einsum("ki,ki->k", normal, eye) - offset
    under = x * normal[owner, 0] + y * normal[owner, 1] + z * normal[owner, 2] - offset[owner]
    share = over[owner] / np.maximum(over[owner] - under, np.float32(1e-6))
    x = eye[owner, 0] + (x - eye[owner, 0]) * share
    y = eye[owner, 1] + (y - eye[owner, 1]) * share
    crossed = PlanPoints(x, y, owner, len(centre))
    radius = crossed.distance(centre)
    close = (radius > _PASSED_FROM * radius_mm) & (radius < radius_mm + _PASSED_BEYOND_MM)
    close[close] = patches.borne(at[close])
    return crossed.where(close)


def with_sides_that_lean(tops: Tops, patches: Patches, planes: TopPlanes, centre: Array, radius_mm: float) -> Tops:
    """The tops with the points of the sides of those that lean by degrees; ``centre`` (k, 2) mm is that of the tops.

    About an upright axis the side of a leaning bar leaves the band in which it is looked for, and what is left of it
    leans less than the bar does. The same tops where none leans.
    """
    own = patches.of(tops.kept)
    points, depth = _below(own, planes.of(tops.kept).height(own), np.ones(len(tops.kept), bool))
    near = points.distance(centre) < radius_mm + _SIDE_BAND_MM[1] + LEAN_MAX * depth
    points, depth = points.where(near), depth[near]
    lean = leans_that_hold(points, depth, centre, radius_mm)
    if not lean.any():
        return tops
    side_xy, side_depth, side_seen = _in_band(points, depth, centre, lean, radius_mm)
    return replace(tops, side_xy=side_xy, side_depth=side_depth, side_seen=side_seen)


def _sides(
    patches: Patches, height: FloatArray, centre: Array, radius_mm: float, kept: BoolArray
) -> tuple[Array, Array, BoolArray]:
    """Plan (k, m, 2) and depth (k, m) of points of the kept bars' sides, and which are there."""
    points, depth = _below(patches, height, kept)
    rows = _in_band(points, depth, centre, np.zeros_like(centre), radius_mm)
    return rows[0][kept], rows[1][kept], rows[2][kept]


def _below(patches: Patches, height: FloatArray, kept: BoolArray) -> tuple[PlanPoints, FloatArray]:
    """Points below the kept tops by what is looked at of a side, and their depth (n,) mm."""
    low, high = _SIDE_DEPTH_MM
    at = np.flatnonzero((height < -low) & (height > -high) & kept[:, None])
    return PlanPoints.of(patches.x, patches.y, at), -height.ravel()[at]


def _in_band(
    points: PlanPoints, depth: FloatArray, centre: Array, lean: Array, radius_mm: float
) -> tuple[Array, Array, BoolArray]:
    """Plan (k, m, 2) and depth (k, m) of points on sides about axes that lean (k, 2), and which are there."""
    moved = lean.astype(np.float32)[points.owner] * depth[:, None]
    upright = PlanPoints(points.x - moved[:, 0], points.y - moved[:, 1], points.owner, points.features)
    off_mm = upright.distance(centre) - radius_mm
    in_band = (off_mm > _SIDE_BAND_MM[0]) & (off_mm < _SIDE_BAND_MM[1])
    points, depth = points.where(in_band), depth[in_band]
    some = thinned_rows(points.owner, points.features, _SIDE_POINTS_MAX)
    values = np.column_stack([points.x[some], points.y[some], depth[some]])
    rows, seen = in_rows(values, points.owner[some], points.features)
    return rows[..., :2], rows[..., 2], seen


def leans_that_hold(points: PlanPoints, depth: FloatArray, centre: Array, radius_mm: float) -> Array:
    """Of each bar the lean (k, 2) that most points of its side agree with; upright where no other is markedly better.

    ``points`` (n,) and their ``depth`` (n,) mm are below the tops; ``centre`` (k, 2) mm is that of the tops.
    Followed from fit to fit instead, a side of few points may run after its noise.
    """
    some = thinned_rows(points.owner, points.features, _POINTS_MAX)
    owner, below = points.owner[some], depth[some]
    x, y = (points.x - centre[points.owner, 0])[some], (points.y - centre[points.owner, 1])[some]
    score = np.empty((len(_TRIED), points.features))
    for row, lean in enumerate(_TRIED):
        off_mm = np.hypot(x - lean[0] * below, y - lean[1] * below) - (radius_mm + _SIDE_MM)
        agreeing = np.maximum(1.0 - (off_mm / _HALF_MM) ** 2, 0.0)
        score[row] = np.bincount(owner, weights=agreeing, minlength=points.features)
    best = score.argmax(axis=0)
    upright, most = score[0], score.max(axis=0)
    return np.where((most > _MORE * upright + _MORE_POINTS)[:, None], _TRIED[best], 0.0)


_FEWEST = 4  # of fewer bars nobody knows which are like the others
_SIGMA_MM = 0.064  # of outlines of one group: cores of one delivery differ by 0.05 mm in radius, ribs add 0.04 mm
_ALIKE_MM = 2.5 * _SIGMA_MM  # one sound bar in a hundred is taken for a burred one
_ALIKE_SHARE = 1.0 / 3.0  # of a group: so many sound bars tell what is usual
_ROUNDS = 3  # towards the middle of all that are alike
_MOST_MM = 0.6  # a burr of 2 mm; what is larger than that is a bar of another size, or no outline
_SHIFT = float(np.pi / 2.0 / np.sqrt(2.0))  # of a circle that is larger by 1: b/2 over b/π, per axis for any direction


def burr_u_mm(rims: Outlines, centre: Array, radius_mm: float) -> Array:
    """Standard uncertainty (k,) mm, per axis, of centres whose outlines are larger than those of most of the group.

    Parameters
    ----------
    rims
        The outlines of the tops.
    centre
        (k, 2) mm, of circles of one radius through them.
    """
    if len(centre) < _FEWEST:
        return np.zeros(len(centre))
    own_mm = circles_through(rims, centre, radius_mm)[1]
    beyond_mm = own_mm - _usual(own_mm)
    larger_mm = np.minimum(beyond_mm, _MOST_MM) + _SIGMA_MM
    return np.where(beyond_mm > _ALIKE_MM, _SHIFT * larger_mm, 0.0)


def _usual(values: Array) -> float:
    """Middle of those bars that are like each other and smallest: burrs only ever add, to a half of the group, too."""
    ordered, held = np.sort(values), max(2, round(_ALIKE_SHARE * len(values)))
    width = ordered[held - 1 :] - ordered[: len(values) - held + 1]
    first = int(np.flatnonzero(width <= max(_ALIKE_MM, width.min()))[0])
    middle = float(median(ordered[first : first + held]))
    for _ in range(_ROUNDS):
        middle = float(median(ordered[np.abs(ordered - middle) <= _ALIKE_MM]))
    return middle
