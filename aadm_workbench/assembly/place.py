"""Measured points brought into the column frame, in the order of the design points they belong to."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.matching.match import Placement
from aadm_workbench.model import Array, AssemblyPoint, Extraction


@dataclass(frozen=True, eq=False)
class PlacedPoint:
    """A measured point: ``point`` in the column frame, ``scan_mm`` (3,) where it is in the scan frame.

    ``from_camera`` (3,) mm is the way to it from the origin of the scan frame, in the axes of the column frame.
    """

    point: AssemblyPoint
    scan_mm: Array
    from_camera: Array
    exposed_length_mm: float | None = None


def place_points(extraction: Extraction, placement: Placement) -> tuple[PlacedPoint | None, ...]:
    """For each design point the measured one that lies there, in the column frame; None where none does.

    Axes are turned to point up along the column; covariances are turned with the points.
    """
    exposed = extraction.exposed_length_mm or (None,) * len(extraction.points)
    return tuple(
        None
        if index < 0
        else PlacedPoint(
            _placed(extraction.points[index], placement.T_design_scan),
            extraction.points[index].centre,
            placement.T_design_scan[:3, :3] @ extraction.points[index].centre,
            exposed[index],
        )
        for index in placement.matched.tolist()
    )


def in_column_frame(extraction: Extraction, placement: Placement) -> list[AssemblyPoint | None]:
    """The points alone of :func:`place_points`."""
    return [None if placed is None else placed.point for placed in place_points(extraction, placement)]


def _placed(point: AssemblyPoint, T_design_scan: Array) -> AssemblyPoint:
    placed = moved_point(point, T_design_scan)
    return replace(placed, axis=-placed.axis) if placed.axis[2] < 0.0 else placed


def moved_point(point: AssemblyPoint, T_to_from: Array) -> AssemblyPoint:
    """A point in another frame: its centre and axis moved by a (4, 4) transform, its covariances turned with them."""
    rotation = T_to_from[:3, :3]
    return replace(
        point,
        centre=rotation @ point.centre + T_to_from[:3, 3],
        axis=rotation @ point.axis,
        covariance=_turned(point.covariance, rotation),
        axis_covariance=_turned(point.axis_covariance, rotation),
    )


def _turned(covariance: Array | None, rotation: Array) -> Array | None:
    return None if covariance is None else rotation @ covariance @ rotation.T


def flat_covariance(point: AssemblyPoint) -> Array | None:
    """Covariance (2, 2), mm², of the centre in the plane of the column frame; None where it is not known."""
    if point.covariance is None or not np.isfinite(point.covariance).all():
        return None
    return point.covariance[:2, :2]
