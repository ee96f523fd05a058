"""A hair's breadth of noise on a frame moves its pairs by a hair's breadth: no choice hangs on single points."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("open3d")
pytest.importorskip("manifold3d")

from aadm_workbench.hoisting.measure import measure_hoisting
from aadm_workbench.model import Array
from aadm_workbench.twin.scenes import LAB
from aadm_workbench.twin.study.hoisting import design_of
from tests import hoisting_scenes as scenes

ALIKE_MM, NOISE_MM, DRAWS = 0.05, 0.01, 5  # half as much again as was measured


def measured(depth: Array) -> tuple[Array, Array]:
    """Distances of all pairs, and the move."""
    scan = replace(scenes.usual().frame, depth=depth.astype(np.float32)).scan()
    report = measure_hoisting(scan, design_of(LAB), near=scenes.NEAR).report
    move = report.correction
    assert move is not None
    return np.array([pair.distance_mm for pair in report.pairs]), np.array([move.dx_mm, move.dy_mm])


def test_noise_of_a_hundredth_of_a_millimetre_moves_no_pair_by_more_than_a_twentieth() -> None:
    depth, rng = scenes.usual().frame.depth, np.random.default_rng(3)
    plain, move = measured(depth)
    for _ in range(DRAWS):
        noisy, other = measured(np.where(depth > 0, depth + rng.uniform(-NOISE_MM, NOISE_MM, depth.shape), 0.0))
        assert np.abs(noisy - plain).max() < ALIKE_MM
        assert np.abs(other - move).max() < ALIKE_MM
