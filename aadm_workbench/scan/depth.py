"""Depth maps (.tiff, .png): one depth a pixel, to points by the camera's intrinsics; and maps of X, Y and Z (.tiff)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from aadm_workbench.errors import CameraError
from aadm_workbench.model import Camera, FloatArray, Reason
from aadm_workbench.scan.camera import depth_to_points
from aadm_workbench.scan.depth_picture import depth_picture
from aadm_workbench.scan.file import Cloud, Declared, ScanFile
from aadm_workbench.scan.picture import Pixels, pixels_of


def read_depth_map(file: ScanFile, declared: Declared) -> Cloud:
    """Read a depth map: uint16 in steps of ``depth_scale_mm``, or floating in the declared unit.

    Three floating values a pixel are X, Y and Z in that unit: an organised cloud, which needs no camera.

    Raises
    ------
    CameraError
        Where no camera is declared, its image has another size, or an integer map comes without ``depth_scale_mm``.
    ScanError
        Where the picture cannot be decoded or is no depth map.
    """
    picture = depth_picture(file)
    if picture.is_point_map:
        return Cloud(pixels_of(file, picture), declared.mm_per_unit, notes=picture.notes)
    _checked_camera(file, picture.width, picture.height, declared)
    return replace(cloud_of_depth_map(file, pixels_of(file, picture), declared), notes=picture.notes)


def cloud_of_depth_map(file: ScanFile, depth: Pixels, declared: Declared) -> Cloud:
    """Return the points of a depth map, organised, in mm; 0, negative and not finite is no return.

    Parameters
    ----------
    file
        Where the map is from, for messages.
    depth
        (h, w) uint16, float32 or float64.
    declared
        Camera, unit of floating maps, step of integer maps.

    Returns
    -------
    Cloud
        (h, w, 3) float32, mm, camera frame; the camera stands at the origin.
    """
    if depth.ndim != 2:
        raise file.wrong(Reason("scan.channels", channels=depth.shape[-1]))
    height, width = depth.shape
    camera = _checked_camera(file, width, height, declared)
    depth_mm = _in_millimetres(file, depth, declared)
    return Cloud(depth_to_points(depth_mm, camera), mm_per_unit=1.0, T_scan_file=np.eye(4), is_depth_map=True)


def _checked_camera(file: ScanFile, width: int, height: int, declared: Declared) -> Camera:
    camera = declared.camera
    if camera is None:
        wanted = Reason("scan.wanted_intrinsics", width=width, height=height)
        raise CameraError(Reason("scan.needs_intrinsics", name=file.name, wanted=wanted))
    if (width, height) != (camera.width, camera.height):
        raise CameraError(
            Reason(
                "scan.depth_size",
                name=file.name,
                width=width,
                height=height,
                camera_width=camera.width,
                camera_height=camera.height,
            )
        )
    return camera


def _in_millimetres(file: ScanFile, depth: Pixels, declared: Declared) -> FloatArray:
    if depth.dtype.kind == "f":
        return depth if declared.mm_per_unit == 1.0 else depth * depth.dtype.type(declared.mm_per_unit)
    if depth.dtype == np.uint8:
        raise file.wrong(Reason("scan.eight_bits"))
    if depth.dtype != np.uint16:
        raise file.wrong(Reason("scan.depth_type", dtype=depth.dtype))
    if declared.depth_scale_mm is None:
        raise CameraError(Reason("scan.depth_step", name=file.name))
    return depth * np.float32(declared.depth_scale_mm)
