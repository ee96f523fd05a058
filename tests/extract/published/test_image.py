"""The image method: pictures, back-projection, and what it cannot do without."""

import numpy as np
import pytest

from aadm_workbench.extract.published.image import (
    back_projected,
    depth_around,
    depth_picture,
    extract_rebars,
    extract_sleeves,
    plane_through,
)
from aadm_workbench.model import Camera, Scan
from aadm_workbench.scan.camera import depth_to_points

CAMERA = Camera(fx=1200.0, fy=1190.0, cx=310.4, cy=255.2, width=640, height=480)
CENTRES_MM = np.array([[-60.0, -50.0], [60.0, -50.0], [60.0, 50.0], [-60.0, 50.0]])
DEPTH_MM = 800.0


def grey_foot() -> Scan:
    """A flat foot, 800 mm away, with four dark holes in its picture and no depth inside them."""
    depth = np.full((CAMERA.height, CAMERA.width), DEPTH_MM, np.float32)
    picture = np.full(depth.shape, 180, np.uint8)
    points = depth_to_points(depth, CAMERA)
    for centre in CENTRES_MM:
        hole = np.hypot(points[..., 0] - centre[0], points[..., 1] - centre[1]) < 18.0
        picture[hole] = 30
        depth[hole] = np.nan
    return Scan(depth_to_points(depth, CAMERA), camera=CAMERA, viewpoint=np.zeros(3), image=picture)


def test_circles_of_the_grey_picture_are_lifted_to_the_depth_around_them() -> None:
    found = extract_sleeves(grey_foot(), 36.0, np.random.default_rng(0))
    centres = np.array([point.centre for point in found.points])
    distance = np.hypot(*(centres[:, None, :2] - CENTRES_MM[None]).transpose(2, 0, 1))
    assert len(centres) == 4
    assert distance.min(axis=0).max() < 1.5  # pixels are 0.67 mm
    assert np.allclose(centres[:, 2], DEPTH_MM, atol=1e-3)
    assert found.quality["picture"] == "grey picture"
    assert found.plane is not None
    assert np.allclose(found.plane.normal, [0.0, 0.0, -1.0], atol=1e-6)
    assert all(point.diameter_mm == pytest.approx(36.0, abs=3.0) for point in found.points)


def test_without_camera_or_order_there_is_a_reason() -> None:
    scan = grey_foot()
    for lacking in (Scan(scan.points, image=scan.image), Scan(scan.points.reshape(-1, 3), camera=CAMERA)):
        for recipe in (extract_sleeves, extract_rebars):
            found = recipe(lacking, 36.0, np.random.default_rng(0))
            assert found.points == ()
            assert found.plane is None
            assert "camera" in found.reason


def test_picture_of_another_size_is_refused() -> None:
    scan = grey_foot()
    assert scan.image is not None
    other = Scan(scan.points, camera=CAMERA, image=scan.image[::2, ::2])
    assert "differ in size" in extract_sleeves(other, 36.0, np.random.default_rng(0)).reason


def test_picture_without_circles_gives_a_reason() -> None:
    scan = grey_foot()
    blank = Scan(scan.points, camera=CAMERA, image=np.full(scan.points.shape[:2], 180, np.uint8))
    found = extract_sleeves(blank, 36.0, np.random.default_rng(0))
    assert found.points == ()
    assert "no circle" in found.reason


def test_back_projection_is_the_camera_s_own() -> None:
    points = depth_to_points(np.full((480, 640), 731.5, np.float32), CAMERA)
    pixels = np.array([[0.0, 0.0], [639.0, 479.0], [17.0, 400.0]])
    seen = points[pixels[:, 1].astype(int), pixels[:, 0].astype(int)]
    assert np.allclose(back_projected(pixels, np.full(3, 731.5), CAMERA), seen, atol=1e-3)


def test_depth_picture_shows_near_as_white_and_what_is_out_of_range_as_black() -> None:
    depth = np.array([[500.0, 550.0, 600.0, 601.0, 499.0, np.nan]])
    assert depth_picture(depth, (500.0, 600.0)).tolist() == [[255, 191, 128, 0, 0, 0]]


def test_depth_around_looks_at_the_ring_alone() -> None:
    rows, columns = np.mgrid[:100, :100]
    distance = np.hypot(rows - 40.0, columns - 60.0)
    depth = np.where(distance < 11.0, 900.0, np.where(distance < 16.0, 700.0, 100.0))
    assert depth_around(depth, np.array([60.0, 40.0]), 10.0, (1.15, 1.5)) == 700.0
    assert np.isnan(depth_around(np.full((100, 100), np.nan), np.array([60.0, 40.0]), 10.0, (1.15, 1.5)))
    assert np.isnan(depth_around(depth, np.array([400.0, 400.0]), 10.0, (1.15, 1.5)))


def test_plane_through_centres_and_through_too_few_of_them() -> None:
    normal = np.array([0.05, -0.1, -1.0]) / np.linalg.norm([0.05, -0.1, -1.0])
    xy = np.array([[0.0, 0.0], [100.0, 0.0], [0.0, 80.0], [90.0, 70.0]])
    z = (-700.0 - xy @ normal[:2]) / normal[2]
    centres = np.column_stack([xy, z])
    assert np.allclose(plane_through(centres).normal, normal, atol=1e-9)
    assert plane_through(centres[:2]).normal.tolist() == [0.0, 0.0, -1.0]
    assert plane_through(centres[:2] * [1, 1, 0] + [0, 0, 500.0]).offset == pytest.approx(-500.0)
