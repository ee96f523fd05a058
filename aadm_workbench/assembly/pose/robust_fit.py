"""How far each point stands from the place that most of the others give it: for blame, never for a verdict.

Least squares spreads the error of one point over all: one bar that is 7.5 mm off moves the fit by more than half a
millimetre, and innocent neighbours seem to fail. Least absolute distances leave the error with the point that has it.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.assembly.pose.upright import turn
from aadm_workbench.model import Array

_ROUNDS = 60  # a cap: a choice, not tuned since
_SMALLEST_MM = 0.02
"""Distances below this count alike: no scan resolves less, and a weight may not grow without end."""


def robust_offsets(measured: Array, design: Array) -> Array:
    """Offsets (n, 2) mm, measured minus design, after the planar fit with the least sum of absolute distances.

    Parameters
    ----------
    measured, design
        (n, 2) float64, mm; row i of one belongs to row i of the other.
    """
    fit = fit_eopa_planar(measured, design)
    if isinstance(fit, NoFit):
        return np.asarray(measured - design)
    residuals = fit.residuals
    for _ in range(_ROUNDS):
        weights = 1.0 / np.maximum(np.hypot(*residuals.T), _SMALLEST_MM)
        residuals = _weighted(measured, design, weights / weights.sum())
    return np.asarray(residuals)


def _weighted(measured: Array, design: Array, share: Array) -> Array:
    """Residuals (n, 2) of the planar fit of weighted squares; ``share`` (n,) has the sum 1."""
    middle, centre = share @ measured, share @ design
    a, b = measured - middle, design - centre
    yaw = float(np.arctan2(share @ (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), share @ (a * b).sum(axis=1)))
    return np.asarray(a @ turn(yaw).T - b)
