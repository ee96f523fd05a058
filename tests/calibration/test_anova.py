"""The analysis of variance of a gauge study: a published table, and variances that were put in."""

import numpy as np
import pytest

from aadm_workbench.calibration.gauge.anova import analysed, variances_of

# AIAG, Measurement Systems Analysis, 4th edition, the data of its GRR study: ten parts, three appraisers, three trials.
AIAG = """
 0.29  0.41  0.64 -0.56 -0.68 -0.58  1.34  1.17  1.27  0.47  0.50  0.64 -0.80 -0.92 -0.84
 0.02 -0.11 -0.21  0.59  0.75  0.66 -0.31 -0.20 -0.17  2.26  1.99  2.01 -1.36 -1.25 -1.31
 0.08  0.25  0.07 -0.47 -1.22 -0.68  1.19  0.94  1.34  0.01  1.03  0.20 -0.56 -1.20 -1.28
-0.20  0.22  0.06  0.47  0.55  0.83 -0.63  0.08 -0.34  1.80  2.12  2.19 -1.68 -1.62 -1.50
 0.04 -0.11 -0.15 -1.38 -1.13 -0.96  0.88  1.09  0.67  0.14  0.20  0.11 -1.46 -1.07 -1.45
-0.29 -0.67 -0.49  0.02  0.01  0.21 -0.46 -0.56 -0.49  1.77  1.45  1.87 -1.49 -1.77 -2.16
"""


@pytest.fixture(scope="module")
def published() -> np.ndarray:
    by_appraiser = np.array(AIAG.split(), dtype=float).reshape(3, 10, 3)
    return by_appraiser.transpose(1, 0, 2)[None]


def test_the_published_table(published: np.ndarray) -> None:
    table = analysed(published)
    assert table.operators is not None
    assert table.interaction is not None
    lines = (table.operators, table.parts, table.interaction, table.repeats)
    assert [line.freedom for line in lines] == [2, 9, 18, 60]
    assert [line.squares for line in lines] == pytest.approx([3.1673, 88.3619, 0.3590, 2.7589], abs=1e-4)
    assert table.pooled  # F = 0.434: the manual pools it
    assert table.interaction.mean / table.repeats.mean == pytest.approx(0.434, abs=1e-3)


def test_the_published_variances(published: np.ndarray) -> None:
    found = variances_of(analysed(published), np.random.default_rng(1))
    assert found.reproducibility is not None
    assert found.repeatability.value**0.5 == pytest.approx(0.199933, abs=1e-5)
    assert found.reproducibility.value**0.5 == pytest.approx(0.226838, abs=1e-5)
    assert found.gauge.value**0.5 == pytest.approx(0.302373, abs=1e-5)
    assert found.parts.value**0.5 == pytest.approx(1.042327, abs=1e-5)


def test_the_interval_of_repeats_is_that_of_chi_squared(published: np.ndarray) -> None:
    from scipy import stats

    found = variances_of(analysed(published), np.random.default_rng(2)).repeatability
    squares = 0.3590 + 2.7589
    ends = [squares / stats.chi2.ppf(level, 78) for level in (0.975, 0.025)]
    assert [found.low, found.high] == pytest.approx(ends, rel=0.04)


@pytest.mark.parametrize("operators", [1, 4])
def test_variances_that_were_put_in_are_within_their_intervals(operators: int) -> None:
    """By a generator that adds effects, of which the analysis knows nothing."""
    parts, repeats, sigma = 12, 3, {"part": 0.5, "operator": 0.05, "crossed": 0.04, "repeat": 0.03}
    truth = {"repeatability": 0.03**2, "parts": 0.5**2}
    truth["reproducibility"] = 0.05**2 + 0.04**2 if operators > 1 else 0.0
    rng, within, studies = np.random.default_rng(7), dict.fromkeys(truth, 0), 80
    for _ in range(studies):
        shape = (2, parts, operators, repeats)
        crossed = operators > 1
        values = 7.0 + rng.normal(0.0, sigma["part"], (2, parts, 1, 1)) + rng.normal(0.0, sigma["repeat"], shape)
        values = values + crossed * rng.normal(0.0, sigma["operator"], (2, 1, operators, 1))
        values = values + crossed * rng.normal(0.0, sigma["crossed"], (2, parts, operators, 1))
        found = variances_of(analysed(values), rng)
        for name in within:
            estimate = getattr(found, name)
            within[name] += estimate is None or estimate.low <= truth[name] <= estimate.high
    # 95 % of 80, and three standard deviations of such a count below it
    assert min(within.values()) >= 70, within


def test_what_cannot_be_analysed_is_refused() -> None:
    with pytest.raises(ValueError, match="two repeats"):
        analysed(np.zeros((1, 5, 2, 1)))
