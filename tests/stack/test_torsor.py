"""Small displacements against exact rotation matrices, which know nothing of linearisation."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.stack.torsor import Torsor, carried_to, cross_matrix, in_plan, plumbed, seen_from

HEIGHT_MM = 3600.0
LINEAR_MM = 0.01


def exact(values: np.ndarray, point: np.ndarray) -> np.ndarray:
    """How far a point moves when the body is really turned."""
    return Rotation.from_rotvec(values[3:]).apply(point) + values[:3] - point


@pytest.mark.parametrize(
    "degrees",
    [(0.0, 0.0, 0.1), (0.0, 0.02, 0.0), (0.08, 0.0, 0.1), (0.05, -0.05, -0.1), (-0.03, 0.07, 0.2), (0.08, 0.08, 0.0)],
)
@pytest.mark.parametrize("aside", [(0.0, 0.0), (300.0, -300.0), (-300.0, 150.0)])
def test_linear_is_exact_to_a_hundredth(degrees: tuple[float, ...], aside: tuple[float, float]) -> None:
    values = np.array([2.0, -3.0, 1.0, *np.radians(degrees)])
    point = np.array([*aside, HEIGHT_MM])
    linear, _ = Torsor(values, np.zeros((6, 6))).at(point)
    assert np.abs(linear - exact(values, point)).max() <= LINEAR_MM


def test_what_is_linear_alone_is_noticed_at_ten_times_the_turn() -> None:
    values = np.array([0.0, 0.0, 0.0, *np.radians([0.8, 0.5, 1.0])])
    point = np.array([300.0, -300.0, HEIGHT_MM])
    linear, _ = Torsor(values, np.zeros((6, 6))).at(point)
    assert np.abs(linear - exact(values, point)).max() > 10.0 * LINEAR_MM


def test_a_lean_of_two_hundredths_of_a_degree_on_3600_mm() -> None:
    """By hand: 3600 · 0.02 · π / 180 = 1.2566."""
    values = np.array([-3.0, 2.0, 1.0, 0.0, np.radians(0.02), 0.0])
    moved, _ = Torsor(values, np.zeros((6, 6))).at(np.array([0.0, 0.0, HEIGHT_MM]))
    assert moved == pytest.approx([-3.0 + 1.2566, 2.0, 1.0], abs=1e-4)


def test_a_displacement_told_elsewhere_moves_points_alike() -> None:
    rng = np.random.default_rng(3)
    values, origin, point = rng.normal(size=6), rng.normal(size=3) * 100, rng.normal(size=3) * 100
    there = Torsor(values, np.eye(6)).through(carried_to(origin))
    here, _ = Torsor(values, np.eye(6)).at(point)
    assert there.at(point - origin)[0] == pytest.approx(here)


def test_a_displacement_seen_from_a_turned_frame() -> None:
    turn = Rotation.from_euler("zyx", [40.0, 10.0, -20.0], degrees=True).as_matrix()
    values, point = np.array([1.0, 2.0, 3.0, 0.01, -0.02, 0.03]), np.array([10.0, 20.0, 30.0])
    told = Torsor(values, np.eye(6)).through(seen_from(turn))
    assert told.at(turn @ point)[0] == pytest.approx(turn @ Torsor(values, np.eye(6)).at(point)[0])


def test_covariances_of_points_as_a_crowd_of_draws_has_them() -> None:
    rng = np.random.default_rng(5)
    half = rng.normal(size=(6, 6)) * np.array([1.0, 1.0, 1.0, 3e-4, 3e-4, 3e-4])[:, None]
    covariance, point = half @ half.T, np.array([300.0, 200.0, HEIGHT_MM])
    draws = rng.multivariate_normal(np.zeros(6), covariance, size=40_000)
    moved = draws[:, :3] + np.cross(draws[:, 3:], point)
    _, told = Torsor(np.zeros(6), covariance).at(point)
    assert np.cov(moved.T) == pytest.approx(told, rel=0.05, abs=0.05 * np.sqrt(np.trace(told)))


def test_braces_zero_the_tilt_and_nothing_else() -> None:
    assert np.array_equal(np.diag(plumbed()), [1, 1, 1, 0, 0, 1])


def test_cross_matrix_is_the_cross_product() -> None:
    assert cross_matrix(np.array([1.0, 2.0, 3.0])) @ [4.0, 5.0, 6.0] == pytest.approx(np.cross([1, 2, 3], [4, 5, 6]))


def test_in_plan_fills_the_three_of_six() -> None:
    torsor = in_plan(np.array([1.0, 2.0, 0.5]), np.diag([4.0, 9.0, 16.0]))
    assert torsor.values.tolist() == [1.0, 2.0, 0.0, 0.0, 0.0, 0.5]
    assert np.diag(torsor.covariance).tolist() == [4.0, 9.0, 0.0, 0.0, 0.0, 16.0]
