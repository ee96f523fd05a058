"""Clusters of a cloud: DBSCAN of Open3D."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.model import Array, IntArray


def dbscan(open3d: Any, points: Array, neighbour_mm: float, core_points: int, at_least: float) -> list[IntArray]:
    """Indices of the points (n, 3) mm of each cluster that has ``at_least`` so many of them, in DBSCAN's order."""
    if len(points) < core_points:
        return []
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    label = np.asarray(cloud.cluster_dbscan(neighbour_mm, core_points), np.int64)
    order = np.argsort(label, kind="stable")
    counts = np.bincount(label + 1)  # the first count is that of noise, label -1
    members = np.split(order, np.cumsum(counts)[:-1])[1:]
    return [member.astype(np.int64) for member in members if len(member) >= at_least]
