"""What a method made of each true point of a scan: errors in the scan frame, without any fit to the truth.

A camera's scale error is no error of a method: the true points are taken as far from the camera as it would have them.
It counts where a method's uncertainty is held against the truth, since that uncertainty has to cover it.

Errors lie in the plane across the true vertical. Their x and y are the image's right and down, laid into that plane;
``radial`` points away from the camera's foot point, which is where an edge seen from one side is pushed to.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.pattern import adjacent, pair
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Vector2
from aadm_workbench.twin.scene import TrueScan

WITHIN_95 = 5.991
"""Of the squared distance in units of its covariance: the 95 % point of the law with two degrees of freedom."""


@dataclass(frozen=True)
class FeatureError:
    """One true point; what was not found of it is None.

    ``error_mm`` (x, y), ``along_mm`` along the vertical, both without the camera's scale error; ``u_mm`` per axis
    (k = 1) includes it; ``covered`` whether the true centre lies in the 95 % region of the found one.
    """

    label: str
    error_mm: Vector2 | None = None
    radial_mm: float | None = None
    along_mm: float | None = None
    u_mm: float | None = None
    covered: bool | None = None
    diameter_error_mm: float | None = None

    @property
    def distance_mm(self) -> float | None:
        """Length of the error in the plane."""
        return None if self.error_mm is None else math.hypot(*self.error_mm)


@dataclass(frozen=True)
class SpacingError:
    """Distance in the plane between two adjacent centres, measured minus true; None where one was not found."""

    between: tuple[str, str]
    error_mm: float | None


@dataclass(frozen=True)
class Comparison:
    """An extraction against the truth; ``false`` is the number of found points that are none of the true ones."""

    features: tuple[FeatureError, ...]
    spacings: tuple[SpacingError, ...]
    false: int


def compared(found: Extraction, truth: TrueScan, design_centres: Array, reach_mm: float) -> Comparison:
    """Compare found points with the true ones.

    Parameters
    ----------
    found
        In the scan frame.
    truth
        The scan's true points, in the order of ``design_centres``.
    design_centres
        (n, 2) mm: they say which points are adjacent.
    reach_mm
        A found point belongs to a true one, one to one, within this distance in the plane.
    """
    axes = _image_axes(truth)
    true = truth.points_scan() @ axes.T
    centres = np.array([point.centre for point in found.points]).reshape(-1, 3) @ axes.T
    partner = pair(true[:, :2], centres[:, :2], reach_mm)
    features = tuple(
        FeatureError(point.label)
        if number < 0
        else _feature(point, found.points[number], true[k], centres[number], axes, truth)
        for k, (point, number) in enumerate(zip(truth.points, partner.tolist(), strict=True))
    )
    spacings = tuple(
        _spacing(truth.points, (i, j), true[:, :2] * (1.0 + truth.scale), centres[:, :2], partner.tolist())
        for i, j in adjacent(design_centres)
    )
    return Comparison(features, spacings, len(centres) - int((partner >= 0).sum()))


def _image_axes(truth: TrueScan) -> Array:
    """Rows (3, 3): image right and image down in the plane across the vertical, and the vertical; scan frame."""
    vertical = truth.T_column_scan[2, :3]
    right = np.array([1.0, 0.0, 0.0]) - vertical[0] * vertical
    right /= np.linalg.norm(right)
    forward = vertical if vertical[2] > 0 else -vertical
    return np.vstack([right, np.cross(forward, right), vertical])


def _feature(
    true_point: AssemblyPoint, point: AssemblyPoint, true: Array, centre: Array, axes: Array, truth: TrueScan
) -> FeatureError:
    """Errors of one point whose true and found centres are given as (x, y, along) with the camera at the origin."""
    error = centre - true * (1.0 + truth.scale)
    spoke = true[:2] / max(float(np.linalg.norm(true[:2])), 1e-9)
    u_mm, covered = None, None
    if point.covariance is not None:
        scale = truth.camera.scale_error * true[:2]
        covariance = axes[:2] @ point.covariance @ axes[:2].T + np.outer(scale, scale)
        u_mm = math.sqrt(float(np.trace(covariance)) / 2.0)
        off = (centre - true)[:2]
        covered = bool(off @ np.linalg.solve(covariance, off) <= WITHIN_95)
    return FeatureError(
        true_point.label,
        (float(error[0]), float(error[1])),
        float(error[:2] @ spoke),
        float(error[2]),
        u_mm,
        covered,
        point.diameter_mm - true_point.diameter_mm,
    )


def _spacing(
    points: tuple[AssemblyPoint, ...], ends: tuple[int, int], true: Array, centres: Array, partner: list[int]
) -> SpacingError:
    i, j = ends
    between = (points[i].label, points[j].label)
    if partner[i] < 0 or partner[j] < 0:
        return SpacingError(between, None)
    measured = float(np.linalg.norm(centres[partner[i]] - centres[partner[j]]))
    return SpacingError(between, measured - float(np.linalg.norm(true[i] - true[j])))
