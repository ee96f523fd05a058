"""What a reader is given and what it gives back: the bytes of a file, what the job says of it, its points, their axes.

The axes of a cloud are a camera's, or OpenGL's, in which y points up and z backward:
librealsense writes its PLY files in OpenGL's axes (x, -y, -z), as do viewers and meshing programs. Points and poses are
right in both; only what is at the top of the picture differs, by half a turn.
"""

from __future__ import annotations

import hashlib
import os
import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from aadm_workbench.errors import ScanError
from aadm_workbench.model import AXES_UNKNOWN, CAMERA_AXES, OPENGL_AXES, Array, BoolArray, Camera, FloatArray, Reason
from aadm_workbench.model.reason import said_of

DEPTH_MAPS = (".tif", ".tiff", ".png")
"""Pictures of depths: they are read with a camera alone."""

CLOUDS = (".ply", ".pcd", ".xyz", ".pts", ".ptx", ".las", ".laz", ".e57")
"""Files that hold points, whatever else lies beside them."""

TABLES = (".txt", ".csv", ".asc", ".npz")
"""What can hold points, and anything else: in the folder of a capture mostly that."""

LARGEST_FILE_BYTES = 2**30
"""A frame of a structured-light camera takes 10 to 100 MB; beyond this it is something else."""

LARGEST_POINT_COUNT = 40_000_000
"""Bound on what a file may unpack to: 1 GB of coordinates. A frame of today's largest cameras has 8 million."""

HUGE_COORDINATE_MM = 1e7
"""Beyond this, float32 rounds by a millimetre: map coordinates stay float64."""

LARGEST_COORDINATE = 1e12
"""In the unit of a file: the earth's girth is 4e10 mm. What lies further off is no measurement but a fault."""


@dataclass(frozen=True, eq=False)
class ScanFile:
    """The bytes of one scan file, read once.

    Parameters
    ----------
    name
        The file as the job names it; every message about the file starts with it.
    content
        All bytes.
    sha256
        Their hash, hexadecimal.
    """

    name: str
    content: bytes
    sha256: str

    def wrong(self, what: str) -> ScanError:
        """Return the error that says what is wrong with this file."""
        return ScanError(Reason("said.of_file", file=self.name, why=what))


@dataclass(frozen=True)
class Declared:
    """What the job says of a scan because most formats do not: unit, camera, step of an integer depth map, axes."""

    mm_per_unit: float = 1.0
    camera: Camera | None = None
    depth_scale_mm: float | None = None
    axes: str | None = None


@dataclass(frozen=True, eq=False)
class Cloud:
    """The points of a file as they stand in it.

    Parameters
    ----------
    points
        (n, 3) or, organised, (h, w, 3) floating, native byte order, writable, in the unit and frame of the file.
    mm_per_unit
        Millimetres in one unit of the file.
    T_scan_file
        (4, 4) float64, in units of the file: the pose of the sensor that the file carries; None where it carries none.
    unit_from
        What in the file gives its unit, in words; empty where the job's word is all there is.
    grey
        (h, w) uint8, the grey values that an organised file carries along with its points.
    dropped
        Points of the file that are left out of ``points`` because they are marked as no measurement.
    notes
        What the reader did that the file's owner should know.
    is_depth_map
        Whether the points were computed by the declared camera, in whose axes they are then.
    """

    points: FloatArray
    mm_per_unit: float
    T_scan_file: Array | None = None
    unit_from: str = ""
    grey: npt.NDArray[np.uint8] | None = None
    dropped: int = 0
    notes: tuple[str, ...] = ()
    is_depth_map: bool = False


def load(path: Path, name: str) -> ScanFile:
    """Read a scan file and hash it.

    Raises
    ------
    ScanError
        Where there is no such file, or it is a folder, empty, unreadable or larger than ``LARGEST_FILE_BYTES``.
    """
    try:
        content = _content(path)
    except FileNotFoundError as error:
        raise ScanError(said_of(path, "scan.no_file")) from error
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ScanError(said_of(path, "scan.unreadable", why=reason)) from error
    return ScanFile(name, content, hashlib.sha256(content).hexdigest())


def _content(path: Path) -> bytes:
    """Return all bytes of a regular file; what is read is what was looked at, and no pipe is waited for."""
    status = path.stat()
    _check_status(status.st_mode, status.st_size, path)
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(descriptor, "rb") as stream:
        status = os.fstat(descriptor)
        _check_status(status.st_mode, status.st_size, path)
        # Not a byte more, for a file may grow while it is read.
        return stream.read(status.st_size)


def _check_status(mode: int, size_bytes: int, path: Path) -> None:
    if stat.S_ISDIR(mode):
        raise ScanError(said_of(path, "scan.is_folder"))
    if not stat.S_ISREG(mode):
        raise ScanError(said_of(path, "scan.is_device"))
    if size_bytes == 0:
        raise ScanError(said_of(path, "scan.is_empty"))
    if size_bytes > LARGEST_FILE_BYTES:
        sizes = {"size_bytes": size_bytes, "limit_gb": LARGEST_FILE_BYTES / 2**30}
        raise ScanError(said_of(path, "scan.too_large", **sizes))


def without_return(points: FloatArray) -> BoolArray:
    """Tell which points are no measurement: not finite, out of this world, or all three coordinates exactly zero.

    Cameras write NaN, infinity or the origin where a pixel saw nothing; no surface lies in the camera's centre.

    Parameters
    ----------
    points
        (..., 3) floating, in the frame of the file.

    Returns
    -------
    BoolArray
        (...) bool.
    """
    with np.errstate(all="ignore"):
        # One sum instead of three tests: it is not finite where a term is not, and it is zero at the origin alone.
        total = np.abs(points[..., 0]) + np.abs(points[..., 1]) + np.abs(points[..., 2])
        measured: BoolArray = (total > 0.0) & (total < LARGEST_COORDINATE)
    return ~measured


def narrowed(points: Array, dtype: np.dtype[Any], mm_per_unit: float) -> FloatArray:
    """Return points in the precision of their file, unless float32 would round them by a millimetre.

    Parameters
    ----------
    points
        (..., 3) float64.
    dtype
        float32 or float64, what the file declares.
    mm_per_unit
        Millimetres in one unit of ``points``.
    """
    return points if _is_huge(points, mm_per_unit) else points.astype(dtype, copy=False)


def to_millimetres(points: FloatArray, mm_per_unit: float, T_scan_file: Array | None) -> FloatArray:
    """Move points by the pose that their file carries, then scale them to millimetres.

    Parameters
    ----------
    points
        (..., 3) floating, unit and frame of the file.
    mm_per_unit
        Millimetres in one unit of the file.
    T_scan_file
        (4, 4) float64, unit of the file; None for no motion.

    Returns
    -------
    FloatArray
        (..., 3) mm, scan frame, in the precision of ``points`` or, for huge coordinates, float64.
    """
    if T_scan_file is not None and not np.array_equal(T_scan_file, np.eye(4)):
        moved = (points.astype(np.float64) @ T_scan_file[:3, :3].T + T_scan_file[:3, 3]) * mm_per_unit
        return narrowed(moved, points.dtype, 1.0)
    if mm_per_unit == 1.0:
        return points
    if _is_huge(points, mm_per_unit):
        points = points.astype(np.float64)
    return points * points.dtype.type(mm_per_unit)


def _is_huge(points: FloatArray, mm_per_unit: float) -> bool:
    reach = np.max(np.abs(points), where=np.isfinite(points), initial=0.0)
    return bool(reach * mm_per_unit > HUGE_COORDINATE_MM)


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
