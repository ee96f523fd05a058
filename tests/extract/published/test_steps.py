"""The steps that the methods of the literature are made of, each against an exact truth."""

import numpy as np
import open3d
import pytest

from aadm_workbench.extract.published.binary_image import binary_image, pitch_mm
from aadm_workbench.extract.published.edge_points import dbscan, edge_points
from aadm_workbench.extract.published.fusion import projected_onto
from aadm_workbench.extract.published.hough import hough_circles, votes_needed
from aadm_workbench.extract.published.pass_through import (
    face_range_mm,
    near_is_low,
    out_of_the_concrete,
    passed,
    tops_range_mm,
)
from aadm_workbench.extract.published.ransac_plane import ransac_plane
from aadm_workbench.extract.published.round_fits import ransac_circle, ransac_cylinder
from aadm_workbench.model import Array, Plane, Scan


def at_depths(*layers: tuple[float, float, int]) -> Array:
    """Points at x = y = 0 whose z is spread evenly over layers (low, high, count)."""
    z = np.concatenate([np.linspace(low, high, count) for low, high, count in layers])
    return np.column_stack([np.zeros((len(z), 2)), z])


def test_face_range_holds_the_face_and_not_what_lies_behind() -> None:
    low, high = face_range_mm(at_depths((990.0, 1010.0, 50_000), (1012.0, 1300.0, 2_000), (1600.0, 1605.0, 9_000)))
    assert 980.0 < low < 990.0
    assert 1010.0 < high < 1025.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_tops_range_holds_the_tops_and_not_the_floor(sign: float) -> None:
    tops = [(795.0 + 4.0 * k, 796.5 + 4.0 * k, 1000) for k in range(6)]
    points = sign * at_depths(*tops, (800.0, 930.0, 3_000), (900.0, 950.0, 300_000))
    viewpoint = None if sign < 0 else np.zeros(3)
    low, high = sorted(abs(z) for z in tops_range_mm(points, viewpoint, 1000.0))
    assert 785.0 < low < 795.0
    assert 816.5 < high < 825.0


def test_tops_range_without_a_floor_keeps_all_tops() -> None:
    low, high = tops_range_mm(at_depths((795.0, 796.5, 1000), (805.0, 806.5, 1000)), np.zeros(3), 1000.0)
    assert low < 795.0
    assert high >= 806.5


def test_one_stray_point_before_the_tops_moves_nothing() -> None:
    clean = at_depths((800.0, 802.0, 1000), (900.0, 905.0, 100_000))
    strayed = np.vstack([clean, [[0.0, 0.0, 400.0]]])
    assert tops_range_mm(strayed, np.zeros(3), 1000.0) == pytest.approx(
        tops_range_mm(clean, np.zeros(3), 1000.0), abs=2
    )


def test_near_side_is_the_viewpoint_s_else_the_side_of_what_stands_out() -> None:
    z = at_depths((100.0, 101.0, 1000), (220.0, 221.0, 99_000))[:, 2]
    assert near_is_low(z, np.zeros(3))
    assert not near_is_low(z, np.array([0.0, 0.0, 900.0]))
    assert near_is_low(z, None)
    assert not near_is_low(-z, None)


def test_pass_through_keeps_its_ends() -> None:
    assert passed(at_depths((1.0, 5.0, 5)), (2.0, 4.0))[:, 2].tolist() == [2.0, 3.0, 4.0]


def test_projection_is_equation_1() -> None:
    rng = np.random.default_rng(1)
    a, b, c, d = 0.3, -0.2, 0.9, -70.0
    points = rng.uniform(-50.0, 50.0, (20, 3))
    published = points - ((points @ [a, b, c] + d) / (a * a + b * b + c * c))[:, None] * np.array([a, b, c])
    length = np.linalg.norm([a, b, c])
    assert np.allclose(projected_onto(points, Plane(np.array([a, b, c]) / length, -d / length)), published, atol=1e-9)


