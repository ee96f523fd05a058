"""On which side of a foot face the air is."""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.plane import facing, in_plane, turned_over
from aadm_workbench.model import Array, FloatArray, Plane, Scan

WALL_DEPTH_MM = 3.0  # from here on a point beside the plane is a wall and no noise
_AROUND = 1.1  # of the radius


def out_of_the_concrete(plane: Plane, scan: Scan, points: FloatArray, centres: Array, radius_mm: float) -> Plane:
    """Turn the normal of a face to the viewpoint; without one, away from where its holes have their walls.

    ``points`` (n, 3) mm are all of the scan, ``centres`` (k, 3) mm those of the holes, both in the scan frame.
    """
    if scan.viewpoint is not None:
        return facing(plane, scan.viewpoint)
    beside = in_plane(points[np.abs(plane.height(points)) > WALL_DEPTH_MM].astype(np.float64), plane)
    balance = 0.0
    for centre in in_plane(centres, plane):
        inside = np.hypot(*(beside[:, :2] - centre[:2]).T) < _AROUND * radius_mm
        balance += float(np.sign(beside[inside, 2]).sum())
    return turned_over(plane) if balance > 0 else plane
