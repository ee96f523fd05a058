"""What a pose of the smallest largest distance may be off by, against poses of the true points."""

import numpy as np
import pytest

from aadm_workbench.assembly.pose.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.pose.minimax_spread import minimax_covariance

ROUND = {
    count: np.column_stack([np.cos(a), np.sin(a)]) for count in (4, 8, 12) for a in [np.arange(count) / count * 6.2832]
}
WITHIN_95 = 7.815  # of chi-squared with three degrees of freedom


def minimax(source: np.ndarray, target: np.ndarray) -> MinimaxPose:
    found = fit_minimax(source, target, np.full(len(source), 3.0))
    assert isinstance(found, MinimaxPose)
    return found


@pytest.mark.parametrize("count", ROUND)
def test_true_poses_lie_in_the_regions_that_are_stated(count: int) -> None:
    rng = np.random.default_rng(count)
    source, held = 110.0 * ROUND[count], 0
    covariance = 0.05**2 * np.eye(2 * count) + 0.05**2 * np.kron(np.ones((count, count)), np.eye(2))
    for _ in range(200):
        true = source + rng.normal(0.0, 0.35, source.shape) + rng.normal(0.0, 5.0, 2)
        seen = true + rng.normal(0.0, 0.05, source.shape) + rng.normal(0.0, 0.05, 2)
        pose, best = minimax(source, seen), minimax(source, true)
        spread = minimax_covariance(source, seen, covariance, pose, np.random.default_rng(0))
        off = np.array([*(pose.shift - best.shift), pose.yaw - best.yaw])
        held += int(off @ np.linalg.solve(spread, off) < WITHIN_95)
    assert 180 <= held <= 198


def test_unlike_limits_leave_regions_of_their_own() -> None:
    source, limits_mm = 110.0 * ROUND[8], np.array([3.0, 3.0, 3.0, 6.0, 3.0, 30.0, 3.0, 3.0])
    rng, held = np.random.default_rng(3), 0
    u_mm = np.where(limits_mm > 10.0, 0.5, 0.08)
    covariance = np.diag(np.repeat(u_mm**2, 2))
    for _ in range(150):
        true = source + rng.normal(0.0, 0.35, source.shape)
        seen = true + rng.normal(0.0, 1.0, source.shape) * u_mm[:, None]
        pose, best = (fit_minimax(source, target, limits_mm) for target in (seen, true))
        assert isinstance(pose, MinimaxPose)
        assert isinstance(best, MinimaxPose)
        spread = minimax_covariance(source, seen, covariance, pose, np.random.default_rng(0), limits_mm)
        off = np.array([*(pose.shift - best.shift), pose.yaw - best.yaw])
        held += int(off @ np.linalg.solve(spread, off) < WITHIN_95)
    assert 134 <= held <= 149


def test_points_known_exactly_leave_nothing_unsure() -> None:
    source = 100.0 * ROUND[8]
    target = source + np.random.default_rng(1).normal(0.0, 0.3, source.shape)
    pose = minimax(source, target)
    spread = minimax_covariance(source, target, np.zeros((16, 16)), pose, np.random.default_rng(0))
    assert np.abs(spread).max() < 0.01**2
