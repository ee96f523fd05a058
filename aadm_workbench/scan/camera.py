"""The pinhole camera of a scan: depth to points, whether points belong to it, and its intrinsics from a file."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from aadm_workbench.errors import CameraError
from aadm_workbench.model import Array, Camera, FloatArray, Reason
from aadm_workbench.scan import intrinsics
from aadm_workbench.scan.file import load

LARGEST_PIXEL_OFFSET = 2.0
"""Conventions differ by half a pixel; the intrinsics of another camera of the same model by ten and more."""

LARGEST_INTRINSICS_BYTES = 2**20
"""Intrinsics take a few hundred bytes; those of a whole rig with its images' names a few thousand."""

_DEPTH_SCALE = re.compile(
    r"^(?!\s*(?:#|//|%|;))[^\n]{0,4000}?\bdepth_scale_mm\b[\"']?\s*[:=]\s*"
    r"([0-9]{1,12}(?:\.[0-9]{0,12})?(?:[eE][-+]?[0-9]{1,3})?)",
    re.MULTILINE,
)

LARGEST_DEPTH_MM = 1e9
"""A thousand kilometres: what is further off is a fault of the file."""

LEAST_FRACTION_IN_VIEW = 0.95
"""Of a cloud: flying points and rounding at the rim leave the view of its own camera, nothing else does."""
_SAMPLE_SIZE = 20_000  # points: a fraction is then known to a fifth of a percent


def depth_to_points(depth_mm: FloatArray, camera: Camera) -> FloatArray:
    """Return the points of a depth map: X = (u - cx) Z / fx, Y = (v - cy) Z / fy, with u and v whole at pixel centres.

    Parameters
    ----------
    depth_mm
        (h, w) floating, mm, along the optical axis; 0, negative, not finite and absurdly far is no return.
    camera
        Intrinsics of the same size.

    Returns
    -------
    FloatArray
        (h, w, 3) float32, mm, camera frame, each coordinate a plane of its own in memory; NaN where there is no
        return.
    """
    height, width = depth_mm.shape
    # Plane by plane: three of the four steps, and all that is asked of depths alone later, then run over one plane.
    points = np.empty((3, height, width), np.float32)
    x, y, z = points
    z.fill(np.nan)
    np.copyto(z, depth_mm, casting="same_kind", where=(depth_mm > 0) & (depth_mm < LARGEST_DEPTH_MM))
    np.multiply(z, ((np.arange(width) - camera.cx) / camera.fx).astype(np.float32), out=x)
    np.multiply(z, ((np.arange(height) - camera.cy) / camera.fy).astype(np.float32)[:, None], out=y)
    return points.transpose(1, 2, 0)


def projected(points: FloatArray, camera: Camera) -> Array:
    """Return the pixels (u, v) at which a camera sees points.

    Parameters
    ----------
    points
        (n, 3) floating, camera frame, any unit.

    Returns
    -------
    Array
        (n, 2) float64; not finite for points in the plane of the camera.
    """
    x, y, z = points.astype(np.float64).T
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.stack([x / z * camera.fx + camera.cx, y / z * camera.fy + camera.cy], axis=-1)


def seen_by(name: str, points: FloatArray, camera: Camera) -> FloatArray:
    """Check that this camera took a cloud; make it organised where its points fill the image pixel by pixel.

    Parameters
    ----------
    name
        The scan, for messages.
    points
        (n, 3) or (h, w, 3) floating, mm; NaN where there is no return.
    camera
        The declared camera.

    Returns
    -------
    FloatArray
        (n, 3) or (h, w, 3): the same points.

    Raises
    ------
    CameraError
        Where an organised cloud has another size or other rays than the camera, or where less than
        ``LEAST_FRACTION_IN_VIEW`` of another cloud lies in its view.
    """
    shape = (camera.height, camera.width)
    if points.ndim == 3:
        if points.shape[:2] != shape:
            size = {"cloud_width": points.shape[1], "cloud_height": points.shape[0]}
            raise CameraError(Reason("scan.size_differs", name=name, **size, width=camera.width, height=camera.height))
        offset = _pixel_offset(points, camera)
        if offset > LARGEST_PIXEL_OFFSET:
            raise CameraError(Reason("scan.beside_rays", name=name, offset_pixels=offset, remedy=_REMEDY))
        return points
    if len(points) == camera.width * camera.height:
        image = points.reshape(*shape, 3)
        if _pixel_offset(image, camera) <= LARGEST_PIXEL_OFFSET:
            return image
    fraction = _fraction_in_view(points, camera)
    if fraction < LEAST_FRACTION_IN_VIEW:
        raise CameraError(Reason("scan.out_of_camera", name=name, fraction=fraction, remedy=_REMEDY))
    return points


