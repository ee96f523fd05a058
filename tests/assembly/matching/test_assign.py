"""The best assignment against a search of all of them."""

import itertools

import numpy as np
import pytest

from aadm_workbench.assembly.matching.assign import best_assignment
from aadm_workbench.model import Array


def worth(margins: Array, pairs: list[tuple[int, int]]) -> tuple[int, float, float]:
    """How many go on, the smallest margin of these, the sum of all that is known."""
    chosen = [float(margins[row, column]) for row, column in pairs if np.isfinite(margins[row, column])]
    going = [margin for margin in chosen if margin >= 0.0]
    return len(going), round(min(going, default=0.0), 9), round(sum(chosen), 6)


def searched(margins: Array) -> tuple[int, float, float]:
    rows, columns = margins.shape
    turned = margins.T if rows > columns else margins
    every = itertools.permutations(range(turned.shape[1]), turned.shape[0])
    return max(worth(turned, list(enumerate(order))) for order in every)


@pytest.mark.parametrize("seed", range(40))
def test_equals_the_search_of_all_assignments(seed: int) -> None:
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(1, 6)), int(rng.integers(1, 6))
    margins = rng.normal(0.3, 0.5, shape)
    found = best_assignment(margins)
    assert len({row for row, _ in found}) == len({column for _, column in found}) == len(found) == min(shape)
    assert worth(margins, found) == pytest.approx(searched(margins))


@pytest.mark.parametrize("seed", range(20))
def test_equals_the_search_of_all_assignments_where_cells_are_not_known(seed: int) -> None:
    """Any shape and any share of gaps: margins of both signs, some of them equal, some of hundreds."""
    rng = np.random.default_rng([seed, 1])
    for _ in range(60):
        shape = int(rng.integers(1, 6)), int(rng.integers(1, 7))
        margins = rng.normal(rng.uniform(-0.5, 0.5), 0.5, shape)
        margins = np.round(margins, 1) if rng.random() < 0.3 else margins * rng.choice([1.0, 300.0])
        margins[rng.random(shape) < rng.uniform(0.0, 0.9)] = np.nan
        found = best_assignment(margins)
        assert len({row for row, _ in found}) == len({column for _, column in found}) == len(found)
        assert all(np.isfinite(margins[row, column]) for row, column in found)
        assert worth(margins, found) == pytest.approx(searched(margins))


def test_the_smallest_margin_comes_before_the_sum() -> None:
    margins = np.array([[0.9, 0.3], [0.3, 0.1]])
    assert best_assignment(margins) == [(0, 1), (1, 0)]


def test_a_column_that_goes_nowhere_does_not_spoil_the_others() -> None:
    """The largest smallest margin of all would be -0.4, and only one column would go on."""
    margins = np.array([[-0.1, -0.5, -0.4], [0.5, 0.1, -0.4], [0.2, -0.5, 0.4]])
    found = best_assignment(margins)
    assert sum(margins[row, column] >= 0.0 for row, column in found) == 2
    assert (0, 1) in found or (0, 0) in found


def test_what_is_not_known_is_left_out() -> None:
    margins = np.array([[np.nan, 0.2], [np.nan, 0.5]])
    assert best_assignment(margins) == [(1, 1)]
    assert best_assignment(np.full((2, 2), np.nan)) == []
    assert best_assignment(np.zeros((0, 3))) == []
