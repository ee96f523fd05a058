"""One scan file, of any supported format, to a :class:`Scan` in millimetres."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from aadm_workbench.errors import CameraError, ScanError
from aadm_workbench.model import CAMERA_AXES, OPENGL_AXES, Array, Camera, FloatArray, Reason, Scan
from aadm_workbench.scan.file import (
    AXES,
    DEPTH_MAPS,
    Cloud,
    Declared,
    ScanFile,
    axes_of,
    load,
    to_millimetres,
    turned,
    without_return,
)
from aadm_workbench.scan.pixels import is_picture, on_pixels

Reader = Callable[[ScanFile, Declared], Cloud]

FURTHEST_VIEW_RATIO = 100.0
"""Distance of a scanner from what it scans over the extent of the scan; a component fills a part of the view."""

_SAMPLE_SIZE = 10_000  # points: enough for an extent and a median

MM_PER_UNIT = MappingProxyType({"mm": 1.0, "m": 1000.0})

_READERS = MappingProxyType(
    {
        **dict.fromkeys(DEPTH_MAPS, "depth.read_depth_map"),
        ".ply": "formats.ply.read_ply",
        ".pcd": "formats.pcd.read_pcd",
        ".xyz": "formats.text.read_text",
        ".txt": "formats.text.read_text",
        ".csv": "formats.text.read_text",
        ".asc": "formats.text.read_text",
        ".pts": "formats.pts.read_pts",
        ".ptx": "formats.ptx.read_ptx",
        ".las": "formats.las.read_las",
        ".laz": "formats.las.read_las",
        ".e57": "formats.e57.read_e57",
        ".npz": "formats.npz.read_npz",
    }
)
"""By ending: the function of this package that reads it, imported where such a file is read."""


def supported_formats() -> tuple[str, ...]:
    """Return the extensions of the files that :func:`read_scan` reads, in lower case with their dot."""
    return tuple(_READERS)


def read_scan(
    path: Path,
    *,
    units: str = "mm",
    camera: Camera | None = None,
    depth_scale_mm: float | None = None,
    source: str | None = None,
    image: Path | None = None,
    axes: str | None = None,
) -> Scan:
    """Read one scan.

    Parameters
    ----------
    path
        The file; its extension (in any case) tells the format. Or the folder of one capture, as the camera's SDK saves
        it (:mod:`aadm_workbench.scan.capture`).
    units
        Unit of its coordinates, or of a floating depth map: "mm" or "m". It is never guessed; what a file says of its
        own unit goes before it, and is said in ``notes``.
    camera
        Intrinsics. Depth maps need them; of a cloud they say that it is in the camera's frame, which is checked.
    depth_scale_mm
        Step of an integer depth map.
    source
        How the job names the file; ``path`` by default.
    image
        Grey picture of the same view, pixel for pixel.
    axes
        Of a cloud: one of :data:`~aadm_workbench.scan.file.AXES`; None where they are to be found out.

    Returns
    -------
    Scan
        Points in the precision of the file (depth maps float32). The scan frame is that of the camera where one is
        given; else that of the file, after the pose that the file carries. ``viewpoint`` is None where neither tells
        it. A cloud in OpenGL's axes is turned into a camera's. A cloud whose points lie on the pixels of a camera at
        its origin comes as that camera's picture. Points that are not finite or exactly zero are no measurement: NaN
        in an organised scan, left out of another, and counted in ``dropped``.

    Raises
    ------
    ScanError
        Where the file cannot be read or is no scan.
    CameraError
        Where intrinsics are missing or cannot belong to the scan.
    MissingDependencyError
        Where the format needs a package that is not installed.
    """
    path, name = Path(path), source or str(path)
    declared = _declared(units, camera, depth_scale_mm, axes)
    if _is_folder(path):
        return _read_capture(path, name, declared, image)
    return _read_file(path, name, declared, image)


def _is_folder(path: Path) -> bool:
    """Whether a path is a folder; why it cannot even be looked at is said where it is read."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _read_capture(path: Path, name: str, declared: Declared, image: Path | None) -> Scan:
    """Return the scan of a capture folder: its depth map or cloud, with the intrinsics and the picture beside it."""
    from aadm_workbench.scan.capture import find_capture

    capture = find_capture(path, name, declared)
    texture = capture.texture if image is None else image
    try:
        scan = _read_file(capture.scan, f"{name}/{capture.scan.name}", capture.declared, texture)
    except CameraError as error:
        if capture.declared.camera is not None or not capture.notes:
            raise
        raise CameraError(Reason("said.with_notes", why=error, notes=capture.notes)) from error
    return replace(scan, source=name, sha256=capture.sha256(scan.sha256), notes=(*capture.notes, *scan.notes))


def _read_file(path: Path, name: str, declared: Declared, image: Path | None) -> Scan:
    camera = declared.camera
    reader = _reader_of(path)
    file = load(path, name)
    cloud = reader(file, declared)
    axes = _axes(file, cloud, declared)
    points, dropped = _measured(file, cloud, camera, axes)
    viewpoint = _viewpoint(cloud, camera, points, axes)
    picture = on_pixels(points) if points.ndim == 2 and (viewpoint is None or not viewpoint.any()) else None
    if picture is not None:
        points, viewpoint = picture, np.zeros(3)
    elif viewpoint is None and points.ndim == 3 and is_picture(points):
        viewpoint = np.zeros(3)
    grey = cloud.grey if image is None else _grey_picture(Path(image), points, camera)
    if grey is not None and points.ndim == 3 and grey.shape != points.shape[:2]:
        grey = None
    return Scan(
        points,
        file.name,
        file.sha256,
        camera,
        viewpoint,
        dropped,
        grey,
        (*cloud.notes, *_unit_note(cloud, declared), *_axes_note(axes, declared)),
        declared.mm_per_unit / cloud.mm_per_unit if cloud.unit_from else 1.0,
        axes,
    )