_REMEDY = Reason("scan.other_camera")


def _sample(points: FloatArray) -> tuple[FloatArray, Array]:
    """Return evenly spread finite points (n, 3) and their flat indices (n,)."""
    flat = points.reshape(-1, 3)
    index = np.arange(0, len(flat), max(1, len(flat) // _SAMPLE_SIZE))
    index = index[np.isfinite(flat[index]).all(axis=1)]
    return flat[index], index.astype(np.float64)


def _pixel_offset(points: FloatArray, camera: Camera) -> float:
    """Return the median distance, in pixels, of points (h, w, 3) from the pixels that they stand at in the grid."""
    sample, index = _sample(points)
    if len(sample) == 0:
        return 0.0
    grid = np.stack([index % camera.width, index // camera.width], axis=-1)
    offset = np.abs(projected(sample, camera) - grid).max(axis=1)
    return float(np.median(np.nan_to_num(offset, nan=np.inf)))


def _fraction_in_view(points: FloatArray, camera: Camera) -> float:
    sample, _ = _sample(points)
    if len(sample) == 0:
        return 1.0
    pixels = projected(sample, camera)
    beyond = [camera.width, camera.height]
    in_view = (sample[:, 2] > 0) & (pixels > -1.0).all(axis=1) & (pixels < beyond).all(axis=1)
    return float(in_view.mean())


def read_camera(path: Path, size: tuple[int, int] | None = None) -> Camera:
    """Read intrinsics from a TOML or JSON file, or from the text that a camera's SDK prints.

    Parameters
    ----------
    path
        ``.toml``, ``.json`` or ``.xml`` with fx, fy, cx, cy, width and height (at the top or in a table), or any text
        with a 3 x 3 camera matrix or the rows ``[fx, fy; cx, cy]``, and ``width: ..., height: ...``. Where a file
        describes a texture and a depth camera, the depth camera is meant.
    size
        Width and height of the depth map, where it is at hand; used where the file does not say it.

    Raises
    ------
    CameraError
        For a file that lacks one of the six numbers, contradicts itself, or describes a lens whose distortion was not
        taken out.
    ScanError
        For a file that cannot be read.
    """
    path = Path(path)
    content = load(path, str(path)).content
    if len(content) > LARGEST_INTRINSICS_BYTES:
        raise CameraError(Reason("scan.no_intrinsics_size", path=path, size_bytes=len(content)))
    text = content.decode("utf-8-sig", errors="replace")
    try:
        found = intrinsics.parse(text, path.suffix.lower())
        if size is not None and found.width is None and found.height is None:
            found = replace(found, width=size[0], height=size[1])
        return intrinsics.checked_camera(found)
    except CameraError as error:
        raise type(error)(Reason("said.of_file", file=path, why=error)) from error


def read_depth_scale_mm(path: Path) -> float | None:
    """Return the step of integer depth maps that a file of intrinsics names in mm; other names tell no unit.

    Raises
    ------
    ScanError
        For a file that cannot be read.
    """
    text = load(Path(path), str(path)).content[:LARGEST_INTRINSICS_BYTES].decode("utf-8-sig", errors="replace")
    found = _DEPTH_SCALE.search(text)
    scale_mm = float(found[1]) if found else 0.0
    return scale_mm if 0.0 < scale_mm < np.inf else None
