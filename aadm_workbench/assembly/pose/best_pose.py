"""The pose that leaves most of what is allowed: of the distances, and of the room over the ribs, each of its own.

It is the pose with the smallest largest ratio of a gap to its limit (:mod:`.minimax`), taken over the gaps of the
centres and of the axes at both ends of the embedded length (:mod:`.constraints`). Where it leaves nothing, no pose
does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.constraints import Gaps, gaps_of
from aadm_workbench.assembly.pose.eopa import NoFit
from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.model import Array

WITHIN = 1.0 + 1e-9
"""A largest ratio up to this is within its limits: rounding."""

SMALLEST_LIMIT_MM = 0.01
"""Stands for a room of zero or below, where a pose is still wanted."""


@dataclass(frozen=True, eq=False)
class BestFit:
    """The best pose, radians and (2,) mm of bars onto sleeves, and its gaps.

    ``ratio`` is the largest ratio of a gap to its limit, infinite where a bar is as wide as its sleeve; ``multipliers``
    (n,) say how much each pair decides, with the sum 1, and ``gap_multipliers`` (c,) each of its gaps.
    """

    yaw: float
    shift: Array
    ratio: float
    multipliers: Array
    gaps: Gaps
    gap_multipliers: Array

    @property
    def margin(self) -> float | None:
        """1 minus the largest ratio: negative where no pose meets all limits; None where a bar has no room at all."""
        return 1.0 - self.ratio if np.isfinite(self.ratio) else None

    @property
    def exists(self) -> bool:
        """Whether by value alone a pose meets all limits."""
        return self.ratio <= WITHIN


def fit_best_pose(pairs: Sequence[Pair], limits_mm: Array) -> BestFit | NoFit:
    """The pose with the largest margin of distances and rooms.

    Parameters
    ----------
    limits_mm
        (n,) float64, above zero, of the distance of each pair.
    """
    gaps = gaps_of(pairs, limits_mm)
    hopeless = gaps.limits_mm <= 0.0
    fit = fit_minimax(gaps.source, gaps.target, np.maximum(gaps.limits_mm, SMALLEST_LIMIT_MM))
    if isinstance(fit, NoFit):
        return fit
    multipliers = np.zeros(len(pairs))
    np.add.at(multipliers, gaps.owner, fit.multipliers)
    ratio = float("inf") if hopeless.any() else fit.ratio
    return BestFit(fit.yaw, fit.shift, ratio, multipliers, gaps, fit.multipliers)
