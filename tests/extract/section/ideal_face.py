"""A foot's face by ray casting of its own: half-planes and discs, many rays a pixel; nothing of the product's cameras.

A pixel returns what its rays hit. ``mixing``: a pixel that sees the face with enough of its rays returns it;
its height then bends by how far the middle of what it sees is from the pixel's own middle, along one axis, and scatters
by as much more as less of it is lit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from aadm_workbench.model import Array, AssemblyPoint, Camera, Extraction, Kind, Plane, Scan

WIDE, HIGH, FOCAL = 760, 620, 1500.0
_RAYS = 9  # a side of each pixel
_BASE_MM = 250.0


@dataclass(frozen=True)
class IdealFace:
    """Corners (4, 2) mm counter-clockwise in the picture's axes (x right, y down), mouths, and pieces cut off them."""

    corners: Array
    mouths: Array
    radius_mm: float = 18.0
    cuts: tuple[tuple[float, float, float], ...] = ()  # discs (x, y, radius) without concrete
    bump_mm: float = 0.0  # how much the face rises from its middle to its corners

    def lit(self, xy: Array) -> Array:
        """Which places (n, 2) are face."""
        inside = np.ones(len(xy), bool)
        for a, b in zip(self.corners, np.roll(self.corners, -1, axis=0), strict=True):
            inside &= (b[0] - a[0]) * (xy[:, 1] - a[1]) - (b[1] - a[1]) * (xy[:, 0] - a[0]) > 0.0
        for x, y, radius in [*((*mouth, self.radius_mm) for mouth in self.mouths.tolist()), *self.cuts]:
            inside &= (xy[:, 0] - x) ** 2 + (xy[:, 1] - y) ** 2 > radius**2
        return inside


def scanned(
    face: IdealFace,
    rng: np.random.Generator,
    *,
    distance_mm: float = 900.0,
    aside_mm: Sequence[float] = (0.0, 0.0),
    noise_mm: float = 0.08,
    mixing: bool = False,
    least: float = 0.2,
) -> tuple[Scan, Extraction]:
    """The scan from a camera ``aside_mm`` from the middle, looking squarely, and what was extracted: the truth.

    ``least``: share of a pixel's rays that must see the face, where it mixes.
    """
    rows, columns = (part.astype(float) for part in np.mgrid[:HIGH, :WIDE])
    share, middle = _seen(face, columns, rows, distance_mm, aside_mm, np.zeros(1))
    if mixing:
        around = cv2.blur(share, (5, 5))
        border = (around > 0.0) & (around < 1.0)
        rays = (np.arange(_RAYS) + 0.5) / _RAYS - 0.5
        share[border], middle[border] = _seen(face, columns[border], rows[border], distance_mm, aside_mm, rays)
    x = (columns - WIDE / 2) / FOCAL * distance_mm + aside_mm[0]
    y = (rows - HIGH / 2) / FOCAL * distance_mm + aside_mm[1]
    reach = np.abs(face.corners).max()
    depth = distance_mm + rng.normal(0.0, noise_mm, (HIGH, WIDE)) / np.maximum(share, 0.05)
    depth -= face.bump_mm * (x**2 + y**2) / (2.0 * reach**2)
    if mixing:
        depth += middle * distance_mm / FOCAL * distance_mm / _BASE_MM
    depth[share < (least if mixing else 0.5)] = np.nan
    rays = np.stack([(columns - WIDE / 2) / FOCAL, (rows - HIGH / 2) / FOCAL, np.ones((HIGH, WIDE))], axis=-1)
    camera = Camera(FOCAL, FOCAL, WIDE / 2, HIGH / 2, WIDE, HIGH)
    scan = Scan((rays * depth[..., None]).astype(np.float32), camera=camera, viewpoint=np.zeros(3))
    return scan, _extracted(face, distance_mm, np.asarray(aside_mm))


def _seen(
    face: IdealFace, columns: Array, rows: Array, distance_mm: float, aside_mm: Sequence[float], rays: Array
) -> tuple[Array, Array]:
    """Share of the rays of pixels that see the face, and the mean place, in pixels to the right, of those that do."""
    lit, middle = np.zeros(columns.shape), np.zeros(columns.shape)
    for down in rays:
        for right in rays:
            x = (columns + right - WIDE / 2) / FOCAL * distance_mm + aside_mm[0]
            y = (rows + down - HIGH / 2) / FOCAL * distance_mm + aside_mm[1]
            on = face.lit(np.column_stack([x.ravel(), y.ravel()])).reshape(columns.shape)
            lit += on
            middle += on * right
    return lit / len(rays) ** 2, middle / np.maximum(lit, 1)


def _extracted(face: IdealFace, distance_mm: float, aside_mm: Array) -> Extraction:
    plane = Plane(np.array([0.0, 0.0, -1.0]), -distance_mm, 0.08)
    axis = np.array([0.0, 0.0, 1.0])
    points = tuple(
        AssemblyPoint("", Kind.SLEEVE, np.array([*(mouth - aside_mm), distance_mm]), axis, 2 * face.radius_mm)
        for mouth in face.mouths
    )
    return Extraction(Kind.SLEEVE, "refined", points, plane, axis)


def T_scan_column(distance_mm: float = 900.0, aside_mm: Sequence[float] = (0.0, 0.0), roll_deg: float = 0.0) -> Array:
    """(4, 4): the column's axes are the picture's, turned by ``roll_deg``."""
    c, s = np.cos(np.radians(roll_deg)), np.sin(np.radians(roll_deg))
    T = np.eye(4)
    T[:2, :2] = [[c, -s], [s, c]]
    T[:3, 3] = -aside_mm[0], -aside_mm[1], distance_mm
    return T
