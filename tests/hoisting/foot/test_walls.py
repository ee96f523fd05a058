"""Far sleeves scatter more than near ones, and their points must not be weighed by what the near ones do."""

import numpy as np

from aadm_workbench.hoisting.foot.walls import own_spreads


def test_each_sleeve_has_its_own_spread() -> None:
    rng = np.random.default_rng(7)
    true_mm, counts = np.array([0.1, 0.2, 0.45]), np.array([180, 90, 40])
    ranges_mm = np.array([1100.0, 1800.0, 2600.0, 900.0])  # the last shows no wall
    owner = np.repeat(np.arange(3), counts)
    for _ in range(20):
        residual = rng.normal(0.0, true_mm[owner])
        residual[::31] += 4.0  # what flies does not count
        found = own_spreads(residual, owner, ranges_mm, 0.14)
        by_sleeve = np.array([found[owner == k][0] for k in range(3)])
        assert (np.abs(by_sleeve / true_mm - 1.0) < [0.3, 0.35, 0.5]).all()
        assert len(set(found)) == 3


def test_a_few_points_are_not_believed_alone() -> None:
    owner = np.array([0] * 100 + [1] * 6)
    residual = np.concatenate([np.tile([-0.1, 0.1], 50), np.full(6, 0.001)])
    found = own_spreads(residual, owner, np.array([1000.0, 1000.0]), 0.1)
    assert found[-1] > 0.08
