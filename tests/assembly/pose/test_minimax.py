"""The minimax pose against an independent reference: a dense search of turn × smallest enclosing circle."""

import itertools

import numpy as np
import pytest

from aadm_workbench.assembly.pose.eopa import fit_eopa_planar, turn
from aadm_workbench.assembly.pose.minimax import MinimaxPose, find_window, fit_minimax
from aadm_workbench.errors import AadmError
from aadm_workbench.model import Array


def posed(source: Array, target: Array, limits: Array) -> MinimaxPose:
    fit = fit_minimax(source, target, limits)
    assert isinstance(fit, MinimaxPose), fit
    return fit


def smallest_ratio(points: Array, limits: Array) -> float:
    """Smallest largest |point − centre| / limit: the best centre among those that two or three points define.

    Two points share the line between them as their limits do; for three, with u the squared ratio, the differences
    of |c − p|² = u·limit² are linear in c and u, and one of the three is then quadratic in u.
    """
    i, j = np.array(list(itertools.combinations(range(len(points)), 2))).T
    centres = [(points[i] * limits[j, None] + points[j] * limits[i, None]) / (limits[i] + limits[j])[:, None]]
    i, j, k = np.array(list(itertools.combinations(range(len(points)), 3))).T
    A = 2.0 * np.stack([points[j] - points[i], points[k] - points[i]], axis=1)
    flat = np.abs(np.linalg.det(A)) < 1e-12
    A[flat] = np.eye(2)
    squares, permitted = (points**2).sum(axis=1), limits**2
    rest = np.stack([squares[j] - squares[i], squares[k] - squares[i]], axis=1)
    slope = -np.stack([permitted[j] - permitted[i], permitted[k] - permitted[i]], axis=1)
    a, b = (np.linalg.solve(A, v[:, :, None])[:, :, 0] for v in (rest, slope))
    away = a - points[i]
    p, q, r = (b**2).sum(axis=1), 2.0 * (b * away).sum(axis=1) - permitted[i], (away**2).sum(axis=1)
    root = np.sqrt(np.maximum(q**2 - 4.0 * p * r, 0.0))
    both = 2.0 * r / (-q + root), np.where(p > 1e-15, (-q + root) / (2.0 * np.maximum(p, 1e-15)), 0.0)
    centres += [(a + b * u[:, None])[~flat] for u in both]
    every = np.concatenate(centres)
    return float((np.linalg.norm(points[None] - every[:, None], axis=2) / limits).max(axis=1).min())


def searched(source: Array, target: Array, limits: Array) -> float:
    """Smallest largest ratio: a grid of turns about the least-squares one, then golden sections in the best cell."""
    fit = fit_eopa_planar(source, target)
    assert fit

    def value(angle: float) -> float:
        return smallest_ratio(target - source @ turn(angle).T, limits)

    grid = np.linspace(fit.yaw - 0.03, fit.yaw + 0.03, 31)
    lowest = int(np.argmin([value(angle) for angle in grid]))
    low, high = grid[max(lowest - 1, 0)], grid[min(lowest + 1, 30)]
    for _ in range(40):
        a, b = low + 0.381966 * (high - low), low + 0.618034 * (high - low)
        low, high = (low, b) if value(a) < value(b) else (a, high)
    return value(0.5 * (low + high))


def as_built(rng: np.random.Generator, source: Array, scatter_mm: float = 1.2) -> Array:
    return source @ turn(rng.uniform(-3.0, 3.0)).T + rng.uniform(-5, 5, 2) + rng.normal(0.0, scatter_mm, source.shape)


