"""Lengths that are larger or smaller as a whole than designed: a wrong camera, a wrong unit or a wrong template.

Single sleeves stand off their places at random; that also changes the scale of a pattern, by their scatter over the
root of the sum of their squared distances from the middle. What is beyond that and a play of concrete and templates is
no chance. Few points, near to each other, tell little by that alone. But a wrong camera makes everything too large: the
patterns of both scans, and the bores of the sleeves, which are machined. What each of them tells is joined by weight.
The scale is a diagnostic and never applied.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.findings.diameters import bore_against_design
from aadm_workbench.assembly.findings.finding import SeenGroup, make_finding
from aadm_workbench.assembly.matching.pattern_search import USUAL_SCATTER_MM
from aadm_workbench.model import Array, Finding, Kind

PLAY = 5e-4
"""Relative: shrinkage of concrete, 0.3 mm/m, and 20 K of temperature at 10⁻⁵ a kelvin (EN 1992-1-1, 3.1)."""

NORMAL_QUANTILE = 3.89
"""Two-sided 0.01 %: of sound scans not one in ten thousand is beyond it, play aside."""

_OF_ALL_QUANTILE = 3.0  # two-sided 0.3 %: witnesses that share nothing but the camera's lengths
_PATTERNS_QUANTILE = 1.64  # one-sided 5 %: so far the patterns have to say it, too; bores alone are another size
# of jobs, how many have intrinsics that are not the camera's, and by how much, relatively, lengths are off then: those
# of another camera of the type, or before its lens was set anew; own figures, unverified
_WRONG_SHARE, _WRONG_BY = 0.02, 0.03
_SURE = 30.0  # of a logarithm of odds: beyond it a probability is one
_PRIOR_WEIGHT = 4.0  # the usual scatter counts as so many coordinates do
# relative: what edges shift along the view, by about a pixel for each unit of its slope, is a scale; pixels are a
# two-thousandth of the distance
_ALONG_VIEW = 5e-4
_FEWEST_PAIRS = 3  # two points have one distance, and nothing to hold it against


@dataclass(frozen=True)
class Scale:
    """Measured over designed size, its standard uncertainty, and the degrees of freedom of that."""

    value: float
    u: float
    freedom: float

    @property
    def expanded(self) -> float:
        """Half-width of the range that holds the true scale in all but one of ten thousand cases."""
        return self.within(NORMAL_QUANTILE)

    @property
    def differs(self) -> bool:
        """Whether it is another than designed, beyond chance and play."""
        return abs(self.value - 1.0) > PLAY + self.expanded

    def within(self, normal_quantile: float) -> float:
        """Half-width of the range that holds the true scale as often as so many sigmas of the normal law do."""
        return student_quantile(self.freedom, normal_quantile) * self.u


def scale_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """Findings on the scale of each group by itself, of all together, and of the two against each other."""
    scales = [(group, found) for group in groups if (found := pattern_scale(group)) is not None]
    differing = [(group, scale) for group, scale in scales if scale.differs]
    apart = list(_apart(scales))
    of_all = [] if apart or len(differing) == len(scales) else list(_of_all(scales))
    yield from of_all
    for group, scale in [] if of_all else differing:
        name = group.kind.plural
        yield make_finding("scale_differs.group", [name], group=name, scale=scale.value, U=scale.expanded)
    yield from apart


def _apart(scales: Sequence[tuple[SeenGroup, Scale]]) -> Iterator[Finding]:
    """A finding where one of the two groups is larger than the other one, against the design."""
    if len(scales) < 2:
        return
    (_, first), (_, second) = scales
    expanded = student_quantile(first.freedom + second.freedom) * math.hypot(first.u, second.u)
    difference = abs(first.value - second.value)
    if difference > PLAY + expanded:
        yield make_finding("scale_differs.column", ["sleeves", "rebars"], difference=difference, U=expanded)


def _of_all(scales: Sequence[tuple[SeenGroup, Scale]]) -> Iterator[Finding]:
    """A finding where all that was scanned with one camera is too large, or too small, together."""
    patterns = [scale for _, scale in scales]
    bores = [scale for group, _ in scales if (scale := bore_scale(group)) is not None]
    about = [group.kind.plural for group, _ in scales]
    placed = pooled(patterns) if patterns else None
    if placed is not None and len(patterns) > 1 and placed.differs:
        yield make_finding("scale_differs.camera", about, scale=placed.value, U=placed.expanded)
    elif placed is not None and bores:
        yield from _with_bores(placed, pooled([*patterns, *bores]), about)


def _with_bores(placed: Scale, together: Scale, about: Sequence[str]) -> Iterator[Finding]:
    expanded = together.within(_OF_ALL_QUANTILE)
    agrees = (placed.value - 1.0) * math.copysign(1.0, together.value - 1.0) > placed.within(_PATTERNS_QUANTILE)
    if agrees and abs(together.value - 1.0) > PLAY + expanded:
        yield make_finding("scale_differs.bores", about, groups=about, scale=together.value, U=expanded)


def pooled(scales: Sequence[Scale]) -> Scale:
    """The scale of one camera, that all of these were scanned with.

    Its degrees of freedom are those of Welch and Satterthwaite (GUM, G.4.1).
    """
    weight = np.array([scale.u**-2 for scale in scales])
    value = float(weight @ [scale.value for scale in scales] / weight.sum())
    freedom = float(weight.sum() ** 2 / (weight**2 @ [1.0 / scale.freedom for scale in scales]))
    return Scale(value, float(weight.sum() ** -0.5), freedom)


def doubted_scale_error(group: SeenGroup, others: Sequence[SeenGroup] = ()) -> float:
    """Relative standard uncertainty of the lengths of a scan, with what speaks against them: it, and ``others``.

    A scan whose pattern, with its bores and other scans of the camera, is likelier to have been made with wrong
    intrinsics than with right ones may have been: what it would be off then counts by the probability of that (Bayes'
    rule, the prior is ours).
    """
    told = [(pattern_scale(one), bore_scale(one)) for one in (group, *others)]
    scales = [scale for both in told for scale in both if scale is not None]
    if told[0][0] is None:
        return group.scale_error
    together = pooled(scales)
    off, variance = together.value - 1.0, together.u**2 + PLAY**2
    if_wrong = variance + _WRONG_BY**2
    log_ratio = 0.5 * (math.log(variance / if_wrong) + off**2 * (1.0 / variance - 1.0 / if_wrong))
    if log_ratio <= 0.0:
        return group.scale_error
    odds = _WRONG_SHARE / (1.0 - _WRONG_SHARE) * math.exp(min(log_ratio, _SURE))
    share = _WRONG_BY**2 / if_wrong  # of what is seen, what a wrong scale has of it
    square = (share * off) ** 2 + share * variance
    return math.hypot(group.scale_error, math.sqrt(odds / (1.0 + odds) * square))


def pattern_scale(group: SeenGroup) -> Scale | None:
    """Scale of the measured pattern against the design, by least squares; None for too few points.

    Its uncertainty holds the scatter of the points about the scaled pattern, pooled with the usual one, their own
    uncertainties, and that of the camera's lengths.
    """
    pairs = group.placed()  # places that fit alike are as far apart
    if len(pairs) < _FEWEST_PAIRS:
        return None
    design = np.array([target.centre[:2] for target, _ in pairs])
    measured = np.array([point.point.centre[:2] for _, point in pairs])
    about, seen = design - design.mean(axis=0), measured - measured.mean(axis=0)
    spread = float((about**2).sum())
    # A similarity as a complex factor: measured = factor · design.
    factor = complex(float((seen * about).sum()), float((_cross(about, seen)).sum())) / spread
    left = seen - np.column_stack(
        [factor.real * about[:, 0] - factor.imag * about[:, 1], factor.imag * about[:, 0] + factor.real * about[:, 1]]
    )
    freedom = 2 * len(pairs) - 4 + _PRIOR_WEIGHT
    variance = (float((left**2).sum()) + _PRIOR_WEIGHT * USUAL_SCATTER_MM**2) / freedom
    return Scale(abs(factor), math.hypot(math.sqrt(variance / spread), group.scale_error, _ALONG_VIEW), freedom)


def bore_scale(group: SeenGroup) -> Scale | None:
    """Scale of the bores of sleeves against the design, by a method that states what its diameters are off together.

    None for bars, whose cores differ by more than cameras do.
    """
    if group.kind is not Kind.SLEEVE or group.extraction.method != "refined":
        return None
    told = bore_against_design(group)
    return None if told is None else Scale(told.value, told.u, math.inf)


def student_quantile(freedom: float, normal_quantile: float = NORMAL_QUANTILE) -> float:
    """Quantile of Student's law, two-sided 0.01 % or that of another quantile of the normal law.

    The expansion of Cornish and Fisher, its first three terms as Abramowitz and Stegun give them (26.7.5): within 4 %
    from eight degrees on.
    """
    z = normal_quantile
    first = (z**3 + z) / 4.0
    second = (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0  # (26.7.5)
    third = (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0  # (26.7.5)
    return z + first / freedom + second / freedom**2 + third / freedom**3


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
