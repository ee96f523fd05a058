"""The published hoisting method and its peers on a frame whose truth is known: baselines, not measurements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.extract.published.hoisting import METHODS, find_key_points
from tests import hoisting_scenes as scenes


@pytest.mark.parametrize("method", METHODS)
def test_key_points_are_found_to_some_millimetres(method: str) -> None:
    truth = scenes.usual()
    found = find_key_points(truth.frame.scan(), method, 26.0, 18.0, 42.0, np.random.default_rng(0))
    assert found.reason == ""
    true = np.array([truth.pairs[k].distance_mm for k in (9, 0, 3)])  # left, middle, right
    assert np.abs(found.distances_mm() - true).max() < 6.0
    sleeves = np.array([truth.pairs[k].sleeve_scan_mm for k in (9, 0, 3)])
    assert np.linalg.norm(found.sleeves[list(found.sleeve_keys)] - sleeves, axis=1).max() < 6.0


def test_the_same_seed_finds_the_same_points() -> None:
    scan = scenes.usual().frame.scan()
    first, second = (
        find_key_points(scan, "fusion", 26.0, 18.0, 42.0, np.random.default_rng(0)).distances_mm() for _ in range(2)
    )
    assert first == pytest.approx(second)


@pytest.mark.parametrize("method", METHODS)
def test_a_frame_without_a_foot_has_no_key_points(method: str) -> None:
    scan = scenes.usual().frame.scan()
    points = scan.points.copy()
    points[:620] = np.nan
    found = find_key_points(replace(scan, points=points), method, 26.0, 18.0, 42.0, np.random.default_rng(0))
    assert found.reason
    assert np.isnan(found.distances_mm()).all()
