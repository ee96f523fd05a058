"""Coordinates as GenICam cameras send them, to millimetres: formats of the PFNC, features of the SFNC's chapter Scan3d.

A transmitted value times its scale plus its offset is the coordinate, for each axis by itself, in the unit that the
device says. Axes A, B, C of the Cartesian system anchored to the camera are x, y, z.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from aadm_workbench.errors import CaptureError
from aadm_workbench.model import Array, Camera, FloatArray, Reason

MM_PER_UNIT = {
    "Micrometer": 1e-3,
    "Micron": 1e-3,
    "Millimeter": 1.0,
    "Centimeter": 10.0,
    "Meter": 1000.0,
    "Inch": 25.4,
}
"""What devices call their unit; the SFNC has Millimeter and Inch, the others are vendors' own."""

BEST_FORMATS = (
    *(f"Coord3D_ABC{bits}{order}" for bits in ("32f", "16") for order in ("", "_Planar")),
    "Coord3D_C32f",
    "Coord3D_C16",
)
"""Formats that are read, best first: all three coordinates before depth alone, floats before steps."""

BEST_MODE = "CalibratedABC_Grid"
"""All three coordinates, in the order of the sensor's pixels."""

_WHOLE_MODES = (BEST_MODE, "CalibratedABC_PointCloud")
_DEPTH_MODES = ("CalibratedC", "ProjectedC", "")
_REGULAR_MODE = "RectifiedC"
_COORDINATES = re.compile(r"Coord3D_(ABC|[ABC])(\d+)(f|s|p)?(_Planar)?")

Pixels = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class Axis:
    """One coordinate: what the transmitted value is multiplied by, what is added, and which value is no return."""

    scale: float = 1.0
    offset: float = 0.0
    invalid: float | None = None


@dataclass(frozen=True)
class Coding:
    """What a device says of its coordinates; empty where it does not say.

    ``camera`` holds intrinsics for formats that carry the depth alone; ``distortion`` the coefficients of a lens whose
    picture was not straightened.
    """

    unit: str = "Millimeter"
    mode: str = BEST_MODE
    system: str = "Cartesian"
    reference: str = "Anchor"
    axes: Mapping[str, Axis] = field(default_factory=dict)
    camera: Camera | None = None
    distortion: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class Part:
    """One part of a frame: its pixel format as the PFNC calls it, its size, and its values, flat."""

    format: str
    width: int
    height: int
    values: Pixels


@dataclass(frozen=True, eq=False)
class Measured:
    """Points (h, w, 3) float32, mm, or depths (h, w) float32, mm, with their camera; NaN where there is no return."""

    points: FloatArray | None = None
    depth_mm: FloatArray | None = None
    camera: Camera | None = None


def measured(parts: Sequence[Part], coding: Coding) -> Measured:
    """Return what the parts of one frame measure.

    Raises
    ------
    CaptureError
        For a frame without coordinates, of a size that its values do not fill, or of a unit, an axis system or a mode
        in which nothing can be measured.
    """
    mm_per_unit = _mm_per_unit(coding)
    _check_frame(coding)
    found = {name: part for part in parts if (name := _axes_of(part.format))}
    if "ABC" in found:
        return Measured(_points(_in_rows(found["ABC"]), coding, mm_per_unit))
    if {"A", "B", "C"} <= found.keys():
        return Measured(_points(_joined([found[axis] for axis in "ABC"]), coding, mm_per_unit))
    if "C" in found:
        return _of_depths(found["C"], coding, mm_per_unit)
    sent = ", ".join(part.format for part in parts) or "nothing"
    raise CaptureError(Reason("camera.frame_without", sent=sent, formats=BEST_FORMATS))


def _axes_of(pixel_format: str) -> str:
    match = _COORDINATES.fullmatch(pixel_format)
    return match[1] if match else ""


def _mm_per_unit(coding: Coding) -> float:
    if coding.unit in MM_PER_UNIT:
        return MM_PER_UNIT[coding.unit]
    raise CaptureError(Reason("camera.unit", unit=coding.unit) if coding.unit else Reason("camera.unit_unsaid"))


def _check_frame(coding: Coding) -> None:
    if coding.system not in ("Cartesian", ""):
        raise CaptureError(Reason("camera.axes_system", system=coding.system))
    if coding.reference not in ("Anchor", ""):
        raise CaptureError(Reason("camera.reference", reference=coding.reference))
    if coding.mode in (*_WHOLE_MODES, *_DEPTH_MODES, _REGULAR_MODE):
        return
    raise CaptureError(Reason("camera.mode", mode=coding.mode, best=BEST_MODE))


