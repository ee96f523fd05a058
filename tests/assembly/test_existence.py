"""The probability that a pose exists, against a closed form and against single minimax fits."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.existence import pose_exists, probability_of_a_pose
from aadm_workbench.assembly.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.pairs import form_pairs
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial import try_assembly
from aadm_workbench.assembly.upright import turn
from aadm_workbench.model import Array, Verdict

CN = load_profile("cn")


def test_probability_of_a_pose_of_two_opposite_pairs_has_a_closed_form(build: Any) -> None:
    """Two pairs fit where the distances of bars and of sleeves differ by at most twice the limit."""
    centres = np.array([[-300.0, 0.0, 0.0], [300.0, 0.0, 0.0]])
    design = build.column(centres)
    bars = np.array([[-2.8, 0.0], [2.8, 0.0]])
    pairs, _ = form_pairs(
        design, build.moved(design.sleeves, 0 * bars, 0.15), build.moved(design.rebars, bars, 0.15), (0, 1)
    )
    fit = fit_minimax(centres[:, :2] + bars, centres[:, :2], np.full(2, 3.0))
    assert isinstance(fit, MinimaxPose)
    found = probability_of_a_pose(pairs, np.full(2, 3.0), fit.yaw, fit.shift, np.random.default_rng(1), 20_000)
    draws = 5.6 + np.random.default_rng(2).normal(0.0, 0.15 * 2.0, 1_000_000)
    assert found == pytest.approx((draws <= 6.0).mean(), abs=0.01)


def test_probability_equals_that_of_single_minimax_fits(build: Any, square: Array) -> None:
    """Each draw decided by itself, by the full minimax fit: the shortcut must decide alike in every one."""
    design = build.column(square)
    bars = np.random.default_rng(5).normal(0.0, 1.25, (12, 2))
    pairs, _ = form_pairs(
        design, build.moved(design.sleeves, 0 * bars, 0.2), build.moved(design.rebars, bars, 0.2), range(12)
    )
    source, target = square[:, :2] + bars, square[:, :2]
    fit = fit_minimax(source, target, np.full(12, 3.0))
    assert isinstance(fit, MinimaxPose)
    limits = np.full(12, 3.0 * fit.ratio)
    found = probability_of_a_pose(pairs, limits, fit.yaw, fit.shift, np.random.default_rng(6), 100)
    noise = np.sqrt(0.08) * np.random.default_rng(6).standard_normal((100, 12, 2))
    decided = [fit_minimax(source + turn(-fit.yaw).dot(draw.T).T, target, limits) for draw in noise]
    expected = np.mean([pose.ratio <= 1.0 for pose in decided if isinstance(pose, MinimaxPose)])
    assert found == pytest.approx(expected, abs=1e-12)
    assert 0.05 < expected < 0.95


def test_clearances_are_limits_of_the_pose_as_well(build: Any, square: Array) -> None:
    """One tight sleeve: the minimax pose touches, a pose a little aside does not, and the report says both."""
    design = build.column(square, sleeve_mm=36.0)
    tight = list(design.sleeves)
    tight[6] = replace(tight[6], diameter_mm=25.5)
    design = replace(design, sleeves=tuple(tight))
    bars = np.zeros((12, 2))
    bars[6] = [2.4, 0.0]
    sleeves, rebars = build.moved(design.sleeves, 0 * bars), build.moved(design.rebars, bars)
    report = try_assembly(design, sleeves, rebars, CN, np.random.default_rng(0))
    assert report.collisions == ("S7",)
    assert report.verdict is Verdict.FAIL
    assert any("another pose within the limits is free of collisions" in note for note in report.notes)
    pairs, _ = form_pairs(design, sleeves, rebars, range(12))
    assert report.minimax is not None
    T = report.minimax.T_sleeves_rebars
    yaw, shift = float(np.arctan2(T[1, 0], T[0, 0])), T[:2, 3]
    assert pose_exists(pairs, np.full(12, 3.0), yaw, shift)
    assert not pose_exists(pairs, np.full(12, 1.2), yaw, shift)
