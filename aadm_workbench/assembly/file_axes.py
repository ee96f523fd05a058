"""A report in the own coordinates of its scan's file, where these are not the scan frame: a file in OpenGL's axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.model import (
    AXES_UNKNOWN,
    OPENGL_AXES,
    AbsolutePosition,
    Array,
    ControlPoint,
    GroupReport,
    Reason,
    Scan,
    Vector3,
)

AXES_NOT_TOLD = Reason("assembly.axes_not_told")
"""Note of a cloud in any frame, for which the job declares what is at the top."""


def in_scan_frame(points: Sequence[ControlPoint], scan: Scan) -> tuple[ControlPoint, ...]:
    """Control points, given in the coordinates of a file, in the scan frame."""
    return tuple(replace(point, scan_mm=_turned(scan.R_file_scan.T, point.scan_mm)) for point in points)


def in_coordinates_of_the_file(report: GroupReport, scan: Scan) -> GroupReport:
    """Return a report on a scan with all that is in the scan frame in the coordinates of its file."""
    if scan.axes != OPENGL_AXES:
        return report
    R = scan.R_file_scan
    points = tuple(
        point if point.scan_mm is None else replace(point, scan_mm=_turned(R, point.scan_mm)) for point in report.points
    )
    fit = None if report.fit is None else replace(report.fit, T_design_scan=_from_file(report.fit.T_design_scan, R))
    absolute = None if report.absolute is None else _absolute(report.absolute, R)
    quality = {**report.quality, "axes": scan.axes}
    return replace(report, points=points, fit=fit, absolute=absolute, quality=quality)


def axes_not_told(views: Sequence[Scan], up_deg: float | None) -> tuple[str, ...]:
    """A note on each scan whose top a job declares, and whose axes nobody does."""
    if up_deg is None:
        return ()
    return tuple(
        Reason("said.of_file", file=view.source, why=AXES_NOT_TOLD) for view in views if view.axes == AXES_UNKNOWN
    )


def _absolute(absolute: AbsolutePosition, R: Array) -> AbsolutePosition:
    residuals = tuple(replace(point, scan_mm=_turned(R, point.scan_mm)) for point in absolute.control_points)
    T = absolute.T_column_scan
    return replace(absolute, control_points=residuals, T_column_scan=None if T is None else _from_file(T, R))


def _from_file(T_to_scan: Array, R: Array) -> Array:
    """A transform (4, 4) from the scan frame, as one from the file's coordinates."""
    T_scan_file = np.eye(4)
    T_scan_file[:3, :3] = R.T
    return np.asarray(T_to_scan @ T_scan_file)


def _turned(R: Array, point: Vector3) -> Vector3:
    x, y, z = (R @ np.array(point, dtype=np.float64)).tolist()
    return x, y, z
