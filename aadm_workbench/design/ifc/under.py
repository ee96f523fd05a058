"""The connecting rebars that a column comes down on: those of the model whose positions match its sleeves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.ifc.bars import BarEnd, FoundBars
from aadm_workbench.design.ifc.columns import ColumnBody, Foot
from aadm_workbench.design.ifc.sleeves import Mouth
from aadm_workbench.design.recognise.pattern import pair
from aadm_workbench.design.recognise.rings import smallest_spacing
from aadm_workbench.model import Array, IntArray, Reason

_WIDEST_PAIR_MM = 40.0  # less than half the spacing of sleeves, which the next line narrows where they are closer
_PAIR_SPACING_RATIO = 0.45
"""A bar nearer to its sleeve than to any other cannot be mistaken for a neighbour's."""

_SAME_BAR_MM = 5.0  # nearer to each other, two tops are one bar, drawn in pieces
_AT_FOOT_MM = 1.0
"""Some exporters draw only what sticks out of the floor: a bar that begins at the foot face comes from below."""


@dataclass(frozen=True, eq=False)
class Under:
    """For each sleeve its bar, or None; ``warnings`` about them."""

    bars: tuple[BarEnd | None, ...]
    warnings: tuple[str, ...]


def bars_under(body: ColumnBody, foot: Foot, mouths: Sequence[Mouth], bars: FoundBars) -> Under:
    """Pair a column's sleeves with the bars under it, by their distance in the plane of the foot face.

    Bars of the column's own assembly are not under it, nor are bars that begin above its foot face or end above its
    middle. Of bars one above the other the one that ends nearest to the foot face counts, so that neither the
    storey nor the height at which the column is drawn matters.
    """
    sleeves = np.array([mouth.centre for mouth in mouths]).reshape(-1, 2)
    if not foot.stands:
        return Under((None,) * len(mouths), (Reason("ifc.lying"),))
    near = bars_below(body, foot, bars)
    tops = foot.local(np.array([end.top for end in near]).reshape(-1, 3))
    reach_mm = min(_WIDEST_PAIR_MM, _PAIR_SPACING_RATIO * smallest_spacing(sleeves) or _WIDEST_PAIR_MM)
    partner = pair(sleeves, tops[:, :2], reach_mm)
    paired = tuple(near[index] if index >= 0 else None for index in partner)
    return Under(paired, tuple(_warnings(sleeves, tops, partner)))


def bars_below(body: ColumnBody, foot: Foot, bars: FoundBars) -> list[BarEnd]:
    """Bars that come up to a column from below, one for each place in the plane: the end nearest to the foot face."""
    reach_mm = math.hypot(foot.reach_mm + _WIDEST_PAIR_MM * math.sqrt(2.0), foot.height_mm / 2.0)
    around = bars.tops.near(foot.T_model_foot[:3, 3], reach_mm)
    tops = foot.local(bars.tops.points[around])
    foot_level_mm = float(foot.T_model_foot[2, 3])
    within = (np.abs(tops[:, :2]) < foot.half_size_mm + _WIDEST_PAIR_MM).all(axis=1)
    within &= np.abs(tops[:, 2]) < foot.height_mm / 2.0
    kept: list[int] = []
    numbers = [int(index) for index in np.flatnonzero(within)]
    for index in sorted(numbers, key=lambda k: (abs(float(tops[k, 2])), k)):
        end = bars.ends[around[index]]
        from_below = end.lowest_mm < foot_level_mm + _AT_FOOT_MM
        own = bool(end.wholes & body.own_ids)
        if own or not from_below:
            continue
        apart = tops[kept, :2] - tops[index, :2]
        if (np.hypot(apart[:, 0], apart[:, 1]) > _SAME_BAR_MM).all():
            kept.append(index)
    return [bars.ends[around[index]] for index in kept]


def _warnings(sleeves: Array, tops: Array, partner: IntArray) -> list[str]:
    paired = partner >= 0
    if not paired.any():
        return [Reason("ifc.no_bars")]
    found: list[str] = []
    if not paired.all():
        missing = int((~paired).sum())
        found.append(Reason("ifc.bars_assumed", missing=missing, count=len(sleeves)))
    if (tops[partner[paired], 2] <= 0.0).any():
        found.append(Reason("ifc.above_bars"))
    return found
