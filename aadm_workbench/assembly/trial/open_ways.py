"""In how many ways the sleeves of one scan may meet the bars of another, where it is open how the two lie.

Turned together, both make the same pairs again: what counts is which measured sleeve meets which measured bar. Of a
square ring that was seen whole four ways are left of sixteen; of parts of a row, that may be shifted against each other
from either side, all that differ.
"""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.assembly.matching.match import Match, Placement
from aadm_workbench.model import ColumnDesign


def open_ways(design: ColumnDesign, sleeves: Match, rebars: Match) -> Iterator[tuple[Placement, Placement]]:
    """Placements of sleeves and of rebars, each that makes pairs of its own once, the chosen one first."""
    known = set()
    for sleeve_turn in sleeves.evaluated:
        for rebar_turn in rebars.evaluated:
            pairs = _pairs(design, sleeve_turn, rebar_turn)
            if pairs not in known:
                known.add(pairs)
                yield sleeve_turn, rebar_turn


def _pairs(design: ColumnDesign, sleeve_turn: Placement, rebar_turn: Placement) -> frozenset[tuple[float, ...]]:
    """Which measured points meet, with the sizes that the design gives them there."""
    pairs = set()
    places = zip(sleeve_turn.matched.tolist(), rebar_turn.matched.tolist(), strict=False)
    for place, (sleeve, rebar) in enumerate(places):
        bar = design.rebars[place]
        sizes = design.sleeves[place].diameter_mm, bar.diameter_mm, bar.outer_diameter_mm or 0.0
        pairs.add((sleeve, rebar, *sizes))
    return frozenset(pairs)
