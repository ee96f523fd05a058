"""The hanging scene: its truth follows from its parts and poses by arithmetic that shares nothing with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.twin.hoisting import Hang, Stand, hanging_pose, standing_pose, true_pairs
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot
from tests import hoisting_scenes as scenes


def test_a_column_straight_above_its_bars_has_no_offset() -> None:
    rng = np.random.default_rng(0)
    foot, bars = random_foot(LAB, rng, 0.0), random_bars(LAB, rng, 0.0)
    pose = hanging_pose(Hang(120.0))
    assert max(pair.distance_mm for pair in true_pairs(foot, bars, pose, np.eye(4))) < 1e-12


def test_spacing_and_angle_move_the_nearest_corner_to_the_same_side() -> None:
    rng = np.random.default_rng(0)
    foot, bars = random_foot(LAB, rng, 0.0), random_bars(LAB, rng, 0.0)
    for hang, expected in ((Hang(180.0, spacing=40.0), 40.0), (Hang(180.0, 30.0), 2 * 127.28 * np.sin(np.pi / 12))):
        pairs = true_pairs(foot, bars, hanging_pose(hang), np.eye(4))
        assert pairs[0].distance_mm == pytest.approx(expected, abs=0.01)
    both = true_pairs(foot, bars, hanging_pose(Hang(180.0, 30.0, 100.0)), np.eye(4))
    assert both[0].distance_mm > 150.0  # they add up there, as in the paper's Table 6
    assert both[6].distance_mm < 60.0


def test_a_tilted_foot_sees_its_bars_along_its_own_normal() -> None:
    rng = np.random.default_rng(0)
    foot, bars = random_foot(LAB, rng, 0.0), random_bars(LAB, rng, 0.0)
    level = replace(bars, bars=tuple(replace(bar, top=0.0) for bar in bars.bars))
    pairs = true_pairs(foot, level, hanging_pose(Hang(180.0, tilt=1.0)), np.eye(4))
    expected = 180.0 * np.tan(np.radians(1.0))
    middle = np.mean([pair.offset_mm for pair in pairs], axis=0)
    assert np.hypot(*middle) == pytest.approx(expected, rel=0.01)


def test_the_camera_stands_on_the_diagonal_and_looks_at_the_gap() -> None:
    hang, stand = Hang(100.0), Stand(850.0)
    pose = standing_pose(stand, hang, LAB.centres())
    first = np.array([-90.0, -90.0])
    assert np.hypot(*(pose[:2, 3] - first)) == pytest.approx(850.0)
    assert pose[2, 3] == -60.0
    towards = np.array([0.0, 0.0, 45.0]) - pose[:3, 3]
    assert pose[:3, 2] == pytest.approx(towards / np.linalg.norm(towards))
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1.0)


def test_the_frame_shows_what_its_truth_says() -> None:
    pytest.importorskip("open3d")
    pytest.importorskip("manifold3d")
    truth = scenes.usual()
    depth, camera = truth.frame.depth, truth.frame.camera
    for pair in truth.pairs[:4]:  # bars of the two sides that the camera sees: their fronts, 9 mm before their axes
        x, y, z = pair.rebar_scan_mm
        u, v = round(x / z * camera.fx + camera.cx), round(y / z * camera.fy + camera.cy)
        strip = depth[v + 40 : v + 80, u - 3 : u + 4]
        assert np.nanmedian(strip) - z == pytest.approx(-9.0, abs=12.0)
        assert np.isnan(depth[v - 60 : v - 40, u - 3 : u + 4]).mean() > 0.9  # the gap
