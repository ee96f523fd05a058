"""What the top of each bar shows by itself: the plane that it was cut in, and its diameter.

Tops differ by centimetres and may be cut slanted, so each has a plane of its own.

The fit of all bars shares one radius, which is what makes centres sure; a single bar of another size is lost in it, or
not measured at all. Its own outline tells it apart. What a camera does at edges it does to all, so that what outlines
say is set against the shared diameter of the bars that were measured.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import (
    Outlines,
    PlanPoints,
    agreeing_shares,
    bins_for,
    circles_through,
    in_rows,
    outlines,
    thinned_rows,
)
from aadm_workbench.extract.patches import Patches, patches_around
from aadm_workbench.extract.plane import BAND_SIGMAS, LEAST_BAND_MM, WIDEST_BAND, in_plane
from aadm_workbench.extract.sample import thinned
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray, Plane, Scan
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import median

_TOP_ZONE_MM = 8.0  # a cut of 15 degrees over a 28 mm bar
_CORE = 0.95  # of the radius
_LAYER_MM = 1.2  # a flat cut within the noise of a camera; what hangs in the air above is spread over more
_LAYER_SHARE = 0.3  # of the fullest layer: a top of which a piece is broken off still is the highest such layer
_LEAN_COSINE = 0.85  # 32 degrees: cuts slant by half of that at most, and sides stand square to them
_FEWEST_OF_PLANE = 20  # points of a plane, as in plane.py
_ENOUGH_OF_PLANE = 500  # points of one top
_HYPOTHESES = 80  # a top that half of the points of a core lie on is missed once in 40,000
_INLIER_DISTANCE_MM = 0.5  # the noise of the reference camera at 2 m is 0.4 mm
_PLANE_ROUNDS = 5  # as many as in plane.py


@dataclass(frozen=True, eq=False)
class TopPlanes:
    """Planes of k tops: ``normal`` (k, 3), unit, upwards, ``offset`` (k,) mm and ``residual_mm`` (k,) as of ``Plane``.

    In the axes of the patches, each about its own place. ``found`` (k,) tells which there are.
    """

    normal: Array
    offset: Array
    residual_mm: Array
    found: BoolArray

    def of(self, chosen: IntArray) -> TopPlanes:
        """Those of some of the tops (m,)."""
        return TopPlanes(self.normal[chosen], self.offset[chosen], self.residual_mm[chosen], self.found[chosen])

    def height(self, patches: Patches) -> FloatArray:
        """Height (k, n) float32, mm, of all points of the patches over the top of their bar."""
        normal, offset = self.normal.astype(np.float32), self.offset.astype(np.float32)
        over = patches.x * normal[:, :1] + patches.y * normal[:, 1:2] + patches.height * normal[:, 2:]
        return np.asarray(over - offset[:, None])


def top_planes(patches: Patches, radius_mm: float, rng: np.random.Generator) -> TopPlanes:
    """Planes of the tops among patches about the bars.

    Points that fly above a top are few and scattered, so the top is the highest layer that many points share.
    """
    features = len(patches.x)
    points, seen = _cores(patches, radius_mm)
    level = np.array([_level(points[k, seen[k], 2]) for k in range(features)])
    seen &= np.abs(points[..., 2] - level[:, None]) < _TOP_ZONE_MM
    points, seen = in_rows(points[seen], np.nonzero(seen)[0], features)
    found = seen.sum(axis=1) >= _FEWEST_OF_PLANE
    if not found.any():
        nothing = np.zeros(features)
        return TopPlanes(np.tile([0.0, 0.0, 1.0], (features, 1)), nothing, nothing, found)
    normal, offset = _ransac(points, seen, rng)
    normal, offset, residual_mm = _least_squares(points, seen, normal, offset)
    found &= np.abs(normal[:, 2]) >= _LEAN_COSINE
    upwards = np.where(normal[:, 2] < 0, -1.0, 1.0)
    return TopPlanes(normal * upwards[:, None], offset * upwards, residual_mm, found)


def _cores(patches: Patches, radius_mm: float) -> tuple[Array, BoolArray]:
    inside = patches.x * patches.x + patches.y * patches.y < (_CORE * radius_mm) ** 2
    chosen = np.flatnonzero(inside)
    owner = chosen // patches.x.shape[1]
    kept = thinned_rows(owner, len(patches.x), _ENOUGH_OF_PLANE)
    chosen, owner = chosen[kept], owner[kept]
    points = np.column_stack([part.ravel()[chosen] for part in (patches.x, patches.y, patches.height)])
    return in_rows(points, owner, len(patches.x))


def _level(heights: Array) -> float:
    """Height of the highest layer that many points (n,) share: slips of the fringe order hang above it by the dozen."""
    if len(heights) == 0:
        return 0.0
    ordered = np.sort(heights)
    within = np.searchsorted(ordered, ordered + _LAYER_MM, side="right") - np.arange(len(ordered))
    full = np.flatnonzero(within >= _LAYER_SHARE * within.max())
    return float(ordered[full[-1]] + 0.5 * _LAYER_MM)


def _ransac(points: Array, seen: BoolArray, rng: np.random.Generator) -> tuple[Array, Array]:
    """The plane through three points of each feature that most others lie on: normals (k, 3) and offsets (k,)."""
    features = np.arange(len(points))
    draw = rng.random((len(points), _HYPOTHESES * 3)) * np.maximum(seen.sum(axis=1), 1)[:, None]
    corners = points[features[:, None], draw.astype(np.int64)].reshape(len(points), _HYPOTHESES, 3, 3)
    normals = np.cross(corners[:, :, 1] - corners[:, :, 0], corners[:, :, 2] - corners[:, :, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-9)
    offsets = np.einsum("khi,khi->kh", normals, corners[:, :, 0])
    distance = normals.astype(np.float32) @ points.astype(np.float32).transpose(0, 2, 1)
    agree = np.abs(distance - offsets[..., None].astype(np.float32)) < 2.0 * _INLIER_DISTANCE_MM
    flat = np.abs(normals[..., 2]) >= _LEAN_COSINE  # a bar's side has many points too
    best = (np.where(flat, (agree & seen[:, None]).sum(axis=2), -1)).argmax(axis=1)
    return normals[features, best], offsets[features, best]


def _least_squares(points: Array, seen: BoolArray, normal: Array, offset: Array) -> tuple[Array, Array, Array]:
    """Planes through the inliers of others, repeated with a band that narrows to three robust sigmas."""
    widest_mm = WIDEST_BAND * _INLIER_DISTANCE_MM
    band_mm, residual_mm = np.full(len(points), widest_mm), np.zeros(len(points))
    for _ in range(_PLANE_ROUNDS):
        inside = seen & (np.abs(np.einsum("kmi,ki->km", points, normal) - offset[:, None]) < band_mm[:, None])
        enough = inside.sum(axis=1) >= _FEWEST_OF_PLANE
        weight = inside / np.maximum(inside.sum(axis=1, keepdims=True), 1)
        centre = np.einsum("km,kmi->ki", weight, points)
        about = points - centre[:, None]
        smallest = np.linalg.eigh((about * weight[..., None]).transpose(0, 2, 1) @ about)[1][..., 0]
        smallest *= np.where(np.einsum("ki,ki->k", smallest, normal) < 0, -1.0, 1.0)[:, None]
        normal = np.where(enough[:, None], smallest, normal)
        offset = np.where(enough, np.einsum("ki,ki->k", normal, centre), offset)
        off = np.abs(np.einsum("kmi,ki->km", about, normal))
        spread = np.array(
            [TO_SIGMA * float(median(o[i])) if i.any() else 0.0 for o, i in zip(off, inside, strict=True)]
        )
        residual_mm = np.where(enough, spread, residual_mm)
        band_mm = np.clip(BAND_SIGMAS * residual_mm, LEAST_BAND_MM, widest_mm)
    return normal, offset, residual_mm


_SAMPLE = 30_000  # pixels: they say where to look, within a stride
_CORE_SHARE = 0.7  # of the nominal radius: the plane of a top two sizes smaller is found in it
_BAND_MM = 0.8  # about the plane of a top: twice the noise at 2 m
_ZONE = 0.35, 1.7  # of the nominal radius: bars two sizes off either way, and nothing that stands beside them
_ROUNDS = 4  # points of ribs leave in the first two
# an outline's points lie up to a pitch within the edge, on either side of their middle; at a lost pixel a little more
_ROUND_WITHIN_PITCHES = 0.75
# ribs stand out by more; of the outline; of the turn: a choice, not tuned since
_ROUND_WITHIN_MM, _ROUND_SHARE, _COVERED_SHARE = 0.45, 0.6, 0.7
_FEWEST, _ENOUGH = 2, 4  # of fewer a median is no sign; of fewer nobody knows how much outlines of this scan scatter
# of one outline: half a pixel, and ribs that stand out on one side; a whole pixel where the scatter is not known
_LEAST_U_MM, _UNKNOWN_U_MM = 0.25, 0.5
_OF_MEDIAN = 1.57  # variance of a median against that of a mean, for the normal law


@dataclass(frozen=True, eq=False)
class OwnDiameters:
    """Diameters (k,) mm of single bars, NaN where an outline is not round or not seen, and their standard uncertainty.

    None of them is known where fewer than two bars tell what outlines of sound bars look like.
    """

    diameters_mm: Array
    u_mm: float


def own_diameters(
    scan: Scan, level: Plane, places: Array, shared_mm: Array, nominal_mm: float, rng: np.random.Generator
) -> OwnDiameters:
    """Diameters of bars that stand at some places.

    Parameters
    ----------
    level
        Plane of the tops, scan frame.
    places
        (k, 3) mm, scan frame: measured tops, and where one should be.
    shared_mm
        (k,) the diameters that all bars share; NaN where none was measured.
    """
    own_mm = 2.0 * _radii(scan, level, places, nominal_mm / 2.0, rng)
    known = np.isfinite(own_mm) & np.isfinite(shared_mm)
    if known.sum() < _FEWEST:
        return OwnDiameters(np.full(len(places), np.nan), 0.0)
    beyond = own_mm[known] - shared_mm[known]
    usual_mm = float(median(beyond))
    scatter_mm = TO_SIGMA * float(median(np.abs(beyond - usual_mm)))
    least_mm = _LEAST_U_MM if known.sum() >= _ENOUGH else _UNKNOWN_U_MM
    u_mm = max(scatter_mm, least_mm) * float(np.sqrt(1.0 + _OF_MEDIAN / known.sum()))
    return OwnDiameters(own_mm - usual_mm, u_mm)


def _radii(scan: Scan, level: Plane, places: Array, radius_mm: float, rng: np.random.Generator) -> Array:
    """Radii (k,) mm of the outlines of the tops, NaN where there is no round one."""
    centres = in_plane(places, level)[:, :2]
    patches = patches_around(scan, thinned(scan, _SAMPLE, rng), level, centres, _ZONE[1] * radius_mm + 2.0)
    planes = top_planes(patches, _CORE_SHARE * radius_mm, rng)
    if not planes.found.any():
        return np.full(len(places), np.nan)
    band_mm = np.maximum(3.0 * planes.residual_mm, _BAND_MM).astype(np.float32)[:, None]
    on_top = (np.abs(planes.height(patches)) < band_mm) & planes.found[:, None]
    top = PlanPoints.of(patches.x, patches.y, np.flatnonzero(on_top))
    inside = np.bincount(top.owner[top.distance(np.zeros_like(centres)) < radius_mm], minlength=len(places))
    pitch_mm = np.sqrt(np.pi * radius_mm**2 / np.maximum(inside, 1))
    usual_pitch_mm = float(median(pitch_mm[planes.found]))
    bins = bins_for(radius_mm, usual_pitch_mm)
    centre, radius = np.zeros((len(places), 2)), np.full(len(places), radius_mm)
    for _ in range(_ROUNDS):
        shape = _outlined(top, centre, radius_mm, bins)
        centre, radius = circles_through(shape, centre, radius_mm)
    within_mm = max(_ROUND_WITHIN_MM, _ROUND_WITHIN_PITCHES * usual_pitch_mm)
    round_ = agreeing_shares(shape, centre, radius, within_mm) > _ROUND_SHARE
    return np.where(round_ & (shape.coverage > _COVERED_SHARE) & planes.found, radius, np.nan)


def _outlined(top: PlanPoints, centre: Array, radius_mm: float, bins: int) -> Outlines:
    far_mm = top.distance(centre)
    wanted = (far_mm > _ZONE[0] * radius_mm) & (far_mm < _ZONE[1] * radius_mm)
    return outlines(top.where(wanted), centre, bins, innermost=False)
