"""The paper's method as published: point cloud to plane to binary image to Hough circles, and back to 3-D.

Source: Long et al., *Automated alignment deviation measurement for precast concrete assembly using point cloud-image
fusion*, section 2.1.1: pass-through filter along z, RANSAC plane (50 mm, 500 iterations), orthogonal projection
(Eq. 1), binary image (column white on black, rebars black on white), Hough circles (radii from the nominal diameters,
at least 30 votes), centres back to 3-D on the plane.

What the paper leaves open, and how it was read:

* *Range thresholds* of the pass-through filter: given, or derived (see :mod:`.pass_through`).
* *Pixel size*: the pitch of the scan's own points. Cells that no point falls into are closed with the 3 x 3 dilation of
  section 2.2.1.
* *Smoothing and Canny threshold*: 5 x 5 Gaussian, 100 of 255; accumulator at full resolution (``dp`` = 1).
* *30 votes* are out of reach where a circle is small in pixels: see :func:`.hough.votes_needed`.
* *Axis*: the plane's normal, for sleeves and bars; the method measures no other.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from aadm_workbench.extract.plane import from_plane, in_plane, turned_over
from aadm_workbench.extract.published.binary_image import BinaryImage, binary_image, pitch_mm
from aadm_workbench.extract.published.hough import RADIUS_MISFIT, hough_circles, votes_needed
from aadm_workbench.extract.published.pass_through import (
    face_range_mm,
    finite_points,
    near_is_low,
    out_of_the_concrete,
    passed,
    tops_range_mm,
)
from aadm_workbench.extract.published.ransac_plane import open3d_for, ransac_plane
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Figures, FloatArray, Kind, Plane, Reason, Scan

INLIER_DISTANCE_MM = 50.0  # as published (2.1.1)
ITERATIONS = 500  # as published (2.1.1)
DILATION_PIXELS = 3  # as published (2.2.1)
_POINTS_MIN = 100  # of a scan: fewer show no circle of any size

Range = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Flattened:
    """The points that passed, flattened onto their plane: its binary image, and the range of z they came from."""

    plane: Plane
    image: BinaryImage
    z_range_mm: Range


def extract_sleeves(
    scan: Scan,
    diameter_mm: float,
    rng: np.random.Generator,
    places: Array | None = None,
    *,
    z_range_mm: Range | None = None,
) -> Extraction:
    """Centres of all sleeves of one diameter in the scan of a foot, by the published method.

    Parameters
    ----------
    scan
        Organised or not; points in mm, scan frame, z along the view.
    diameter_mm
        Nominal inner diameter at the mouth.
    rng
        Seeds the plane hypotheses.
    places
        Not used: the published method looks nowhere twice.
    z_range_mm
        Thresholds of the pass-through filter, scan frame; derived from the scan where not given.

    Raises
    ------
    MissingDependencyError
        Where Open3D is not installed.
    """
    open3d = open3d_for("fusion")
    points = finite_points(scan)
    if len(points) < _POINTS_MIN:
        return _nothing(Kind.SLEEVE, Reason("extract.few_points"))
    flat = _flattened(open3d, scan, points, z_range_mm or face_range_mm(points), diameter_mm, rng)
    if flat is None:
        return _nothing(Kind.SLEEVE, Reason("extract.no_plane_in_range"))
    centres, diameters_mm = _circles(flat.image, flat.plane, diameter_mm, Kind.SLEEVE)
    face = out_of_the_concrete(flat.plane, scan, points, centres, diameter_mm / 2)
    return _extraction(Kind.SLEEVE, flat, face, -face.normal, "foot face", centres, diameters_mm)


def extract_rebars(
    scan: Scan,
    diameter_mm: float,
    rng: np.random.Generator,
    places: Array | None = None,
    *,
    z_range_mm: Range | None = None,
) -> Extraction:
    """Centres of the tops of all bars of one diameter, on one plane through all tops, by the published method.

    Parameters and errors are those of :func:`extract_sleeves`; ``diameter_mm`` is the nominal one of the bars.
    """
    open3d = open3d_for("fusion")
    points = finite_points(scan)
    spacing_mm = pitch_mm(scan, None, diameter_mm / 2)
    if len(points) < _POINTS_MIN or spacing_mm is None:
        return _nothing(Kind.REBAR, Reason("extract.few_points"))
    if z_range_mm is None:
        z_range_mm = tops_range_mm(points, scan.viewpoint, np.pi * (diameter_mm / 2 / spacing_mm) ** 2)
    flat = _flattened(open3d, scan, points, z_range_mm, diameter_mm, rng)
    if flat is None:
        return _nothing(Kind.REBAR, Reason("extract.no_plane_in_range"))
    centres, diameters_mm = _circles(flat.image, flat.plane, diameter_mm, Kind.REBAR)
    up = flat.plane.normal[2] < 0 if near_is_low(points[:, 2], scan.viewpoint) else flat.plane.normal[2] > 0
    tops = flat.plane if up else turned_over(flat.plane)
    return _extraction(Kind.REBAR, flat, tops, tops.normal, "plane through the tops", centres, diameters_mm)


def projected_onto(points: Array, plane: Plane) -> Array:
    """Orthogonal projection of points (n, 3) mm onto a plane, Eq. (1): (a, b, c) is its unit normal, -d its offset."""
    return np.asarray(points - plane.height(points)[:, None] * plane.normal)


def _flattened(
    open3d: Any, scan: Scan, points: FloatArray, z_range_mm: Range, diameter_mm: float, rng: np.random.Generator
) -> Flattened | None:
    kept = passed(points, z_range_mm)
    plane = ransac_plane(open3d, kept, INLIER_DISTANCE_MM, ITERATIONS, rng)
    pixel_mm = pitch_mm(scan, z_range_mm, diameter_mm / 2)
    if plane is None or pixel_mm is None:
        return None
    inliers = kept[np.abs(plane.height(kept)) < INLIER_DISTANCE_MM]
    on_plane = in_plane(projected_onto(inliers, plane), plane)[:, :2]
    return Flattened(plane, binary_image(on_plane, pixel_mm, diameter_mm), z_range_mm)


def _circles(image: BinaryImage, plane: Plane, diameter_mm: float, kind: Kind) -> tuple[Array, Array]:
    """Centres (n, 3) mm, scan frame, on the plane, and diameters (n,) mm of the circles in the binary image."""
    dilated = cv2.dilate(image.filled, np.ones((DILATION_PIXELS, DILATION_PIXELS), np.uint8))
    shown = np.asarray(dilated if kind is Kind.SLEEVE else 255 - dilated, np.uint8)
    # the dilation of the points makes a hole smaller and a bar larger
    grown = DILATION_PIXELS // 2 * (-1.0 if kind is Kind.SLEEVE else 1.0)
    nominal = diameter_mm / 2 / image.pixel_mm
    radii = ((1.0 - RADIUS_MISFIT) * nominal + grown, (1.0 + RADIUS_MISFIT) * nominal + grown)
    pixels, found = hough_circles(shown, radii, votes_needed(nominal))
    local = np.column_stack([image.millimetres(pixels), np.zeros(len(pixels))])
    return from_plane(local, plane), 2.0 * image.pixel_mm * (found - grown)


def _extraction(
    kind: Kind, flat: Flattened, plane: Plane, vertical: Array, source: str, centres: Array, diameters_mm: Array
) -> Extraction:
    points = tuple(
        AssemblyPoint("", kind, centre, vertical, float(diameter), why=Reason("extract.hough", picture="binary image"))
        for centre, diameter in zip(centres, diameters_mm, strict=True)
    )
    quality: Figures = {
        "pixel_mm": flat.image.pixel_mm,
        "plane_residual_mm": plane.residual_mm,
        "z_range_mm": flat.z_range_mm,
    }
    reason = "" if points else Reason("extract.no_circle.binary")
    return Extraction(kind, "fusion", points, plane, vertical, source, quality=quality, reason=reason)


def _nothing(kind: Kind, reason: str) -> Extraction:
    return Extraction(kind, "fusion", (), None, None, reason=reason)
