"""The published method without anything around it: what its three library calls alone take.

RANSAC plane of Open3D (50 mm, 500 iterations) on all points of the scan, the raster of the face or of the tops at the
scan's own pitch, Hough circles of OpenCV. This is what a straightforward program of the paper's steps cannot do
without, so it is the honest thing to divide by: no thinning, no repeatable draw, no way back to 3-D, and the filter
along z is not counted. On all points the plane under bars is that of the floor: this is a time and no result.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.published.binary_image import binary_image, pitch_mm
from aadm_workbench.extract.published.fusion import INLIER_DISTANCE_MM, ITERATIONS, projected_onto
from aadm_workbench.extract.published.hough import RADIUS_MISFIT, hough_circles, votes_needed
from aadm_workbench.extract.published.pass_through import face_range_mm, finite_points, passed, tops_range_mm
from aadm_workbench.extract.published.ransac_plane import SAMPLE, open3d_for
from aadm_workbench.model import Kind, Plane, Scan

_POINTS_MIN = 100  # as in the method itself (fusion.py)


def seconds_of_bare_calls(scan: Scan, kind: Kind, diameter_mm: float, clock: Callable[[], float]) -> float | None:
    """Seconds of the three calls on a scan in memory; None where it holds too little.

    Open3D and OpenCV use as many threads as they like.
    """
    open3d = open3d_for("fusion")
    points = finite_points(scan)
    pixel_mm = pitch_mm(scan, None, diameter_mm / 2)
    if len(points) < _POINTS_MIN or pixel_mm is None:
        return None
    points_of_a_top = np.pi * (diameter_mm / 2 / pixel_mm) ** 2
    is_foot = kind is Kind.SLEEVE
    kept = passed(points, face_range_mm(points) if is_foot else tops_range_mm(points, scan.viewpoint, points_of_a_top))
    if len(kept) == 0:
        return None
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points.astype(np.float64)))
    nominal = diameter_mm / 2 / pixel_mm
    began = clock()
    model, _ = cloud.segment_plane(INLIER_DISTANCE_MM, SAMPLE, ITERATIONS)
    length = float(np.linalg.norm(model[:3]))
    plane = Plane(np.asarray(model[:3]) / length, -float(model[3]) / length)
    on_plane = in_plane(projected_onto(kept, plane), plane)[:, :2]
    image = binary_image(on_plane, pixel_mm, diameter_mm).filled
    shown = np.asarray(image if is_foot else 255 - image, np.uint8)
    hough_circles(shown, ((1.0 - RADIUS_MISFIT) * nominal, (1.0 + RADIUS_MISFIT) * nominal), votes_needed(nominal))
    return clock() - began
