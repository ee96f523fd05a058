"""Planes in a scan: RANSAC to find one, least squares on its inliers to measure it.

The threshold is about 1 mm, not the 50 mm of the published method: a wide one swallows the
sleeves' inner walls and pulls the plane by 0.2 to 0.8 mm.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from aadm_workbench.model import Array, AssemblyPoint, BoolArray, FloatArray, IntArray, Kind, Plane
from aadm_workbench.model.measured import TO_SIGMA
from aadm_workbench.model.special import median, percentiles

INLIER_DISTANCE_MM = 1.2
"""Three standard deviations of the reference camera's noise at 2 m (0.4 mm): a wider band takes in walls."""
WIDEST_BAND = 2.5
"""Inlier distances in which a plane's own points are searched first: the plane of three of them is off by as much."""
BAND_SIGMAS, LEAST_BAND_MM = 3.5, 0.1
"""The band that a plane is fitted in: one point in 2,000 of a normal law lies outside, and steps of depth within."""
_HYPOTHESES = 400  # a plane that a quarter of the points lie on is missed once in 500 searches
# that plane has 75 ± 8 of the first 300, which puts it among the likely ones; all points then decide
_SCORED, _SCORED_AT_FIRST, _LIKELY = 2000, 300, 24
_ENOUGH, _ENOUGH_AT_FIRST = 10_000, 2_500  # points: noise averages out long before; what remains is the camera's warp
# the band narrows on a few points; all of them then measure (a choice: ±30 % moves centres by up to 0.3 u)
_ROUNDS_AT_FIRST, _ROUNDS = 3, 2


