"""A pattern that is larger or smaller as a whole than designed: a wrong camera, a wrong unit or a wrong template.

Single sleeves stand off their places at random; that also changes the scale of a fit, by their scatter over the root of
the sum of their squared distances from the middle. What is beyond that and a play of concrete and templates is no
chance. The scale is a diagnostic and never applied.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.assembly.matching.likelihood import USUAL_SCATTER_MM
from aadm_workbench.model import Array, Finding

PLAY = 5e-4
"""Relative: shrinkage of concrete, 0.3 mm/m, and 20 K of temperature at 10⁻⁵ a kelvin (EN 1992-1-1, 3.1)."""

NORMAL_QUANTILE = 3.89
"""Two-sided 0.01 %: of sound scans not one in ten thousand is beyond it, play aside."""

_PRIOR_WEIGHT = 4.0  # the usual scatter counts as so many coordinates do
_FEWEST = 3  # two points have one distance, and nothing to hold it against


@dataclass(frozen=True)
class Scale:
    """Measured over designed size of a pattern, its standard uncertainty, and the degrees of freedom of that."""

    value: float
    u: float
    freedom: float

    @property
    def expanded(self) -> float:
        """Half-width of the range that holds the true scale in all but one of ten thousand cases."""
        return student_quantile(self.freedom) * self.u

    @property
    def differs(self) -> bool:
        """Whether it is another than designed, beyond chance and play."""
        return abs(self.value - 1.0) > PLAY + self.expanded


def scale_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """Findings on the scale of each group by itself, and of the two against each other."""
    scales = [(group, found) for group in groups if (found := pattern_scale(group)) is not None]
    differing = [(group, scale) for group, scale in scales if scale.differs]
    for group, scale in differing:
        name = group.kind.plural
        yield make_finding("scale_differs.group", [name], group=name, scale=scale.value, U=scale.expanded)
    if len(scales) == 2:
        both = _pooled([scale for _, scale in scales])
        if not differing and both.differs:
            yield make_finding("scale_differs.camera", ["sleeves", "rebars"], scale=both.value, U=both.expanded)
        (_, first), (_, second) = scales
        u = math.hypot(first.u, second.u)
        expanded = student_quantile(first.freedom + second.freedom) * u
        difference = abs(first.value - second.value)
        if difference > PLAY + expanded:
            yield make_finding("scale_differs.column", ["sleeves", "rebars"], difference=difference, U=expanded)


def _pooled(scales: Sequence[Scale]) -> Scale:
    """The scale of one camera, that all of the patterns were scanned with: small ones tell it together."""
    weight = np.array([scale.u**-2 for scale in scales])
    value = float(weight @ [scale.value for scale in scales] / weight.sum())
    return Scale(value, float(weight.sum() ** -0.5), sum(scale.freedom for scale in scales))


def pattern_scale(group: SeenGroup) -> Scale | None:
    """Scale of the measured pattern against the design, by least squares; None for too few points.

    Its uncertainty holds the scatter of the points about the scaled pattern, pooled with the usual one, their own
    uncertainties, and that of the camera's lengths.
    """
    if group.match and group.match.orientation == "ambiguous":
        return None
    pairs = group.placed()
    if len(pairs) < _FEWEST:
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
    return Scale(abs(factor), math.hypot(math.sqrt(variance / spread), group.scale_error), freedom)


def student_quantile(freedom: float) -> float:
    """Two-sided 0.01 % of Student's law, by the expansion of Cornish and Fisher: within 4 % from eight degrees on."""
    z = NORMAL_QUANTILE
    first = (z**3 + z) / 4.0
    second = (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0
    third = (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0
    return z + first / freedom + second / freedom**2 + third / freedom**3


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
