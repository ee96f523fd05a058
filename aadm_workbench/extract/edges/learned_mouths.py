"""Mouths of sleeves, their centres drawn to what is known of the camera's edges."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from aadm_workbench.extract.edges.edge_shift import PARTS_VIEW_MM, BentDiscs
from aadm_workbench.extract.edges.learned_edges import (
    DISC_U_PITCHES,
    LEARNED_BAND_MM,
    NEAR_DISC_MM,
    KnownEdges,
    with_learned_discs,
    without_losses,
    without_view,
)
from aadm_workbench.extract.edges.seen_disc import SightLines, seen_discs
from aadm_workbench.extract.mouths import Mouths
from aadm_workbench.extract.pooled.fit import PooledFit
from aadm_workbench.model import BoolArray

_BY_BORES = 1.0  # rings at which the radius is that of the bores, whatever the rims show

FitOfDiscs: TypeAlias = Callable[[Mouths, BentDiscs, BoolArray, float, float], PooledFit]
"""From mouths, discs of those that are whole, their diameter and the pitch, mm, to the fit of discs and bores."""


def mouths_as_learned(
    fit: PooledFit, mouths: Mouths, lines: SightLines, radius_mm: float, known: KnownEdges, fit_of: FitOfDiscs
) -> tuple[PooledFit, dict[str, float]]:
    """The fit, its centres drawn to discs of lines of sight set right by what was learned, and to the bores.

    What chamfers do along the view moves discs, and hardly the fit of rims and bores: that part is the fit's. And how
    many pixels those discs are larger than the bores: edges of the camera that was learned are where bores begin.
    """
    lines, on = without_losses(lines, fit.centre, 1.0, known), np.abs(lines.height) < LEARNED_BAND_MM
    seen = seen_discs(lines, on, fit.centre, radius_mm, known.pitch_mm, 1.0)
    whole = np.hypot(*(seen.centre - fit.centre).T) < NEAR_DISC_MM
    if not whole.any():
        return fit, {}
    own = seen.covariance + (DISC_U_PITCHES * known.pitch_mm) ** 2 * np.eye(2)
    nothing = np.zeros((int(whole.sum()), 2, 2))
    discs = BentDiscs(seen.centre[whole], own[whole], nothing, seen.radius, 0.0, _BY_BORES)
    joint = fit_of(mouths, discs, whole, 2.0 * radius_mm, known.pitch_mm)
    off = {"learned_edges_off_pixels": (seen.radius - float(np.median(joint.radius))) / known.pitch_mm}
    joint = replace(joint, centre=without_view(joint.centre, fit.centre, lines.slope))
    return with_learned_discs(fit, joint, whole, lines.slope, known, PARTS_VIEW_MM[1.0]), off
