"""Where to start a fit of discs from: the likeliest circles of one radius, on a grid.

Robust fits mislead where ribs stand out on half of an outline: half a rib makes an outline that a larger, shifted
circle fits well, so the radius cannot come from all features alike. Ribs only ever add. Each feature is fitted with
a radius of its own, and the lower quartile of these is the radius of the core; with it each centre follows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aadm_workbench.extract.plan_points import in_rows
from aadm_workbench.extract.pooled.edge_law import BracketLaw, RimLaw
from aadm_workbench.model import Array, BoolArray

_POINTS_MAX = 30  # of each kind and feature
# first centres are right within a millimetre, at a fourth of it each; then the steps that are promised
_SHIFTS_MM = np.arange(-0.9, 0.91, 0.225), np.arange(-0.15, 0.16, 0.05)
# a core may be that much smaller or larger than nominal; then the same steps
_RADII_MM = np.arange(-1.0, 1.01, 0.25), np.arange(-0.15, 0.16, 0.05)
_CORE_PERCENTILE = 25.0  # the lower quartile: ribs only ever add to a radius
# half of the finest step; as far as rays that pass a top are looked for; past the end of any table
_TABLE_STEP_MM, _TABLE_REACH_MM, _FAR = 0.025, 6.0, 1_000_000


@dataclass(frozen=True, eq=False)
class CircleEvidence:
    """Points of one kind about each feature: ``xy`` (k, m, 2) mm, which are there, and their law.

    ``side`` is +1 where the points lie outside of the circle, -1 where inside.
    """

    xy: Array
    seen: BoolArray
    law: RimLaw | BracketLaw
    side: float


def likeliest_circles(evidence: list[CircleEvidence], centres: Array, radius_mm: float) -> tuple[Array, float]:
    """Centres (k, 2) and the one radius, mm, of discs near some centres (k, 2), to about 0.05 mm."""
    thin = [_Tabled(part) for part in evidence]
    count = len(centres)
    radii = radius_mm + np.tile(_RADII_MM[0], (count, 1))
    near, own = _likeliest(thin, centres, radii, _SHIFTS_MM[0])
    _, own = _likeliest(thin, near, own[:, None] + _RADII_MM[1], _SHIFTS_MM[1])
    core_mm = float(np.percentile(own, _CORE_PERCENTILE))
    radii = np.full((count, 1), core_mm)
    near, _ = _likeliest(thin, centres, radii, _SHIFTS_MM[0])
    return _likeliest(thin, near, radii, _SHIFTS_MM[1])[0], core_mm


class _Tabled:
    """A thinned part of the evidence, and the cost of its law in steps of distance."""

    def __init__(self, evidence: CircleEvidence) -> None:
        self.xy, self.seen = _thinned(evidence.xy, evidence.seen)
        off = np.arange(-_TABLE_REACH_MM, _TABLE_REACH_MM, _TABLE_STEP_MM)
        self._cost = evidence.law.cost(evidence.side * off).astype(np.float32)
        self._cost[-1] = 0.0  # of what is farther away, and of padding

    def costs(self, centres: Array, shifts: Array, radii: Array) -> npt.NDArray[np.float32]:
        """Cost (k, radii, shifts) of circles about ``centres + shifts`` (k, s, 2) with ``radii`` (k, r)."""
        about = (self.xy - centres[:, None]).astype(np.float32)
        moved = shifts.astype(np.float32)
        x = about[:, None, :, 0] - moved[:, None, 0]
        y = about[:, None, :, 1] - moved[:, None, 1]
        steps = (np.sqrt(x * x + y * y) / np.float32(_TABLE_STEP_MM)).astype(np.int32)
        steps[~np.broadcast_to(self.seen[:, None], steps.shape)] = _FAR
        first = np.rint((radii - _TABLE_REACH_MM) / _TABLE_STEP_MM).astype(np.int32)
        answer = np.empty((*radii.shape, len(shifts)), np.float32)
        for place in range(radii.shape[1]):
            cost = np.take(self._cost, steps - first[:, place, None, None], mode="clip")
            answer[:, place] = cost.sum(axis=2)
        return answer


def _likeliest(parts: list[_Tabled], centres: Array, radii: Array, steps_mm: Array) -> tuple[Array, Array]:
    """The most likely centre (k, 2) and radius (k,) on a grid around each centre."""
    shifts = np.stack(np.meshgrid(steps_mm, steps_mm), -1).reshape(-1, 2)
    costs = sum(part.costs(centres, shifts, radii) for part in parts)
    best = np.asarray(costs).reshape(len(centres), -1).argmin(axis=1)
    which, where = np.divmod(best, len(shifts))
    return centres + shifts[where], radii[np.arange(len(centres)), which]


def _thinned(xy: Array, seen: BoolArray) -> tuple[Array, BoolArray]:
    """At most so many points of each feature, evenly taken."""
    rank = np.cumsum(seen, axis=1) - 1
    step = seen.sum(axis=1) // _POINTS_MAX + 1
    chosen = seen & (rank % step[:, None] == 0)
    owner = np.nonzero(chosen)[0]
    return in_rows(xy[chosen], owner, len(xy))
