"""Which elements of a model that is no IFC file may be grouting sleeves, and which are connecting rebars."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from aadm_workbench.design.elements import Element
from aadm_workbench.design.ifc.bars import UP, BarEnd, FoundBars, geometric_reason, no_end, not_a_bar, upright_ends
from aadm_workbench.design.ifc.sleeves import Candidate, Evidence
from aadm_workbench.design.ifc.words import COUPLERS
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.element_kind import (
    described,
    generic,
    is_opening,
    is_rebar,
    not_a_sleeve,
    not_connecting,
    sleeve_word,
)
from aadm_workbench.design.recognise.paths import Straight
from aadm_workbench.design.recognise.selectors import select
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.model import AssemblyPoint, Kind, Reason

_SHORTEST_TUBE_MM = 1.0  # a chamfer is shorter
_UPRIGHT_COS = float(np.cos(np.radians(5.0)))  # 5 degrees: sleeves stand along their column

DIAMETER_MM = (8.0, 60.0)
"""Of what may be a bar by its shape alone; connecting rebars have 12 to 40 mm."""

_SLENDEREST_RATIO = 4.0  # length over diameter: shorter ones are bolts and dowels' heads
_ROUND_NO_LENGTH = Reason("ifc.no_round")


def named_sleeves(elements: Sequence[Element], source: str, rule: str | None) -> tuple[list[Candidate], list[NotTaken]]:
    """Candidates by the rule, else by class and name; what a name excludes is listed apart."""
    if rule is not None:
        chosen = select(elements, source, "sleeves", rule)
        return [c for e in chosen for c in _candidates(e, Evidence.SELECTOR, Reason("ifc.chosen"))], []
    found: list[Candidate] = []
    left: list[NotTaken] = []
    for element in elements:
        word = sleeve_word(element)
        excluded = word and not_a_sleeve(element)
        if excluded:
            reason = Reason("ifc.no_sleeve", excluded=repr(excluded))
            left.append(NotTaken.of("sleeve", element, reason))
        elif word:
            evidence = Evidence.CLASS if word in COUPLERS else Evidence.NAME
            found += _candidates(element, evidence, described(element))
    return found, left


def unnamed_sleeves(elements: Sequence[Element]) -> list[Candidate]:
    """Every hollow cylinder and round opening that no name and no class makes something else."""
    may_be = [e for e in elements if (generic(e) or is_opening(e)) and not is_rebar(e) and not not_a_sleeve(e)]
    return [
        candidate
        for element in may_be
        for candidate in _candidates(element, Evidence.GEOMETRY, Reason("ifc.no_name", type=element.is_a()))
        if not candidate.tube.is_hole or is_opening(element)
    ]


def own_holes(element: Element) -> list[Candidate]:
    """Round holes in a column's own body."""
    why = Reason("ifc.hole_in", element=described(element))
    return [Candidate(element, tube, Evidence.GEOMETRY, why) for tube in element.tubes if _is_hole(tube)]


def round_holes(elements: Sequence[Element]) -> tuple[tuple[AssemblyPoint, ...], list[str]]:
    """Every upright round hole of a model in which nothing was recognised, whatever its size, in the model frame.

    The mouth is the lower end. A warning says that nothing makes them sleeves.
    """
    found = []
    for element in elements:
        for tube in (tube.upwards(UP) for tube in element.tubes if _is_hole(tube)):
            axis = (tube.end - tube.start) / tube.length_mm
            if float(axis @ UP) < _UPRIGHT_COS:
                continue
            why = Reason("ifc.hole_unsaid", element=described(element))
            bore_mm = tube.bore_mm[0] or 0.0
            found.append(
                AssemblyPoint(
                    "",
                    Kind.SLEEVE,
                    tube.start,
                    axis,
                    bore_mm,
                    global_id=element.GlobalId,
                    why=why,
                    length_mm=tube.length_mm,
                )
            )
    found.sort(key=lambda point: tuple(np.round(point.centre, 3)))
    note = Reason("ifc.listed_loose")
    return tuple(found), [note] if found else []


def _candidates(element: Element, evidence: Evidence, why: str) -> list[Candidate]:
    tubes = [tube for tube in element.tubes if tube.length_mm > _SHORTEST_TUBE_MM]
    # Of a block with holes the holes are meant, whatever round outline the block may have.
    hollow = [tube for tube in tubes if tube.bore_mm != (None, None)]
    return [Candidate(element, tube, evidence, why) for tube in hollow or tubes]


def _is_hole(tube: Tube) -> bool:
    return tube.is_hole and tube.length_mm > _SHORTEST_TUBE_MM


def named_bars(elements: Sequence[Element], source: str, rule: str | None) -> FoundBars:
    """Upright bar ends by the rule, else by class and name; bars that are no connecting rebars are listed apart."""
    ends: list[BarEnd] = []
    left: list[NotTaken] = []
    chosen = [e for e in elements if is_rebar(e)] if rule is None else select(elements, source, "rebars", rule)
    for element in chosen:
        refused = not_connecting(element) if rule is None else None
        evidence = described(element) if rule is None else Reason("ifc.chosen_element", element=described(element))
        bars = bars_of(element)
        for bar in bars:
            reason = refused or not_a_bar(bar)
            tops = [] if reason else upright_ends(list(bar.legs))
            ends += [BarEnd.of(element, bar, top, evidence, round(bar.diameter_mm, 6)) for top in tops]
            if not tops:
                left.append(no_end(element, bar, bar.diameter_mm, reason or geometric_reason(list(bar.legs))))
        if not bars:
            left.append(NotTaken.of("rebar", element, refused or _ROUND_NO_LENGTH))
    return FoundBars(tuple(ends), tuple(left), ())


def drawn_bars(elements: Iterable[Element]) -> list[BarEnd]:
    """Upright ends of slender solid cylinders that neither class nor name makes anything else."""
    found: list[BarEnd] = []
    for element in elements:
        if not generic(element) or is_rebar(element) or sleeve_word(element) or not_connecting(element):
            continue
        for bar in bars_of(element):
            if (
                DIAMETER_MM[0] <= bar.diameter_mm <= DIAMETER_MM[1]
                and bar.length_mm > _SLENDEREST_RATIO * bar.diameter_mm
            ):
                why = Reason("ifc.bar_by_shape", element=described(element))
                tops = upright_ends(list(bar.legs))
                found += [BarEnd.of(element, bar, top, why, round(bar.diameter_mm, 6)) for top in tops]
    return found


def bars_of(element: Element) -> list[Course]:
    """Round bars of an element: bent ones, and solid cylinders."""
    found: list[Course] = []
    for solid in element.solids:
        straight = [_as_bar(tube) for tube in solid.tubes if tube.outer_mm is not None and tube.bore_mm == (None, None)]
        found += solid.bars or straight
    return found


def _as_bar(tube: Tube) -> Course:
    return Course((Straight(tube.start, tube.end),), tube.outer_mm or 0.0)
