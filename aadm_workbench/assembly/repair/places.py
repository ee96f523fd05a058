"""Where a bar may stand once it is bent: inside its sleeve, near its own place, not too far from where it is.

A bent bar keeps its lean, unless that alone takes more room than its sleeve has: then it must be set upright.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.best_pose import leans_at
from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.model import Array

_STEPS = 21  # places along a line of some tenths of a millimetre
_ROUNDS = 60  # projections onto three discs at most: they settle to a nanometre unless the discs hardly meet


@dataclass(frozen=True, eq=False)
class FreePlace:
    """The disc in which a bent bar may stand: its middle (2,) mm from the sleeve's centre, its radius in mm.

    A radius of zero or below: no place at all. ``upright``: only for a bar that is also set upright.
    """

    middle: Array
    radius_mm: float
    upright: bool = False


def free_place(pair: Pair, limit_mm: float, yaw: float) -> FreePlace:
    """A disc of offsets that meet the limit of the distance and leave room over the ribs; about the largest one."""
    if pair.room_mm is None:
        return FreePlace(np.zeros(2), limit_mm)
    bar_lean, sleeve_lean = leans_at(pair, yaw)
    leaning = _widest(limit_mm, pair.room_mm, bar_lean, sleeve_lean)
    if leaning.radius_mm > 0.0:
        return leaning
    straight = _widest(limit_mm, pair.room_mm, np.zeros(2), sleeve_lean)
    return FreePlace(straight.middle, straight.radius_mm, upright=True)


def _widest(limit_mm: float, room_mm: float, bar_lean: Array, sleeve_lean: Array) -> FreePlace:
    """The widest disc whose middle is on the line from the sleeve's centre to the middle of the two leans."""
    middles = np.linspace(0.0, 1.0, _STEPS)[:, None] * (bar_lean + sleeve_lean) / 2.0
    discs = ((np.zeros(2), limit_mm), (bar_lean, room_mm), (sleeve_lean, room_mm))
    radius = np.min([reach - np.hypot(*(middles - centre).T) for centre, reach in discs], axis=0)
    best = int(np.argmax(np.round(radius, 9)))  # the first of equals, on every machine
    return FreePlace(middles[best], float(radius[best]))


def own_places(rebars_xy: Array, design_xy: Array, bent: Sequence[int]) -> Array | None:
    """Places (n, 2) mm, in the frame of the measured bars, that the bars that stay give to all bars.

    Bars that stand off would pull a fit of all bars towards them. None where too few bars stay.
    """
    stay = np.setdiff1d(np.arange(len(rebars_xy)), np.array(bent, dtype=np.int64))
    fit = fit_eopa_planar(rebars_xy[stay], design_xy[stay])
    if isinstance(fit, NoFit) or len(stay) < 3:
        return None
    return np.asarray((design_xy - fit.t) @ fit.R.T)


def nearest_in_discs(point: Array, centres: Sequence[Array], radii_mm: Sequence[float]) -> Array:
    """The point (2,) of the intersection of some discs nearest to a given one (Dykstra's projections)."""
    x = np.asarray(point, dtype=np.float64)
    left = [np.zeros(2) for _ in centres]
    for _ in range(_ROUNDS):
        for index, (centre, radius) in enumerate(zip(centres, radii_mm, strict=True)):
            wanted = x + left[index]
            away = wanted - centre
            length = float(np.hypot(*away))
            x = wanted if length <= radius else centre + away * (max(radius, 0.0) / length)
            left[index] = wanted - x
    return x
