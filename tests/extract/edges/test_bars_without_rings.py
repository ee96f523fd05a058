"""Bars of a camera that drops pixels beside steps of depth: found, round or not, and as wrong as they say."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.model import Array
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_pose
from tests.scenes import BESIDE_MM, quiet_noise, window

STEP_MM = 5.0
CHI2_95 = 5.99  # two degrees of freedom
IN_REGION = 0.85  # of 12 bars that share errors: 95 % of regions are stated


def without_rings(depth: Array, rings: int) -> Array:
    """The depth map without the pixels within so many of a step of 5 mm, or of where nothing came back."""
    there = np.isfinite(depth)
    window_of = np.ones((2 * rings + 1, 2 * rings + 1), np.uint8)
    highest = cv2.dilate(np.where(there, depth, -1e6).astype(np.float32), window_of)
    lowest = cv2.erode(np.where(there, depth, 1e6).astype(np.float32), window_of)
    empty = cv2.morphologyEx((~there).astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    beside = (highest - lowest > STEP_MM) | (cv2.dilate(empty, window_of) > 0)
    return np.asarray(np.where(beside, np.nan, depth))


def bars(setting: Setting, seed: int) -> TrueScan:
    rng = np.random.default_rng([seed, 5])
    part, pose = random_bars(setting, rng), random_pose(setting, False, rng)
    return scan_of(part, pose, quiet_noise(), rng, window(PRO_M, pose, setting.half_width + BESIDE_MM, even=True))


@pytest.mark.parametrize("rings", [1, 2])
@pytest.mark.parametrize(
    "setting", [replace(LAB, distance=600.0), LAB, replace(FIELD, distance=2000.0)], ids=["0.6 m", "0.8 m", "2 m"]
)
def test_bars_keep_to_their_regions_from_near_and_far(setting: Setting, rings: int) -> None:
    true = bars(setting, 11)
    cut = replace(true, depth=without_rings(true.depth, rings).astype(np.float32))
    found = extract_rebars(cut.scan(), setting.bar_diameter, np.random.default_rng(0))
    assert len(found.points) == 12
    true_axis = cut.axes_scan().mean(axis=0)
    across = np.linalg.svd(true_axis[None])[2][1:]
    inside = []
    for centre in cut.points_scan():
        point = min(found.points, key=lambda point: float(np.linalg.norm(point.centre - centre)))
        off = across @ (point.centre - centre)
        assert point.covariance is not None
        inside.append(off @ np.linalg.solve(across @ point.covariance @ across.T, off) < CHI2_95)
        assert np.sqrt(np.trace(point.covariance)) < 0.1 * setting.bar_diameter
    assert np.mean(inside) > IN_REGION
