"""Signs of filters on discs with noise in closed form: none on a few small ones that are sound, seen when smoothed."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from aadm_workbench.extract.filter_signs import SMOOTHED, FilterSigns, filter_signs
from aadm_workbench.extract.patches import Patches

PITCH_MM, SIDE = 0.8, 41


def signs(discs: int, radius_mm: float, shared: float, seed: int) -> FilterSigns:
    """Of tops whose noise has a Gaussian kernel of so many pixels, in the air, one pixel in forty lost."""
    rng = np.random.default_rng(seed)
    steps = PITCH_MM * (np.arange(SIDE) - SIDE // 2)
    x, y = (np.tile(one.ravel(), (discs, 1)).astype(np.float32) for one in np.meshgrid(steps, steps))
    noise = ndimage.gaussian_filter(rng.normal(size=(discs, SIDE, SIDE)), (0.0, shared, shared)).reshape(discs, -1)
    noise *= 0.3 / noise.std()
    inside = (np.hypot(x, y) < radius_mm) & (rng.random(x.shape) > 0.025)
    height = np.where(inside, noise, np.nan).astype(np.float32)
    patches = Patches(x, y, height, None, SIDE)
    return filter_signs(patches, np.zeros((discs, 2)), radius_mm, PITCH_MM, -1.0)


def test_few_small_tops_of_a_sound_camera_are_not_smoothed() -> None:
    seen = [signs(3, 10.0, 0.5, seed) for seed in range(80)]
    assert 0.55 < np.median([one.fine for one in seen]) < 0.75
    assert [one for one in seen if one.reason(blurred=False) == SMOOTHED] == []


@pytest.mark.parametrize("discs", [3, 12])
def test_the_spread_of_what_is_seen_is_stated(discs: int) -> None:
    seen = [signs(discs, 10.0, 0.5, seed) for seed in range(80)]
    stated = np.median([one.fine_u for one in seen])
    assert 0.5 < np.std([one.fine for one in seen]) / stated < 1.5


@pytest.mark.parametrize(("discs", "radius_mm"), [(3, 10.0), (12, 10.0), (4, 16.0)])
def test_smoothing_is_seen_on_few_and_on_many(discs: int, radius_mm: float) -> None:
    assert all(signs(discs, radius_mm, 0.8, seed).reason(blurred=False) == SMOOTHED for seed in range(20))
