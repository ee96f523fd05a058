"""One bar of a cloud: the plane of its top, the cylinder of its sides and rim, and where axis and top meet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.extract.plane import axes_on
from aadm_workbench.extract.published.edge_points import edge_points
from aadm_workbench.extract.published.ransac_plane import ransac_plane
from aadm_workbench.extract.published.round_fits import RoundFit, ransac_cylinder
from aadm_workbench.model import Array, Plane

HIGHEST = 20  # points that give a bar's height (Long et al., 2.2.2)
TOP_ZONE_MM = 3.0  # below the highest points: a cut slanted by 8 degrees over a bar of 20 mm
TOP_DISTANCE_MM = 0.5  # as of circles and tops elsewhere: noise of the reference camera at 1 m, five times
TOP_ITERATIONS = 200  # a top that a third of its zone lies on is missed once in 1,900
TOP_LEAN_COSINE = 0.9  # 26 degrees: more is a side
CYLINDER_DISTANCE_MM = 0.6  # half a rib and noise (a choice, not tuned since)
SIDE_DEPTH_MM = 1.0  # below the rim of the top
SIDE_POINTS_MIN = 60  # fewer, on a shorter side, do not tell a lean (a choice, not tuned since)
SIDE_LENGTH_MIN_MM = 25.0  # over it a noise of 0.1 mm turns an axis by 0.2 degrees


@dataclass(frozen=True, eq=False)
class MeasuredBar:
    """Centre (3,) mm of a bar's top, its axis (3,) pointing up, and its diameter."""

    centre: Array
    axis: Array
    diameter_mm: float
    leaning: bool


def measured_bar(
    open3d: Any, points: Array, vertical: Array, radius_mm: float, spacing_mm: float, rng: np.random.Generator
) -> MeasuredBar | None:
    """Measure one bar from its cluster of points (n, 3) mm; None where it shows no top or no round outline.

    ``vertical`` (3,) points up along the bars, ``radius_mm`` is nominal, ``spacing_mm`` the pitch of the points.
    """
    axes = axes_on(Plane(vertical, 0.0))
    local = points @ axes.T
    # heights from the top on, so that the lean of the axis does not depend on where the scan frame begins
    shift = np.array([0.0, 0.0, np.sort(local[:, 2])[-HIGHEST:].mean()])
    local = local - shift
    top = ransac_plane(open3d, local[np.abs(local[:, 2]) < TOP_ZONE_MM], TOP_DISTANCE_MM, TOP_ITERATIONS, rng)
    if top is None or abs(top.normal[2]) < TOP_LEAN_COSINE:
        return None
    depth = top.height(local) / top.normal[2]
    on_top = local[np.abs(depth) < TOP_DISTANCE_MM]
    sides = local[depth < -SIDE_DEPTH_MM]
    rim = on_top[edge_points(on_top[:, :2], spacing_mm)]
    leaning = len(sides) >= SIDE_POINTS_MIN and float(np.ptp(sides[:, 2])) >= SIDE_LENGTH_MIN_MM
    fit = ransac_cylinder(np.vstack([rim, sides]), radius_mm, CYLINDER_DISTANCE_MM, leaning, rng)
    if fit is None:
        return None
    centre, direction = _axis_on_top(fit, top)
    return MeasuredBar(axes.T @ (centre + shift), axes.T @ direction, 2.0 * fit.radius_mm, leaning)


def _axis_on_top(fit: RoundFit, top: Plane) -> tuple[Array, Array]:
    """Where the axis of a cylinder meets a plane, and the direction of the axis; both (3,)."""
    direction = np.array([*fit.lean, 1.0])
    foot = np.array([*fit.centre, 0.0])
    along = (top.offset - float(top.normal @ foot)) / float(top.normal @ direction)
    return foot + along * direction, direction / np.linalg.norm(direction)
