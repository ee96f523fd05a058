"""Clouds that are a camera's picture without its rows; the clouds are made by Open3D, or are no picture at all."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.scan.pixels import on_pixels

SIZE, FOCAL, MIDDLE = (640, 480), (1210.3, 1208.9), (318.4, 243.7)


def depth_map(rng: np.random.Generator) -> np.ndarray:
    """A wavy surface with a step and pixels that returned nothing, mm."""
    u, v = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]))
    depth = 900.0 + 3.0 * np.sin(u / 40.0) + 0.05 * v + rng.normal(0.0, 0.1, u.shape)
    depth[:, 400:] += 150.0
    depth[rng.random(depth.shape) < 0.2] = 0.0
    return depth.astype(np.float32)


def unprojected(depth: np.ndarray) -> np.ndarray:
    """The cloud (n, 3) that Open3D makes of a depth map, in no order."""
    open3d = pytest.importorskip("open3d")
    lens = open3d.camera.PinholeCameraIntrinsic(*SIZE, *FOCAL, *MIDDLE)
    cloud = open3d.geometry.PointCloud.create_from_depth_image(
        open3d.geometry.Image(depth), lens, depth_scale=1.0, depth_trunc=1e5
    )
    return np.random.default_rng(2).permutation(np.asarray(cloud.points))


@pytest.mark.parametrize("decimals", [6, 2], ids=["exact", "hundredths"])
def test_every_point_is_back_in_its_pixel(decimals: int) -> None:
    depth = depth_map(np.random.default_rng(1))
    picture = on_pixels(np.round(unprojected(depth), decimals).astype(np.float32))
    assert picture is not None
    assert picture.shape == (*depth.shape, 3)
    returned = depth > 0
    np.testing.assert_array_equal(np.isfinite(picture[..., 2]), returned)
    np.testing.assert_allclose(picture[returned, 2], depth[returned], atol=0.6 * 10.0**-decimals + 1e-4)


def test_a_cloud_that_was_moved_is_no_picture() -> None:
    points = unprojected(depth_map(np.random.default_rng(1)))
    turn = np.radians(3.0)
    about_y = np.array([[np.cos(turn), 0.0, np.sin(turn)], [0.0, 1.0, 0.0], [-np.sin(turn), 0.0, np.cos(turn)]])
    assert on_pixels(points @ about_y.T) is None
    assert on_pixels(points + np.array([40.0, 0.0, 0.0])) is None


@pytest.mark.parametrize(("distance", "step", "noise"), [(300.0, 0.3, 0.02), (800.0, 0.4, 0.02), (1300.0, 0.5, 0.1)])
def test_the_even_steps_of_a_line_scanner_are_no_camera(distance: float, step: float, noise: float) -> None:
    """Seen from the origin a flat face in even steps lies on an even grid, too."""
    x, y = np.meshgrid(np.arange(-100.0, 100.0, step), np.arange(-100.0, 100.0, step))
    z = distance + np.random.default_rng(3).normal(0.0, noise, x.shape)
    assert on_pixels(np.column_stack([x.ravel(), y.ravel(), z.ravel()]).astype(np.float32)) is None


def test_points_anywhere_are_no_picture() -> None:
    points = np.random.default_rng(4).uniform([-100.0, -100.0, 800.0], [100.0, 100.0, 900.0], (20_000, 3))
    assert on_pixels(points) is None
    assert on_pixels(points[:50]) is None
