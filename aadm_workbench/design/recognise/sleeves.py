"""Which elements of a model that is no IFC file may be grouting sleeves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.design.elements import Element
from aadm_workbench.design.ifc.bars import UP
from aadm_workbench.design.ifc.sleeves import Candidate, Evidence
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.recognise.element_kind import (
    described,
    generic,
    is_opening,
    is_rebar,
    not_a_sleeve,
    sleeve_word,
)
from aadm_workbench.design.recognise.selectors import select
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.model import AssemblyPoint, Kind, Reason

_SHORTEST_TUBE_MM = 1.0  # a chamfer is shorter
_UPRIGHT_COS = float(np.cos(np.radians(5.0)))  # 5 degrees: sleeves stand along their column


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
            left.append(NotTaken("sleeve", str(element.is_a()), element.GlobalId, element.Name, reason))
        elif word:
            evidence = Evidence.CLASS if word == "COUPLER" else Evidence.NAME
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