def find_plane(
    points: FloatArray,
    rng: np.random.Generator,
    inlier_distance_mm: float = INLIER_DISTANCE_MM,
    hypotheses: int = _HYPOTHESES,
) -> Plane | None:
    """The plane that most points (n, 3) mm lie on; None where there are too few points.

    Its normal has no preferred side yet: see :func:`facing`.
    """
    if len(points) < 50:  # fewer agree on a plane by chance
        return None
    scored = points[rng.integers(0, len(points), _SCORED)] if len(points) > _SCORED else points
    middle = scored.mean(axis=0, dtype=np.float64)
    scored = (scored - middle).astype(np.float32)  # near the origin single precision is enough
    corners = scored[rng.integers(0, len(scored), (hypotheses, 3))].astype(np.float64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    usable = lengths > 1e-9 * max(1.0, float(lengths.max(initial=0.0)))
    if not usable.any():
        return None
    normals = normals[usable] / lengths[usable, None]
    offsets = np.einsum("ij,ij->i", normals, corners[usable, 0])
    within_mm = 2.0 * inlier_distance_mm
    likely = np.argsort(-_counted(scored[:_SCORED_AT_FIRST], normals, offsets, within_mm), kind="stable")[:_LIKELY]
    best = likely[_counted(scored, normals[likely], offsets[likely], within_mm).argmax()]
    offset = float(offsets[best] + normals[best] @ middle)
    return refined_plane(points, Plane(normals[best], offset), inlier_distance_mm)


def _counted(points: FloatArray, normals: Array, offsets: Array, within_mm: float) -> IntArray:
    """How many points (n, 3) lie near each of some planes (m,)."""
    distances = normals.astype(np.float32) @ points.T
    distances -= offsets[:, None].astype(np.float32)
    return np.asarray((np.abs(distances, out=distances) < within_mm).sum(axis=1))


def refined_plane(points: FloatArray, start: Plane, inlier_distance_mm: float = INLIER_DISTANCE_MM) -> Plane:
    """Least squares on the inliers of a plane, repeated with a band that narrows to three robust sigmas."""
    widest_mm = WIDEST_BAND * inlier_distance_mm
    plane, band = start, widest_mm
    few = points[:: len(points) // _ENOUGH_AT_FIRST + 1]
    for part in (few,) * _ROUNDS_AT_FIRST + (points,) * _ROUNDS:
        inliers = part[np.abs(plane.height(part)) < band]
        if len(inliers) < 20:  # nothing to average
            return plane
        centre = inliers.mean(axis=0, dtype=np.float64)
        about = inliers - centre
        normal = np.linalg.eigh(about.T @ about)[1][:, 0]
        normal = normal if normal @ plane.normal > 0 else -normal
        residual = TO_SIGMA * float(median(np.abs(about @ normal)))
        plane = Plane(normal, float(normal @ centre), residual)
        band = min(widest_mm, max(BAND_SIGMAS * residual, LEAST_BAND_MM))
    return plane


def find_planes(points: FloatArray, rng: np.random.Generator, count: int) -> Iterator[Plane]:
    """Up to ``count`` planes, the one with most points first; each is searched among what the last ones left."""
    left = points[:: max(1, len(points) // _ENOUGH)]
    all_of_them = len(left)
    for _ in range(count):
        plane = find_plane(left, rng)
        if plane is None:
            return
        yield plane
        left = left[np.abs(plane.height(left)) > 3.0 * INLIER_DISTANCE_MM]
        if len(left) < 0.02 * all_of_them:  # strays
            return


def facing(plane: Plane, viewpoint: Array) -> Plane:
    """The same plane with its normal on the side of the viewpoint (3,) mm."""
    towards = float(plane.normal @ viewpoint) - plane.offset
    return plane if towards >= 0 else turned_over(plane)


def turned_over(plane: Plane) -> Plane:
    """The same plane with the opposite normal."""
    return Plane(-plane.normal, -plane.offset, plane.residual_mm)


def axes_on(plane: Plane) -> Array:
    """Rotation (3, 3) whose rows are two directions in the plane and its normal (right-handed)."""
    helper = np.eye(3)[int(np.abs(plane.normal).argmin())]
    first = np.cross(helper, plane.normal)
    first /= np.linalg.norm(first)
    return np.vstack([first, np.cross(plane.normal, first), plane.normal])


def in_plane(points: FloatArray, plane: Plane) -> Array:
    """Points (n, 3) mm of the scan frame as (x, y, height) in the plane's own axes; see :func:`axes_on`."""
    local = points @ axes_on(plane).T
    local[:, 2] -= plane.offset
    return np.asarray(local)


def from_plane(local: Array, plane: Plane) -> Array:
    """The inverse of :func:`in_plane`."""
    lifted = np.array(local, np.float64)
    lifted[..., 2] += plane.offset
    return np.asarray(lifted @ axes_on(plane))


def near(points: FloatArray, plane: Plane, distance_mm: float) -> BoolArray:
    """Which points (n, 3) lie within a distance of the plane."""
    return np.asarray(np.abs(plane.height(points)) < distance_mm)


# a camera's warp does not average out as noise does: 0.025 mm rms of the reference camera, less over one mouth
_U_HEIGHT_MIN_MM = 0.02
_SEEN_COUNT_MIN, _SEEN_PERCENT = 10, 95.0  # strays lie deepest


def found_points(
    kind: Kind,
    plane: Plane,
    centres: Array,
    directions: Array,
    covariances: Array,
    heights_u_mm: Array,
    diameters_mm: Array,
    why: Sequence[str],
    leans: Array,
    seen_lengths_mm: Sequence[float | None],
) -> tuple[AssemblyPoint, ...]:
    """Lift centres (k, 3) and axes (k, 3) from a plane's own axes into the scan frame, with their uncertainty.

    ``covariances`` (k, 2, 2) mm² are those of the plan positions; ``heights_u_mm`` (k,) are the standard uncertainties
    across it. ``diameters_mm`` (k,); ``why`` the evidence. ``leans`` (k, 2, 2) are the covariances of the axes'
    offsets per length, what is usual taken in; ``seen_lengths_mm`` how much of each bore or bar is seen.
    """
    axes = axes_on(plane)
    turned = directions @ axes
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    flat = np.zeros((len(centres), 3, 3))
    flat[:, :2, :2] = covariances
    flat[:, 2, 2] = np.maximum(heights_u_mm, _U_HEIGHT_MIN_MM) ** 2
    lifted = axes.T @ flat @ axes
    turning = np.zeros((len(centres), 3, 3))
    turning[:, :2, :2] = leans
    turning = axes.T @ turning @ axes
    rows = zip(
        from_plane(centres, plane), turned, diameters_mm.tolist(), lifted, why, turning, seen_lengths_mm, strict=True
    )
    return tuple(
        AssemblyPoint(
            "",
            kind,
            centre,
            axis,
            diameter_mm,
            covariance,
            why=words,
            axis_covariance=lean,
            axis_believed=True,
            seen_length_mm=seen_mm,
        )
        for centre, axis, diameter_mm, covariance, words, lean, seen_mm in rows
    )


def seen_lengths(depth: Array, seen: BoolArray) -> list[float | None]:
    """How far down each of k bores or bars points are seen that tell of its axis, mm; None where there are too few.

    ``depth`` (k, m) mm of the points along the axis, and which of them are there, ``seen`` (k, m).
    """
    enough = seen.sum(axis=1) >= _SEEN_COUNT_MIN
    return [float(percentiles(d[s], _SEEN_PERCENT)) if e else None for d, s, e in zip(depth, seen, enough, strict=True)]
