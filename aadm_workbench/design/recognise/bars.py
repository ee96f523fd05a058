"""Which elements of a model that is no IFC file are connecting rebars."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from aadm_workbench.design.elements import Element
from aadm_workbench.design.ifc.bars import BarEnd, FoundBars, geometric_reason, upright_ends
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.element_kind import described, generic, is_rebar, not_connecting, sleeve_word
from aadm_workbench.design.recognise.paths import Straight
from aadm_workbench.design.recognise.selectors import select
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.model import Array, Reason

DIAMETER_MM = (8.0, 60.0)
"""Of what may be a bar by its shape alone; connecting rebars have 12 to 40 mm."""

_SLENDEREST_RATIO = 4.0  # length over diameter: shorter ones are bolts and dowels' heads
_ROUND_NO_LENGTH = Reason("ifc.no_round")


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
            tops = [] if refused else upright_ends(list(bar.legs))
            ends += [_end(element, bar, top, evidence) for top in tops]
            if not tops:
                left.append(_left_out(element, bar, refused or geometric_reason(list(bar.legs))))
        if not bars:
            left.append(_without_bars(element, refused))
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
                found += [_end(element, bar, top, why) for top in upright_ends(list(bar.legs))]
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


def _end(element: Element, bar: Course, top: tuple[Array, Array], why: str) -> BarEnd:
    return BarEnd(
        global_id=element.GlobalId,
        name=element.Name,
        ifc_class=str(element.is_a()),
        top=top[0],
        axis=top[1],
        lowest_mm=float(bar.points[:, 2].min()),
        diameter_mm=round(bar.diameter_mm, 6),
        length_mm=bar.length_mm,
        over_ribs_mm=None,
        wholes=frozenset(),
        why=why,
    )


def _left_out(element: Element, bar: Course, reason: str) -> NotTaken:
    return NotTaken(
        what="rebar",
        ifc_class=str(element.is_a()),
        global_id=element.GlobalId,
        name=element.Name,
        reason=reason,
        point=bar.points[int(bar.points[:, 2].argmax())],
        diameter_mm=bar.diameter_mm,
        length_mm=bar.length_mm,
    )


def _without_bars(element: Element, refused: str | None) -> NotTaken:
    return NotTaken("rebar", str(element.is_a()), element.GlobalId, element.Name, refused or _ROUND_NO_LENGTH)