def test_ransac_plane_with_50_mm_takes_the_walls_in_and_a_tight_one_does_not() -> None:
    rng = np.random.default_rng(2)
    face = np.column_stack([rng.uniform(-150.0, 150.0, (40_000, 2)), np.full(40_000, 900.0)])
    wall = np.column_stack([np.full(2_000, 100.0), rng.uniform(-150.0, 150.0, 2_000), rng.uniform(900.0, 945.0, 2_000)])
    points = np.vstack([face, wall])
    wide = ransac_plane(open3d, points, 50.0, 500, np.random.default_rng(3))
    tight = ransac_plane(open3d, points, 2.0, 500, np.random.default_rng(3))
    assert wide is not None
    assert tight is not None
    at = np.array([[100.0, 0.0, 900.0]])
    assert abs(float(wide.height(at)[0])) > 1.0
    assert abs(float(tight.height(at)[0])) < 0.1


def test_ransac_plane_of_two_points_is_none() -> None:
    assert ransac_plane(open3d, np.zeros((2, 3)), 50.0, 500, np.random.default_rng(0)) is None


def test_binary_image_marks_each_point_where_it_says() -> None:
    xy = np.array([[0.0, 0.0], [10.0, 4.0], [3.2, 1.9]])
    image = binary_image(xy, 0.5, 6.0)
    rows, columns = np.nonzero(image.filled)
    marked = image.millimetres(np.column_stack([columns, rows]).astype(np.float64))
    distance = np.hypot(*(marked[:, None] - xy[None]).transpose(2, 0, 1))
    assert len(marked) == 3
    assert (distance.min(axis=0) <= 0.5 * np.sqrt(0.5) + 1e-9).all()
    assert set(np.unique(image.filled)) == {0, 255}


def test_binary_image_of_a_huge_range_gets_larger_pixels() -> None:
    assert binary_image(np.array([[0.0, 0.0], [1e5, 1e5]]), 0.5, 1.0).filled.size < 5e7


def test_pitch_of_a_grid_and_of_a_cloud() -> None:
    grid = np.zeros((60, 80, 3))
    grid[..., 1], grid[..., 0] = np.mgrid[:60, :80] * 0.4
    grid[..., 2] = 500.0
    grid[10:20, 10:20] = np.nan
    assert pitch_mm(Scan(grid), (490.0, 510.0), 10.0) == pytest.approx(0.4)
    assert pitch_mm(Scan(grid[~np.isnan(grid[..., 2])]), None, 10.0) == pytest.approx(0.4, rel=0.1)
    assert pitch_mm(Scan(grid), (600.0, 700.0), 10.0) is None
    assert pitch_mm(Scan(np.empty((0, 3))), None, 10.0) is None


def test_thirty_votes_are_asked_where_they_can_be_had() -> None:
    assert votes_needed(200.0) == 30
    assert votes_needed(5.0) == 10
    assert 10 < votes_needed(80.0) < 30


def test_hough_finds_a_hole_and_a_disc_to_a_pixel_without_a_common_shift() -> None:
    rng = np.random.default_rng(4)
    rows, columns = np.mgrid[:140, :140]
    errors = []
    for k in range(60):
        centre = rng.uniform(60.0, 80.0, 2)
        inside = np.hypot(columns - centre[0], rows - centre[1]) < 25.0
        image = np.where(inside == (k % 2 == 0), 0, 255).astype(np.uint8)
        found, radii = hough_circles(image, (21.0, 29.0), votes_needed(25.0))
        assert len(found) == 1
        assert radii[0] == pytest.approx(25.0, abs=2.5)
        errors.append(found[0] - centre)
    assert np.hypot(*np.array(errors).T).mean() < 1.2
    assert np.abs(np.mean(errors, axis=0)).max() < 0.4  # half a pixel would be a convention taken wrongly


def test_hough_finds_nothing_of_another_size() -> None:
    rows, columns = np.mgrid[:140, :140]
    image = np.where(np.hypot(columns - 70, rows - 70) < 12.0, 0, 255).astype(np.uint8)
    assert len(hough_circles(image, (21.0, 29.0), 10)[0]) == 0


