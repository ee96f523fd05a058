"""Rings of pixels that a camera drops at steps: drawn on a raster, where each ring is taken by hand."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.extract.edges.lost_rings import gaps_at_steps, rings_dropped
from aadm_workbench.extract.patches import Patches

RADIUS, PITCH, SIDE = 18.0, 0.5, 101


def picture(rings: int, lit: float, lost: float, rng: np.random.Generator) -> Patches:
    """Three mouths before a floor 80 mm behind: its ``lit`` share, and the share of pixels ``lost`` anywhere."""
    steps = (np.arange(SIDE) - SIDE // 2) * PITCH
    x, y = np.meshgrid(steps, steps)
    heights = []
    for off_x, off_y in rng.uniform(-0.4, 0.4, (3, 2)):
        inside = np.hypot(x - off_x, y - off_y) < RADIUS
        height = np.where(inside, -80.0, 0.0)
        height[inside & (np.arctan2(y, x) > np.pi * (2.0 * lit - 1.0))] = np.nan
        height[rng.random(height.shape) < lost] = np.nan
        for _ in range(rings):
            height = without_a_ring(height, inside)
        heights.append(height.ravel())
    flat = np.array(heights, np.float32)
    x, y = (np.tile(part.ravel().astype(np.float32), (3, 1)) for part in (x, y))
    return Patches(x, y, flat, np.tile([0.0, 0.0, 1e3], (3, 1)), SIDE, x, y)


def without_a_ring(height: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Without the pixels that have one of the other surface, or one already taken at the edge, beside them."""
    other = np.zeros(height.shape, bool)
    at_edge = np.isnan(height) & (np.abs(np.hypot(*np.indices(height.shape) - SIDE // 2) * PITCH - RADIUS) < 4.0)
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            other |= np.roll(inside, (down, right), (0, 1)) != inside
            other |= np.roll(at_edge, (down, right), (0, 1))
    return np.where(other, np.nan, height)


@pytest.mark.parametrize("rings", [0, 1, 2])
@pytest.mark.parametrize("lit", [1.0, 0.4])
def test_rings_are_counted_where_something_is_lit_behind(rings: int, lit: float) -> None:
    patches = picture(rings, lit, 0.005, np.random.default_rng(3))
    gaps = gaps_at_steps(patches, patches.height, np.zeros((3, 2)), RADIUS, PITCH)
    assert rings_dropped(gaps) == rings, gaps


def test_a_camera_that_loses_half_of_its_pixels_drops_no_rings() -> None:
    patches = picture(0, 1.0, 0.5, np.random.default_rng(4))
    gaps = gaps_at_steps(patches, patches.height, np.zeros((3, 2)), RADIUS, PITCH)
    assert gaps[0] > 0.2 * gaps.sum()
    assert rings_dropped(gaps) == 0


def test_dark_mouths_and_clouds_tell_nothing() -> None:
    patches = picture(1, 0.0, 0.0, np.random.default_rng(5))
    assert rings_dropped(gaps_at_steps(patches, patches.height, np.zeros((3, 2)), RADIUS, PITCH)) == 0
    cloud = Patches(patches.x, patches.y, patches.height, patches.eye, 0)
    assert gaps_at_steps(cloud, cloud.height, np.zeros((3, 2)), RADIUS, PITCH).sum() == 0
