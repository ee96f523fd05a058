"""Conformance probabilities against closed forms, printed tables and scipy."""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.stats import ncx2, norm

from aadm_workbench.assembly.decision import (
    decide_per_axis,
    decide_probability,
    decide_radial,
    decide_signed,
    probability_between,
    probability_within_disc,
    probability_within_square,
    standard_uncertainty,
)
from aadm_workbench.model import Verdict

# σ, then for limits of 3 and 2 mm: the largest deviation that passes and the smallest that fails; None for never.
GUARDED = [
    (0.10, 2.834, 3.163, 1.833, 2.162),
    (0.20, 2.664, 3.323, 1.660, 2.320),
    (0.30, 2.490, 3.480, 1.480, 2.473),
    (0.40, 2.312, 3.634, 1.292, 2.623),
    (0.50, 2.128, 3.785, 1.093, 2.769),
    (0.70, 1.741, 4.081, 0.627, 3.052),
    (1.00, 1.074, 4.508, None, 3.452),
    (1.20, 0.354, 4.782, None, 3.703),
]


@pytest.mark.parametrize("row", GUARDED)
@pytest.mark.parametrize("limit_mm", [3.0, 2.0])
def test_guarded_limits_of_the_rice_law(row: tuple[float | None, ...], limit_mm: float) -> None:
    sigma, accept, reject = row[0], row[1 if limit_mm == 3.0 else 3], row[2 if limit_mm == 3.0 else 4]
    assert sigma is not None
    assert reject is not None

    def excess(deviation: float, wanted: float) -> float:
        return probability_within_disc(np.array([deviation, 0.0]), np.eye(2) * sigma**2, limit_mm) - wanted

    assert brentq(excess, limit_mm, 6.0, args=(0.05,)) == pytest.approx(reject, abs=5.1e-4)
    if accept is None:
        assert excess(0.0, 0.95) < 0.0
    else:
        assert brentq(excess, 0.0, limit_mm, args=(0.95,)) == pytest.approx(accept, abs=5.1e-4)


def test_nothing_passes_once_sigma_is_above_0_409_of_the_limit() -> None:
    critical = 3.0 / np.sqrt(-2.0 * np.log(0.05))
    for factor, verdict in ((0.999, Verdict.PASS), (1.001, Verdict.INCONCLUSIVE)):
        covariance = np.eye(2) * (factor * critical) ** 2
        assert decide_radial(np.zeros(2), covariance, 3.0, "guarded").verdict is verdict


def test_example_of_jcgm_106() -> None:
    assert probability_between(13.6, 1.8, 12.5, 16.3) == pytest.approx(0.6626, abs=5e-5)


@pytest.mark.parametrize("seed", range(60))
def test_disc_is_the_rice_law_for_equal_axes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sigma, radius = 10.0 ** rng.uniform(-1.5, 1.0), rng.uniform(0.5, 6.0)
    offset = rng.uniform(-1.5 * radius, 1.5 * radius, 2)
    expected = ncx2.cdf((radius / sigma) ** 2, 2, (offset @ offset) / sigma**2)
    assert probability_within_disc(offset, np.eye(2) * sigma**2, radius) == pytest.approx(expected, abs=2e-7)


@pytest.mark.parametrize("seed", range(20))
def test_disc_of_an_anisotropic_covariance(seed: int) -> None:
    """Against a sum over quantiles of the narrow axis, which shares nothing with the quadrature."""
    rng = np.random.default_rng(seed)
    sigma = 10.0 ** rng.uniform(-3.0, 0.3, 2)
    angle = rng.uniform(0.0, np.pi)
    axes = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    offset = rng.uniform(-2.0, 2.0, 2)
    narrow = int(np.argmin(sigma))
    along = offset @ axes
    across = along[narrow] + sigma[narrow] * norm.ppf((np.arange(40000) + 0.5) / 40000)
    half = np.sqrt(np.maximum(4.0 - across**2, 0.0))
    inside = norm.cdf((half - along[1 - narrow]) / sigma[1 - narrow])
    inside -= norm.cdf((-half - along[1 - narrow]) / sigma[1 - narrow])
    expected = np.mean(np.where(np.abs(across) <= 2.0, inside, 0.0))
    found = probability_within_disc(offset, axes @ np.diag(sigma**2) @ axes.T, 2.0)
    assert found == pytest.approx(expected, abs=2e-5)


