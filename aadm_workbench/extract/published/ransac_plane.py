"""RANSAC plane of Open3D, in a way that repeats."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.errors import install_of, needed
from aadm_workbench.model import FloatArray, Plane
from aadm_workbench.model.measured import TO_SIGMA

SAMPLE = 3  # points that make a plane
SCORED = 50_000  # more of them place a plane no better


def open3d_for(method: str) -> Any:
    """Open3D, imported where it is used.

    Raises
    ------
    MissingDependencyError
        Where it is not installed.
    """
    with needed("open3d", f"Method {method}", install_of("published")):
        import open3d
    return open3d


def ransac_plane(
    open3d: Any, points: FloatArray, inlier_distance_mm: float, iterations: int, rng: np.random.Generator
) -> Plane | None:
    """The plane ax + by + cz + d = 0 that most points (n, 3) mm lie on; None for fewer than three points.

    At most ``SCORED`` of the points are looked at, and every hypothesis on them: Open3D stops as soon as one of its
    threads has a hypothesis that is good enough, so with its early stop the result would depend on the machine's load.
    Open3D ends with least squares on the inliers.
    """
    if len(points) < SAMPLE:
        return None
    scored = points[rng.integers(0, len(points), SCORED)] if len(points) > SCORED else points
    scored = scored.astype(np.float64)
    open3d.utility.random.seed(int(rng.integers(2**31)))  # it takes a C int
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(scored))
    model, _ = cloud.segment_plane(inlier_distance_mm, SAMPLE, iterations, 1.0)
    length = float(np.linalg.norm(model[:3]))
    if not length > 0:
        return None
    plane = Plane(np.asarray(model[:3]) / length, -float(model[3]) / length)
    height = np.abs(plane.height(scored))
    inliers = height[height < inlier_distance_mm]
    return Plane(plane.normal, plane.offset, TO_SIGMA * float(np.median(inliers)) if len(inliers) else 0.0)
