"""What the ray caster's pixel sees that has a size: light from both sides of an edge.

A structured-light camera does not measure depth but where on the projector a pixel's light comes from. A pixel that
an edge crosses gets light from the part of the surface that it covers, whose middle is not on the pixel's own ray:
read along this ray, the place on the projector belongs to another depth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from aadm_workbench.model import Array, BoolArray, Camera
from aadm_workbench.twin.raycast import PROJECTOR_BASELINE_MM, Caster, View, rays_of
from aadm_workbench.twin.surface import BAR, DARK, SLEEVE_WALL

_STEP_MM = 5.0  # surfaces further apart than that lie in different fringes
_REACH_PX = 2  # beyond two pixels the light of an edge is below a thousandth
_LEAST_LIGHT = 0.05  # of concrete's square to the view: below it the fringes drown in noise
_BRIGHTNESS = {SLEEVE_WALL: 0.3, BAR: 0.8, DARK: 0.0}  # of metal in the mean over its directions, concrete being 1


@dataclass(frozen=True)
class FinitePixel:
    """The pixel's size, and which of its consequences are wanted.

    ``spread_px``: standard deviation of the place in the pixel that light comes from, optics included. ``curl``: edges
    carry the place of their lit part. ``overhang``: a ray that just misses an edge still returns it, where most of
    the light comes from there. ``slips``: share of the pixels with light of two depths, half from each, that come out
    in a wrong fringe. ``ghosts``: share of unlit sleeve walls that do. Such a point lies between ``slip_mm`` nearer.
    ``samples`` rays are cast per pixel at an edge.
    """

    spread_px: float = 0.5
    curl: bool = True
    overhang: bool = True
    slips: float = 0.15
    ghosts: float = 0.03
    slip_mm: tuple[float, float] = (50.0, 105.0)
    samples: int = 32


@dataclass(frozen=True, eq=False)
class _Sampled:
    """Rays (n, s) within n pixels at edges: what they hit, the light that comes back along them, their slopes in x.

    The first ray of each pixel is its own, through its middle.
    """

    hit: View
    light: Array
    slope: Array


def seen_by_pixels(view: View, caster: Caster, camera: Camera, pixel: FinitePixel, rng: np.random.Generator) -> View:
    """The view that a camera has whose pixels have a size, from that of their middles."""
    rows, columns = np.nonzero(_at_edges(view))
    sampled = _sampled(rays_of(camera)[rows, columns], caster, camera, pixel, rng)
    chosen, rival = _chosen(sampled, pixel)
    depth = _read_depth(sampled, chosen, pixel)
    lit = (sampled.light * chosen).mean(axis=1) > _LEAST_LIGHT
    slipped = rng.random(len(rows)) < 2.0 * pixel.slips * rival
    depth = np.where(slipped, depth - rng.uniform(*pixel.slip_mm, len(rows)), depth)
    seen = View(view.depth.copy(), view.cosine.copy(), view.kind.copy(), view.owner.copy(), view.lit.copy())
    seen.lit[rows, columns] = lit
    brightest = (sampled.light * chosen).argmax(axis=1)
    at = rows[lit], columns[lit]
    source = np.nonzero(lit)[0], brightest[lit]
    seen.depth[at] = depth[lit]
    for name in ("cosine", "kind", "owner"):
        getattr(seen, name)[at] = getattr(sampled.hit, name)[source]
    return _haunted(seen, pixel, rng)


def _at_edges(view: View) -> BoolArray:
    side = 2 * _REACH_PX + 1
    deep = np.where(np.isnan(view.depth), np.float32(1e6), view.depth)
    spread = ndimage.maximum_filter(deep, side) - ndimage.minimum_filter(deep, side)
    border = ndimage.maximum_filter(view.lit, side) != ndimage.minimum_filter(view.lit, side)
    return np.asarray((spread > _STEP_MM) | border)


def _sampled(
    rays: npt.NDArray[np.float32], caster: Caster, camera: Camera, pixel: FinitePixel, rng: np.random.Generator
) -> _Sampled:
    """Cast the pixels' own rays (n, 3) and others beside them."""
    offsets = rng.normal(0.0, pixel.spread_px, (len(rays), pixel.samples, 2)) / [camera.fx, camera.fy]
    offsets[:, 0] = 0.0
    around = np.repeat(rays[:, None], pixel.samples, 1)
    around[..., :2] += offsets.astype(np.float32)
    hit = caster.view(around)
    light: Array = np.where(hit.lit, hit.cosine, 0.0).astype(np.float64)
    for kind, share in _BRIGHTNESS.items():
        light[hit.kind == kind] *= share
    return _Sampled(hit, light, around[..., 0].astype(np.float64))


def _chosen(sampled: _Sampled, pixel: FinitePixel) -> tuple[BoolArray, Array]:
    """Which rays (n, s) hit the surface that the pixel returns, and the share (n,) of the light that is not its."""
    depth, light = sampled.hit.depth, sampled.light
    nearest = np.min(np.where(light > 0.0, depth, np.inf), axis=1, keepdims=True)
    front = (light > 0.0) & (depth - nearest < _STEP_MM)
    back = (light > 0.0) & ~front
    ahead, behind = (light * front).sum(axis=1), (light * back).sum(axis=1)
    takes_front = ahead >= behind if pixel.overhang else front[:, 0]
    chosen = np.where(takes_front[:, None], front, back)
    if not pixel.overhang:
        chosen &= (light[:, :1] > 0.0) & (np.abs(depth - depth[:, :1]) < _STEP_MM)
    total = np.maximum(ahead + behind, 1e-12)
    return np.asarray(chosen), 1.0 - (light * chosen).sum(axis=1) / total


def _read_depth(sampled: _Sampled, chosen: BoolArray, pixel: FinitePixel) -> Array:
    """Depth (n,) mm that the pixel's own ray has where it meets the light of what the pixel returns."""
    weight = sampled.light * chosen
    total = np.maximum(weight.sum(axis=1), 1e-12)
    deep = np.where(chosen, sampled.hit.depth, 1.0).astype(np.float64)
    if not pixel.curl:
        return np.where(chosen[:, 0], deep[:, 0], (weight * deep).sum(axis=1) / total)
    # Seen from the projector's middle, a point lies at the slope (x - baseline) / z = slope - baseline / z.
    from_projector = (weight * (sampled.slope - PROJECTOR_BASELINE_MM / deep)).sum(axis=1) / total
    return np.asarray(PROJECTOR_BASELINE_MM / np.maximum(sampled.slope[:, 0] - from_projector, 1e-3))


def _haunted(view: View, pixel: FinitePixel, rng: np.random.Generator) -> View:
    """Some of the unlit walls return light that bounced there, and lie in a fringe that it came from."""
    rows, columns = np.nonzero((view.kind == SLEEVE_WALL) & ~view.lit & np.isfinite(view.depth))
    ghost = rng.random(len(rows)) < pixel.ghosts
    rows, columns = rows[ghost], columns[ghost]
    view.depth[rows, columns] -= rng.uniform(*pixel.slip_mm, len(rows)).astype(np.float32)
    view.lit[rows, columns] = True
    return view