def test_disc_of_a_covariance_along_a_line_or_of_none() -> None:
    line = np.array([[0.0, 0.0], [0.0, 0.25]])
    half = np.sqrt(4.0 - 1.5**2)
    expected = norm.cdf(half / 0.5) - norm.cdf(-half / 0.5)
    assert probability_within_disc(np.array([1.5, 0.0]), line, 2.0) == pytest.approx(expected, abs=1e-12)
    assert probability_within_disc(np.array([2.5, 0.0]), line, 2.0) == 0.0
    assert probability_within_disc(np.array([1.9, 0.0]), np.zeros((2, 2)), 2.0) == 1.0
    assert probability_within_disc(np.array([2.1, 0.0]), np.zeros((2, 2)), 2.0) == 0.0


def test_square_of_uncorrelated_and_of_correlated_axes() -> None:
    offset = np.array([0.5, -1.2])
    expected = probability_between(0.5, 0.3, -2, 2) * probability_between(-1.2, 0.6, -2, 2)
    assert probability_within_square(offset, np.diag([0.09, 0.36]), 2.0) == pytest.approx(expected, abs=1e-12)
    together = np.array([[0.25, 0.25], [0.25, 0.25]])
    expected = probability_between(0.0, 0.5, -1.0, 2.0)
    assert probability_within_square(np.array([0.0, -1.0]), together, 2.0) == pytest.approx(expected, abs=1e-3)
    assert decide_per_axis(np.array([1.9, -1.9]), None, 2.0, "guarded").verdict is Verdict.PASS
    assert decide_per_axis(np.array([1.9, -2.1]), np.eye(2) * 1e-8, 2.0, "guarded").verdict is Verdict.FAIL


@pytest.mark.parametrize(
    ("probability", "within", "verdict"),
    [
        (0.95, True, Verdict.PASS),
        (0.9499, True, Verdict.INCONCLUSIVE),
        (0.0501, False, Verdict.INCONCLUSIVE),
        (0.05, False, Verdict.FAIL),
        (0.02, True, Verdict.INCONCLUSIVE),
        (0.98, False, Verdict.INCONCLUSIVE),
    ],
)
def test_guard_band(probability: float, within: bool, verdict: Verdict) -> None:
    assert decide_probability(probability, within) is verdict


def test_ignorance_alone_fails_nothing() -> None:
    """A value in the middle of its limits of which nothing is known: hardly probable, and not proven wrong."""
    vague = decide_radial(np.array([0.1, 0.0]), 20.0**2 * np.eye(2), 3.0, "guarded")
    assert vague.probability is not None
    assert vague.probability < 0.05
    assert vague.verdict is Verdict.INCONCLUSIVE
    assert decide_signed(0.1, 60.0, -2.0, 2.0, "guarded").verdict is Verdict.INCONCLUSIVE
    assert decide_per_axis(np.array([0.1, 0.0]), 20.0**2 * np.eye(2), 3.0, "guarded").verdict is Verdict.INCONCLUSIVE
    assert decide_signed(9.0, 0.1, -2.0, 2.0, "guarded").verdict is Verdict.FAIL


def test_without_covariance_the_value_alone_decides() -> None:
    for decision in ("guarded", "simple"):
        assert decide_radial(np.array([0.0, 2.0]), None, 2.0, decision).verdict is Verdict.PASS  # type: ignore[arg-type]
    assert decide_radial(np.array([0.0, 2.0001]), None, 2.0, "guarded").verdict is Verdict.FAIL
    assert decide_radial(np.array([0.0, 1.99]), np.eye(2), 2.0, "simple").probability is None
    assert decide_radial(np.array([0.0, 1.99]), np.eye(2) * 0.01, 2.0, "guarded").verdict is Verdict.INCONCLUSIVE


def test_signed_limits() -> None:
    assert decide_signed(-2.0, None, -2.0, 2.0, "guarded").verdict is Verdict.PASS
    assert decide_signed(-2.01, None, -2.0, 2.0, "guarded").verdict is Verdict.FAIL
    assert decide_signed(-50.0, 0.1, None, 2.0, "guarded").verdict is Verdict.PASS
    at_guard = 2.0 - 1.6448536 * 0.2
    assert decide_signed(at_guard - 1e-3, 0.2, -2.0, 2.0, "guarded").verdict is Verdict.PASS
    assert decide_signed(at_guard + 1e-3, 0.2, -2.0, 2.0, "guarded").verdict is Verdict.INCONCLUSIVE
    assert decide_signed(1.0, 0.0, 0.0, 10.0, "guarded").probability == 1.0


def test_uncertainty_per_axis() -> None:
    assert standard_uncertainty(np.diag([0.01, 0.03])) == pytest.approx(np.sqrt(0.02))
    assert standard_uncertainty(None) is None
