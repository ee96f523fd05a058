"""An extraction in the own coordinates of its scan's file, where these are not the scan frame."""

from __future__ import annotations

from dataclasses import replace

from aadm_workbench.model import OPENGL_AXES, Array, AssemblyPoint, Extraction, Scan


def in_coordinates_of_the_file(extraction: Extraction, scan: Scan) -> Extraction:
    """Return what was found in a scan in the coordinates of its file: where these are OpenGL's, it is turned back."""
    if scan.axes != OPENGL_AXES:
        return extraction
    R = scan.R_file_scan
    plane = extraction.plane
    return replace(
        extraction,
        points=tuple(_turned(point, R) for point in extraction.points),
        plane=None if plane is None else replace(plane, normal=R @ plane.normal),
        vertical=None if extraction.vertical is None else R @ extraction.vertical,
    )


def _turned(point: AssemblyPoint, R: Array) -> AssemblyPoint:
    return replace(
        point,
        centre=R @ point.centre,
        axis=R @ point.axis,
        covariance=None if point.covariance is None else R @ point.covariance @ R.T,
        axis_covariance=None if point.axis_covariance is None else R @ point.axis_covariance @ R.T,
    )
