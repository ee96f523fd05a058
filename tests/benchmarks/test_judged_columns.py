"""Whole columns against a truth from a linear program, in small: rates, stated probabilities, followed advice."""

import numpy as np
import pytest

from benchmarks.columns import SCENES, Scene, build_columns, true_margin_mm
from benchmarks.judged_columns import judged_columns, repaired_columns
from benchmarks.smooth_margin import margins_mm
from benchmarks.verdict import FIELD

BY_NAME = {scene.name: scene for scene in SCENES}


def test_the_truth_itself_is_known_where_it_has_a_closed_form() -> None:
    """Opposite bars 4 mm further apart than their sleeves keep 1 mm of 3; one of 5 mm between good ones none."""
    sleeves = np.array([[-240.0, 0.0], [240.0, 0.0]])
    apart = sleeves + np.array([[-2.0, 0.0], [2.0, 0.0]])
    assert true_margin_mm(apart, sleeves, np.full(2, 3.0)) == pytest.approx(1.0, abs=0.005)
    # A turn of all does no harm, a stretch of the pattern does.
    turned = FIELD @ np.array([[1.0, 1e-4], [-1e-4, 1.0]])
    assert true_margin_mm(turned, FIELD, np.full(12, 3.0)) == pytest.approx(3.0, abs=0.005)
    assert true_margin_mm(FIELD * 1.01, FIELD, np.full(12, 3.0)) == pytest.approx(3.0 - 2.4 * np.sqrt(2.0), abs=0.01)


def test_both_ways_to_the_truth_agree() -> None:
    """Newton's on a smooth maximum, and a linear program of polygons that lie around the discs by 0.05 %."""
    rng = np.random.default_rng(1)
    source = FIELD + rng.normal(0.0, 1.5, (6, 12, 2))
    limits = rng.uniform(1.5, 3.5, (6, 12))
    smooth = margins_mm(source, np.broadcast_to(FIELD, source.shape), limits)
    for k in range(6):
        by_polygons = true_margin_mm(source[k], FIELD, limits[k])
        assert -1e-4 < by_polygons - smooth[k] < 0.003


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_no_verdict_is_wrong_with_certainty(scene: Scene) -> None:
    """Too few cases for rates of half a percent: more than one wrong one of these would be far beyond them."""
    found = judged_columns(scene, 20, np.random.default_rng(11))
    infeasible = found.cases - found.feasible
    assert min(found.feasible, infeasible) > 3
    assert found.false_passes * infeasible <= 1.0
    assert found.false_fails * found.feasible <= 1.0
    assert all(abs(one.sigmas) < 4.0 for one in found.bins)
    if scene.u_worse_mm is None and not scene.missing:
        assert found.undecided_far_off <= 0.15
    else:
        assert found.passes == 0


def test_half_of_what_is_stated_to_be_open_is_feasible() -> None:
    """All stated probabilities together: their sum is the number of feasible columns, within three deviations."""
    found = judged_columns(BY_NAME["28/20"], 60, np.random.default_rng(3))
    stated = sum(one.cases * one.stated for one in found.bins)
    variance = sum(one.cases * one.stated * (1.0 - one.stated) for one in found.bins)
    assert abs(stated - found.feasible) < 3.0 * np.sqrt(variance + 1.0)


@pytest.mark.parametrize("name", ["36/20", "28/20"])
def test_advice_that_is_followed_helps(name: str) -> None:
    found = repaired_columns(BY_NAME[name], 30, np.random.default_rng(5))
    assert found.failing > 4
    assert found.promised > 3
    assert found.kept == 1.0
    assert found.good_ones_bent == 0
    assert found.blamed > 0.95


def test_a_column_is_the_same_for_the_same_seed() -> None:
    first, second = (build_columns(SCENES[1], 5, np.random.default_rng(2)) for _ in range(2))
    assert [one.margin_mm for one in first] == [one.margin_mm for one in second]
    assert all(-1.55 < one.margin_mm < 1.55 for one in first)
