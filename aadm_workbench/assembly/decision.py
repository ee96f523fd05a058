"""From a deviation, its uncertainty and a limit to a verdict.

A deviation in the plane is a length, so with equal uncertainties per axis it follows the Rice law and in general
the normal law integrated over the disc of the limit; signed deviations follow the normal law (JCGM 106:2012, 7).
A guarded decision asks for 95 % of conformance probability before it says pass or fail, after ISO 14253-1:2017. It
fails only what the measured value itself says is beyond the limit: with a large uncertainty hardly any value has 5 % of
probability, and ignorance is no proof.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal, TypeAlias, TypeVar

import numpy as np

from aadm_workbench.model import Array, PointResult, Reason, SpacingResult, Verdict

DecisionRule: TypeAlias = Literal["guarded", "simple"]

PASS_PROBABILITY = 0.95
"""Probability from which on a deviation is within its limit: the default of ISO 14253-1:2017."""
FAIL_PROBABILITY = 0.05
"""Probability up to which it is beyond it: the same, for the other side."""

_TAIL_SIGMAS = 9.0  # beyond lie 2e-19 of a normal law, less than a double can add to one
_SURE_SIGMAS = 2.5  # exp(-2.5²/2) is 4.4 %, Q(2.5) far less: both within what a pass and a fail need
_NODES = 160  # of Gauss and Legendre: nine to each of 18 standard deviations

Result = TypeVar("Result", PointResult, SpacingResult)

AMBIGUOUS_POINT = Reason("assembly.turn_decides")


@dataclass(frozen=True)
class Decision:
    """A verdict and the probability, None for a simple decision, that the true value is within the limit."""

    verdict: Verdict
    probability: float | None


def decide_probability(probability: float, within: bool) -> Verdict:
    """Verdict of a guarded decision, from the probability and on which side of its limit the measured value is.

    At least 95 % of a value within its limit is a pass, at most 5 % of one beyond it a fail, all else inconclusive.
    """
    if within:
        return Verdict.PASS if probability >= PASS_PROBABILITY else Verdict.INCONCLUSIVE
    return Verdict.FAIL if probability <= FAIL_PROBABILITY else Verdict.INCONCLUSIVE


def decide_radial(offset_mm: Array, covariance: Array | None, limit_mm: float, decision: DecisionRule) -> Decision:
    """Whether a point in the plane lies within ``limit_mm`` of where it should be.

    Parameters
    ----------
    offset_mm
        (2,) float64, measured minus nominal.
    covariance
        (2, 2) float64, mm², of the offset; None where unknown, then the value alone is compared.
    limit_mm
        Radius of the permitted disc; a value on the limit passes.
    """
    within = math.hypot(float(offset_mm[0]), float(offset_mm[1])) <= limit_mm
    if decision == "simple" or covariance is None:
        return Decision(Verdict.PASS if within else Verdict.FAIL, None)
    probability = probability_within_disc(offset_mm, covariance, limit_mm)
    return Decision(decide_probability(probability, within), probability)


def verdict_radial(offset_mm: Array, covariance: Array | None, limit_mm: float, decision: DecisionRule) -> Verdict:
    """The verdict of :func:`decide_radial` alone; what is far from the limit needs no integral.

    Along its widest axis an offset errs by ``u``; it is d beyond, or within, the rim with a probability of at most
    Q(d/u), or exp(-(d/u)²/2).
    """
    if decision == "simple" or covariance is None:
        return decide_radial(offset_mm, covariance, limit_mm, decision).verdict
    inside_mm = limit_mm - math.hypot(float(offset_mm[0]), float(offset_mm[1]))
    u_mm = math.sqrt(max(float(np.linalg.eigvalsh(covariance)[-1]), 0.0))
    if inside_mm > _SURE_SIGMAS * u_mm:
        return Verdict.PASS
    if inside_mm < -_SURE_SIGMAS * u_mm:
        return Verdict.FAIL
    return decide_radial(offset_mm, covariance, limit_mm, decision).verdict


def decide_per_axis(offset_mm: Array, covariance: Array | None, limit_mm: float, decision: DecisionRule) -> Decision:
    """Whether both components of an offset lie within ±``limit_mm``; as :func:`decide_radial`."""
    within = float(np.abs(offset_mm).max()) <= limit_mm
    if decision == "simple" or covariance is None:
        return Decision(Verdict.PASS if within else Verdict.FAIL, None)
    probability = probability_within_square(offset_mm, covariance, limit_mm)
    return Decision(decide_probability(probability, within), probability)


def decide_signed(
    value_mm: float, u_mm: float | None, lower_mm: float | None, upper_mm: float, decision: DecisionRule
) -> Decision:
    """Whether a signed value lies between its limits (``lower_mm`` None: it has only an upper one)."""
    lower = -math.inf if lower_mm is None else lower_mm
    within = lower <= value_mm <= upper_mm
    if decision == "simple" or u_mm is None:
        return Decision(Verdict.PASS if within else Verdict.FAIL, None)
    probability = probability_between(value_mm, u_mm, lower, upper_mm)
    return Decision(decide_probability(probability, within), probability)


def probability_between(value: float, u: float, lower: float, upper: float) -> float:
    """Probability that the true value is in [lower, upper], p = Φ((upper−y)/u) − Φ((lower−y)/u) (JCGM 106, 7.4)."""
    if u <= 0.0:
        return float(lower <= value <= upper)
    return _normal_cdf((upper - value) / u) - _normal_cdf((lower - value) / u)


def probability_within_disc(offset: Array, covariance: Array, radius: float) -> float:
    """Probability that the true offset is within ``radius`` of the origin, its law normal about ``offset``.

    Parameters
    ----------
    offset
        (2,) float64, mm.
    covariance
        (2, 2) float64, mm²; it may be singular or zero.

    Notes
    -----
    In the principal axes of the covariance: along the wider one the integral is a difference of Φ, along the
    narrower one it is a Gauss–Legendre sum over y = radius·sin φ, which has no kink at the rim of the disc.
    For equal axes this is the Rice law, 1 − Q₁(|offset|/σ, radius/σ).
    """
    variances, axes = np.linalg.eigh(covariance)
    narrow, wide = (float(value) for value in np.asarray(offset) @ axes)
    sigma_narrow, sigma_wide = (float(value) for value in np.sqrt(np.maximum(variances, 0.0)))
    if radius <= 0.0:
        return 0.0
    length = math.hypot(narrow, wide)
    if abs(radius - length) >= _TAIL_SIGMAS * sigma_wide:  # so far from the rim that the rest is below rounding
        return float(length < radius)
    if sigma_narrow <= 1e-12 * radius:
        chord = math.sqrt(max(radius**2 - narrow**2, 0.0)) if abs(narrow) <= radius else -1.0
        return probability_between(wide, sigma_wide, -chord, chord) if chord >= 0.0 else 0.0
    low, high = (
        math.asin(min(max((narrow + side * _TAIL_SIGMAS * sigma_narrow) / radius, -1.0), 1.0)) for side in (-1, 1)
    )
    nodes, weights = _quadrature()
    angle = 0.5 * (high - low) * nodes + 0.5 * (high + low)
    across, chord_half = radius * np.sin(angle), radius * np.cos(angle)
    density = np.exp(-0.5 * ((across - narrow) / sigma_narrow) ** 2) / (sigma_narrow * math.sqrt(2.0 * math.pi))
    inner = [probability_between(wide, sigma_wide, -float(half), float(half)) for half in chord_half]
    return _clip(0.5 * (high - low) * float(np.sum(weights * density * chord_half * np.array(inner))))


def probability_within_square(offset: Array, covariance: Array, half_width: float) -> float:
    """Probability that both components of the true offset are within ±``half_width``; as the disc."""
    order = [0, 1] if covariance[0, 0] <= covariance[1, 1] else [1, 0]
    first, second = (float(value) for value in np.asarray(offset)[order])
    variances = covariance[np.ix_(order, order)]
    sigma = math.sqrt(max(float(variances[0, 0]), 0.0))
    if sigma <= 1e-12 * half_width:
        return float(abs(first) <= half_width) * probability_between(
            second, math.sqrt(max(float(variances[1, 1]), 0.0)), -half_width, half_width
        )
    slope = float(variances[0, 1] / variances[0, 0])
    rest = math.sqrt(max(float(variances[1, 1] - slope * variances[0, 1]), 0.0))
    low = max(first - _TAIL_SIGMAS * sigma, -half_width)
    high = min(first + _TAIL_SIGMAS * sigma, half_width)
    if low >= high:
        return 0.0
    nodes, weights = _quadrature()
    along = 0.5 * (high - low) * nodes + 0.5 * (high + low)
    density = np.exp(-0.5 * ((along - first) / sigma) ** 2) / (sigma * math.sqrt(2.0 * math.pi))
    inner = [probability_between(second + slope * (x - first), rest, -half_width, half_width) for x in along.tolist()]
    return _clip(0.5 * (high - low) * float(np.sum(weights * density * np.array(inner))))


def standard_uncertainty(covariance: Array | None) -> float | None:
    """Standard uncertainty per axis, mm, of a point in the plane: root of the mean of the two variances."""
    return None if covariance is None else math.sqrt(max(float(np.trace(covariance)) / 2.0, 0.0))


def _normal_cdf(z: float) -> float:
    return 0.5 * math.erfc(-z / math.sqrt(2.0))


def _clip(probability: float) -> float:
    return min(max(probability, 0.0), 1.0)


@cache
def _quadrature() -> tuple[Array, Array]:
    # Built when first needed: it costs a few milliseconds that a simple decision does not owe.
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    return nodes, weights


def agreed(verdicts: Iterable[Verdict]) -> Verdict:
    """The verdict of all candidates where they agree, else inconclusive; of none, not measured."""
    present = set(verdicts)
    if not present:
        return Verdict.NOT_MEASURED
    return present.pop() if len(present) == 1 else Verdict.INCONCLUSIVE


def agree_on_points(candidates: Sequence[Sequence[PointResult]]) -> tuple[PointResult, ...]:
    """The points as the first candidate has them, with the verdicts that all candidates agree on."""
    return tuple(_agreed(same, {"what": same[0].label}) for same in zip(*candidates, strict=True))


def agree_on_spacing(candidates: Sequence[Sequence[SpacingResult]]) -> tuple[SpacingResult, ...]:
    """The spacings as the first candidate has them, with the verdicts that all candidates agree on."""
    return tuple(
        _agreed(same, dict(zip(("first", "second"), same[0].between, strict=True)))
        for same in zip(*candidates, strict=True)
    )


def _agreed(same: tuple[Result, ...], called: Mapping[str, str]) -> Result:
    if len({other.verdict for other in same}) == 1:
        return same[0]
    code = "said.of" if "what" in called else "said.between"
    return replace(same[0], verdict=Verdict.INCONCLUSIVE, reason=Reason(code, **called, why=AMBIGUOUS_POINT))
