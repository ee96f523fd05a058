"""From an ideal view to what a structured-light camera returns: noise, warp, lost and flying pixels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from aadm_workbench.model import BoolArray, Camera
from aadm_workbench.twin.finite_pixel import FinitePixel
from aadm_workbench.twin.raycast import View
from aadm_workbench.twin.surface import DARK, SLEEVE_WALL


@dataclass(frozen=True)
class CameraNoise:
    """How far a camera's depth is from the truth. Lengths in mm, shares 0..1.

    ``depth_at_1m``: standard deviation on a surface square to the view at 1 m; it grows with the
    distance squared and with 1/cos of the incidence. ``correlated`` is the share of its variance that
    neighbouring pixels have in common. ``wall_bias`` pushes returns of sleeve walls along the ray, and
    ``wall_bias_own`` those of each sleeve by an amount of its own, up to this. ``warp_period`` is in pixels: a third
    of the image's width where it is None. ``pixel``: what a pixel sees that has a size; None is a pixel without.
    """

    depth_at_1m: float = 0.07
    correlated: float = 0.5
    warp: float = 0.05
    scale: float = 0.0
    random_loss: float = 0.004
    outliers: float = 0.0002
    outlier_reach: float = 80.0
    step_loss: float = 0.5
    step_fly: float = 0.15
    step_height: float = 5.0
    grazing_full: float = 0.3
    grazing_none: float = 0.06
    wall_loss: float = 0.25
    wall_bias: float = 0.0
    wall_bias_own: float = 0.0
    warp_period: float | None = None
    pixel: FinitePixel | None = None

    @staticmethod
    def drawn(rng: np.random.Generator) -> CameraNoise:
        """A camera drawn from the ranges that accuracy targets refer to."""
        return CameraNoise(
            depth_at_1m=rng.uniform(0.05, 0.10),
            scale=rng.uniform(-1e-4, 1e-4),
            step_fly=rng.uniform(0.0, 0.3),
            wall_loss=rng.uniform(0.0, 0.5),
            wall_bias=rng.uniform(-0.8, 0.8),
        )


def captured(view: View, camera: Camera, noise: CameraNoise, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """Depth map (h, w) float32, mm, as the camera returns it; NaN where it returns nothing."""
    ideal = view.depth
    measured = ideal + _depth_error(view, camera, noise, rng)
    wall = view.kind == SLEEVE_WALL
    measured[wall] += (noise.wall_bias * rng.uniform(0.6, 1.0, wall.sum())).astype(np.float32)
    if noise.wall_bias_own > 0.0:
        own = rng.uniform(-noise.wall_bias_own, noise.wall_bias_own, int(view.owner.max(initial=0)) + 1)
        measured[wall] += own[view.owner[wall]].astype(np.float32)
    measured *= np.float32(1.0 + noise.scale)
    low, high = _neighbourhood(ideal)
    step = np.isfinite(low) & np.isfinite(high) & (high - low > noise.step_height)
    low, high = np.where(step, low, 0.0), np.where(step, high, 0.0)
    flying = step & (rng.random(ideal.shape) < noise.step_fly)
    mixture = rng.random(ideal.shape).astype(np.float32)
    measured = np.where(flying, low + mixture * (high - low), measured)
    outlier = rng.random(ideal.shape) < noise.outliers
    measured[outlier] += rng.uniform(-noise.outlier_reach, noise.outlier_reach, outlier.sum()).astype(np.float32)
    measured[_lost(view, step & ~flying, wall, noise, rng)] = np.nan
    return measured.astype(np.float32)


def _lost(view: View, step: BoolArray, wall: BoolArray, noise: CameraNoise, rng: np.random.Generator) -> BoolArray:
    chance = np.full(view.depth.shape, noise.random_loss, np.float32)
    span = noise.grazing_full - noise.grazing_none
    chance = np.maximum(chance, np.clip((noise.grazing_full - view.cosine) / span, 0.0, 1.0))
    chance[wall] = 1.0 - (1.0 - chance[wall]) * (1.0 - noise.wall_loss)
    chance[step] = np.maximum(chance[step], noise.step_loss)
    chance[view.kind == DARK] = 1.0
    return np.asarray(~view.lit | (rng.random(view.depth.shape) < chance))


def _depth_error(view: View, camera: Camera, noise: CameraNoise, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    shape = view.depth.shape
    white = rng.standard_normal(shape, dtype=np.float32)
    smooth = ndimage.gaussian_filter(rng.standard_normal(shape, dtype=np.float32), 1.2)
    smooth /= smooth.std()
    unit = np.sqrt(1.0 - noise.correlated) * white + np.sqrt(noise.correlated) * smooth
    sigma = noise.depth_at_1m * (view.depth / 1000.0) ** 2 / np.maximum(view.cosine, 0.05)
    return np.asarray(sigma * unit + _warp(camera, noise, rng), np.float32)


def _warp(camera: Camera, noise: CameraNoise, rng: np.random.Generator) -> npt.NDArray[np.float32]:
    """A smooth error along both sides of the image."""
    phase = rng.uniform(0.0, 2 * np.pi, 2)
    period = camera.width / 3.0 if noise.warp_period is None else noise.warp_period
    u = np.sin(2 * np.pi * np.arange(camera.width) / period + phase[0])
    v = np.sin(2 * np.pi * np.arange(camera.height) / period + phase[1])
    return np.asarray(noise.warp * 0.5 * (u[None, :] + v[:, None]), np.float32)


def _neighbourhood(depth: npt.NDArray[np.float32]) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    low = ndimage.minimum_filter(np.where(np.isnan(depth), np.float32(np.inf), depth), 3)
    high = ndimage.maximum_filter(np.where(np.isnan(depth), np.float32(-np.inf), depth), 3)
    return low, high
