"""The best assignment of columns to positions: as many as can go on, then the largest smallest margin, then the sum."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, BoolArray
from aadm_workbench.model.special import distinct


def best_assignment(margins: Array) -> list[tuple[int, int]]:
    """Pairs (row, column) of the best assignment, by rows.

    Where all rows (or all columns, of which there may be fewer) can be given a margin of zero or more, the smallest
    margin is made as large as possible, and then the sum. Where not all can, as many as possible are, and the same
    holds for these; a column that goes nowhere does not spoil the others. What is not known counts nothing, neither for
    nor against: it takes the place of no pair that goes on.

    Parameters
    ----------
    margins
        (m, n) float64; NaN where the two must not be put together.
    """
    if not margins.size:
        return []
    allowed = np.isfinite(margins)
    going = allowed & (np.where(allowed, margins, -1.0) >= 0.0)
    most = _largest_matching(going)
    threshold = _highest_threshold(margins, going, most) if most else np.inf
    filled = np.where(allowed, margins, 0.0)
    bonus = 1.0 + 2.0 * max(margins.shape) * float(np.ptp(np.append(filled, 0.0)))
    value = filled + np.where(going & (filled >= threshold), bonus, 0.0)
    rows, columns = _assigned(value)
    return [(row, column) for row, column in zip(rows, columns, strict=True) if allowed[row, column]]


def _highest_threshold(margins: Array, going: BoolArray, most: int) -> float:
    """The largest margin that so many pairs can all have at once: found by bisection over the margins there are."""
    levels = distinct(margins[going])
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high + 1) // 2
        if _largest_matching(going & (np.where(going, margins, -1.0) >= levels[middle])) >= most:
            low = middle
        else:
            high = middle - 1
    return float(levels[low])


def _largest_matching(permitted: BoolArray) -> int:
    """How many pairs can be made of permitted ones."""
    rows, columns = _assigned(permitted.astype(np.float64))
    return int(permitted[rows, columns].sum())


def _assigned(value: Array) -> tuple[list[int], list[int]]:
    # Slow to import, and a check needs none of it.
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(value, maximize=True)
    return [int(row) for row in rows], [int(column) for column in columns]
