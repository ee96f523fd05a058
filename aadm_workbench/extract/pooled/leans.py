"""Leans of bars: what their sides show, and that bars of one group stand alike."""

from __future__ import annotations

import numpy as np
from scipy.special import expit

from aadm_workbench.extract.pooled.fit import PooledFit
from aadm_workbench.extract.pooled.system import Priors
from aadm_workbench.model import Array

BAR_PRIORS = Priors(
    lean=0.03, own_radius=0.02, own_push=1e-3, push=1e-3, radius=0.06, wall_to_edge=0.02, rim_to_beyond=0.03
)
"""Leans of bars that were bent, too; cores of a group are alike; a side is not pushed; edge and side are one radius."""

_BAR_LEAN_U = 7e-3  # ribs, which stand out on one side here and on the other there: half of one over 60 mm of side
USUAL_LEAN = 5e-3
"""0.3 degrees, as bars and sleeves are cast in; this product's own figure."""
_COMMON_COUNT = 4  # fewer bars have no middle that one of them does not move
_BENT_SHARE = 0.1  # of bars that lean by more than that: bent by hand, or hit


def believed_leans(fit: PooledFit, prior: float) -> tuple[Array, Array]:
    """Leans (k, 2) and covariances (k, 2, 2): what sides show, and that bars of one group stand alike.

    Most bars lean about their median by what is usual, some were bent and lean anyhow. Each is both, by the odds of the
    two: one that leans like the others, as far as its side tells, is drawn to them; one that does not is left as seen;
    between the two it is not known which, and that counts. A side that does not show tells nothing: the odds stay.
    """
    told, weight = _told_by_sides(fit, prior)
    common = np.median(fit.lean, axis=0) if len(fit.lean) >= _COMMON_COUNT else np.zeros(2)
    off = weight - told @ common
    usual, usual_off, usual_odds = _posterior(told, off, USUAL_LEAN)
    bent, bent_off, bent_odds = _posterior(told, off, BAR_PRIORS.lean)
    odds = np.log(_BENT_SHARE / (1.0 - _BENT_SHARE)) + bent_odds - usual_odds
    share = expit(odds)[:, None]
    apart = bent_off - usual_off
    unsure = (share * (1.0 - share))[..., None] * apart[:, :, None] * apart[:, None, :]
    usual = usual + np.eye(2) * (USUAL_LEAN**2 / max(len(fit.lean), 1))
    lean = common + usual_off + share * apart
    return lean, share[..., None] * bent + (1.0 - share[..., None]) * usual + unsure


def _told_by_sides(fit: PooledFit, prior: float) -> tuple[Array, Array]:
    """Information (k, 2, 2) of what sides show of leans, and that times the leans (k, 2): without the fit's prior."""
    of_prior = np.eye(2) / prior**2
    told = np.linalg.inv(fit.lean_covariance) - of_prior
    values, axes = np.linalg.eigh(told)
    told = (axes * np.maximum(values, 0.0)[:, None, :]) @ axes.transpose(0, 2, 1)
    ribs = np.linalg.inv(np.eye(2) + _BAR_LEAN_U**2 * told)
    weight = np.einsum("kij,kj->ki", told + of_prior, fit.lean)
    return ribs @ told, np.einsum("kij,kj->ki", ribs, weight)


def _posterior(told: Array, off: Array, lean: float) -> tuple[Array, Array, Array]:
    """Covariance (k, 2, 2) and mean (k, 2) of leans with a prior about zero, and its log evidence (k,)."""
    covariance = np.asarray(np.linalg.inv(told + np.eye(2) / lean**2), float)
    mean = np.einsum("kij,kj->ki", covariance, off)
    evidence = 0.5 * (np.einsum("ki,ki->k", off, mean) + np.linalg.slogdet(covariance / lean**2)[1])
    return covariance, mean, evidence
