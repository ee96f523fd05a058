"""The statistics that benchmarks/verdict.py prints, in small: bounds that hold for any seed, and fixed seeds."""

import numpy as np
import pytest

from aadm_workbench.model import RepairAction, Verdict
from benchmarks.matching import best_worth, matched_margins, worth_of
from benchmarks.periodic import periodic_views
from benchmarks.verdict import (
    FIELD,
    LAB,
    Guarded,
    feasibility,
    guarded_points,
    guarded_trials,
    least_squares,
    like_the_paper,
    turned_rings,
)


def test_minimax_rejects_nothing_feasible_and_accepts_nothing_infeasible() -> None:
    found = feasibility(300, np.random.default_rng(11))
    assert 100 < found.feasible < 200
    assert (found.rejected_though_feasible, found.accepted_though_infeasible) == (0, 0)
    assert found.error_mm < 1e-9


def test_least_squares_would_refuse_one_good_column_in_four() -> None:
    found = least_squares(300, np.random.default_rng(12))
    assert found.good > 270
    # 24 % with a standard deviation of 2.5 % for so many columns.
    assert found.share_refused == pytest.approx(0.24, abs=0.07)


def seldom_wrong(found: Guarded) -> None:
    assert found.bad_that_pass <= 0.05
    assert found.good_that_fail <= 0.05
    assert found.inconclusive_far_off <= 0.02


@pytest.mark.parametrize("limit_mm", [2.0, 3.0])
def test_guarded_verdicts_on_points_are_seldom_wrong_and_mostly_decided(limit_mm: float) -> None:
    found = guarded_points(3000, np.random.default_rng(13), limit_mm=limit_mm)
    seldom_wrong(found)
    assert found.decided >= 0.6


def test_guarded_trials_are_seldom_wrong_and_mostly_decided() -> None:
    found = guarded_trials(80, np.random.default_rng(14), samples=400)
    seldom_wrong(found)
    assert found.decided >= 0.6
    hard = guarded_trials(80, np.random.default_rng(15), scatter_mm=1.6, samples=400)
    assert 20 < hard.good < 60, "both kinds are among them"
    seldom_wrong(hard)


def test_a_square_ring_without_up_is_never_labelled_with_false_confidence() -> None:
    found = turned_rings(60, np.random.default_rng(16))
    assert found["wrong"] == 0
    assert found["ambiguous"] >= 57


def test_assignments_equal_the_search_of_all_of_them() -> None:
    found = matched_margins(1500, np.random.default_rng(17))
    assert (found.matrices, found.worse) == (1500, 0)
    # The search itself: one column that goes on is worth more than any sum, and gaps place nobody.
    margins = np.array([[0.1, np.nan], [9.0, -0.2]])
    assert best_worth(margins) == (1, 9.0, 9.0)
    assert worth_of(margins, [(0, 0), (1, 1)]) < best_worth(margins)


def test_parts_of_rows_are_right_or_ambiguous() -> None:
    found = periodic_views(25, np.random.default_rng(18))
    assert found["wrong"] == 0
    assert found["right"] > 2
    assert found["ambiguous"] > 5


@pytest.mark.parametrize("seed", range(4))
def test_the_laboratory_columns_of_the_paper_go_on(seed: int) -> None:
    """Its Fig. 14: at most 2.39 mm, 1.23 mm in the mean, standard deviation 0.53 mm."""
    trial, repair = like_the_paper(2.39, 1.23, 0.53, LAB, 26.0, np.random.default_rng(seed))
    assert trial.least_squares is not None
    numbers = trial.least_squares.max_mm, trial.least_squares.mean_mm, trial.least_squares.sd_mm
    assert numbers == pytest.approx((2.39, 1.23, 0.53), abs=1e-6)
    assert trial.verdict is Verdict.PASS
    assert repair is None


@pytest.mark.parametrize("seed", range(4))
def test_the_field_column_of_the_paper_fails_and_gets_a_plan(seed: int) -> None:
    """Its Fig. 28: at most 13.93 mm, 8.34 mm in the mean, standard deviation 4.16 mm: manual correction is needed."""
    trial, repair = like_the_paper(13.93, 8.34, 4.16, FIELD, 36.0, np.random.default_rng(seed))
    assert trial.least_squares is not None
    numbers = trial.least_squares.max_mm, trial.least_squares.mean_mm, trial.least_squares.sd_mm
    assert numbers == pytest.approx((13.93, 8.34, 4.16), abs=1e-6)
    assert trial.verdict is Verdict.FAIL
    assert repair is not None
    assert repair.action is RepairAction.DISPOSAL_PLAN
    assert "特殊处理方案" in repair.advice
    assert repair.steps
