"""A gauge study of repeat captures: what repeats, what does not, and whether the stated uncertainty is believable.

The terms and thresholds are those of AIAG, *Measurement Systems Analysis*, 4th edition: %GRR under 10 is acceptable,
over 30 is not, and a gauge tells five or more categories apart. The stated uncertainty is compared with the same
analysis of values over their own u: what captures scatter, in units of what was stated.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.calibration.gauge.anova import Anova, Estimate, Variances, analysed, variances_of
from aadm_workbench.calibration.gauge.captures import Capture, Study, studies_of
from aadm_workbench.model import Array, Reason, Verdict, worst

_SIX = 6.0
"""Standard deviations that a tolerance is compared with: what the manual has since its 3rd edition."""

_ACCEPTABLE, _UNACCEPTABLE = 10.0, 30.0  # %GRR: the manual's
_CATEGORIES = 1.41  # the root of two: 97 % intervals of the gauge side by side, as the manual has it
_HALF_TOO_SMALL = 2.0
"""The ratio of scatter to stated u from which on an uncertainty is half of what it should be: a study that cannot
exclude it has not decided."""

LIMITS_MM = (2.0, 3.0)
"""The limits that a column meets: of a centre against design, and of a bar against its sleeve."""


@dataclass(frozen=True, slots=True)
class AgainstLimit:
    """A gauge against one limit, ± so many mm: ``percent`` is six standard deviations over the whole range."""

    limit_mm: float
    percent: Estimate
    categories: int
    verdict: Verdict


@dataclass(frozen=True, slots=True)
class StatedU:
    """The scatter of captures over the stated uncertainty: ``ratio``; what follows of it in one sentence."""

    ratio: Estimate | None
    u_mm: float | None
    verdict: Verdict
    reason: Reason


@dataclass(frozen=True, eq=False)
class QuantityStudy:
    """What a study of one quantity comes to; ``percent_of_study`` and ``categories`` are against the parts themselves.

    Variances are in mm² per axis.
    """

    study: Study
    table: Anova
    variances: Variances
    percent_of_study: Estimate
    categories: int
    against: tuple[AgainstLimit, ...]
    stated: StatedU


@dataclass(frozen=True, eq=False)
class GaugeStudy:
    """All quantities that were measured often enough, and why others were not."""

    captures: tuple[Capture, ...]
    quantities: tuple[QuantityStudy, ...]
    not_studied: tuple[Reason, ...]

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """What is judged: the gauge against the limit of its quantity, and the stated uncertainty."""
        found = [one.stated.verdict for one in self.quantities]
        found += [worst([*(limit.verdict for limit in judged(one))]) for one in self.quantities if judged(one)]
        return tuple(found) or (Verdict.NOT_MEASURED,)


def judged(found: QuantityStudy) -> tuple[AgainstLimit, ...]:
    """The gauge against the limit that the quantity itself has; against others it is told and not judged."""
    return tuple(one for one in found.against if one.limit_mm == found.study.limit_mm)


def gauge_study(captures: Sequence[Capture], rng: np.random.Generator) -> GaugeStudy:
    """Study repeat captures; ``rng`` draws the intervals."""
    found = studies_of(captures)
    return GaugeStudy(
        tuple(captures),
        tuple(_studied(one, rng) for one in found if isinstance(one, Study)),
        tuple(one for one in found if isinstance(one, Reason)),
    )


def _studied(study: Study, rng: np.random.Generator) -> QuantityStudy:
    table = analysed(study.values)
    variances = variances_of(table, rng)
    gauge, parts = variances.gauge, variances.parts
    total = math.sqrt(gauge.value + parts.value)
    limits = sorted({*LIMITS_MM, *([] if study.limit_mm is None else [study.limit_mm])})
    return QuantityStudy(
        study,
        table,
        variances,
        _scaled_root(gauge, 100.0 / total if total > 0.0 else 0.0),
        _categories(parts.value, gauge.value),
        tuple(_against(limit_mm, gauge) for limit_mm in limits),
        _stated(study, rng),
    )


def _scaled_root(variance: Estimate, factor: float) -> Estimate:
    return Estimate(*(factor * math.sqrt(value) for value in (variance.value, variance.low, variance.high)))


def _categories(parts: float, gauge: float) -> int:
    """Number of distinct categories, cut off: one where parts do not stand out, a hundred at most."""
    if gauge <= parts * (_CATEGORIES / _MOST_CATEGORIES) ** 2:
        return _MOST_CATEGORIES
    return max(1, int(_CATEGORIES * math.sqrt(parts / gauge)))


_MOST_CATEGORIES = 100  # finer ones tell nobody anything


def _against(limit_mm: float, gauge: Estimate) -> AgainstLimit:
    tolerance_mm = 2.0 * limit_mm
    percent = _scaled_root(gauge, 100.0 * _SIX / tolerance_mm)
    allowed = (tolerance_mm / _SIX) ** 2
    verdict = (
        Verdict.PASS
        if percent.value < _ACCEPTABLE
        else Verdict.FAIL
        if percent.value > _UNACCEPTABLE
        else Verdict.INCONCLUSIVE
    )
    return AgainstLimit(limit_mm, percent, _categories(max(0.0, allowed - gauge.value), gauge.value), verdict)


def _stated(study: Study, rng: np.random.Generator) -> StatedU:
    own = np.sqrt(np.mean(study.u_mm**2, axis=(1, 2)))
    if not np.isfinite(own).all() or not (own > 0.0).all():
        return StatedU(None, None, Verdict.NOT_MEASURED, Reason("gauge.u_not_stated"))
    ratio = _scaled_root(variances_of(analysed(study.values / own[:, None, None]), rng).gauge, 1.0)
    verdict, code = _believed(ratio)
    said = Reason(code, ratio=ratio.value, low=ratio.low, high=ratio.high)
    return StatedU(ratio, _usual(own), verdict, said)


def _usual(own: Array) -> float:
    return float(np.sqrt(np.mean(own**2)))


def _believed(ratio: Estimate) -> tuple[Verdict, str]:
    if ratio.low > 1.0:
        return Verdict.FAIL, "gauge.u_too_small"
    if ratio.high < 1.0:
        return Verdict.PASS, "gauge.u_covers"
    if ratio.high < _HALF_TOO_SMALL:
        return Verdict.PASS, "gauge.u_believable"
    return Verdict.INCONCLUSIVE, "gauge.u_open"