def _reader_of(path: Path) -> Reader:
    if path.suffix.lower() not in _READERS:
        known = " ".join(supported_formats())
        raise ScanError(Reason("scan.format", path=path, suffix=path.suffix or "(none)", known=known))
    module, _, name = _READERS[path.suffix.lower()].rpartition(".")
    reader: Reader = getattr(import_module(f"aadm_workbench.scan.{module}"), name)
    return reader


def _axes(file: ScanFile, cloud: Cloud, declared: Declared) -> str:
    """Return the axes of the frame of a file, after its pose."""
    if cloud.is_depth_map:
        return CAMERA_AXES
    pose = None if declared.camera is not None else cloud.T_scan_file
    if pose is None or np.array_equal(pose, np.eye(4)):
        return axes_of(file, cloud.points, None if pose is None else np.zeros(3), declared.axes)
    sample = cloud.points.reshape(-1, 3)[:: max(1, cloud.points.size // (3 * _SAMPLE_SIZE))]
    return axes_of(file, to_millimetres(sample, 1.0, pose), pose[:3, 3], declared.axes)


def _axes_note(axes: str, declared: Declared) -> tuple[str, ...]:
    # A note of a cloud whose axes were found out.
    return (Reason("scan.opengl_axes"),) if axes == OPENGL_AXES and declared.axes is None else ()


def _unit_note(cloud: Cloud, declared: Declared) -> tuple[str, ...]:
    """Return a note where a file gives its unit itself, and it is not the one that the job declares."""
    if not cloud.unit_from or math.isclose(cloud.mm_per_unit, declared.mm_per_unit):
        return ()
    return (Reason("scan.unit_of_file", mm_per_unit=cloud.mm_per_unit, why=cloud.unit_from),)


def _declared(units: str, camera: Camera | None, depth_scale_mm: float | None, axes: str | None) -> Declared:
    if units not in MM_PER_UNIT:
        raise ScanError(Reason("scan.units", units=repr(units), known=map(repr, MM_PER_UNIT)))
    if depth_scale_mm is not None and not (math.isfinite(depth_scale_mm) and depth_scale_mm > 0):
        raise CameraError(Reason("scan.depth_scale", depth_scale_mm=depth_scale_mm))
    if axes is not None and axes not in AXES:
        raise ScanError(Reason("scan.axes", axes=repr(axes), known=map(repr, AXES)))
    return Declared(MM_PER_UNIT[units], camera, depth_scale_mm, axes)


def _measured(file: ScanFile, cloud: Cloud, camera: Camera | None, axes: str) -> tuple[FloatArray, int]:
    """Return the points in mm in the scan frame, in a camera's axes, and how many of the file are no measurement."""
    # What a depth map lacks is NaN already, and its points lie on the camera's rays because they were laid there.
    missing = np.isnan(cloud.points[..., 2]) if cloud.is_depth_map else without_return(cloud.points)
    dropped = int(np.count_nonzero(missing))
    if dropped == missing.size:
        raise file.wrong(Reason("scan.nothing_measured", count=missing.size))
    if cloud.is_depth_map:
        return cloud.points, dropped + cloud.dropped
    # A declared camera fixes the frame to its own, in which the files of all cameras hold their points.
    T_scan_file = None if camera is not None else cloud.T_scan_file
    if dropped and (camera is not None or cloud.points.ndim == 3):
        cloud.points[missing] = np.nan
    points = cloud.points
    if camera is not None:
        from aadm_workbench.scan.camera import seen_by

        points = seen_by(file.name, turned(points) if axes == OPENGL_AXES else points, camera)
    if dropped and points.ndim == 2:
        points = points[~missing]
    points = to_millimetres(points, cloud.mm_per_unit, T_scan_file)
    return turned(points) if axes == OPENGL_AXES and camera is None else points, dropped + cloud.dropped


def _viewpoint(cloud: Cloud, camera: Camera | None, points: FloatArray, axes: str) -> Array | None:
    if camera is not None:
        return np.zeros(3)
    if cloud.T_scan_file is None:
        return None
    viewpoint: Array = cloud.T_scan_file[:3, 3] * cloud.mm_per_unit
    if axes == OPENGL_AXES:
        viewpoint = viewpoint * np.array([1.0, -1.0, -1.0])
    return viewpoint if _can_see(viewpoint, points) else None


def _can_see(viewpoint: Array, points: FloatArray) -> bool:
    """Whether a cloud may be seen from a point: exporters write the origin for scans in map coordinates, too."""
    flat = points.reshape(-1, 3)
    sample = flat[:: max(1, len(flat) // _SAMPLE_SIZE)].astype(np.float64)
    sample = sample[np.isfinite(sample).all(axis=1)]
    if not len(sample):
        return False
    extent = np.ptp(sample, axis=0).max()
    return bool(np.linalg.norm(np.median(sample, axis=0) - viewpoint) <= FURTHEST_VIEW_RATIO * extent)


def _grey_picture(path: Path, points: FloatArray, camera: Camera | None) -> npt.NDArray[np.uint8]:
    from aadm_workbench.scan.picture import grey_of

    file = load(path, str(path))
    grey = grey_of(file)
    size = (camera.height, camera.width) if camera is not None else points.shape[:2] if points.ndim == 3 else grey.shape
    if grey.shape != size:
        raise file.wrong(
            Reason(
                "scan.grey_size",
                width=grey.shape[1],
                height=grey.shape[0],
                scan_width=size[1],
                scan_height=size[0],
            )
        )
    return grey
