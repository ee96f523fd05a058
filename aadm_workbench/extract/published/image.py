"""The image method, after Ye et al.: circles in the camera's picture, back-projected with their depth.

Source: the comparison in Long et al. (section 3.2, "image processing method"), and the pinhole model of its Eq. (7):
X = (u - cx) Z / fx, Y = (v - cy) Z / fy. The text of Ye et al. was not at hand; what had to be interpreted:

* *The picture*: the grey one that came with the scan. Without one the depth map is shown as a picture, as near as white
  and as far as grey over the range of z that holds the face or the tops; what lies deeper, or has no return, is black.
* *Radii* in pixels: from the nominal diameter and that range of z.
* *Depth of a circle*: the median around it: for a sleeve on the face about its mouth, for a bar inside its top.
* *Plane*: least squares through the centres. The method measures no axis: it is the plane's normal.
"""

from __future__ import annotations

import cv2
import numpy as np
import numpy.typing as npt

from aadm_workbench.extract.plane import facing
from aadm_workbench.extract.published.binary_image import pitch_mm
from aadm_workbench.extract.published.hough import RADIUS_MISFIT, hough_circles, votes_needed
from aadm_workbench.extract.published.pass_through import face_range_mm, finite_points, tops_range_mm
from aadm_workbench.model import Array, AssemblyPoint, Camera, Extraction, FloatArray, Kind, Plane, Reason, Scan

MEDIAN_PIXELS = 5  # closes single lost pixels
FAR_GREY = 128.0  # half of white: the far end of the range stays clear of the black behind it
SLEEVE_SURROUNDINGS = (1.15, 1.5)  # of the radius
BAR_SURROUNDINGS = (0.0, 0.6)  # of the radius: the top, off its rim
_POINTS_MIN = 100  # as in fusion.py
_DEPTHS_MIN = 10  # of a ring or a disc: fewer are no surface
_FLATTEST_MM = 5.0  # centres that spread less than this across their line carry no plane
_VIEW = np.array([0.0, 0.0, -1.0])

Range = tuple[float, float]


def extract_sleeves(
    scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None
) -> Extraction:
    """Centres of all sleeves of one diameter, from the picture of a foot and the depth around each circle.

    Parameters
    ----------
    scan
        Organised, mm, scan frame, with its camera; otherwise the answer is empty, with a reason.
    diameter_mm
        Nominal inner diameter at the mouth.
    rng, places
        Not used: the method draws nothing and looks nowhere twice.
    """
    return _extracted(scan, diameter_mm, Kind.SLEEVE)


def extract_rebars(scan: Scan, diameter_mm: float, rng: np.random.Generator, places: Array | None = None) -> Extraction:
    """Centres of the tops of all bars of one diameter, from the picture and the depth inside each circle.

    Parameters are those of :func:`extract_sleeves`; ``diameter_mm`` is the nominal one of the bars.
    """
    return _extracted(scan, diameter_mm, Kind.REBAR)


def _extracted(scan: Scan, diameter_mm: float, kind: Kind) -> Extraction:
    if scan.camera is None or scan.points.ndim != 3:
        return _nothing(kind, Reason("extract.image_needs"))
    if scan.image is not None and scan.image.shape != scan.points.shape[:2]:
        return _nothing(kind, Reason("extract.image_size"))
    z_range_mm = _range_of(scan, diameter_mm / 2, kind)
    if z_range_mm is None:
        return _nothing(kind, Reason("extract.few_points"))
    depth_mm = scan.points[..., 2]
    picture = depth_picture(depth_mm, z_range_mm) if scan.image is None else scan.image
    pixels, radii = _circles(picture, scan.camera, diameter_mm, z_range_mm)
    ring = SLEEVE_SURROUNDINGS if kind is Kind.SLEEVE else BAR_SURROUNDINGS
    depths = [depth_around(depth_mm, pixel, radius, ring) for pixel, radius in zip(pixels, radii, strict=True)]
    z = np.array(depths, np.float64)
    seen = (z > z_range_mm[0]) & (z < z_range_mm[1])
    centres = back_projected(pixels[seen], z[seen], scan.camera)
    diameters_mm = 2.0 * radii[seen] * z[seen] / scan.camera.fx
    return _extraction(kind, centres, diameters_mm, "depth map" if scan.image is None else "grey picture")


