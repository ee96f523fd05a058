"""Somebody else's camera: another lens, noise and way with edges, and a ray caster that shares nothing with the twin.

Everything is analytic: a face or a floor is a plane, a bore or a bar a cylinder, a bar's ribs are coaxial rings.
Lengths are in metres, camera frame, as such a camera's own software would have it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

FX, FY, CX, CY, WIDTH, HEIGHT = 2800.0, 2795.0, 1201.3, 1047.8, 2448, 2048
SECOND_EYE = np.array([0.0, -0.180, 0.0])  # a stereo pair, one above the other
DISPARITY_NOISE_PIXELS = 0.05
DISPARITY_STEP_PIXELS = 1.0 / 32.0
STEP = 0.004
SHADOW_MARGIN = 0.0004


@dataclass(frozen=True)
class Rod:
    """A cylinder (or a bore) about a line: ``start`` and unit ``axis`` (3,), ``radius``, from 0 to ``length``."""

    start: Floats
    axis: Floats
    radius: float
    length: float


def rays(rows: slice, columns: slice) -> Floats:
    """Directions (h, w, 3) with z = 1 of a part of the image."""
    u, v = np.meshgrid(np.arange(WIDTH)[columns], np.arange(HEIGHT)[rows])
    return np.stack([(u - CX) / FX, (v - CY) / FY, np.ones(u.shape)], -1)


def part_of_image(rod: Rod, margin: float) -> tuple[slice, slice]:
    """Rows and columns that show a rod, with a margin in metres around it."""
    ends = np.stack([rod.start, rod.start + rod.length * rod.axis])
    u, v = FX * ends[:, 0] / ends[:, 2] + CX, FY * ends[:, 1] / ends[:, 2] + CY
    reach = FX * (rod.radius + margin) / ends[:, 2].min()
    top, bottom = np.clip([v.min() - reach, v.max() + reach], 0, HEIGHT).astype(int)
    left, right = np.clip([u.min() - reach, u.max() + reach], 0, WIDTH).astype(int)
    return slice(top, bottom), slice(left, right)


def side_hits(rod: Rod, origin: Floats, direction: Floats) -> tuple[Floats, Floats]:
    """Parameters (near, far) at which rays pass through the side of an endless cylinder; NaN where they miss it."""
    away = origin - rod.start
    d = direction - (direction @ rod.axis)[..., None] * rod.axis
    o = away - (away @ rod.axis)[..., None] * rod.axis
    a, b, c = (d * d).sum(-1), (d * o).sum(-1), (o * o).sum(-1) - rod.radius**2
    inside = b * b - a * c
    root = np.sqrt(np.where(inside > 0, inside, np.nan))
    return (-b - root) / a, (-b + root) / a


def along(rod: Rod, point: Floats) -> Floats:
    """How far along its axis points lie."""
    return (point - rod.start) @ rod.axis


def first_hit(rod: Rod, origin: Floats, direction: Floats) -> Floats:
    """Parameter of the first point of a solid rod on each ray: its side, or the disc at its start; NaN without one."""
    near, _ = side_hits(rod, origin, direction)
    height = along(rod, origin + near[..., None] * direction)
    side = np.where((height >= 0) & (height <= rod.length) & (near > 0), near, np.inf)
    disc = ((rod.start - origin) @ rod.axis) / (direction @ rod.axis)
    from_axis = np.linalg.norm(origin + disc[..., None] * direction - rod.start, axis=-1)
    disc = np.where((from_axis <= rod.radius) & (disc > 0), disc, np.inf)
    first = np.minimum(side, disc)
    return np.where(np.isfinite(first), first, np.nan)


def foot_depth(normal: Floats, distance: float, bores: list[Rod], half_size: float, middle: Floats) -> Floats:
    """Ideal depths (HEIGHT, WIDTH) of a foot face ``normal @ x == distance`` with open bores, nothing behind it."""
    whole = rays(slice(None), slice(None))
    depth = distance / (whole @ normal)
    point = whole * depth[..., None]
    side = np.cross(normal, [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    other = np.cross(side, normal)
    on_foot = (np.abs((point - middle) @ side) < half_size) & (np.abs((point - middle) @ other) < half_size)
    depth[~on_foot] = np.nan
    for bore in bores:
        rows, columns = part_of_image(bore, 0.006)
        part, face = whole[rows, columns], depth[rows, columns]
        mouth = point[rows, columns] - bore.start
        from_axis = np.linalg.norm(mouth - (mouth @ bore.axis)[..., None] * bore.axis, axis=-1)
        _, far = side_hits(bore, np.zeros(3), part)
        wall = far[..., None] * part
        seen = (along(bore, wall) < bore.length) & seen_through(bore, wall, normal, distance)
        face[...] = np.where(from_axis < bore.radius, np.where(seen, far, np.nan), face)
    return depth


def seen_through(bore: Rod, wall: Floats, normal: Floats, distance: float) -> npt.NDArray[np.bool_]:
    """Whether the second eye sees wall points, too, through the mouth of their bore."""
    ray = wall - SECOND_EYE
    crossing = SECOND_EYE + ray * ((distance - normal @ SECOND_EYE) / (ray @ normal))[..., None]
    away = crossing - bore.start
    return np.linalg.norm(away - (away @ bore.axis)[..., None] * bore.axis, axis=-1) < bore.radius


def bars_depth(normal: Floats, distance: float, bars: list[list[Rod]]) -> Floats:
    """Ideal depths of bars, each a stack of coaxial rods, before a floor ``normal @ x == distance``."""
    whole = rays(slice(None), slice(None))
    depth = distance / (whole @ normal)
    for bar in bars:
        for rod in bar:
            rows, columns = part_of_image(rod, 0.004)
            hit = first_hit(rod, np.zeros(3), whole[rows, columns])
            depth[rows, columns] = np.fmin(depth[rows, columns], hit)
    hidden = np.zeros(depth.shape, bool)
    for bar in bars:
        rows, columns = shadow_of(bar[0], normal, distance)
        point = whole[rows, columns] * depth[rows, columns][..., None]
        ray = point - SECOND_EYE
        reach = first_hit(bar[0], SECOND_EYE, ray)
        hidden[rows, columns] |= reach < 1.0 - SHADOW_MARGIN / np.linalg.norm(ray, axis=-1)
    depth[hidden] = np.nan
    return depth


def shadow_of(rod: Rod, normal: Floats, distance: float) -> tuple[slice, slice]:
    """Rows and columns in which a rod can hide the floor, or another side of itself, from the second eye."""
    ray = rod.start - SECOND_EYE
    fallen = SECOND_EYE + ray * (distance - normal @ SECOND_EYE) / (ray @ normal)
    length = float(np.linalg.norm(fallen - rod.start))
    shadow = Rod(rod.start, (fallen - rod.start) / length, rod.radius, length)
    parts = [part_of_image(either, 0.010) for either in (rod, shadow)]
    joined = [slice(min(p[k].start for p in parts), max(p[k].stop for p in parts)) for k in (0, 1)]
    return joined[0], joined[1]


def returned(depth: Floats, edges: str, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Depths in metres as the camera gives them: white noise on quantised disparities, and its way with edges.

    ``edges`` is "mixed" (a pixel beside a step is kept, 30 % of it from the other side) or "dropped" (it is not there).
    """
    focal = FY * float(np.linalg.norm(SECOND_EYE))
    near, far = neighbours(depth)
    step = far - near > STEP
    if edges == "mixed":
        other = np.where(depth - near > far - depth, near, far)
        depth = np.where(step, 0.7 * depth + 0.3 * other, depth)
    disparity = focal / depth + rng.normal(0.0, DISPARITY_NOISE_PIXELS, depth.shape)
    depth = focal / (np.rint(disparity / DISPARITY_STEP_PIXELS) * DISPARITY_STEP_PIXELS)
    if edges == "dropped":
        beside_nothing = neighbours(np.isfinite(depth).astype(float))[0] == 0.0
        depth = np.where(step | beside_nothing, np.nan, depth)
    return depth.astype(np.float32)


def neighbours(depth: Floats) -> tuple[Floats, Floats]:
    """Smallest and largest depth (h, w) among a pixel and its four neighbours, leaving out those without one."""
    framed = np.pad(depth, 1, constant_values=np.nan)
    around = [framed[1:-1, 1:-1], framed[:-2, 1:-1], framed[2:, 1:-1], framed[1:-1, :-2], framed[1:-1, 2:]]
    near, far = around[0], around[0]
    for one in around[1:]:
        near, far = np.fmin(near, one), np.fmax(far, one)
    return near, far
