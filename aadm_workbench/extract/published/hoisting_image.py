"""Foot and bars in one picture, after Ye et al.: ellipses and strips in the depth map, lifted with the depth beside."""

from __future__ import annotations

import cv2
import numpy as np

from aadm_workbench.extract.published.image import back_projected, plane_through
from aadm_workbench.model import Array, Camera, FloatArray, Plane, Scan

_CLOSING = np.ones((5, 5), np.uint8)  # closes pixels that were lost alone
_AXIS_MISFIT = 0.35  # relative, of an ellipse's width: mouths are cut by shadows; a choice, not tuned since
_STRIP_MISFIT = 0.35  # relative, of a strip's width: ribs, and lost edges; a choice, not tuned since
_DEPTHS_MIN = 10  # points of an outline: five make an ellipse
_JUMP_MM = 4.0  # between neighbours: walls fall by less, seen along; a choice, not tuned since


def image_points(
    scan: Scan, foot: Array, bars: Array, sleeve_mm: float, rebar_mm: float
) -> tuple[Array, Array, Plane | None]:
    """Centres of mouths (k, 3) and of bar tops (l, 3), mm, and the plane through the mouths.

    ``foot`` and ``bars`` (n, 3) mm tell which rows of the picture show them. Without rows and columns, or without a
    camera, nothing is found.
    """
    none = np.empty((0, 3))
    if scan.camera is None or not scan.organised:
        return none, none, None
    depth = scan.points[..., 2]
    sleeves = _mouths(depth, scan.camera, _rows(scan.camera, foot), sleeve_mm)
    rebars = _strips(depth, scan.camera, _rows(scan.camera, bars), rebar_mm)
    return sleeves, rebars, plane_through(sleeves) if len(sleeves) >= 3 else None


def _rows(camera: Camera, points: Array) -> slice:
    v = points[:, 1] / points[:, 2] * camera.fy + camera.cy
    low, high = np.quantile(v, [0.002, 0.998])  # strays do not stretch it
    return slice(max(int(low), 0), min(int(high) + 2, camera.height))


def _mouths(depth: FloatArray, camera: Camera, rows: slice, sleeve_mm: float) -> Array:
    """Ellipses of surface that stands out in depth from what is beside it, lifted with the depth of their middle."""
    part = np.nan_to_num(depth[rows].astype(np.float32))
    filled = cv2.morphologyEx(part, cv2.MORPH_CLOSE, _CLOSING)
    # 16 mm a grey level bring 4 m into a byte, which is all that this filter takes; 5 pixels close thin gaps.
    around = cv2.medianBlur(np.clip(filled / 16.0, 0, 255).astype(np.uint8), 5)
    step = np.abs(cv2.Sobel(filled, cv2.CV_32F, 0, 1, ksize=3)) > _JUMP_MM
    steady = ((~step) & (around > 0)).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(steady, connectivity=4)
    found = []
    for label in range(1, count):
        width = stats[label, cv2.CC_STAT_WIDTH]
        # Forty pixels are less than the smallest mouth has.
        middle_mm = float(np.median(filled[labels == label])) if stats[label, cv2.CC_STAT_AREA] > 40 else 0.0
        if middle_mm <= 0 or abs(width * middle_mm / camera.fx / sleeve_mm - 1.0) > _AXIS_MISFIT:
            continue
        contours, _ = cv2.findContours((labels == label).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        outline = max(contours, key=len)
        if len(outline) >= _DEPTHS_MIN:
            (u, v), _, _ = cv2.fitEllipse(outline)
            # what is seen through a mouth is its far wall
            found.append([u, v + rows.start, middle_mm - sleeve_mm / 2])
    table = np.array(found, np.float64).reshape(-1, 3)
    return back_projected(table[:, :2], table[:, 2], camera)


def _strips(depth: FloatArray, camera: Camera, rows: slice, rebar_mm: float) -> Array:
    """Upright strips as wide as a bar, lifted at the middle of their upper end with the depth of their front."""
    part = np.nan_to_num(depth[rows].astype(np.float32))
    # Across a bar depth changes by itself, as on any cylinder: only what is far beyond that ends it.
    step = np.abs(cv2.Sobel(part, cv2.CV_32F, 1, 0, ksize=3)) > 16.0 * _JUMP_MM
    strip = ((~step) & (part > 0)).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(strip, connectivity=4)
    found = []
    for label in range(1, count):
        left, top, width, height = stats[label, : cv2.CC_STAT_AREA]
        if height < 2 * width or width < 4:
            continue
        body = part[top : top + height, left : left + width][labels[top : top + height, left : left + width] == label]
        upper = body[: max(len(body) // 8, 4)]  # a camera that looks up sees the lower end of a bar farther away
        front_mm = float(np.quantile(upper, 0.1))  # nearest but for strays
        if abs(width * front_mm / camera.fx / rebar_mm - 1.0) > _STRIP_MISFIT:
            continue
        found.append([left + 0.5 * (width - 1), top + rows.start, front_mm + rebar_mm / 2])
    table = np.array(found, np.float64).reshape(-1, 3)
    return back_projected(table[:, :2], table[:, 2], camera)
