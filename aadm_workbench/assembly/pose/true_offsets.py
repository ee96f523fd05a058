"""What the true offsets of bars from their sleeves may be, given the measured ones.

Measured offsets scatter more than true ones, by their uncertainty, and the largest of many most of all: drawn about
them, a column looks worse than it is. How bars and sleeves scatter as built is told by the pairs themselves, so both
are drawn together (Gibbs sampling of a hierarchical model; Gelman et al., Bayesian Data Analysis, 3rd ed., 11.1, 17.2):

    measured offset = pose + true scatter + error        error ~ N(0, its covariance)
    true scatter ~ the normal law in the plane or Student's, of a width that all pairs share

Which of the two is told by the pairs as well, and before they say anything the odds are even. By Student's law few
points far off are usual: what stands far off by more than its uncertainty is left where it was measured and not drawn
to the others. By the normal law there are none, and what was hardly seen stands about like the rest. The pose is free,
as in the trial.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.matching.pattern_search import USUAL_SCATTER_MM
from aadm_workbench.model import Array, BoolArray
from aadm_workbench.model.special import gammainc, gammaincinv

CHAINS = 300
"""So many draws are made at once, each from the one before it."""

_SETTLE = 8
"""Sweeps that are left out: the start is the moments' estimate, and the pose is drawn with the scatter integrated."""

_FREEDOM = 4.0
"""Of Student's law: one point in a hundred lies beyond four and a half widths."""

_PRIOR_POINTS = 1.0
"""The usual scatter of bars and sleeves counts as one pair does."""

_USUAL_VARIANCE = 2.0 * USUAL_SCATTER_MM**2  # mm²: of a bar and its sleeve together, per axis

_SMALLEST_VARIANCE = 0.05**2  # mm²: no pattern is cast to less than a twentieth
_ANYTHING = 1e6  # mm²: a metre, of a pair that need not stand like the others
_TINY = 1e-18  # keeps quotients finite

_LEAST_LEAN = 0.1
"""Of what is usual: no group stands straighter."""

_OF_A_MEDIAN = np.pi / 2.0
"""Variance of the median of many normal numbers, in that of their mean."""


@dataclass(frozen=True, eq=False)
class Measured:
    """n offsets (n, 2) mm, how they change with a turn of the bars, (n, 2), and their covariances (n, 2, 2) mm².

    ``apart`` (n,): pairs of which nothing is believed but their own measurement; they may stand off by anything.
    """

    offsets: Array
    turning: Array
    covariances: Array
    apart: BoolArray

    @property
    def by_pose(self) -> Array:
        """How the offsets change with the pose (turn, x, y): (n, 2, 3)."""
        change = np.zeros((len(self.offsets), 2, 3))
        change[:, :, 0], change[:, 0, 1], change[:, 1, 2] = self.turning, 1.0, 1.0
        return change


def true_offsets(measured: Measured, generator: np.random.Generator) -> Iterator[Array]:
    """Draws of the true offsets, (k, n, 2) mm with k = :data:`CHAINS`, again and again."""
    by_pose, alike = measured.by_pose, ~measured.apart
    variance, weight = np.full(CHAINS, _first_variance(measured)), np.ones((CHAINS, len(measured.offsets)))
    sweep = 0
    while True:
        own = np.where(alike, variance[:, None] / weight, _ANYTHING)
        inverse = _inverse(own[..., None, None] * np.eye(2) + measured.covariances)
        pose = _drawn_pose(measured, by_pose, inverse, generator)
        moved = (pose @ by_pose.reshape(-1, 3).T).reshape(len(pose), -1, 2)
        scatter = _drawn_scatter(measured, moved, own, inverse, generator)
        squares = np.where(alike, (scatter**2).sum(axis=2), 0.0)
        weight = _drawn_weights(squares / variance[:, None], generator)
        variance = _drawn_variance((weight * squares).sum(axis=1), int(alike.sum()), generator)
        sweep += 1
        if sweep > _SETTLE:
            yield scatter - moved


def _first_variance(measured: Measured) -> float:
    """Of the true scatter, per axis, by the moments."""
    count = len(measured.offsets)
    found = float((measured.offsets**2).sum()) / max(2 * count - 3, 1)
    return max(found - float(np.trace(measured.covariances, axis1=1, axis2=2).mean()) / 2.0, _USUAL_VARIANCE / 10.0)


def _inverse(matrices: Array) -> Array:
    """Inverses of symmetric matrices (..., 2, 2)."""
    a, b, c = matrices[..., 0, 0], matrices[..., 0, 1], matrices[..., 1, 1]
    adjugate = np.stack([np.stack([c, -b], axis=-1), np.stack([-b, a], axis=-1)], axis=-2)
    return np.asarray(adjugate / (a * c - b * b)[..., None, None])


