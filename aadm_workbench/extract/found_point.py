"""A measured centre in the axes of a plane, as an assembly point of the scan frame."""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.plane import axes_on, from_plane
from aadm_workbench.model import Array, AssemblyPoint, Kind, Plane

_U_HEIGHT_MIN_MM = 0.02


def found_point(
    kind: Kind,
    plane: Plane,
    centre: Array,
    axis: Array,
    covariance: Array,
    height_u_mm: float,
    diameter_mm: float,
    why: str,
) -> AssemblyPoint:
    """Lift a centre (3,) and an axis (3,) from a plane's own axes into the scan frame, with its uncertainty.

    ``covariance`` (2, 2) mm² is that of the plan position; ``height_u_mm`` is the standard uncertainty across it.
    """
    axes = axes_on(plane)
    direction = axes.T @ axis
    flat = np.zeros((3, 3))
    flat[:2, :2] = covariance
    flat[2, 2] = max(height_u_mm, _U_HEIGHT_MIN_MM) ** 2
    return AssemblyPoint(
        label="",
        kind=kind,
        centre=from_plane(centre, plane),
        axis=direction / np.linalg.norm(direction),
        diameter_mm=diameter_mm,
        covariance=axes.T @ flat @ axes,
        why=why,
    )
