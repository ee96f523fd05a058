"""Light from the projector over the scene into the camera's pixels, traced by Mitsuba 3.

Light is linear in what the projector shows, so one set of paths answers for all patterns: each path carries the
pattern's constant part and, for every number of periods, the cosine and the sine of the phase at the projector
pixel that it started from. What four phase steps would record is put together from these afterwards.

The fine relief and the stains of cast concrete, as a tile that repeats.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np
import numpy.typing as npt
from scipy import ndimage

from aadm_workbench.model import BoolArray, Camera
from aadm_workbench.twin.fringe.rig import FringeRig

VERTICES = 7  # of the longest path; what bounces more often inside a sleeve has lost all but a hundredth
_ROULETTE_FROM = 3  # vertices: shorter paths carry most of the light and are all followed to their end
_PRIMARY_DIMENSIONS = 10  # random numbers of a path that are spread evenly; those of its later turns are not

TEXEL_MM = 0.2  # finer than half a pixel's width on the nearest face
_TEXELS = 1024  # 205 mm: no two sleeves of a face lie on the same part of it
_GRAIN_MM = (0.4, 1.5, 6.0)  # sand, trowel marks and the formwork's waves
_GRAIN_SHARES = (0.5, 0.6, 0.6)  # amplitudes of these lengths: a choice by eye
_STAIN_MM = (0.6, 8.0)  # lengths of stains: sand, and damp patches
_STAIN_SHARES = (0.6, 0.8)  # their amplitudes: a choice by eye


@dataclass(frozen=True, eq=False)
class Stage:
    """A scene as Mitsuba holds it, in the camera frame. ``cast`` says which of its shapes have a relief.

    ``to_column``: the pose T_column_scan as Mitsuba's transform; the relief is fixed to the column.
    """

    scene: Any
    shapes: tuple[Any, ...]
    cast: BoolArray
    relief: Any
    to_column: Any


def traced(
    stage: Stage, rig: FringeRig, camera: Camera, pixels: npt.NDArray[np.int64], paths: int, seed: int
) -> npt.NDArray[np.float32]:
    """Constant, cosine and sine parts (n, 1 + 2 k) of the light in pixels (n, 2), columns and rows.

    Parameters
    ----------
    paths
        Per pixel, even: every path has a mirrored twin, which keeps the mean place in pixel and lenses exact.
    """
    pairs = paths // 2
    count = len(pixels) * 2 * pairs
    number = dr.arange(mi.UInt32, count)
    pixel, sample = number // (2 * pairs), number % (2 * pairs)
    column = dr.gather(mi.Float, mi.Float(pixels[:, 0].astype(np.float32)), pixel)
    row = dr.gather(mi.Float, mi.Float(pixels[:, 1].astype(np.float32)), pixel)
    draws = _spread(pixels, camera, pixel, sample // 2, seed)
    sign = dr.select(sample % 2 == 0, mi.Float(1.0), mi.Float(-1.0))
    ray = _camera_ray(rig, camera, column, row, draws, sign)
    lens = mi.warp.square_to_uniform_disk_concentric(mi.Point2f(draws[8], draws[9])) * sign
    generator = mi.PCG32(size=count, initstate=_opaque(seed), initseq=mi.UInt64(number))
    sums = _followed(stage, rig, ray, mi.Point2f(lens), generator)
    dr.eval(sums)  # all together: the sums below would follow the paths once for each of them
    parts = [dr.block_sum(part, 2 * pairs) / (2 * pairs) for part in sums]
    dr.eval(parts)
    return np.stack([np.asarray(part.numpy(), np.float32) for part in parts], -1)


def _opaque(seed: int) -> Any:
    """A seed that is no part of the compiled code: a literal would have it compiled again for every portion."""
    return dr.opaque(mi.UInt64, seed)


def _spread(pixels: npt.NDArray[np.int64], camera: Camera, pixel: Any, pair: Any, seed: int) -> list[Any]:
    """Evenly spread points of the unit cube for the pairs of each pixel: a lattice sequence, shifted per pixel."""
    flat = mi.UInt64((pixels[:, 1] * camera.width + pixels[:, 0]).astype(np.uint64))
    generator = mi.PCG32(size=len(pixels), initstate=_opaque(seed + 1), initseq=flat)
    ratio = _golden_ratio(_PRIMARY_DIMENSIONS)
    points = []
    for dimension in range(_PRIMARY_DIMENSIONS):
        shift = dr.gather(mi.Float, generator.next_float32(), pixel)
        point = shift + mi.Float(pair) * float(ratio ** -(dimension + 1) % 1.0)
        points.append(point - dr.floor(point))
    return points


def _golden_ratio(dimensions: int) -> float:
    """The root of x^(d+1) = x + 1, whose inverse powers step evenly through the d-dimensional cube."""
    ratio = 2.0
    for _ in range(60):
        ratio = (1.0 + ratio) ** (1.0 / (dimensions + 1))
    return ratio


def _camera_ray(rig: FringeRig, camera: Camera, column: Any, row: Any, draws: list[Any], sign: Any) -> Any:
    """Rays through a thin lens: a place in the pixel, its picture on the plane of focus, a place in the lens."""
    lenses = rig.lenses
    x = column + sign * _in_pixel(draws[0], draws[1], rig)
    y = row + sign * _in_pixel(draws[2], draws[3], rig)
    focus = mi.Point3f((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0) * lenses.camera_focus
    disk = mi.warp.square_to_uniform_disk_concentric(mi.Point2f(draws[4], draws[5]))
    disk *= sign * (lenses.camera_aperture / 2.0)
    origin = mi.Point3f(disk.x, disk.y, 0.0)
    return mi.Ray3f(origin, dr.normalize(focus - origin))


def _in_pixel(in_square: Any, in_blur: Any, rig: FringeRig) -> Any:
    """Offset from the pixel's centre, px: within its sensitive square, spread by the lens."""
    bounded = dr.clip(2.0 * in_blur - 1.0, -0.9999, 0.9999)
    return (in_square - 0.5) * rig.lenses.fill + rig.lenses.blur * float(np.sqrt(2.0)) * dr.erfinv(bounded)


