"""Captures of a plate by closed formulas: a camera and a projector square to it, whose rays meet circles and cylinders.

It shares nothing with the virtual cameras: a point of a pin's side, or of a bore, is a root of a quadratic.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.calibration.plate.file import plate_text
from aadm_workbench.calibration.plate.plate import Place, Plate, drawn_plate
from aadm_workbench.model import Array, BoolArray, Camera, Kind, Scan
from aadm_workbench.scan.write import write_depth_tiff

CAMERA = Camera(1200.0, 1200.0, 479.6, 300.3, 960, 600)
EYE = np.zeros(2)


@dataclass(frozen=True)
class Painter:
    """A camera: ``projector_mm`` along x, ``noise_mm`` of single points, ``scale`` of all lengths, relative.

    ``warp_mm``: how high its error waves across the picture, one and a half times. ``lost``: of pixels anywhere.
    """

    projector_mm: float = 200.0
    noise_mm: float = 0.06
    scale: float = 0.0
    warp_mm: float = 0.0
    lost: float = 0.003

    def depth(self, plate: Plate, distance_mm: float, turn_deg: float, off: Array, rng: np.random.Generator) -> Array:
        """Depths (h, w) float32, mm, of a plate at a distance, turned, its middle off (2,) mm; NaN for none."""
        c, s = np.cos(np.radians(turn_deg)), np.sin(np.radians(turn_deg))
        places = np.array([[one.x_mm, -one.y_mm] for one in plate.places]) @ np.array([[c, s], [-s, c]]) + off
        u, v = np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height))
        at = np.stack([(u - CAMERA.cx) / CAMERA.fx, (v - CAMERA.cy) / CAMERA.fy], -1)
        depth = np.full(u.shape, distance_mm)
        depth[np.abs(at * distance_mm - off).max(axis=-1) > plate.size_mm / 2.0] = np.nan
        pins = [pair for pair in zip(plate.places, places, strict=True) if pair[0].kind is Kind.REBAR]
        for one, place in zip(plate.places, places, strict=True):
            if one.kind is Kind.SLEEVE:
                window = _window(place, one.diameter_mm, distance_mm)
                depth[window] = self._bore(at[window], depth[window], one, place, (distance_mm, plate.bore_mm))
        lit = np.ones(depth.shape, bool)
        for one, place in pins:
            window = _window(place, one.diameter_mm, distance_mm - one.z_mm)
            first = _pin(EYE, at[window], place, one.diameter_mm / 2.0, distance_mm - one.z_mm, distance_mm)
            depth[window] = np.fmin(depth[window], first)
        for one, place in pins:
            window = _window(place, 2.0 * (one.z_mm + one.diameter_mm), distance_mm - one.z_mm)
            light = np.array([self.projector_mm, 0.0])
            towards = (at[window] * depth[window][..., None] - light) / depth[window][..., None]
            first = _pin(light, towards, place, one.diameter_mm / 2.0, distance_mm - one.z_mm, distance_mm)
            lit[window] &= ~(first < depth[window] - 0.05)
        height = self.warp_mm * np.sin(3.0 * np.pi * u / CAMERA.width)
        found = (depth + rng.normal(0.0, self.noise_mm, depth.shape) + height) * (1.0 + self.scale)
        return np.where(lit & (rng.random(depth.shape) > self.lost), found, np.nan).astype(np.float32)

    def _bore(self, at: Array, depth: Array, one: Place, place: Array, reach: tuple[float, float]) -> Array:
        """Depths about a bore: of its wall where it is seen, and lit through its mouth."""
        distance_mm, bore_mm = reach
        light, radius = np.array([self.projector_mm, 0.0]), one.diameter_mm / 2.0
        wall = _root(EYE, at, place, radius, 1.0)
        mouth = light + (at * wall[..., None] - light) * (distance_mm / wall)[..., None]
        seen = (wall < distance_mm + bore_mm) & _within(mouth, place, radius)
        return np.where(_within(at * distance_mm, place, radius), np.where(seen, wall, np.nan), depth)


def painted_captures(folder: Path, painter: Painter, count: int, seed: int) -> Plate:
    """Write plate.toml, camera.toml and so many captures of a plate into a new folder, in steps of 0.025 mm."""
    rng = np.random.default_rng(seed)
    drawn = drawn_plate(12, 36.0, 160.0, 20.0)
    plate = replace(drawn, places=tuple(replace(one, u_mm=0.01) for one in drawn.places))
    folder.mkdir(parents=True)
    (folder / "plate.toml").write_text(plate_text(plate))
    keys = ("fx", "fy", "cx", "cy", "width", "height")
    (folder / "camera.toml").write_text("".join(f"{key} = {getattr(CAMERA, key)}\n" for key in keys))
    for number in range(count):
        turn, off = 90.0 * number + rng.uniform(-3.0, 3.0), rng.uniform(-15.0, 15.0, 2)
        depth = painter.depth(plate, (1300.0, 1400.0)[number % 2], turn, off, rng)
        write_depth_tiff(folder / f"plate-{number + 1}.tiff", depth, 0.025)
    return plate


def scan_of(depth: Array, source: str = "") -> Scan:
    """A scan (h, w, 3) mm from depths (h, w), as a pinhole has it."""
    u, v = np.meshgrid(np.arange(CAMERA.width), np.arange(CAMERA.height))
    x, y = (u - CAMERA.cx) / CAMERA.fx * depth, (v - CAMERA.cy) / CAMERA.fy * depth
    return Scan(np.stack([x, y, depth], -1), source, "", CAMERA, np.zeros(3))


def _window(place: Array, reach_mm: float, depth_mm: float) -> tuple[slice, slice]:
    """Rows and columns that show what is no farther than so much from a place (2,) mm at a depth."""
    u, v = CAMERA.fx * place[0] / depth_mm + CAMERA.cx, CAMERA.fy * place[1] / depth_mm + CAMERA.cy
    reach = CAMERA.fx * reach_mm / depth_mm + 3.0
    return slice(max(0, int(v - reach)), max(0, int(v + reach))), slice(max(0, int(u - reach)), max(0, int(u + reach)))


def _within(at: Array, place: Array, radius: float) -> BoolArray:
    return np.asarray(np.hypot(at[..., 0] - place[0], at[..., 1] - place[1]) < radius)


def _root(origin: Array, direction: Array, place: Array, radius: float, sign: float) -> Array:
    """Depth at which rays (…, 2) per unit of depth pass a cylinder along z: far (1) or near (-1); NaN: they miss it."""
    away = origin - place
    square, mixed = (direction**2).sum(-1), direction @ away
    inside = mixed**2 - square * (away @ away - radius**2)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray((-mixed + sign * np.sqrt(np.where(inside > 0.0, inside, np.nan))) / square)


def _pin(origin: Array, direction: Array, place: Array, radius: float, top_mm: float, foot_mm: float) -> Array:
    """Depth of the first point of a pin on rays: its end, or its side; NaN where they miss it."""
    end = np.where(_within(origin + direction * top_mm, place, radius), top_mm, np.nan)
    side = _root(origin, direction, place, radius, -1.0)
    return np.fmin(end, np.where((side > top_mm) & (side < foot_mm), side, np.nan))
