"""Mould drift: what the columns of one mould have in common, told apart from the scatter of casting.

For each sleeve the mean of its displacements over the columns is tested against their scatter, F = n·|z̄|²/(d·s²) with
z the displacement divided by the root of what a fit leaves of it (a fit takes up a part of each deviation, more of it
along the ring than across). s² is pooled over all sleeves, but no sleeve is judged by less than its own scatter. With a
dozen sleeves one would be called displaced by chance at every second job, so the p-values are corrected after Holm: the
probability of any false alarm for one mould stays near 5 %.

A fit of all sleeves hides a part of what one of them does and lays it on the others. So the most significant sleeve is
taken out of the fit, and the rest is looked at again, until none is left that stands out.

The laws behind a drift: F and t, Holm's correction, and the intervals of process capability.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, BoolArray, Vector2

SIGNIFICANT = 0.05
"""Of sound moulds one in twenty is called a drifting one; for all sleeves of a mould together (Holm)."""
CONFIDENCE = 0.95
"""Of the intervals that are given: the usual 95 %."""

_NO_FREEDOM = 1e-6  # of one dimension that a fit leaves of a point: what is less is rounding
_NO_SCATTER_MM2 = 1e-18  # keeps a division: a nanometre, squared

_NO_VARIANCE = 1e-18  # mm²: a nanometre, squared, is no scatter


@dataclass(frozen=True, eq=False)
class SharedDisplacement:
    """K sleeves over N columns, mm.

    Parameters
    ----------
    mean_mm, interval_mm
        (K, 2), mean displacements against the sleeves that do not drift, and half their confidence intervals.
    fitted_mean_mm, scatter_each_mm
        (K, 2), means and standard deviations of the offsets as they are, after each column's own fit.
    counts
        (K,), in how many columns each was measured.
    p_values
        (K,), corrected for their number.
    drifts, scatters_more
        (K,), which are displaced, and whose scatter is significantly larger than that of the others.
    p_value
        Of the test that no sleeve is displaced at all.
    scatter_mm
        The pooled scatter per axis.
    """

    mean_mm: Array
    interval_mm: Array
    fitted_mean_mm: Array
    scatter_each_mm: Array
    counts: Array
    p_values: Array
    drifts: BoolArray
    scatters_more: BoolArray
    p_value: float
    scatter_mm: float


def shared_displacement(offsets: Array, measured: BoolArray, design: Array) -> SharedDisplacement:
    """Mean and scatter of displacements over columns, and how sure it is that the means are not zero.

    Parameters
    ----------
    offsets
        (N, K, 2) mm, measured minus design after each column's own fit; zero where not measured.
    measured
        (N, K); each sleeve at least twice.
    design
        (K, 2) mm, the sleeves' places.
    """
    counts = measured.sum(axis=0).astype(np.float64)
    mean = offsets.sum(axis=0) / counts[:, None]
    about = np.where(measured[:, :, None], offsets - mean, 0.0)
    scatter = _Scatter.of(about, measured, counts, _left(_residual_of(design, np.zeros(len(design), dtype=bool))))
    drifts = np.zeros(len(design), dtype=bool)
    while True:
        residual = _residual_of(design, drifts)
        left, against = _left(residual), (residual @ mean.reshape(-1)).reshape(-1, 2)
        p_values = holm(_p_values(against, left, counts, scatter))
        more = ~drifts & (p_values < SIGNIFICANT)
        if not more.any() or drifts.sum() >= (len(design) - 2) // 2:
            break
        drifts[np.flatnonzero(more)[np.argmin(p_values[more])]] = True
    quantile = np.array([t_quantile(CONFIDENCE, value) for value in scatter.freedom])
    deviation = np.sqrt(scatter.variance[:, None] * np.diagonal(left, axis1=1, axis2=2))
    return SharedDisplacement(
        mean_mm=against,
        interval_mm=quantile[:, None] * deviation / np.sqrt(counts)[:, None],
        fitted_mean_mm=mean,
        scatter_each_mm=np.sqrt((about**2).sum(axis=0) / (counts - 1.0)[:, None]),
        counts=counts,
        p_values=p_values,
        drifts=drifts & (p_values < SIGNIFICANT),
        scatters_more=scatter.alone,
        p_value=_overall(mean, counts, scatter, len(design)),
        scatter_mm=float(np.sqrt(scatter.pooled)),
    )


def _residual_of(design: Array, left_out: BoolArray) -> Array:
    """The matrix (2K, 2K) that takes displacements to those against the sleeves that are not left out."""
    spoke = design - design[~left_out].mean(axis=0)
    motion = np.zeros((2 * len(design), 3))
    motion[0::2, 0] = motion[1::2, 1] = 1.0
    motion[0::2, 2], motion[1::2, 2] = -spoke[:, 1], spoke[:, 0]
    fitted = motion * np.repeat(~left_out, 2)[:, None]
    return np.asarray(np.eye(2 * len(design)) - motion @ np.linalg.pinv(fitted))


def _left(residual: Array) -> Array:
    """Covariance (K, 2, 2) that the residuals have where each displacement has that of 1."""
    blocks = residual.reshape(len(residual) // 2, 2, -1)
    return np.asarray(np.einsum("kim,kjm->kij", blocks, blocks))


def _p_values(mean: Array, left: Array, counts: Array, scatter: _Scatter) -> Array:
    size, freedom = _whitened(mean, left)
    return np.array(
        [
            f_exceeded(counts[k] * size[k] / max(freedom[k], 1.0), scatter.variance[k], freedom[k], scatter.freedom[k])
            for k in range(len(counts))
        ]
    )


@dataclass(frozen=True, eq=False)
class _Scatter:
    """Variance per axis, mm², and degrees of freedom that each sleeve (K,) is judged by; those ``alone`` by their own.

    ``pooled`` and ``pooled_freedom`` are of the sleeves that are not alone.
    """

    variance: Array
    freedom: Array
    alone: BoolArray
    pooled: float
    pooled_freedom: float

    @classmethod
    def of(cls, about: Array, measured: BoolArray, counts: Array, left: Array) -> _Scatter:
        """From the displacements about their means, (N, K, 2); ``left`` (K, 2, 2) is what a fit leaves of them."""
        squares, dimensions = _whitened(about, left)
        own_squares = squares.sum(axis=0)
        own_freedom = np.maximum(dimensions * (counts - 1.0), 1.0)
        # A fit of K points leaves 2K − 3 of their 2K coordinates free, and the means take those of one column more.
        left_free = float(np.maximum(2 * measured.sum(axis=1) - 3, 0).sum()) - (2 * len(counts) - 3)
        total, freedom = float((about**2).sum()), max(left_free, 1.0)
        alone = _larger(own_squares, own_freedom, total, freedom)
        share = float(dimensions[~alone].sum() / max(dimensions.sum(), 1.0))
        kept = float((about[:, ~alone] ** 2).sum())
        pooled_freedom = max(freedom * share, 1.0)
        pooled = kept / pooled_freedom
        return cls(
            # Never less than its own: with three columns a loose sleeve is hard to tell from the others.
            variance=np.where(alone, own_squares / own_freedom, np.maximum(pooled, own_squares / own_freedom)),
            freedom=np.where(alone, own_freedom, pooled_freedom),
            alone=alone,
            pooled=pooled,
            pooled_freedom=pooled_freedom,
        )


def _larger(squares: Array, freedom: Array, total: float, total_freedom: float) -> BoolArray:
    """Which sleeves (K,) scatter more than the rest: one-sided F tests, corrected after Holm."""
    rest = np.maximum(total - squares, _NO_SCATTER_MM2)
    rest_freedom = np.maximum(total_freedom - freedom, 1.0)
    p_values = [
        f_exceeded(squares[k] / freedom[k], rest[k] / rest_freedom[k], freedom[k], rest_freedom[k])
        for k in range(len(squares))
    ]
    return np.asarray(holm(np.array(p_values)) < SIGNIFICANT)


def _whitened(vectors: Array, left: Array) -> tuple[Array, Array]:
    """Squared lengths (..., K) of vectors (..., K, 2) in units of what a fit leaves, and their dimensions (K,)."""
    values, axes = np.linalg.eigh(left)
    free = values > _NO_FREEDOM
    along = np.einsum("...kd,kde->...ke", vectors, axes)
    return (along**2 * np.where(free, 1.0 / np.where(free, values, 1.0), 0.0)).sum(axis=-1), free.sum(axis=1)


def _overall(mean: Array, counts: Array, scatter: _Scatter, sleeves: int) -> float:
    kept = ~scatter.alone
    freedom = max((2 * sleeves - 3) * float(kept.mean()), 1.0)
    between = float((counts[kept, None] * mean[kept] ** 2).sum()) / freedom
    return f_exceeded(between, scatter.pooled, freedom, scatter.pooled_freedom)


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
    # 9 = 3², of the three standard deviations that the index stands on.
    half = float(ndtri(0.5 + confidence / 2.0)) * math.sqrt(1.0 / (9.0 * count) + cpk**2 / (2.0 * (count - 1)))
    return cpk, (cpk - half, cpk + half)