@dr.syntax  # type: ignore[untyped-decorator]
def _followed(stage: Stage, rig: FringeRig, ray: Any, lens: Any, generator: Any) -> list[Any]:
    """Follow the rays; at each surface ask how much light comes there straight from a place in the projector's lens."""
    scene, context = stage.scene, mi.BSDFContext()
    sums = [mi.Float(0.0) for _ in range(1 + 2 * len(rig.fringes.periods))]
    weight = mi.Float(1.0)
    vertex = mi.UInt32(0)
    active = mi.Bool(True)
    while dr.hint(active, exclude=[stage, rig]):
        si = scene.ray_intersect(ray, active)
        active &= si.is_valid()
        albedo, lift = _on_relief(stage, si, ray, active)
        bsdf = si.bsdf(ray)
        if_first = vertex == 0
        u, v = generator.next_float32(), generator.next_float32()
        other = mi.warp.square_to_uniform_disk_concentric(mi.Point2f(u, v))
        place = dr.select(if_first, lens, other)
        direction, power, phase = _from_projector(scene, rig, si, lift, place, active)
        reflected = bsdf.eval(context, si, si.to_local(direction), active & (power > 0.0))[0]
        light = weight * albedo * reflected * power
        light = dr.select(active & (light > 0.0), light, 0.0)
        sums[0] += light
        for k, periods in enumerate(rig.fringes.periods):
            sine, cosine = dr.sincos(phase * periods)
            sums[1 + 2 * k] += light * cosine
            sums[2 + 2 * k] += light * sine
        lobe, u, v = generator.next_float32(), generator.next_float32(), generator.next_float32()
        sample, share = bsdf.sample(context, si, lobe, mi.Point2f(u, v), active)
        weight *= albedo * share[0]
        ray = si.spawn_ray(si.to_world(sample.wo))
        vertex += 1
        survives = dr.select(vertex < _ROULETTE_FROM, 1.0, dr.minimum(weight * 2.0, 0.95))
        active &= (vertex < VERTICES) & (weight > 0.0) & (generator.next_float32() < survives)
        weight /= dr.maximum(survives, 1e-6)
    return sums


