"""Measured centres in the axes of a plane, as assembly points of the scan frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.extract.plane import axes_on, from_plane
from aadm_workbench.model import Array, AssemblyPoint, BoolArray, Kind, Plane

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
    return [
        float(np.percentile(d[s], _SEEN_PERCENT)) if e else None for d, s, e in zip(depth, seen, enough, strict=True)
    ]
