"""How likely it is that a pose exists at all in which every rebar enters its sleeve, given the uncertainties.

Not the product over the pairs: at one fixed pose a pair may fail that another pose would save, and all pairs move
together. True centres, leans and rooms are drawn from what is known of them (:mod:`.true_offsets`); for each draw it is
decided whether a pose meets all limits, distances and rooms over the ribs alike, which is a convex question
(:mod:`.smallest_common_disc`).

That a pair stands like the others where it was hardly seen is likely, and no evidence: such a pair is named, and keeps
the trial from passing. So does one that is known worse than the others, where by its own measurement alone, and not by
theirs, a pose is not sure to exist: a bar that was bent is seen worse, too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.decision import PASS_PROBABILITY, probability_within_disc
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.best_pose import WITHIN, BestFit, Part, fit_best_pose, start_pose
from aadm_workbench.assembly.pose.eopa import NoFit, turn
from aadm_workbench.assembly.pose.smallest_common_disc import proven_bound, smallest_common_disc, squared
from aadm_workbench.assembly.pose.true_offsets import Measured, MeasuredShifts, true_offsets
from aadm_workbench.model import Array, BoolArray
from aadm_workbench.model.special import median

SAMPLES = 1200
"""Draws: a probability of 95 % is then known to 0.6 %."""

_FIRST = 300
"""Where so many draws all say the same no more are made: by the rule of three the rest is below 1 %, at 95 %
confidence, and a verdict asks for 5 %."""

_GRANTED_SIGMAS = 1.7
"""Of the root of the sum of both variances: about 5 % of gaps are further off, whatever their direction."""

_HOPELESS_SIGMAS = 8.0
"""No pose exists where the best one is beyond a limit by so many standard uncertainties of the gap known worst."""

_SAFE_SIGMAS = 4.0  # of the root of both variances: the disc then holds all but one in nine million

_WORSE = 4.0
"""Times the usual variance of a pair: known half as well as the others, it was not seen as they were."""

_GAP = 1e-4
"""Share to which a squared ratio has to be known: some hundred times finer than the spread of the draws."""

_LEAST_U = 1e-6  # mm: keeps quotients of exact points finite
_LEAST_SHARE = 1e-9  # keeps multipliers above zero


@dataclass(frozen=True, eq=False)
class Existence:
    """How likely it is that a pose exists, and what has to be known better.

    ``contradicted``: the measured values themselves say that there is none. ``violated`` (n,) is the share of draws in
    which each pair breaks a limit at the best pose of the measured values. ``hardly_seen`` (n,): pairs that would not
    hold their limit for sure even if their bar had been found in the very middle, and pairs known worse than the others
    that a pose would only be sure of because they are taken to stand like these.
    """

    probability: float
    violated: Array
    contradicted: bool
    hardly_seen: BoolArray


@dataclass(frozen=True, eq=False)
class _Draws:
    """k draws of the gaps at the best pose: ``vectors`` (k, c, 2) mm, their turning (c, 2), ``limits_mm`` (k, c)."""

    vectors: Array
    turning: Array
    limits_mm: Array

    def possible(self, multipliers: Array) -> BoolArray:
        """In which draws (k,) a pose meets all limits; multipliers (c,) of a problem like these decide most of them."""
        answer = np.zeros(len(self.vectors), dtype=bool)
        rows = np.flatnonzero((self.limits_mm > 0.0).all(axis=1))
        p, weights = self.vectors[rows], 1.0 / self.limits_mm[rows] ** 2
        q = np.broadcast_to(self.turning, p.shape)
        here = (weights * squared(p)).max(axis=1) <= WITHIN**2
        answer[rows[here]] = True
        shares = np.broadcast_to(np.maximum(multipliers, _LEAST_SHARE), weights.shape)
        unclear = ~here & (proven_bound(p, q, weights, shares) <= WITHIN**2)
        if unclear.any():
            found = smallest_common_disc(p[unclear], q[unclear], weights[unclear], decide_at=WITHIN**2, gap=_GAP)
            answer[rows[unclear]] = found.ratio_squared <= WITHIN**2
        return answer


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
    contradicted = not fit.exists
    if hardly_seen.any() and contradicted:
        granted = fit_best_pose(*_granted(pairs, limits_mm, hardly_seen))
        contradicted = not isinstance(granted, NoFit) and not granted.exists
    far = (fit.ratio - 1.0) / _largest_u(pairs, fit)
    if np.isinf(fit.ratio) or far > _HOPELESS_SIGMAS:
        return Existence(0.0, np.where(hardly_seen, 1.0 - bounds, 0.0), contradicted, hardly_seen)
    all_alike = np.zeros(len(pairs), dtype=bool)
    probability, violated = _counted(_drawn(pairs, limits_mm, fit, all_alike, generator), fit, samples)
    violated = np.where(hardly_seen, 1.0 - bounds, violated)
    worse = _known_worse(pairs)
    if probability >= PASS_PROBABILITY and worse.any() and not hardly_seen.any():
        alone, broken = _counted(_drawn(pairs, limits_mm, fit, worse, generator), fit, samples)
        if alone < PASS_PROBABILITY:
            hardly_seen, violated = worse, np.where(worse, broken, violated)
    return Existence(probability, violated, contradicted, hardly_seen)


def _known_worse(pairs: Sequence[Pair]) -> BoolArray:
    """Pairs (n,) whose centres are known much worse than is usual of the others."""
    variances = np.array([0.0 if pair.covariance is None else np.trace(pair.covariance) for pair in pairs])
    return np.asarray(variances > _WORSE * median(variances))


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


def _largest_u(pairs: Sequence[Pair], fit: BestFit) -> float:
    """Largest standard uncertainty of a gap over its limit: no draw moves the largest ratio by more, in its units."""
    shares = []
    for limit_mm, owner, part in zip(fit.gaps.limits_mm, fit.gaps.owner, fit.gaps.part, strict=True):
        pair = pairs[owner]
        shift = {Part.MOUTH: pair.bar_shift_covariance, Part.TOP: pair.sleeve_shift_covariance}.get(part)
        variance = sum(float(np.linalg.eigvalsh(one)[-1]) for one in (pair.covariance, shift) if one is not None)
        room_u_mm = 0.0 if part == Part.CENTRES else pair.room_u_mm
        shares.append(math.sqrt(max(variance, 0.0) + room_u_mm**2) / limit_mm)
    return max(float(max(shares)), _LEAST_U)


def probability_of_a_pose(
    pairs: Sequence[Pair], limits_mm: Array, generator: np.random.Generator, samples: int = SAMPLES
) -> float | None:
    """The probability alone, where nothing is known of the best pose yet; parameters as :func:`existence_of_a_pose`."""
    fit = fit_best_pose(pairs, limits_mm)
    if isinstance(fit, NoFit):
        return None
    found = existence_of_a_pose(pairs, limits_mm, fit, generator, samples)
    return None if found is None else found.probability


def _counted(draws: Iterator[_Draws], fit: BestFit, samples: int) -> tuple[float, Array]:
    """Share of possible draws, and of draws (n,) in which each pair breaks a limit at the pose of the fit."""
    possible, broken = np.zeros(0, dtype=bool), np.zeros((0, len(fit.gaps.owner)), dtype=bool)
    for some in draws:
        possible = np.concatenate([possible, some.possible(fit.gap_multipliers)])
        broken = np.concatenate([broken, np.hypot(some.vectors[..., 0], some.vectors[..., 1]) > some.limits_mm])
        if len(possible) >= samples or (len(possible) >= _FIRST and possible.all() == possible.any()):
            break
    violated = [broken[:, fit.gaps.owner == index].any(axis=1).mean() for index in range(len(fit.multipliers))]
    return float(possible.mean()), np.array(violated)


def _drawn(
    pairs: Sequence[Pair], limits_mm: Array, fit: BestFit, apart: BoolArray, generator: np.random.Generator
) -> Iterator[_Draws]:
    """Draws of all gaps, as many at a time as true offsets are drawn; pairs ``apart`` (n,) by their own measurement."""
    gaps, count = fit.gaps, len(pairs)
    start = start_pose(pairs, limits_mm, fit.yaw, fit.shift)
    vectors, turning = start.vectors_of(gaps.source, gaps.target)
    centres = np.flatnonzero(gaps.part == Part.CENTRES)
    covariances = np.array([pair.covariance for pair in pairs])
    rooms_u_mm = np.array([pair.room_u_mm for pair in pairs])
    bars, sleeves = _bar_shifts(pairs), _sleeve_shifts(pairs)
    measured = Measured(vectors[centres], turning[centres], covariances, apart)
    for offsets in true_offsets(measured, generator):
        k = len(offsets)
        moved = (offsets - vectors[centres])[:, gaps.owner]
        bar, sleeve = bars.drawn(k, generator) @ turn(fit.yaw).T, sleeves.drawn(k, generator)
        moved -= np.where((gaps.part == Part.MOUTH)[:, None], bar[:, gaps.owner], 0.0)
        moved -= np.where((gaps.part == Part.TOP)[:, None], sleeve[:, gaps.owner], 0.0)
        room = (rooms_u_mm * generator.standard_normal((k, count)))[:, gaps.owner]
        yield _Draws(vectors + moved, turning, gaps.limits_mm + np.where(gaps.part == Part.CENTRES, 0.0, room))


def _bar_shifts(pairs: Sequence[Pair]) -> MeasuredShifts:
    bent_mm = np.array([pair.bar_bent_mm for pair in pairs])
    return MeasuredShifts(
        np.array([pair.bar_shift for pair in pairs]),
        _known([pair.bar_shift_covariance for pair in pairs]) - bent_mm[:, None, None] ** 2 * np.eye(2),
        bent_mm,
        min(pair.bar_usual_mm for pair in pairs),
    )


def _sleeve_shifts(pairs: Sequence[Pair]) -> MeasuredShifts:
    return MeasuredShifts(
        np.array([pair.sleeve_shift for pair in pairs]),
        _known([pair.sleeve_shift_covariance for pair in pairs]),
        np.zeros(len(pairs)),
        min(pair.sleeve_usual_mm for pair in pairs),
    )


def _known(covariances: list[Array | None]) -> Array:
    return np.array([np.zeros((2, 2)) if one is None else one for one in covariances])


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