def _in_rows(part: Part) -> Pixels:
    """Return the values of a part with all coordinates as (h, w, 3)."""
    values = _filled(part, 3)
    if part.format.endswith("_Planar"):
        return np.moveaxis(values.reshape(3, part.height, part.width), 0, -1)
    return values.reshape(part.height, part.width, 3)


def _joined(parts: Sequence[Part]) -> Pixels:
    """Return the values of three parts, a coordinate each, as (h, w, 3)."""
    if len({(part.width, part.height) for part in parts}) > 1:
        sizes = [f"{part.width} x {part.height}" for part in parts]
        raise CaptureError(Reason("camera.sizes_differ", sizes=sizes))
    return np.stack([_plane(part) for part in parts], axis=-1)


def _plane(part: Part) -> Pixels:
    return _filled(part, 1).reshape(part.height, part.width)


def _filled(part: Part, per_pixel: int) -> Pixels:
    """Return the values of a part, if they are as many as its size needs."""
    wanted = part.width * part.height * per_pixel
    if part.values.size != wanted or wanted == 0:
        size = {"width": part.width, "height": part.height, "wanted": wanted}
        raise CaptureError(Reason("camera.short", found=part.values.size, format=part.format, **size))
    return part.values


def _points(values: Pixels, coding: Coding, mm_per_unit: float) -> FloatArray:
    """Return (h, w, 3) float32, mm; a point counts only with all its coordinates."""
    points = np.empty(values.shape, np.float32)
    for place, axis in enumerate("ABC"):
        points[..., place] = _scaled(values[..., place], coding.axes.get(axis, Axis()), mm_per_unit)
    lost = ~np.isfinite(points).all(axis=-1) | (points == 0.0).all(axis=-1)
    points[lost] = np.nan
    return _some(points)


def _of_depths(part: Part, coding: Coding, mm_per_unit: float) -> Measured:
    axis = coding.axes.get("C", Axis())
    depth_mm = _scaled(_plane(part), axis, mm_per_unit)
    depth_mm[~(depth_mm > 0.0)] = np.nan
    if coding.mode == _REGULAR_MODE:
        return Measured(_some(_on_even_grid(depth_mm, coding, mm_per_unit)))
    if any(coding.distortion):
        raise CaptureError(Reason("camera.lens", coefficients=list(map(str, coding.distortion))))
    camera = coding.camera
    if camera is not None and (camera.width, camera.height) != (part.width, part.height):
        of_camera = {"camera_width": camera.width, "camera_height": camera.height}
        raise CaptureError(Reason("camera.intrinsics_size", width=part.width, height=part.height, **of_camera))
    return Measured(depth_mm=_some(depth_mm), camera=camera)


def _on_even_grid(depth_mm: FloatArray, coding: Coding, mm_per_unit: float) -> FloatArray:
    """Return (h, w, 3) of depths over even steps in A and B (SFNC: RectifiedC)."""
    height, width = depth_mm.shape
    across, down = (coding.axes.get(axis, Axis()) for axis in "AB")
    points = np.empty((height, width, 3), np.float32)
    points[..., 0] = _scaled(np.arange(width), across, mm_per_unit)
    points[..., 1] = _scaled(np.arange(height), down, mm_per_unit)[:, None]
    points[..., 2] = depth_mm
    points[~np.isfinite(depth_mm)] = np.nan
    return points


def _scaled(values: Pixels, axis: Axis, mm_per_unit: float) -> FloatArray:
    """Return coordinates, float32, mm: what is float32 and in mm already keeps its bits."""
    if values.dtype == np.float32 and (axis.scale * mm_per_unit, axis.offset) == (1.0, 0.0):
        scaled: FloatArray = values.copy()
    else:
        exact: Array = (values.astype(np.float64) * axis.scale + axis.offset) * mm_per_unit
        scaled = exact.astype(np.float32)
    if axis.invalid is not None:
        scaled[values == axis.invalid] = np.nan
    scaled[~np.isfinite(scaled)] = np.nan
    return scaled


def _some(measured_mm: FloatArray) -> FloatArray:
    if not np.isfinite(measured_mm).any():
        raise CaptureError(Reason("camera.no_return"))
    return measured_mm
