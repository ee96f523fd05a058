"""Mould drift told apart from scatter: false alarms, detection, intervals, by simulated batches with known truth."""

import numpy as np
import pytest

from aadm_workbench.assembly.mould.drift import (
    SharedDisplacement,
    cp_index,
    cpk_index,
    f_exceeded,
    holm,
    shared_displacement,
    t_quantile,
)
from aadm_workbench.assembly.pose.eopa import EopaFit, fit_eopa_planar
from aadm_workbench.model import Array

NO_DRIFT = np.zeros((12, 2))


def batch(
    square: Array,
    rng: np.random.Generator,
    columns: int,
    drift: Array,
    loose: tuple[int, ...] = (),
    missing: tuple[tuple[int, int], ...] = (),
) -> SharedDisplacement:
    """Columns of one mould, each fitted to the design; scatter 0.4 mm per axis, of loose sleeves three times that."""
    design = square[:, :2]
    scatter = np.full((12, 1), 0.4)
    scatter[list(loose)] *= 3.0
    offsets, measured = np.zeros((columns, 12, 2)), np.ones((columns, 12), dtype=bool)
    for place in missing:
        measured[place] = False
    for column in range(columns):
        seen = measured[column]
        built = (design + drift + scatter * rng.normal(size=(12, 2)))[seen]
        fit = fit_eopa_planar(built, design[seen])
        assert isinstance(fit, EopaFit)
        offsets[column, seen] = built @ fit.R + fit.t - design[seen]
    return shared_displacement(offsets, measured, design)


@pytest.mark.parametrize(("columns", "loose"), [(3, ()), (6, ()), (6, (4,))])
def test_false_alarms_are_rare_over_all_sleeves_together(columns: int, loose: tuple[int, ...], square: Array) -> None:
    rng = np.random.default_rng(1)
    found = [batch(square, rng, columns, NO_DRIFT, loose) for _ in range(200)]
    # At a true rate of 5 % more than 19 of 200 come up once in 300 runs; without Holm it would be 90.
    assert sum(result.drifts.any() for result in found) <= 19
    if not loose:
        assert sum(result.scatters_more.any() for result in found) <= 19
        assert sum(result.p_value < 0.05 for result in found) <= 19


def test_a_sleeve_that_the_mould_displaces_is_found_and_no_other(square: Array) -> None:
    drift = NO_DRIFT.copy()
    drift[2] = [0.8, -0.6]
    rng = np.random.default_rng(2)
    found = [batch(square, rng, 6, drift) for _ in range(40)]
    assert sum(result.drifts[2] for result in found) >= 36
    assert sum(np.delete(result.drifts, 2).any() for result in found) <= 6
    seen = np.mean([result.mean_mm[2] for result in found if result.drifts[2]], axis=0)
    np.testing.assert_allclose(seen, drift[2], atol=0.08), "against the others, not against a fit that it pulls along"
    fitted = np.mean([result.fitted_mean_mm[2] for result in found], axis=0)
    assert np.hypot(*fitted) < 0.96, "the fit hides a part of it"


def test_two_sleeves_and_one_that_was_not_always_measured(square: Array) -> None:
    drift = NO_DRIFT.copy()
    drift[0], drift[7] = [1.2, 0.0], [0.0, 1.5]
    result = batch(square, np.random.default_rng(3), 8, drift, missing=((0, 7), (1, 7), (2, 3)))
    assert np.flatnonzero(result.drifts).tolist() == [0, 7]
    assert result.counts.tolist() == [8, 8, 8, 7, 8, 8, 8, 6, 8, 8, 8, 8]
    assert result.p_value < 1e-3


def test_loose_is_not_displaced(square: Array) -> None:
    rng = np.random.default_rng(4)
    found = [batch(square, rng, 8, NO_DRIFT, loose=(5,)) for _ in range(30)]
    assert sum(result.scatters_more[5] for result in found) >= 27
    assert sum(result.drifts[5] for result in found) <= 4


def test_intervals_hold_the_truth(square: Array) -> None:
    drift = NO_DRIFT.copy()
    drift[2] = [0.8, -0.6]
    rng = np.random.default_rng(5)
    inside = []
    for _ in range(60):
        result = batch(square, rng, 8, drift)
        if np.flatnonzero(result.drifts).tolist() == [2]:
            inside.append(np.abs(result.mean_mm - drift) <= result.interval_mm)
    assert len(inside) > 45
    assert 0.92 < np.mean(inside) < 0.985


def test_columns_without_any_scatter(square: Array) -> None:
    design = square[:, :2]
    none = shared_displacement(np.zeros((3, 12, 2)), np.ones((3, 12), dtype=bool), design)
    assert not none.drifts.any()
    assert none.scatter_mm == 0.0
    drift = np.zeros((3, 12, 2))
    drift[:, 3] = [1.0, 0.0]
    same = shared_displacement(drift, np.ones((3, 12), dtype=bool), design)
    assert same.drifts[3]


def test_laws() -> None:
    """Tables: F(0.05; 2, 10) = 4.103, t(0.975; 10) = 2.228; Holm's own example."""
    assert f_exceeded(4.103, 1.0, 2, 10) == pytest.approx(0.05, abs=1e-4)
    assert f_exceeded(1.0, 0.0, 2, 10) == 0.0
    assert f_exceeded(0.0, 0.0, 2, 10) == 1.0
    assert t_quantile(0.95, 10) == pytest.approx(2.228, abs=1e-3)
    np.testing.assert_allclose(holm(np.array([0.01, 0.04, 0.03, 0.005])), [0.03, 0.06, 0.06, 0.02])
    cp, interval = cp_index(2.0, 0.5, 30, 0.95)
    assert cp == pytest.approx(4.0 / 3.0)
    assert interval == pytest.approx((0.990, 1.674), abs=2e-3)
    cpk, around = cpk_index(2.0, -0.5, 0.5, 30, 0.95)
    assert cpk == pytest.approx(1.0)
    assert around == pytest.approx((0.716, 1.284), abs=2e-3)


def test_capability_intervals_hold_the_truth() -> None:
    rng = np.random.default_rng(6)
    held = []
    for _ in range(1500):
        values = rng.normal(0.4, 0.5, 12)
        cp, inside = cp_index(2.0, float(values.std(ddof=1)), 12, 0.95)
        cpk, around = cpk_index(2.0, float(values.mean()), float(values.std(ddof=1)), 12, 0.95)
        assert inside[0] < cp < inside[1]
        assert around[0] < cpk < around[1]
        held.append((inside[0] <= 4.0 / 3.0 <= inside[1], around[0] <= 1.6 / 1.5 <= around[1]))
    assert np.mean([one for one, _ in held]) == pytest.approx(0.95, abs=0.02)
    assert np.mean([one for _, one in held]) == pytest.approx(0.95, abs=0.03)
