"""In how many ways two ambiguous scans may meet, counted by hand."""

from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.matching.match import Match, Placement
from aadm_workbench.assembly.trial.virtual import open_ways
from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.model import ColumnDesign


def design_of(count: int, **changes: Any) -> ColumnDesign:
    centres = [[200.0 * k, 0.0] for k in range(count)]
    return inline_design("row", {"centres": centres, "sleeve_diameter": 36.0, "rebar_diameter": 20.0} | changes)


def placements(orders: list[list[int]], orientation: str = "ambiguous") -> Match:
    found = tuple(Placement(np.eye(4), np.array(one), 0.0, None, 0.0, 0.0, 0.0, 1.0) for one in orders)
    return Match(found, orientation)


def shifted(seen: int, count: int) -> list[list[int]]:
    """A part of a row in all places of it: which measured point stands at each of the design's."""
    return [[-1] * start + list(range(seen)) + [-1] * (count - seen - start) for start in range(count - seen + 1)]


def turned(count: int) -> list[list[int]]:
    return [[(k + by) % count for k in range(count)] for by in range(0, count, count // 4)]


def pairs_of(ways: Any) -> set[frozenset[tuple[int, int]]]:
    return {frozenset(zip(a.matched.tolist(), b.matched.tolist(), strict=True)) for a, b in ways}


def test_parts_of_a_row_may_be_shifted_against_each_other_to_either_side() -> None:
    """Four sleeves of six in three places, five bars of six in two: bars one on, level, or one or two back."""
    sleeves, rebars = placements(shifted(4, 6)), placements(shifted(5, 6))
    ways = list(open_ways(design_of(6), sleeves, rebars))
    assert len(ways) == len(pairs_of(ways)) == 4
    assert ways[0] == (sleeves.placements[0], rebars.placements[0])
    every = {frozenset(zip(a, b, strict=True)) for a in shifted(4, 6) for b in shifted(5, 6)}
    assert pairs_of(ways) == every


@pytest.mark.parametrize("orientations", [("ambiguous", "ambiguous"), ("ambiguous", "declared")])
def test_two_whole_rings_meet_in_four_ways_however_both_are_turned(orientations: tuple[str, str]) -> None:
    sleeves, rebars = (placements(turned(12), one) for one in orientations)
    assert len(list(open_ways(design_of(12), sleeves, rebars))) == 4


def test_turned_together_bars_of_another_size_make_another_trial() -> None:
    """One sleeve is narrower: which measured sleeve that is decides, although the same points meet."""
    narrow = design_of(4, sleeve_diameter=[36.0, 36.0, 30.0, 36.0])
    both = placements(turned(4))
    assert len(list(open_ways(design_of(4), both, both))) == 4
    assert len(list(open_ways(narrow, both, both))) == 16


def test_what_is_settled_meets_in_one_way() -> None:
    settled = placements(turned(12), "declared")
    assert len(list(open_ways(design_of(12), settled, settled))) == 1
