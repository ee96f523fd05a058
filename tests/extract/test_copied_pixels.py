"""Depth maps whose edges were copied over, by other programs' filters: OpenCV's erosion, SciPy's nearest fill."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np
import pytest
from scipy import ndimage

from aadm_workbench.extract.filter_signs import copies_depths
from aadm_workbench.model import Array, Scan

SIDE = 420


def depth_of(seed: int, noise_mm: float = 0.15) -> Array:
    """A tilted face with four holes, each with a shadow that shows nothing, and pixels lost at random and at edges."""
    rng = np.random.default_rng(seed)
    rows, columns = np.mgrid[:SIDE, :SIDE]
    depth = 900.0 + 0.02 * columns - 0.03 * rows
    for row in (120, 300):
        for column in (110, 290):
            far = np.hypot(rows - row, columns - column)
            depth[far < 40] += 120.0
            depth[np.hypot(rows - row, columns - column + 6) < 34] = np.nan
            depth[(np.abs(far - 40) < 1.5) & (rng.random(far.shape) < 0.5)] = np.nan
    depth += rng.normal(0.0, noise_mm, depth.shape)
    depth[rng.random(depth.shape) < 0.004] = np.nan
    return depth


def scan_of(depth: Array) -> Scan:
    rows, columns = np.mgrid[:SIDE, :SIDE]
    across, down = ((place - SIDE / 2) / 2400.0 * depth for place in (columns, rows))
    return Scan(np.stack([across, down, depth], axis=-1).astype(np.float32), "mm", viewpoint=np.zeros(3))


def grown(depth: Array, pixels: int) -> Array:
    filled = np.where(np.isnan(depth), 1e6, depth).astype(np.float32)
    nearest = cv2.erode(filled, np.ones((2 * pixels + 1, 2 * pixels + 1)))
    covered = (nearest < 1e5) & ~(filled - nearest < 5.0)
    return np.where(covered, nearest, np.where(filled > 1e5, np.nan, filled)).astype(np.float64)


def nearest_filled(depth: Array) -> Array:
    place = ndimage.distance_transform_edt(np.isnan(depth), return_distances=False, return_indices=True)
    return np.asarray(depth[tuple(place)])


def filled_from_the_left(depth: Array) -> Array:
    last = np.maximum.accumulate(np.where(np.isnan(depth), 0, np.arange(SIDE)), axis=1)
    return np.asarray(np.take_along_axis(depth, last, axis=1))


@pytest.mark.parametrize("step_mm", [0.0, 0.025, 0.1])
@pytest.mark.parametrize("copied", [lambda d: grown(d, 1), lambda d: grown(d, 3), nearest_filled, filled_from_the_left])
def test_copied_depths_are_told_whatever_the_step_of_the_file(copied: Callable[[Array], Array], step_mm: float) -> None:
    depth = copied(depth_of(1))
    assert copies_depths(scan_of(np.round(depth / step_mm) * step_mm if step_mm else depth))


@pytest.mark.parametrize("step_mm", [0.0, 0.025, 0.1, 0.5, 1.0])
@pytest.mark.parametrize("noise_mm", [0.0, 0.03, 0.3])
def test_sound_scans_and_coarse_files_are_not(step_mm: float, noise_mm: float) -> None:
    for seed in range(2):
        depth = depth_of(seed, noise_mm)
        assert not copies_depths(scan_of(np.round(depth / step_mm) * step_mm if step_mm else depth))


def test_a_median_repeats_depths_everywhere_and_is_no_copy_over_edges() -> None:
    depth = np.nan_to_num(depth_of(2), nan=2000.0)
    median = ndimage.median_filter(depth, 5)
    assert not copies_depths(scan_of(np.where(median > 1500.0, np.nan, median)))


def test_nothing_is_said_of_clouds_and_of_what_has_no_edges() -> None:
    scan = scan_of(grown(depth_of(1), 2))
    assert not copies_depths(replace(scan, points=scan.points.reshape(-1, 3)))
    assert not copies_depths(scan_of(np.full((SIDE, SIDE), 900.0)))
