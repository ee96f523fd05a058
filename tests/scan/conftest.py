"""Fixtures of the scan readers: a small camera, a slanted plane that it sees, a cloud without order."""

import os
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.model import Array, Camera, FloatArray
from aadm_workbench.scan.camera import depth_to_points


@pytest.fixture
def camera() -> Camera:
    return Camera(fx=80.0, fy=81.0, cx=30.5, cy=25.25, width=64, height=48)


@pytest.fixture
def depth_mm() -> Array:
    """(48, 64) float64: a slanted plane, with pixels that saw nothing."""
    depth: Array = 900.0 + np.add.outer(0.7 * np.arange(48), 0.3 * np.arange(64))
    depth[5:9, 10:20] = np.nan
    return depth


@pytest.fixture
def grid(camera: Camera, depth_mm: Array) -> FloatArray:
    """(48, 64, 3) float32: the organised cloud of that plane, 40 points NaN."""
    return depth_to_points(depth_mm, camera)


@pytest.fixture
def cloud() -> FloatArray:
    """(600, 3) float32, without order and without gaps."""
    return np.random.default_rng(7).normal(0.0, 300.0, (600, 3)).astype(np.float32)


@pytest.fixture(scope="session")
def reference_clouds() -> Path:
    """Clouds of other people's programs; AADM_REFERENCE_DATA names the folder, ../shared/data by default."""
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    folder = Path(os.environ.get("AADM_REFERENCE_DATA", default)) / "cloud"
    if not folder.is_dir():
        pytest.skip("no reference data in ../shared/data, and AADM_REFERENCE_DATA names no folder with them")
    return folder