def _drawn_pose(measured: Measured, by_pose: Array, inverse: Array, generator: np.random.Generator) -> Array:
    """Poses (k, 3) that lay the offsets about zero, given the law of scatter and error together."""
    weighted = (inverse @ by_pose).reshape(len(inverse), -1, 3)
    precision = by_pose.reshape(-1, 3).T @ weighted
    right = -measured.offsets.reshape(-1) @ weighted
    covariance = np.linalg.inv(precision)
    root = np.linalg.cholesky((covariance + covariance.transpose(0, 2, 1)) / 2.0)
    normal = generator.standard_normal(right.shape)
    return np.asarray((covariance @ right[:, :, None] + root @ normal[:, :, None])[:, :, 0])


def _drawn_scatter(
    measured: Measured, moved: Array, own: Array, inverse: Array, generator: np.random.Generator
) -> Array:
    """True scatter (k, n, 2) of each pair about its place in the pose."""
    gain = own[..., None, None] * inverse
    middle = (gain @ (measured.offsets + moved)[..., None])[..., 0]
    return np.asarray(middle + _coloured(gain @ measured.covariances, generator.standard_normal(middle.shape)))


def _coloured(covariances: Array, normal: Array) -> Array:
    """Normal numbers (..., 2) with these covariances (..., 2, 2)."""
    first = np.sqrt(np.maximum(covariances[..., 0, 0], _TINY))
    mixed = covariances[..., 0, 1] / first
    second = np.sqrt(np.maximum(covariances[..., 1, 1] - mixed**2, 0.0))
    x, y = normal[..., 0], normal[..., 1]
    return np.stack([first * x, mixed * x + second * y], axis=-1)


def _drawn_weights(squares: Array, generator: np.random.Generator) -> Array:
    """Weights (k, n) of the pairs, one by the normal law; ``squares`` (k, n) of the scatter in units of its width.

    The law of each draw is drawn first: by how likely either makes these squares, both being as likely before.
    """
    student = 2.0 * generator.gamma((_FREEDOM + 2.0) / 2.0, size=squares.shape) / (_FREEDOM + squares)
    by_tails = squares / 2.0 - (_FREEDOM + 2.0) / 2.0 * np.log1p(squares / _FREEDOM)
    has_tails = generator.logistic(size=len(squares)) < by_tails.sum(axis=1)
    return np.where(has_tails[:, None], student, 1.0)


def _drawn_variance(weighted_squares: Array, count: int, generator: np.random.Generator) -> Array:
    """Squared widths (k,) of the scatter: flat in the width, but for a prior that counts as some pairs do."""
    shape = count - 0.5 + _PRIOR_POINTS
    found = weighted_squares / 2.0 + _PRIOR_POINTS * _USUAL_VARIANCE
    return np.maximum(found / generator.gamma(shape, size=len(weighted_squares)), _SMALLEST_VARIANCE)


@dataclass(frozen=True, eq=False)
class MeasuredShifts:
    """How far n axes of one group were measured to lean over the embedded length, ``shifts`` (n, 2) mm.

    ``errors`` (n, 2, 2) mm² are the covariances of these measurements; ``bent_mm`` (n,) is by how much, per axis, each
    may bend where nobody saw it, which the measurement does not hold; ``usual_mm`` by how much, per axis, such axes
    lean as built, zero where the errors hold all that is known.
    """

    shifts: Array
    errors: Array
    bent_mm: Array
    usual_mm: float

    def drawn(self, count: int, generator: np.random.Generator) -> Array:
        """What the true shifts differ from the measured ones by: draws (count, n, 2).

        Axes of one group lean about a common place, as far as they are seen to; ``usual_mm`` counts as one axis more.
        What one of them differs by is partly the error of its measurement, and is drawn towards the others by that
        part. A bend below what was seen is no such error: the seen part says nothing of it, and it only adds.
        """
        normal = generator.standard_normal((2, count, *self.shifts.shape))
        bends = self.bent_mm[:, None] * normal[1]
        if self.usual_mm <= 0.0:
            return np.asarray(_coloured(self.errors, normal[0]) + bends)
        off = self.shifts - np.median(self.shifts, axis=0)
        error = float(np.trace(self.errors, axis1=1, axis2=2).mean()) / 2.0
        both = self._drawn_variance(float((off**2).sum()), error, count, generator)
        middle = np.sqrt(_OF_A_MEDIAN * both / len(off))[:, None] * generator.standard_normal((count, 2))
        variance = (both - error)[:, None, None, None]
        gain = variance * _inverse(variance * np.eye(2) + self.errors)
        left = middle[:, None] - off
        drawn = _coloured(gain @ self.errors, normal[0])
        return np.asarray(left - np.einsum("knij,knj->kni", gain, left) + drawn + bends)

    def _drawn_variance(self, squares: float, error: float, count: int, generator: np.random.Generator) -> Array:
        """Of leans and errors together, (count,) mm²: by the law of a normal sample, beyond what errors alone give."""
        half_freedom = len(self.shifts) - 1.0 + _PRIOR_POINTS
        half_squares = squares / 2.0 + _PRIOR_POINTS * (self.usual_mm**2 + error)
        least = error + (_LEAST_LEAN * self.usual_mm) ** 2
        share = generator.uniform(_TINY, 1.0, count) * gammainc(half_freedom, half_squares / least)
        drawn = half_squares / gammaincinv(half_freedom, np.maximum(share, _TINY))
        return np.asarray(np.maximum(drawn, least))
