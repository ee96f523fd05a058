"""The plane of each bar's top: tops differ by centimetres and may be cut slanted, so each has its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import in_rows, thinned_rows
from aadm_workbench.extract.patches import Patches
from aadm_workbench.extract.plane import BAND_SIGMAS, LEAST_BAND_MM, WIDEST_BAND
from aadm_workbench.model import Array, BoolArray, FloatArray, IntArray
from aadm_workbench.model.measured import TO_SIGMA

_TOP_ZONE_MM = 8.0  # a cut of 15 degrees over a 28 mm bar
_CORE = 0.95  # of the radius
_LAYER_MM = 1.2  # a flat cut within the noise of a camera; what hangs in the air above is spread over more
_LAYER_SHARE = 0.3  # of the fullest layer: a top of which a piece is broken off still is the highest such layer
_LEAN_COSINE = 0.85  # 32 degrees: cuts slant by half of that at most, and sides stand square to them
_FEWEST = 20  # points of a plane, as in plane.py
_ENOUGH = 500  # points of one top
_HYPOTHESES = 80  # a top that half of the points of a core lie on is missed once in 40,000
_INLIER_DISTANCE_MM = 0.5  # the noise of the reference camera at 2 m is 0.4 mm
_ROUNDS = 5  # as many as in plane.py


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
    found = seen.sum(axis=1) >= _FEWEST
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
    kept = thinned_rows(owner, len(patches.x), _ENOUGH)
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
    for _ in range(_ROUNDS):
        inside = seen & (np.abs(np.einsum("kmi,ki->km", points, normal) - offset[:, None]) < band_mm[:, None])
        enough = inside.sum(axis=1) >= _FEWEST
        weight = inside / np.maximum(inside.sum(axis=1, keepdims=True), 1)
        centre = np.einsum("km,kmi->ki", weight, points)
        about = points - centre[:, None]
        smallest = np.linalg.eigh((about * weight[..., None]).transpose(0, 2, 1) @ about)[1][..., 0]
        smallest *= np.where(np.einsum("ki,ki->k", smallest, normal) < 0, -1.0, 1.0)[:, None]
        normal = np.where(enough[:, None], smallest, normal)
        offset = np.where(enough, np.einsum("ki,ki->k", normal, centre), offset)
        off = np.abs(np.einsum("kmi,ki->km", about, normal))
        spread = np.array(
            [TO_SIGMA * float(np.median(o[i])) if i.any() else 0.0 for o, i in zip(off, inside, strict=True)]
        )
        residual_mm = np.where(enough, spread, residual_mm)
        band_mm = np.clip(BAND_SIGMAS * residual_mm, LEAST_BAND_MM, widest_mm)
    return normal, offset, residual_mm
