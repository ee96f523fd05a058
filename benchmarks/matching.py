"""The assignment of ``aadm match`` against all assignments there are, for random matrices of margins with gaps."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations

import numpy as np

from aadm_workbench.assembly.matching.assign import best_assignment
from aadm_workbench.model import Array

_LARGEST = 6
_EQUAL = 1e-9

Worth = tuple[int, float, float]
"""How many go on, the smallest margin of these, the sum of all that is known."""


@dataclass(frozen=True)
class Matched:
    """Of so many matrices, in how many the assignment is worth less than the best of all."""

    matrices: int
    worse: int


def matched_margins(cases: int, rng: np.random.Generator) -> Matched:
    """Matrices up to 6 × 6, of either sign, some rounded so that margins are equal, any share of them not known."""
    worse = 0
    for _ in range(cases):
        shape = int(rng.integers(1, _LARGEST + 1)), int(rng.integers(1, _LARGEST + 1))
        margins = rng.normal(rng.uniform(-0.6, 0.6), 0.5, shape) * rng.choice([1.0, 1.0, 200.0])
        margins = np.round(margins, 1) if rng.random() < 0.3 else margins
        margins[rng.random(shape) < rng.uniform(0.0, 0.9)] = np.nan
        worse += not _alike(worth_of(margins, best_assignment(margins)), best_worth(margins))
    return Matched(cases, worse)


def worth_of(margins: Array, pairs: list[tuple[int, int]]) -> Worth:
    """What an assignment is worth."""
    chosen = [float(margins[row, column]) for row, column in pairs]
    going = [margin for margin in chosen if margin >= 0.0]
    return len(going), min(going, default=0.0), sum(chosen)


def best_worth(margins: Array) -> Worth:
    """The most that any assignment is worth that leaves nobody out who could be placed; all of them are looked at."""
    turned = margins.T if margins.shape[0] > margins.shape[1] else margins
    rows, columns = turned.shape
    orders = np.array(list(permutations(range(columns), rows)), dtype=np.intp).reshape(-1, rows)
    picked = turned[np.arange(rows), orders]
    going = picked >= 0.0
    smallest = np.where(going.any(axis=1), np.where(going, picked, np.inf).min(axis=1), 0.0)
    total = np.nan_to_num(picked).sum(axis=1)
    most = going.sum(axis=1)
    best = most == most.max()
    best &= smallest >= smallest[best].max()
    return int(most.max()), float(smallest[best].max()), float(total[best].max())


def _alike(first: Worth, second: Worth) -> bool:
    return first[0] == second[0] and all(
        abs(a - b) <= _EQUAL * max(1.0, abs(b)) for a, b in zip(first[1:], second[1:], strict=True)
    )
