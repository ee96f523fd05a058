"""Planes in a scan: RANSAC to find one, least squares on its inliers to measure it.

The threshold is about 1 mm, not the 50 mm of the published method: a wide one swallows the
sleeves' inner walls and pulls the plane by 0.2 to 0.8 mm.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, BoolArray, Plane

INLIER_DISTANCE_MM = 1.2
_HYPOTHESES = 400
_SCORED = 2500
_ENOUGH = 15_000  # points: noise averages out long before, and what remains is the camera's own warp


def find_plane(
    points: Array,
    rng: np.random.Generator,
    inlier_distance_mm: float = INLIER_DISTANCE_MM,
    hypotheses: int = _HYPOTHESES,
) -> Plane | None:
    """The plane that most points (n, 3) mm lie on; None where there are too few points.

    Its normal has no preferred side yet: see :func:`facing`.
    """
    if len(points) < 50:
        return None
    scored = points[rng.integers(0, len(points), _SCORED)] if len(points) > _SCORED else points
    corners = scored[rng.integers(0, len(scored), (hypotheses, 3))]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    usable = lengths > 1e-9 * max(1.0, float(lengths.max(initial=0.0)))
    if not usable.any():
        return None
    normals = normals[usable] / lengths[usable, None]
    offsets = np.einsum("ij,ij->i", normals, corners[usable, 0])
    inliers = (np.abs(scored @ normals.T - offsets) < 2.0 * inlier_distance_mm).sum(axis=0)
    best = int(inliers.argmax())
    return refined_plane(points, Plane(normals[best], float(offsets[best])), inlier_distance_mm)


def refined_plane(points: Array, start: Plane, inlier_distance_mm: float = INLIER_DISTANCE_MM) -> Plane:
    """Least squares on the inliers of a plane, repeated with a band that narrows to three robust sigmas."""
    plane, band = start, 2.5 * inlier_distance_mm
    for _ in range(5):
        inliers = points[np.abs(plane.height(points)) < band]
        if len(inliers) < 20:
            return plane
        centre = inliers.mean(axis=0)
        covariance = np.cov((inliers - centre).T)
        normal = np.linalg.eigh(covariance)[1][:, 0]
        normal = normal if normal @ plane.normal > 0 else -normal
        plane = Plane(normal, float(normal @ centre))
        residual = 1.4826 * float(np.median(np.abs(plane.height(inliers))))
        plane = Plane(plane.normal, plane.offset, residual)
        band = min(2.5 * inlier_distance_mm, max(3.5 * residual, 0.1))
    return plane


def find_planes(points: Array, rng: np.random.Generator, count: int) -> list[Plane]:
    """Up to ``count`` planes, the one with most points first; each is searched among what the last ones left."""
    planes: list[Plane] = []
    left = points[:: max(1, len(points) // _ENOUGH)]
    points = left
    for _ in range(count):
        plane = find_plane(left, rng)
        if plane is None:
            break
        planes.append(plane)
        left = left[np.abs(plane.height(left)) > 3.0 * INLIER_DISTANCE_MM]
        if len(left) < 0.02 * len(points):
            break
    return planes


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


def in_plane(points: Array, plane: Plane) -> Array:
    """Points (n, 3) mm of the scan frame as (x, y, height) in the plane's own axes; see :func:`axes_on`."""
    local = points @ axes_on(plane).T
    local[:, 2] -= plane.offset
    return np.asarray(local)


def from_plane(local: Array, plane: Plane) -> Array:
    """The inverse of :func:`in_plane`."""
    lifted = np.array(local, np.float64)
    lifted[..., 2] += plane.offset
    return np.asarray(lifted @ axes_on(plane))


def near(points: Array, plane: Plane, distance_mm: float) -> BoolArray:
    """Which points (n, 3) lie within a distance of the plane."""
    return np.asarray(np.abs(plane.height(points)) < distance_mm)
