"""A foot whose face sites have spoilt, seen by marching along rays over a height: shares nothing with the twin.

Millimetres, camera frame. The face is z = ``DISTANCE``; what is broken out, cut in or plugged is a depth behind it at
each place. A bore is a place without a floor.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Camera, Scan
from aadm_workbench.scan.camera import depth_to_points

Floats = npt.NDArray[np.float64]
Depth = Callable[[Floats, Floats], Floats]
"""From places on the face to how far behind it the solid begins there, all mm."""

_STEPS_MM = np.concatenate([np.arange(0.0, 14.0, 0.5), np.arange(14.0, 112.0, 3.5)])
_HALVINGS = 9


@dataclass(frozen=True)
class SpoiltFoot:
    """Bores of one ``radius`` at ``centres`` (n, 2), some ``plugged`` or ``covered``; ``spoilt`` is done to the face.

    Where a bore is ``covered`` there is face; where it is ``taped``, on the side of a direction, rad, from a share of
    the radius on.
    """

    centres: Floats
    radius: float
    spoilt: Sequence[Depth] = ()
    plugged: frozenset[int] = frozenset()
    covered: frozenset[int] = frozenset()
    taped: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    plug_mm: float = 10.0
    land_mm: float = 0.0

    def depth(self, x: Floats, y: Floats) -> Floats:
        """How far behind the face the solid begins; infinite in an open bore."""
        deepest = np.zeros(x.shape)
        for one in self.spoilt:
            deepest = np.maximum(deepest, one(x, y))
        for number, (cx, cy) in enumerate(self.centres):
            squares = (x - cx) ** 2 + (y - cy) ** 2
            if self.land_mm:
                deepest[squares < (self.radius + self.land_mm) ** 2] = 0.0
            if number not in self.covered:
                end_mm = self.plug_mm if number in self.plugged else np.inf
                turn, share = self.taped.get(number, (0.0, np.inf))
                open_ = (x - cx) * np.cos(turn) + (y - cy) * np.sin(turn) < share * self.radius
                deepest[(squares < self.radius**2) & open_] = end_mm
        return deepest


def dish(cx: float, cy: float, reach_mm: float, depth_mm: float) -> Depth:
    """A piece broken out, as round as a bowl: a paraboloid."""
    return lambda x, y: depth_mm * np.clip(1.0 - ((x - cx) ** 2 + (y - cy) ** 2) / reach_mm**2, 0.0, 1.0)


def grooves(period_mm: float, depth_mm: float) -> Depth:
    """Keys: grooves half as wide as they are apart."""
    return lambda x, y: np.where(np.mod(x, period_mm) < period_mm / 2.0, depth_mm, 0.0)


def scanned(
    foot: SpoiltFoot,
    distance_mm: float,
    rng: np.random.Generator,
    *,
    noise_mm: float = 0.05,
    lost: float = 0.01,
    lost_in_bores: float = 0.2,
    focal_px: float = 2400.0,
) -> Scan:
    """The picture of a foot by a camera square to its face, beside its middle."""
    reach = np.abs(foot.centres).max(axis=0) + foot.radius + 22.0
    width, height = (2.0 * reach * focal_px / distance_mm).astype(int).tolist()
    aside = focal_px / distance_mm * np.array([40.0, -25.0])
    camera = Camera(focal_px, focal_px, width / 2.0 + aside[0], height / 2.0 + aside[1], width, height)
    u, v = np.meshgrid(np.arange(width), np.arange(height))
    x, y = (u - camera.cx) / focal_px, (v - camera.cy) / focal_px
    middle = -aside / focal_px * distance_mm
    z = _marched(foot, x, y, middle, distance_mm)
    deep = z > distance_mm + 1.0
    gone = rng.random(z.shape) < np.where(deep, lost_in_bores, lost)
    z = np.where(gone, np.nan, z + rng.normal(0.0, noise_mm, z.shape))
    return Scan(depth_to_points(z.astype(np.float32), camera), "foot", "", camera, np.zeros(3))


def with_slips(
    scan: Scan, foot: SpoiltFoot, distance_mm: float, rng: np.random.Generator, *, end_mm: float, before_mm: float
) -> Scan:
    """The scan where bores end and light bounces: what is lit there is seen, the rest returns from before the face.

    Projected is from 270 mm beside the camera; of what is not lit a tenth is lost.
    """
    camera, z = scan.camera, scan.points[..., 2].astype(np.float64)
    assert camera is not None
    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    x, y = (u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy
    shift_mm = 270.0 * end_mm / distance_mm
    far_mm = distance_mm + end_mm
    for cx, cy, _ in true_points(foot, distance_mm):
        open_ = np.isnan(z) & (np.hypot(x * distance_mm - cx, y * distance_mm - cy) < foot.radius - 0.5)
        spot = np.hypot(x * far_mm - cx * far_mm / distance_mm + shift_mm, y * far_mm - cy * far_mm / distance_mm)
        lit = open_ & (spot < foot.radius)
        slipped = open_ & ~lit & (rng.random(z.shape) > 0.1)
        z = np.where(lit, far_mm, np.where(slipped, distance_mm - before_mm, z))
    z += rng.normal(0.0, 0.1, z.shape)
    return replace(scan, points=depth_to_points(z.astype(np.float32), camera))


def mixing(scan: Scan, foot: SpoiltFoot, distance_mm: float, rng: np.random.Generator, parts: int = 4) -> Scan:
    """The scan by a camera that projects fringes: a pixel that an edge crosses has the phase of its part on the face.

    From 270 mm beside the camera that stands off by as much of the distance as its middle does aside.
    """
    camera, z = scan.camera, scan.points[..., 2].astype(np.float64)
    assert camera is not None
    steps = (np.arange(parts) + 0.5) / parts - 0.5
    on_face, aside = np.zeros(z.shape), np.zeros(z.shape)
    middle = -np.array([40.0, -25.0])
    for down in steps:
        for right in steps:
            u, v = np.meshgrid(np.arange(camera.width) + right, np.arange(camera.height) + down)
            x, y = (u - camera.cx) / camera.fx * distance_mm, (v - camera.cy) / camera.fy * distance_mm
            hit = foot.depth(x - middle[0], y - middle[1]) == 0.0
            on_face += hit / parts**2
            aside += hit * right * distance_mm / camera.fx / parts**2
    mixed = (on_face > 0.25) & (on_face < 1.0) & (rng.random(z.shape) > 0.05)
    off = aside / np.maximum(on_face, 1e-9) * distance_mm / 270.0
    z = np.where(mixed, distance_mm + off + rng.normal(0.0, 0.05, z.shape), z)
    return replace(scan, points=depth_to_points(z.astype(np.float32), camera))


def true_points(foot: SpoiltFoot, distance_mm: float) -> Floats:
    """Centres (n, 3) of the mouths, scan frame."""
    middle = -np.array([40.0, -25.0])
    return np.column_stack([foot.centres + middle, np.full(len(foot.centres), distance_mm)])


def _marched(foot: SpoiltFoot, x: Floats, y: Floats, middle: Floats, distance_mm: float) -> Floats:
    """Depth (h, w) at which each ray first lies in the solid; NaN where it goes on."""

    def inside(behind: Floats, rays: npt.NDArray[np.intp]) -> npt.NDArray[np.bool_]:
        z = distance_mm + behind
        return behind >= foot.depth(x.ravel()[rays] * z - middle[0], y.ravel()[rays] * z - middle[1])

    low, high = np.zeros(x.size), np.full(x.size, np.nan)
    open_ = np.arange(x.size)
    for step in _STEPS_MM:
        hit = inside(np.full(len(open_), step), open_)
        high[open_[hit]] = step
        open_ = open_[~hit]
        low[open_] = step
    found = np.flatnonzero(high > 0.0)
    for _ in range(_HALVINGS):
        half = (low[found] + high[found]) / 2.0
        hit = inside(half, found)
        high[found[hit]], low[found[~hit]] = half[hit], half[~hit]
    return (distance_mm + high).reshape(x.shape)
