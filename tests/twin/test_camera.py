"""The virtual camera: what it draws is where geometry says, and its errors are as large as it says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.model import Camera
from aadm_workbench.twin.camera import PRO_M, facing
from aadm_workbench.twin.meshes import bars_surface, foot_surface
from aadm_workbench.twin.noise import CameraNoise, captured
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Foot, SleeveAsBuilt
from aadm_workbench.twin.raycast import View, look, rays_of
from aadm_workbench.twin.scene import scan_of
from aadm_workbench.twin.surface import CONCRETE, SLEEVE_WALL, moved

SMALL = Camera(fx=600.0, fy=600.0, cx=319.5, cy=255.5, width=640, height=512)
SLEEVE = SleeveAsBuilt(30.0, -20.0, 36.0, lean=(0.01, 0.0))
SILENT = CameraNoise(
    depth_at_1m=0.0, warp=0.0, random_loss=0.0, outliers=0.0, step_loss=0.0, step_fly=0.0, wall_loss=0.0
)


def pose(distance: float = 800.0) -> np.ndarray:
    return facing(np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]), distance, (0.03, -0.02), 0.1)


def rendered() -> tuple[View, np.ndarray]:
    T = pose()
    view = look(moved(foot_surface(Foot((250.0, 250.0), (SLEEVE,))), np.linalg.inv(T)), SMALL)
    points = rays_of(SMALL) * view.depth[..., None]
    return view, points @ T[:3, :3].T + T[:3, 3]


def test_a_pose_is_a_rotation_and_sees_its_target_in_the_middle() -> None:
    T = pose()
    assert np.allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3))
    assert np.linalg.det(T[:3, :3]) == pytest.approx(1.0)
    assert np.linalg.inv(T) @ [0, 0, 0, 1] == pytest.approx([0.0, 0.0, 800.0, 1.0])


def test_the_logged_pixel_of_the_real_camera_comes_out() -> None:
    """Pixel (222, 222) at 1230.2920 mm was logged at X -374.2097, Y -208.3364 mm."""
    ray = rays_of(PRO_M)[222, 222]
    assert ray[:2] * 1230.2920 == pytest.approx([-374.2097, -208.3364], abs=2e-3)


def test_the_face_is_flat_where_it_should_be() -> None:
    view, column = rendered()
    face = (view.kind == CONCRETE) & (np.abs(column[..., :2]).max(axis=-1) < 120.0)
    assert np.abs(column[face][:, 2]).max() < 0.005


def test_the_bore_has_its_radius_and_its_lean() -> None:
    view, column = rendered()
    wall = (view.kind == SLEEVE_WALL) & (column[..., 2] < 250.0) & (column[..., 2] > 0.5)
    assert wall.sum() > 200
    axis = np.array([30.0, -20.0]) + 0.01 * column[wall][:, 2:3] * np.array([1.0, 0.0])
    assert np.hypot(*(column[wall][:, :2] - axis).T) == pytest.approx(np.full(wall.sum(), 18.0), abs=0.02)


def test_nothing_is_lit_where_the_projector_is_hidden() -> None:
    group = BarGroup((BarAsBuilt(0.0, 0.0, 0.0, 20.0),), -160.0)
    T = facing(np.zeros(3), np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0]), 900.0, (0.0, 0.0), 0.0)
    view = look(moved(bars_surface(group), np.linalg.inv(T)), SMALL)
    points = rays_of(SMALL) * view.depth[..., None]
    column = points @ T[:3, :3].T + T[:3, 3]
    beside = np.abs(column[..., 1]) < 3.0
    # the projector stands at +270 mm, 900 mm above the top: a bar of 160 mm throws a shadow of 48 mm to -x
    shadow = beside & (column[..., 0] < -15.0) & (column[..., 0] > -45.0)
    light = beside & (column[..., 0] > 15.0) & (column[..., 0] < 45.0)
    assert not view.lit[shadow].any()
    assert view.lit[light].all()


def test_a_silent_camera_returns_the_truth() -> None:
    view, _ = rendered()
    depth = captured(view, SMALL, SILENT, np.random.default_rng(0))
    seen = np.isfinite(depth)
    assert seen.sum() > 10_000
    assert np.array_equal(depth[seen], view.depth[seen])


def test_noise_grows_with_the_square_of_the_distance() -> None:
    spread = []
    for distance in (700.0, 1400.0):
        T = facing(np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]), distance, (0.0, 0.0), 0.0)
        view = look(moved(foot_surface(Foot((250.0, 250.0), ())), np.linalg.inv(T)), SMALL)
        noise = replace(SILENT, depth_at_1m=0.1)
        depth = captured(view, SMALL, noise, np.random.default_rng(1))
        spread.append(float(np.nanstd(depth - view.depth)))
    assert spread[0] == pytest.approx(0.049, rel=0.1)
    assert spread[1] / spread[0] == pytest.approx(4.0, rel=0.1)


def test_pixels_are_lost_and_fly_at_depth_steps_only() -> None:
    view, _ = rendered()
    noise = replace(SILENT, step_loss=0.5, step_fly=0.2)
    depth = captured(view, SMALL, noise, np.random.default_rng(2))
    flying = np.isfinite(depth) & (np.abs(depth - view.depth) > 1.0)
    assert flying.sum() > 5
    rows, columns = np.nonzero(flying)
    for row, column in zip(rows, columns, strict=True):
        around = view.depth[row - 1 : row + 2, column - 1 : column + 2]
        assert np.nanmax(around) - np.nanmin(around) > noise.step_height
    plain = np.isfinite(captured(view, SMALL, SILENT, np.random.default_rng(2)))
    assert np.isfinite(depth).sum() < plain.sum()


def test_the_same_seed_gives_the_same_scan() -> None:
    foot = Foot((250.0, 250.0), (SLEEVE,))
    first, second = (scan_of(foot, pose(), CameraNoise(), np.random.default_rng(4), SMALL) for _ in range(2))
    assert np.array_equal(first.depth, second.depth, equal_nan=True)


def test_a_plug_closes_and_a_tape_covers_the_mouth() -> None:
    T = pose()
    for sleeve, covered in ((replace(SLEEVE, plugged_at=0.0), 0.95), (replace(SLEEVE, taped=0.5), 0.35)):
        view = look(moved(foot_surface(Foot((250.0, 250.0), (sleeve,))), np.linalg.inv(T)), SMALL)
        column = (rays_of(SMALL) * view.depth[..., None]) @ T[:3, :3].T + T[:3, 3]
        inside = np.hypot(column[..., 0] - 30.0, column[..., 1] + 20.0) < 16.0
        area = (np.abs(column[inside][:, 2]) < 0.3).sum() * (800.0 / 600.0) ** 2 / (np.pi * 16.0**2)
        assert area > covered


def test_a_bar_is_as_thick_as_its_core_between_ribs() -> None:
    surface = bars_surface(BarGroup((BarAsBuilt(0.0, 0.0, 0.0, 20.0, rib_height=0.9),), -160.0))
    radius = np.hypot(*surface.vertices[(surface.vertices[:, 2] < -1) & (surface.vertices[:, 2] > -100)][:, :2].T)
    assert radius.min() == pytest.approx(10.0, abs=1e-6)
    assert radius.max() == pytest.approx(10.9, abs=0.02)
