"""Measured centres in the axes of a plane, as assembly points of the scan frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.extract.plane import axes_on, from_plane
from aadm_workbench.model import Array, AssemblyPoint, Kind, Plane

_U_HEIGHT_MIN_MM = 0.02


def found_points(
    kind: Kind,
    plane: Plane,
    centres: Array,
    directions: Array,
    covariances: Array,
    heights_u_mm: Array,
    diameters_mm: Array,
    why: Sequence[str],
) -> tuple[AssemblyPoint, ...]:
    """Lift centres (k, 3) and axes (k, 3) from a plane's own axes into the scan frame, with their uncertainty.

    ``covariances`` (k, 2, 2) mm² are those of the plan positions; ``heights_u_mm`` (k,) are the standard uncertainties
    across it. ``diameters_mm`` (k,); ``why`` the evidence in words.
    """
    axes = axes_on(plane)
    turned = directions @ axes
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    flat = np.zeros((len(centres), 3, 3))
    flat[:, :2, :2] = covariances
    flat[:, 2, 2] = np.maximum(heights_u_mm, _U_HEIGHT_MIN_MM) ** 2
    lifted = axes.T @ flat @ axes
    return tuple(
        AssemblyPoint("", kind, centre, axis, diameter_mm, covariance, why=words)
        for centre, axis, diameter_mm, covariance, words in zip(
            from_plane(centres, plane), turned, diameters_mm.tolist(), lifted, why, strict=True
        )
    )
