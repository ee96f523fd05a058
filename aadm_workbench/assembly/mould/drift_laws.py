"""The laws behind a drift: F and t, Holm's correction, and the intervals of process capability."""

from __future__ import annotations

import math

import numpy as np

from aadm_workbench.model import Array, Vector2

_NO_VARIANCE = 1e-18  # mm²: a nanometre, squared, is no scatter


def f_exceeded(between: float, within: float, between_freedom: float, within_freedom: float) -> float:
    """Probability that chance makes the ratio of two variances as large as this one (F law)."""
    # Slow to import, and most jobs have no three columns of one mould.
    from scipy.special import fdtrc

    if between_freedom < 1.0:
        return 1.0
    if within <= _NO_VARIANCE:
        return 1.0 if between <= _NO_VARIANCE else 0.0
    return float(fdtrc(between_freedom, within_freedom, between / within))


def t_quantile(confidence: float, freedom: float) -> float:
    """Half width of a two-sided interval, in standard errors (Student's law)."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 0.5 + confidence / 2.0))


def holm(p_values: Array) -> Array:
    """P-values (k,) corrected for their number: a false alarm anywhere is as rare as a single one (Holm 1979)."""
    order = np.argsort(p_values, kind="stable")
    factors = np.arange(len(p_values), 0, -1)
    corrected = np.minimum(np.maximum.accumulate(p_values[order] * factors), 1.0)
    result = np.empty_like(corrected)
    result[order] = corrected
    return result


def cp_index(limit: float, deviation: float, count: int, confidence: float) -> tuple[float, Vector2]:
    """Cp = limit/(3·s) for limits ±limit, and its interval by the χ² law of s² from ``count`` values."""
    from scipy.special import chdtri

    cp, freedom = limit / (3.0 * deviation), count - 1
    tail = (1.0 - confidence) / 2.0
    low, high = (math.sqrt(float(chdtri(freedom, above)) / freedom) for above in (1.0 - tail, tail))
    return cp, (cp * low, cp * high)


def cpk_index(limit: float, mean: float, deviation: float, count: int, confidence: float) -> tuple[float, Vector2]:
    """Cpk = (limit − |mean|)/(3·s) for limits ±limit, and its interval after Bissell (1990)."""
    from scipy.special import ndtri

    cpk = (limit - abs(mean)) / (3.0 * deviation)
    half = float(ndtri(0.5 + confidence / 2.0)) * math.sqrt(1.0 / (9.0 * count) + cpk**2 / (2.0 * (count - 1)))
    return cpk, (cpk - half, cpk + half)
