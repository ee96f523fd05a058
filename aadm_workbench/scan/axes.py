"""Which way the axes of a cloud run: a camera's, or OpenGL's, in which y points up and z backward.

librealsense writes its PLY files in OpenGL's axes (x, -y, -z), as do viewers and meshing programs. Points and poses are
right in both; only what is at the top of the picture differs, by half a turn.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import AXES_UNKNOWN, CAMERA_AXES, OPENGL_AXES, Array, FloatArray, Reason
from aadm_workbench.scan.file import ScanFile

AXES = (CAMERA_AXES, OPENGL_AXES)

_SAMPLE_SIZE = 10_000  # points: on which side of the origin they lie shows on far fewer
_ALL = 0.999
"""Share of the points that must lie on one side: strays of a faulty frame lie anywhere."""

_WIDEST_TANGENT = 1.2
"""Of half the angle of view, to 50 degrees: cameras for measuring have 15 to 40."""


def axes_of(file: ScanFile, points: FloatArray, viewpoint: Array | None, declared: str | None) -> str:
    """Return the axes of a cloud: those declared, else those that the sides tell on which its points lie.

    Parameters
    ----------
    points
        (..., 3) in the frame of the file after its pose, any unit.
    viewpoint
        (3,) in the same frame and unit; None where it is unknown: the origin counts, if points lie before it as before
        a camera.
    declared
        One of ``AXES``; None where nobody declared them.

    Raises
    ------
    ScanError
        Where all points lie on the other side than the declared axes have them.
    """
    found = _seen_axes(points, viewpoint)
    if declared is None:
        return found
    if declared == OPENGL_AXES and found == CAMERA_AXES:
        raise file.wrong(Reason("scan.not_opengl"))
    return declared


def _seen_axes(points: FloatArray, viewpoint: Array | None) -> str:
    flat = points.reshape(-1, 3)
    sample = flat[:: max(1, len(flat) // _SAMPLE_SIZE)].astype(np.float64)
    sample = sample[np.isfinite(sample).all(axis=1) & (sample != 0.0).any(axis=1)]
    if viewpoint is not None and viewpoint.any():
        # A station in a frame of the building: its axes are the building's.
        return AXES_UNKNOWN
    if not len(sample):
        return AXES_UNKNOWN
    ahead = float((sample[:, 2] > 0).mean())
    if max(ahead, 1.0 - ahead) < _ALL or not _is_in_view(sample):
        return AXES_UNKNOWN
    return CAMERA_AXES if ahead > 0.5 else OPENGL_AXES


def _is_in_view(sample: Array) -> bool:
    """Whether points lie before the origin as before a camera."""
    sideways = np.abs(sample[:, :2]).max(axis=1)
    return bool((sideways < _WIDEST_TANGENT * np.abs(sample[:, 2])).mean() >= _ALL)


def turned(points: FloatArray) -> FloatArray:
    """Return points (..., 3) in the other axes: y and z against their direction."""
    return points * np.array([1.0, -1.0, -1.0], points.dtype)