def test_edge_points_are_those_around_the_hole_and_the_border() -> None:
    xy = np.stack(np.meshgrid(np.arange(0.0, 60.0, 0.5), np.arange(0.0, 60.0, 0.5)), axis=-1).reshape(-1, 2)
    radius = np.hypot(*(xy - 30.0).T)
    lost = np.random.default_rng(5).random(len(xy)) < 0.01
    xy = xy[(radius > 13.0) & ~lost]
    edge = xy[edge_points(xy, 0.5)]
    from_hole = np.hypot(*(edge - 30.0).T) - 13.0
    from_border = np.minimum(edge.min(axis=1), (59.5 - edge).min(axis=1))
    stray = np.minimum(from_hole, from_border) > 1.0
    turns = np.unique(np.floor(np.degrees(np.arctan2(*(edge[from_hole < 1.0] - 30.0).T)) / 10.0))
    assert stray.mean() < 0.02
    assert len(turns) == 36
    assert len(edge_points(np.empty((0, 2)), 0.5)) == 0


def ring(centre: Array, radius: float, turns: Array) -> Array:
    return np.asarray(centre + radius * np.column_stack([np.cos(turns), np.sin(turns)]))


def test_circle_through_an_arc_with_many_outliers_is_exact() -> None:
    rng = np.random.default_rng(6)
    arc = ring(np.array([3.0, -7.0]), 13.2, rng.uniform(0.0, 4.0, 120))
    fit = ransac_circle(np.vstack([arc, rng.uniform(-25.0, 25.0, (60, 2))]), 13.0, 0.02, rng)
    assert fit is not None
    assert np.allclose(fit.centre, [3.0, -7.0], atol=0.01)
    assert fit.radius_mm == pytest.approx(13.2, abs=0.01)
    assert fit.inliers[:120].all()


def test_circle_of_another_size_is_none() -> None:
    rng = np.random.default_rng(7)
    assert ransac_circle(ring(np.zeros(2), 20.0, rng.uniform(0.0, 6.0, 200)), 13.0, 0.05, rng) is None
    assert ransac_circle(np.zeros((2, 2)), 13.0, 0.05, rng) is None


def test_leaning_cylinder_is_exact_and_held_upright_it_is_not() -> None:
    rng = np.random.default_rng(8)
    height, lean = rng.uniform(-100.0, 0.0, 800), np.array([0.01, -0.006])
    xy = ring(np.zeros(2), 9.1, rng.uniform(0.0, 3.5, 800)) + height[:, None] * lean + [2.0, 5.0]
    local = np.column_stack([xy, height])
    free = ransac_cylinder(local, 9.0, 0.6, True, rng)
    held = ransac_cylinder(local, 9.0, 0.6, False, rng)
    assert free is not None
    assert held is not None
    assert np.allclose([*free.centre, *free.lean], [2.0, 5.0, *lean], atol=1e-6)
    assert np.hypot(*(held.centre - [2.0, 5.0])) > 0.1


def test_clusters_leave_noise_and_crumbs_out() -> None:
    rng = np.random.default_rng(9)
    lumps = [rng.uniform(-2.0, 2.0, (count, 3)) + at for count, at in ((200, 0.0), (300, 60.0), (20, 120.0))]
    points = np.vstack([*lumps, [[500.0, 0.0, 0.0]]])
    clusters = dbscan(open3d, points, 2.5, 4, 100)
    assert [len(cluster) for cluster in clusters] == [200, 300]
    assert set(clusters[1]) == set(range(200, 500))
    assert dbscan(open3d, points[:2], 2.5, 4, 1) == []


def test_face_of_a_cloud_without_viewpoint_looks_away_from_its_walls() -> None:
    rng = np.random.default_rng(10)
    wall = np.column_stack([ring(np.zeros(2), 13.0, rng.uniform(0.0, 6.3, 300)), rng.uniform(0.0, 60.0, 300)])
    plane, centre = Plane(np.array([0.0, 0.0, 1.0]), 0.0), np.zeros((1, 3))
    assert out_of_the_concrete(plane, Scan(wall), wall, centre, 13.0).normal[2] == -1.0
    assert out_of_the_concrete(plane, Scan(-wall), -wall, centre, 13.0).normal[2] == 1.0
    eye = np.array([0.0, 0.0, 500.0])
    assert out_of_the_concrete(plane, Scan(wall, viewpoint=eye), wall, centre, 13.0).normal[2] == 1.0