def _from_projector(scene: Any, rig: FringeRig, si: Any, lift: Any, place: Any, active: Any) -> tuple[Any, Any, Any]:
    """Direction towards a place in the projector's lens, light that comes from there, and the phase of one period."""
    projector, lenses = rig.projector, rig.lenses
    axes = [mi.Vector3f(*map(float, axis)) for axis in projector.rotation().T]
    lens = place * (lenses.projector_aperture / 2.0)
    centre = mi.Point3f(projector.baseline, 0.0, 0.0)
    source = centre + axes[0] * lens.x + axes[1] * lens.y
    towards = si.p + lift - source
    ahead = dr.dot(towards, axes[2])
    distance = dr.norm(towards)
    reach = lenses.projector_focus / dr.maximum(ahead, 1.0)
    x = (lens.x + dr.dot(towards, axes[0]) * reach) / lenses.projector_focus * projector.focal
    y = (lens.y + dr.dot(towards, axes[1]) * reach) / lenses.projector_focus * projector.focal
    inside = (ahead > 1.0) & (dr.abs(x) < projector.width / 2.0) & (dr.abs(y) < projector.height / 2.0)
    seen = active & inside
    seen &= ~scene.ray_test(si.spawn_ray_to(source), seen)
    # Radiance 1 over the lens, whose area is left out: the exposure is set by what arrives.
    power = dr.select(seen, ahead / (distance * distance * distance), 0.0)
    return -towards / distance, power, (x / projector.width + 0.5) * float(2.0 * np.pi)


def _on_relief(stage: Stage, si: Any, ray: Any, active: Any) -> tuple[Any, Any]:
    """Tilt the normal where cast concrete was hit; the relative albedo there, and the way onto the relief.

    The point itself stays on the mesh: below it, it would lie in its own shadow.
    """
    cast = mi.Bool(False)
    for shape, is_cast in zip(stage.shapes, stage.cast, strict=True):
        if is_cast:
            cast |= si.shape == mi.ShapePtr(shape)
    cast &= active
    place = stage.to_column @ si.p
    step = 1.0 / stage.relief.shape[0]
    uv = mi.Point2f(place.x, place.y) * (step / TEXEL_MM)
    height, albedo = stage.relief.eval(uv, cast)
    along_x = (stage.relief.eval(uv + mi.Vector2f(step, 0.0), cast)[0] - height) / TEXEL_MM
    along_y = (stage.relief.eval(uv + mi.Vector2f(0.0, step), cast)[0] - height) / TEXEL_MM
    back = stage.to_column.inverse()
    x, y = back @ mi.Vector3f(1.0, 0.0, 0.0), back @ mi.Vector3f(0.0, 1.0, 0.0)
    outward = dr.select(dr.dot(si.n, ray.d) < 0.0, si.n, -si.n)
    slope = x * along_x + y * along_y
    slope -= outward * dr.dot(slope, outward)
    normal = dr.normalize(outward - slope)
    facing = dr.maximum(-dr.dot(outward, ray.d), 0.2)
    frame = mi.Frame3f(normal)
    si.sh_frame = dr.select(cast, frame, si.sh_frame)
    si.wi = dr.select(cast, si.to_local(-ray.d), si.wi)
    return dr.select(cast, albedo, 1.0), dr.select(cast, ray.d * (-height / facing), 0.0)


def relief_tile(relief_mm: float, mottling: float, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Height in mm and relative albedo (n, n, 2) of a square tile with sides of n times :data:`TEXEL_MM`."""
    height = relief_mm * _noise(_GRAIN_MM, _GRAIN_SHARES, rng)
    albedo = np.clip(1.0 + mottling * _noise(_STAIN_MM, _STAIN_SHARES, rng), 0.3, 1.7)
    return np.stack([height, albedo], -1).astype(np.float32)


def _noise(
    lengths_mm: tuple[float, ...], shares: tuple[float, ...], rng: np.random.Generator
) -> npt.NDArray[np.float64]:
    """Smooth noise (n, n) of some lengths, with mean 0 and variance 1."""
    total = np.zeros((_TEXELS, _TEXELS))
    for length, share in zip(lengths_mm, shares, strict=True):
        white = rng.standard_normal((_TEXELS, _TEXELS), dtype=np.float32)
        layer = ndimage.gaussian_filter(white, length / 2.0 / TEXEL_MM, mode="wrap")
        total += share * layer / layer.std()
    return np.asarray((total - total.mean()) / total.std())