def _range_of(scan: Scan, radius_mm: float, kind: Kind) -> Range | None:
    """Range of z, mm, of the face or of the tops; None where there are too few points."""
    points = finite_points(scan)
    spacing_mm = pitch_mm(scan, None, radius_mm)
    if len(points) < _POINTS_MIN or spacing_mm is None:
        return None
    if kind is Kind.SLEEVE:
        return face_range_mm(points)
    return tops_range_mm(points, np.zeros(3), np.pi * (radius_mm / spacing_mm) ** 2)


def depth_picture(depth_mm: FloatArray, z_range_mm: Range) -> npt.NDArray[np.uint8]:
    """Depth map (h, w) mm as a picture: from 255 at the near end of a range to 128 at its far end; beyond, black."""
    low, high = z_range_mm
    grey = 255.0 - (255.0 - FAR_GREY) * (depth_mm - low) / (high - low)
    grey[~((depth_mm >= low) & (depth_mm <= high))] = 0.0
    return np.asarray(grey, np.uint8)


def depth_around(depth_mm: FloatArray, pixel: Array, radius: float, ring: Range) -> float:
    """Median depth, mm, of a ring (in radii) around a pixel (column, row); NaN where too few have one."""
    reach = int(np.ceil(ring[1] * radius))
    column, row = np.rint(pixel).astype(int)
    top, left = max(row - reach, 0), max(column - reach, 0)
    part = depth_mm[top : row + reach + 1, left : column + reach + 1]
    rows, columns = np.indices(part.shape)
    distance = np.hypot(rows + top - pixel[1], columns + left - pixel[0])
    depths = part[(distance >= ring[0] * radius) & (distance <= ring[1] * radius) & np.isfinite(part)]
    return float(np.median(depths)) if len(depths) >= _DEPTHS_MIN else float("nan")


def back_projected(pixels: Array, depth_mm: Array, camera: Camera) -> Array:
    """Points (n, 3) mm, camera frame, of pixels (n, 2) as (u, v) at depths (n,), Eq. (7)."""
    x = (pixels[:, 0] - camera.cx) * depth_mm / camera.fx
    y = (pixels[:, 1] - camera.cy) * depth_mm / camera.fy
    return np.column_stack([x, y, depth_mm])


def plane_through(centres: Array) -> Plane:
    """Least-squares plane through centres (n, 3) mm, facing the camera; square to the view where they carry none."""
    middle = centres.mean(axis=0)
    _, spread, directions = np.linalg.svd(centres - middle)
    normal = directions[2] if len(spread) > 2 and spread[1] > _FLATTEST_MM else _VIEW
    return facing(Plane(normal, float(normal @ middle)), np.zeros(3))


def _circles(
    picture: npt.NDArray[np.uint8], camera: Camera, diameter_mm: float, z_range_mm: Range
) -> tuple[Array, Array]:
    at_far, at_near = (camera.fx * diameter_mm / 2 / z for z in reversed(z_range_mm))
    radii = ((1.0 - RADIUS_MISFIT) * at_far, (1.0 + RADIUS_MISFIT) * at_near)
    cleaned = np.asarray(cv2.medianBlur(picture, MEDIAN_PIXELS), np.uint8)
    return hough_circles(cleaned, radii, votes_needed(at_far))


def _extraction(kind: Kind, centres: Array, diameters_mm: Array, picture: str) -> Extraction:
    if len(centres) == 0:
        return _nothing(kind, Reason("extract.no_circle.picture", picture=picture))
    plane = plane_through(centres)
    vertical = -plane.normal if kind is Kind.SLEEVE else plane.normal
    points = tuple(
        AssemblyPoint("", kind, centre, vertical, float(diameter), why=Reason("extract.hough", picture=picture))
        for centre, diameter in zip(centres, diameters_mm, strict=True)
    )
    source = "plane through the centres"
    return Extraction(kind, "image", points, plane, vertical, source, quality={"picture": picture})


def _nothing(kind: Kind, reason: str) -> Extraction:
    return Extraction(kind, "image", (), None, None, reason=reason)
