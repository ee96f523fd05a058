"""How likely it is that a pose exists at all in which every rebar enters its sleeve, given the uncertainties.

Not the product over the pairs: at one fixed pose a pair may fail that another pose would save, and all pairs move
together. Centres, leans and rooms are drawn from their covariances; for each draw it is decided whether a pose meets
all limits, distances and rooms over the ribs alike, which is a convex question (:mod:`.discs`).

What is drawn about the measured values is worse than these, as these are worse than the truth: the largest of many gaps
grows with any scatter. With r the largest ratio at the best pose, r(measured) is the median of r(drawn) less a bias b,
and about so far above the truth; so a draw counts as possible where r(drawn) ≤ 1 + 2b (the bias-corrected bootstrap,
Efron & Tibshirani 1993, 14.3). It never lifts a pair above what its own uncertainty allows: with its bar found in the
very middle, a pair holds its limit with a probability that bounds that of the whole.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.best_pose import WITHIN, BestFit, fit_best_pose
from aadm_workbench.assembly.constraints import Part, start_pose
from aadm_workbench.assembly.decision import PASS_PROBABILITY, probability_within_disc
from aadm_workbench.assembly.discs import smallest_common_disc
from aadm_workbench.assembly.eopa import NoFit
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.upright import turn
from aadm_workbench.model import Array, BoolArray, IntArray

SAMPLES = 1000
"""Draws: a probability of 95 % is then known to 0.7 %."""

_FIRST = 200
"""Where so many draws all say the same, no more are made: the probability is then known to 1.5 %."""

_SOLVED = 40
"""So many draws, each with its opposite, are solved for the bias: it is then known to a tenth of a spread."""

_GRANTED_SIGMAS = 1.7
"""Of the root of the sum of both variances: about 5 % of gaps are further off, whatever their direction."""

_HOPELESS_SIGMAS = 8.0
"""No pose exists where the best one is beyond a limit by so many standard uncertainties of the gap known worst."""

_LARGEST_BIAS = 1.0
"""The bias counts up to this many spreads of r: beyond, the scatter hides what is measured, and nothing is known."""

_SAFE_SIGMAS = 4.0  # of the root of both variances: the disc then holds all but one in nine million

_GAP = 1e-4
"""Share to which a squared ratio has to be known: some hundred times finer than the spread of the draws."""


@dataclass(frozen=True, eq=False)
class Existence:
    """How likely it is that a pose exists, and what has to be known better.

    ``contradicted``: the measured values themselves say that there is none. ``violated`` (n,) is the share of draws in
    which each pair breaks a limit at the best pose of the measured values.
    """

    probability: float
    violated: Array
    contradicted: bool


@dataclass(frozen=True, eq=False)
class _Draws:
    """k draws of the gaps at the best pose: ``vectors`` (k, c, 2) mm, their turning (c, 2), ``limits_mm`` (k, c)."""

    vectors: Array
    turning: Array
    limits_mm: Array

    def ratios_squared(self, rows: slice | IntArray, decide_at: float | None = None) -> Array:
        """Squared largest ratios (k,) of these draws at their best poses; infinite where there is no room at all."""
        p, limits = self.vectors[rows], self.limits_mm[rows]
        q = np.broadcast_to(self.turning, p.shape)
        weights = 1.0 / np.maximum(limits, 1e-6) ** 2
        found = smallest_common_disc(p, q, weights, decide_at=decide_at, gap=_GAP).ratio_squared
        return np.where((limits > 0.0).all(axis=1), found, np.inf)


def existence_of_a_pose(
    pairs: Sequence[Pair], limits_mm: Array, fit: BestFit, generator: np.random.Generator, samples: int = SAMPLES
) -> Existence | None:
    """Probability that some pose meets all limits; None where the covariance of a centre is missing.

    Parameters
    ----------
    limits_mm
        (n,) float64, of the distance of each pair.
    fit
        The best pose of the measured values.
    generator
        Source of the draws; the same generator in the same state gives the same result.
    """
    if any(pair.covariance is None for pair in pairs):
        return None
    bounds = np.array([_at_most(pair, float(limit_mm)) for pair, limit_mm in zip(pairs, limits_mm, strict=True)])
    hardly_seen = bounds < PASS_PROBABILITY
    if hardly_seen.any():
        pairs, limits_mm = _granted(pairs, limits_mm, hardly_seen)
        granted = fit_best_pose(pairs, limits_mm)
        fit = fit if isinstance(granted, NoFit) else granted
    found = _of_the_rest(pairs, limits_mm, fit, generator, samples)
    violated = np.where(hardly_seen, 1.0 - bounds, found.violated)
    return Existence(min(found.probability, float(bounds.min())), violated, found.contradicted)


def _granted(pairs: Sequence[Pair], limits_mm: Array, hardly_seen: BoolArray) -> tuple[tuple[Pair, ...], Array]:
    """The pairs with those that were hardly seen granted what is not known of them, on top of their limits.

    Where a bar was found says little then. Drawn, several of them would make any column improbable; granted, they speak
    against one only where they are beyond their limits by more than their uncertainty.
    """
    granted, wider_mm = list(pairs), limits_mm.copy()
    for index in np.flatnonzero(hardly_seen).tolist():
        pair = pairs[index]
        u_mm = [math.sqrt(np.trace(one)) for one in (pair.covariance, *_shifts(pair)) if one is not None]
        extra_mm = _GRANTED_SIGMAS * math.hypot(*u_mm, pair.room_u_mm)
        wider_mm[index] += extra_mm
        granted[index] = replace(
            pair,
            covariance=np.zeros((2, 2)),
            bar_shift_covariance=None,
            sleeve_shift_covariance=None,
            room_mm=None if pair.room_mm is None else pair.room_mm + extra_mm,
        )
    return tuple(granted), wider_mm


def _of_the_rest(
    pairs: Sequence[Pair], limits_mm: Array, fit: BestFit, generator: np.random.Generator, samples: int
) -> Existence:
    """As :func:`existence_of_a_pose`, of pairs that were all seen well enough, or that are granted enough."""
    if np.isfinite(fit.ratio) and fit.ratio - 1.0 > _HOPELESS_SIGMAS * _largest_u(pairs, fit):
        return Existence(0.0, np.zeros(len(pairs)), True)
    draws = _drawn(pairs, limits_mm, fit, generator, min(_FIRST, samples))
    possible, reach = _possible(draws, fit, None)
    if samples > _FIRST and 0.0 < possible.mean() < 1.0:
        more = _drawn(pairs, limits_mm, fit, generator, samples - _FIRST)
        possible = np.concatenate([possible, _possible(more, fit, reach)[0]])
    lengths = np.hypot(draws.vectors[..., 0], draws.vectors[..., 1])
    broken = lengths > draws.limits_mm
    violated = np.array([broken[:, fit.gaps.owner == index].any(axis=1).mean() for index in range(len(pairs))])
    return Existence(float(possible.mean()), violated, not fit.exists)


def _largest_u(pairs: Sequence[Pair], fit: BestFit) -> float:
    """Largest standard uncertainty of a gap over its limit: no draw moves the largest ratio by more, in its units."""
    shares = []
    for limit_mm, owner, part in zip(fit.gaps.limits_mm, fit.gaps.owner, fit.gaps.part, strict=True):
        pair = pairs[owner]
        shift = {Part.MOUTH: pair.bar_shift_covariance, Part.TOP: pair.sleeve_shift_covariance}.get(part)
        variance = sum(float(np.linalg.eigvalsh(one)[-1]) for one in (pair.covariance, shift) if one is not None)
        room_u_mm = 0.0 if part == Part.CENTRES else pair.room_u_mm
        shares.append(math.sqrt(max(variance, 0.0) + room_u_mm**2) / limit_mm)
    return float(max(shares))


def _possible(draws: _Draws, fit: BestFit, reach: float | None) -> tuple[BoolArray, float | None]:
    """Which draws count as possible, and the ratio up to which they do; None while that was not needed."""
    if reach is not None:
        return draws.ratios_squared(slice(None), reach**2) <= reach**2, reach
    possible = draws.ratios_squared(slice(None), WITHIN**2) <= WITHIN**2
    if possible.all() or not np.isfinite(fit.ratio):
        return possible, None
    reach = WITHIN + 2.0 * _bias(draws, fit.ratio)
    rest = np.flatnonzero(~possible)
    possible[rest] = draws.ratios_squared(rest, reach**2) <= reach**2
    return possible, reach


def probability_of_a_pose(
    pairs: Sequence[Pair], limits_mm: Array, generator: np.random.Generator, samples: int = SAMPLES
) -> float | None:
    """The probability alone, where nothing is known of the best pose yet; parameters as :func:`existence_of_a_pose`."""
    fit = fit_best_pose(pairs, limits_mm)
    if isinstance(fit, NoFit):
        return None
    found = existence_of_a_pose(pairs, limits_mm, fit, generator, samples)
    return None if found is None else found.probability


def _drawn(
    pairs: Sequence[Pair], limits_mm: Array, fit: BestFit, generator: np.random.Generator, samples: int
) -> _Draws:
    """Draws in opposite pairs, first all of one sign: what is linear in them cancels in their mean."""
    gaps, half = fit.gaps, (samples + 1) // 2
    start = start_pose(pairs, limits_mm, fit.yaw, fit.shift)
    vectors, turning = start.vectors_of(gaps.source, gaps.target)
    shape = (half, len(pairs), 2)
    noise = _noise([pair.covariance for pair in pairs], generator.standard_normal(shape))[:, gaps.owner]
    bar = _noise([pair.bar_shift_covariance for pair in pairs], generator.standard_normal(shape)) @ turn(fit.yaw).T
    sleeve = _noise([pair.sleeve_shift_covariance for pair in pairs], generator.standard_normal(shape))
    noise -= np.where((gaps.part == Part.MOUTH)[:, None], bar[:, gaps.owner], 0.0)
    noise -= np.where((gaps.part == Part.TOP)[:, None], sleeve[:, gaps.owner], 0.0)
    room = (np.array([pair.room_u_mm for pair in pairs]) * generator.standard_normal(shape[:2]))[:, gaps.owner]
    room = np.where(gaps.part == Part.CENTRES, 0.0, room)
    both = np.concatenate([noise, -noise])[:samples], np.concatenate([room, -room])[:samples]
    return _Draws(vectors + both[0], turning, gaps.limits_mm + both[1])


def _noise(covariances: Sequence[Array | None], normal: Array) -> Array:
    """Normal numbers (k, n, 2) with these covariances (2, 2), zero where there is none."""
    known = np.array([np.zeros((2, 2)) if covariance is None else covariance for covariance in covariances])
    values, axes = np.linalg.eigh(known)
    roots = axes * np.sqrt(np.maximum(values, 0.0))[:, None, :]
    return np.asarray(np.einsum("nij,knj->kni", roots, normal))


def _bias(draws: _Draws, ratio: float) -> float:
    """How much larger r is in the middle of the draws than at the measured values, up to :data:`_LARGEST_BIAS`."""
    half = len(draws.vectors) // 2
    few = np.arange(min(_SOLVED, half))
    opposite = np.sqrt(draws.ratios_squared(np.concatenate([few, few + (len(draws.vectors) + 1) // 2])))
    if not len(few):
        return 0.0
    first, second = opposite[: len(few)], opposite[len(few) :]
    usable = np.isfinite(first) & np.isfinite(second)
    if not usable.any():
        return 0.0
    bias = float(np.median((first + second)[usable] / 2.0)) - ratio
    spread = float(np.sqrt(np.mean(((first - second)[usable] / 2.0) ** 2)))
    return min(max(bias, 0.0), _LARGEST_BIAS * spread)


def _at_most(pair: Pair, limit_mm: float) -> float:
    """Probability that the pair holds its limit and its room where its bar was found in the very middle."""
    gaps = [(limit_mm, pair.covariance)]
    if pair.room_mm is not None:
        gaps += [(pair.room_mm, _sum(pair.covariance, shift)) for shift in _shifts(pair)]
    return min((_in_the_middle(limit, covariance) for limit, covariance in gaps), default=1.0)


def _shifts(pair: Pair) -> tuple[Array | None, Array | None]:
    return pair.bar_shift_covariance, pair.sleeve_shift_covariance


def _sum(first: Array | None, second: Array | None) -> Array | None:
    return first if second is None else second if first is None else first + second


def _in_the_middle(limit_mm: float, covariance: Array | None) -> float:
    if covariance is None or np.trace(covariance) * _SAFE_SIGMAS**2 < limit_mm**2:
        return 1.0
    return probability_within_disc(np.zeros(2), covariance, limit_mm)