@pytest.mark.parametrize("seed", range(40))
def test_equals_the_dense_search(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 9))
    source = rng.uniform(-300.0, 300.0, (count, 2))
    target, limits = as_built(rng, source), np.full(count, 3.0)
    pose = posed(source, target, limits)
    if count == 2:
        lengths = [np.hypot(*(points[1] - points[0])) for points in (source, target)]
        expected = abs(lengths[0] - lengths[1]) / 2.0 / 3.0
    else:
        expected = searched(source, target, limits)
    assert 3.0 * pose.ratio == pytest.approx(3.0 * expected, abs=1e-6)
    assert 3.0 * (pose.ratio - pose.bound) < 1e-9
    np.testing.assert_allclose(source @ turn(pose.yaw).T + pose.shift - target, pose.offsets, atol=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_equals_the_dense_search_for_unlike_limits(seed: int) -> None:
    rng = np.random.default_rng(1000 + seed)
    source = rng.uniform(-300.0, 300.0, (5, 2))
    target, limits = as_built(rng, source), rng.uniform(1.0, 3.0, 5)
    pose = posed(source, target, limits)
    assert pose.ratio == pytest.approx(searched(source, target, limits), abs=1e-6)


@pytest.mark.parametrize("seed", range(30))
def test_no_pose_anywhere_is_better(seed: int, square: Array) -> None:
    """The certified bound against ten thousand random poses near and far."""
    rng = np.random.default_rng(seed)
    source = square[:, :2]
    target, limits = as_built(rng, source), rng.uniform(2.0, 3.0, 12)
    pose = posed(source, target, limits)
    assert pose.certified
    assert 0.0 <= pose.ratio - pose.bound < 1e-10
    spread = 10.0 ** rng.uniform(-5.0, 0.0, 10_000)
    yaw = pose.yaw + spread * rng.standard_normal(10_000) / 100.0
    shift = pose.shift + (spread * rng.standard_normal((2, 10_000))).T
    cosine, sine = np.cos(yaw)[:, None], np.sin(yaw)[:, None]
    x = cosine * source[:, 0] - sine * source[:, 1] + shift[:, :1] - target[:, 0]
    y = sine * source[:, 0] + cosine * source[:, 1] + shift[:, 1:] - target[:, 1]
    assert ((np.hypot(x, y) / limits).max(axis=1) >= pose.bound).all()
    least = fit_eopa_planar(source, target)
    assert least
    assert pose.ratio <= (np.hypot(*least.residuals.T) / limits).max()


def test_least_squares_turns_away_one_good_column_in_four(square: Array) -> None:
    """At 1.2 mm of scatter per axis of bar minus sleeve: the reason why minimax decides."""
    rng = np.random.default_rng(0)
    limits, good, refused = np.full(12, 3.0), 0, 0
    for _ in range(80):
        target = square[:, :2] + rng.normal(0.0, 1.2, (12, 2))
        if posed(square[:, :2], target, limits).ratio <= 1.0:
            good += 1
            least = fit_eopa_planar(square[:, :2], target)
            assert least
            refused += bool(np.hypot(*least.residuals.T).max() > 3.0)
    assert 0.15 < refused / good < 0.4


def test_perfect_match_and_known_answers() -> None:
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * 200.0
    pose = posed(corners, corners @ turn(0.3).T + 7.0, np.full(4, 3.0))
    assert pose.ratio < 1e-9
    assert pose.yaw == pytest.approx(0.3)
    # One bar of four 4 mm outwards along the diagonal: the best shift leaves half of it, the opposite corner the same.
    target = corners.copy()
    target[0] -= 4.0 / np.sqrt(2.0)
    pose = posed(target, corners, np.full(4, 2.0))
    assert 2.0 * pose.ratio == pytest.approx(2.0, abs=1e-9)
    assert pose.margin == pytest.approx(0.0, abs=1e-9)


def test_differences_as_large_as_the_pattern_try_other_turns() -> None:
    """No certificate holds there; still the best of many starts is at least as good as least squares."""
    rng = np.random.default_rng(9)
    source, target = rng.uniform(-30.0, 30.0, (6, 2)), rng.uniform(-30.0, 30.0, (6, 2))
    pose = posed(source, target, np.full(6, 3.0))
    grid = [
        smallest_ratio(target - source @ turn(angle).T, np.full(6, 3.0)) for angle in np.linspace(-np.pi, np.pi, 721)
    ]
    assert pose.ratio <= min(grid) + 1e-9


def test_what_cannot_be_posed() -> None:
    assert not fit_minimax(np.zeros((1, 2)), np.zeros((1, 2)), np.ones(1))
    assert not fit_minimax(np.zeros((3, 2)), np.ones((3, 2)), np.ones(3))
    with pytest.raises(AadmError, match="limit above zero"):
        fit_minimax(np.eye(2), np.eye(2), np.array([1.0, 0.0]))


@pytest.mark.parametrize("seed", range(8))
def test_ends_of_the_window_touch_the_limits(seed: int, square: Array) -> None:
    """At each end some pose exists, a hair further none: decided by search over the turn."""
    rng = np.random.default_rng(seed)
    target, limits = square[:, :2] + rng.normal(0.0, 0.8, (12, 2)), np.full(12, 3.0)
    pose = posed(square[:, :2], target, limits)
    placed = square[:, :2] @ turn(pose.yaw).T + pose.shift
    window = find_window(placed, target, limits)
    assert window is not None
    for yaw_deg, side in ((window.yaw_deg[0], -1.0), (window.yaw_deg[1], 1.0)):
        for further, inside in ((-1e-5, True), (1e-5, False)):
            turned = placed @ turn(np.radians(yaw_deg + side * further)).T
            assert (smallest_ratio(target - turned, limits) <= 1.0) is inside
    for axis, ends in enumerate((window.dx_mm, window.dy_mm)):
        for end, side in ((ends[0], -1.0), (ends[1], 1.0)):
            for further, inside in ((-1e-3, True), (1e-3, False)):
                assert reachable(placed, target, axis, end + side * further) is inside


def reachable(placed: Array, target: Array, axis: int, value: float) -> bool:
    """Whether some turn and some shift across meet 3 mm when the shift along one axis is given."""
    angles = np.linspace(-0.01, 0.01, 8001)
    cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
    moved = [cosine * placed[:, 0] - sine * placed[:, 1], sine * placed[:, 0] + cosine * placed[:, 1]]
    along = moved[axis] + value - target[:, axis]
    half = np.sqrt(np.maximum(9.0 - along**2, 0.0))
    across = target[:, 1 - axis] - moved[1 - axis]
    fits = (np.abs(along) <= 3.0).all(axis=1) & ((across - half).max(axis=1) <= (across + half).min(axis=1))
    return bool(fits.any())


def test_no_window_where_nothing_fits(square: Array) -> None:
    target = square[:, :2] * 1.02
    pose = posed(square[:, :2], target, np.full(12, 3.0))
    assert pose.margin < 0.0
    assert find_window(square[:, :2] @ turn(pose.yaw).T + pose.shift, target, np.full(12, 3.0)) is None
