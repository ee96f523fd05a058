"""The single techniques on data whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from aadm_workbench.extract.bracket import crossings, outlined
from aadm_workbench.extract.circle import circle_through, outline
from aadm_workbench.extract.edge_law import BracketLaw, RimLaw
from aadm_workbench.extract.holes import find_discs, rastered
from aadm_workbench.extract.plane import facing, find_plane, find_planes, from_plane, in_plane
from aadm_workbench.model import Plane


def rng() -> np.random.Generator:
    return np.random.default_rng(42)


def plane_points(normal: np.ndarray, offset: float, count: int, noise_mm: float) -> np.ndarray:
    local = np.column_stack([rng().uniform(-300, 300, (count, 2)), rng().normal(0, noise_mm, count)])
    return from_plane(local, Plane(normal, offset))


def test_plane_is_found_among_outliers() -> None:
    normal = np.array([0.1, -0.2, 1.0]) / np.linalg.norm([0.1, -0.2, 1.0])
    points = np.vstack([plane_points(normal, 800.0, 6000, 0.1), rng().uniform(-400, 1200, (6000, 3))])
    plane = find_plane(points, rng())
    assert plane is not None
    assert abs(plane.normal @ normal) > np.cos(2e-4)
    assert abs(plane.offset) == pytest.approx(800.0, abs=0.05)
    assert plane.residual_mm == pytest.approx(0.1, rel=0.2)


def test_bores_behind_a_face_do_not_pull_its_plane() -> None:
    """A 50 mm band would take in the walls (0.2 to 0.8 mm of bias); a 1 mm band leaves them out."""
    face = plane_points(np.array([0.0, 0.0, 1.0]), 0.0, 20000, 0.05)
    wall = np.column_stack([rng().uniform(0, 300, (4000, 2)), -rng().uniform(2.0, 60.0, 4000)])
    plane = find_plane(np.vstack([face, wall]), rng())
    assert plane is not None
    assert abs(plane.height(np.array([[150.0, 150.0, 0.0]]))[0]) < 0.02


def test_planes_come_largest_first() -> None:
    big = plane_points(np.array([0.0, 0.0, 1.0]), 500.0, 8000, 0.1)
    small = plane_points(np.array([0.0, 0.0, 1.0]), 420.0, 3000, 0.1)
    offsets = [abs(plane.offset) for plane in find_planes(np.vstack([small, big]), rng(), 2)]
    assert offsets == pytest.approx([500.0, 420.0], abs=0.2)


def test_too_few_points_make_no_plane() -> None:
    assert find_plane(np.zeros((10, 3)), rng()) is None
    assert find_plane(np.zeros((500, 3)), rng()) is None


def test_facing_turns_the_normal_to_the_viewer() -> None:
    plane = facing(Plane(np.array([0.0, 0.0, 1.0]), 900.0), np.zeros(3))
    assert plane.normal[2] == -1.0
    assert plane.offset == -900.0


def test_plane_coordinates_go_there_and_back() -> None:
    plane = Plane(np.array([0.6, 0.0, 0.8]), 12.0)
    points = rng().uniform(-9, 9, (50, 3))
    assert np.allclose(from_plane(in_plane(points, plane), plane), points)


def test_circle_with_a_sixth_of_its_points_elsewhere() -> None:
    angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    xy = np.column_stack([3 + 18 * np.cos(angle), -5 + 18 * np.sin(angle)])
    xy[:20] += np.array([6.0, 4.0])
    centre, radius = circle_through(xy, np.array([4.0, -4.0]), 17.0)
    assert centre == pytest.approx([3.0, -5.0], abs=0.15)
    assert radius == pytest.approx(18.0, abs=0.15)


def test_outline_takes_the_innermost_of_each_bin() -> None:
    xy = np.array([[2.0, 0.01], [1.0, 0.01], [0.0, 3.0]])
    ring = outline(xy, np.zeros(2), 4, innermost=True)
    assert sorted(ring.index.tolist()) == [1, 2]
    assert ring.coverage == 0.5


def test_discs_and_holes_are_found_on_a_raster() -> None:
    grid = np.stack(np.meshgrid(np.arange(0, 200, 0.7), np.arange(0, 150, 0.7)), -1).reshape(-1, 2)
    hole = np.hypot(*(grid - [60, 70]).T) < 13
    centres, _ = find_discs(rastered(grid[~hole], 1.0, 40.0), 13.0, holes=True)
    assert centres == pytest.approx(np.array([[60.0, 70.0]]), abs=1.0)
    centres, _ = find_discs(rastered(grid[hole], 1.0, 40.0), 13.0, holes=False)
    assert centres == pytest.approx(np.array([[60.0, 70.0]]), abs=1.0)


def test_crossings_lie_where_the_ray_meets_the_plane() -> None:
    plane = Plane(np.array([0.0, 0.0, 1.0]), 0.0)
    crossed = crossings(np.array([[30.0, 0.0, -100.0]]), np.array([0.0, 0.0, 200.0]), plane)
    assert crossed[0] == pytest.approx([20.0, 0.0, 0.0])


def test_an_outline_keeps_what_is_next_to_the_edge_on_either_side() -> None:
    angle = np.linspace(0, 2 * np.pi, 36, endpoint=False) + 0.01
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    face, gap = np.vstack([10.2 * ring, 10.9 * ring]), np.vstack([9.8 * ring, 7.0 * ring])
    shape = outlined(face, gap, np.zeros(2), np.ones(36, bool), hole=True)
    assert np.hypot(*shape.rim.T) == pytest.approx(np.full(36, 10.2))
    assert np.hypot(*shape.beyond.T) == pytest.approx(np.full(36, 9.8))
    half = outlined(face, np.empty((0, 2)), np.zeros(2), np.arange(36) < 18, hole=True)
    assert (len(half.rim), len(half.beyond)) == (18, 0)


@pytest.mark.parametrize("law", [RimLaw(0.5, 1.5, 0.1), BracketLaw(0.1, 0.3)])
def test_slope_is_the_derivative_of_the_cost(law: RimLaw | BracketLaw) -> None:
    at = np.linspace(-2.0, 2.0, 400)
    numeric = np.gradient(law.cost(at), at)
    assert np.corrcoef(numeric, law.slope(at))[0, 1] > 0.99


def test_lost_pixels_move_the_tail_of_a_rim_and_not_its_flank() -> None:
    """With half of the first pixels lost the likeliest edge stays within a tenth of a pixel."""
    law, edge = RimLaw(0.5, 3.0, 0.05), np.linspace(-0.6, 0.6, 121)
    whole = rng().uniform(0.0, 0.5, 400)
    lossy = np.where(rng().random(400) < 0.5, whole, whole + 0.5)
    for behind in (whole, lossy):
        best = edge[np.argmin([law.cost(behind - shift).sum() for shift in edge])]
        assert best == pytest.approx(0.0, abs=0.06)
