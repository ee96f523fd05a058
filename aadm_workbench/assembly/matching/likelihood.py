"""How well a placement explains what was measured: what competing placements of one scan are compared by.

Sleeves and bars are built with a scatter that nobody knows beforehand, and single ones may be far off. So the
deviations follow Student's law in the plane, and its width is taken from the deviations themselves, with a prior: a
fit that is perfect by chance, of four points, say, is no proof.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array

DISTINCT_LOG_RATIO = 7.0
"""Another placement is ruled out where the deviations make it a thousand times (e⁷) less likely than the best one."""

CONTRADICTS_LOG_RATIO = 9.0
"""What is declared is contradicted where another placement is eight thousand times (e⁹) more likely.

More than for choosing freely: a declaration is evidence too, and of sound scans not one in a thousand may be refused.
"""

USUAL_SCATTER_MM = 0.7
"""Per axis: with it 98 % of the points keep their 2 mm (T/CCES 30-2022, 4.3.3); the prior of the width."""

_FREEDOM = 3.0  # of Student's law: one point in a hundred lies beyond six widths
_PRIOR_WEIGHT = 2.0  # the prior counts as one point does
_LEAST_SCATTER_MM = 0.1  # below it lies what scans can tell
# mm, 13 % apart: to 12 mm, beyond which nothing belongs to a place
_WIDTHS_MM = np.geomspace(_LEAST_SCATTER_MM, 12.0, 40)


def log_likelihood(radial_mm: Array) -> float:
    """Logarithm of the likelihood of radial deviations (m,) mm, at the width that suits them best.

    Only differences of it mean something, and only between placements of the same number of points: one that a
    placement leaves without a measured point counts as being as far off as a point may be.
    """
    squared = _WIDTHS_MM[:, None] ** 2
    excess = np.log1p(np.asarray(radial_mm, dtype=np.float64) ** 2 / (_FREEDOM * squared)).sum(axis=1)
    widths = np.log(squared[:, 0])
    prior = 0.5 * _PRIOR_WEIGHT * (widths + USUAL_SCATTER_MM**2 / squared[:, 0])
    return float(np.max(-len(radial_mm) * widths - 0.5 * (_FREEDOM + 2.0) * excess - prior))
