"""Connecting rebars of an IFC model: upright bars whose upper end a column can come down on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.attributes import Contradictions, written_diameter_mm
from aadm_workbench.design.ifc.crowd import Crowd
from aadm_workbench.design.ifc.geometry.shapes import Shapes
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.paths import Leg, Straight
from aadm_workbench.model import Array, AssemblyPoint, Kind, Reason, in_one

UP = np.array([0.0, 0.0, 1.0])

_UPRIGHT_COS = float(np.cos(np.radians(10.0)))  # 10 degrees: bars lean by a few, stirrups lie
_SHORTEST_MM = 100.0
"""A connecting rebar goes eight diameters into its sleeve; a shorter upright end is a hook or a drawing error."""

_HIGHEST_MM = 1.0  # rounding of a level: both legs of a U end highest
NAMED_CLASSES = (
    "IfcBuildingElementProxy",
    "IfcElementComponent",
    "IfcMember",
    "IfcBeam",
    "IfcColumn",
    "IfcFastener",
    "IfcMechanicalFastener",
)
# a rod thicker than that is no reinforcing bar: 50 mm is the largest size (GB/T 1499.2), couplers come on top
_THICKEST_MM = 80.0


@dataclass(frozen=True, eq=False)
class BarEnd:
    """An upright end of a bar, in the model frame.

    ``top`` (3,) mm is where the axis meets the top, ``axis`` (3,) points up and out of the bar, ``lowest_mm`` is the
    height of the bar's lowest point. ``wholes`` are the numbers of what the bar is a part of.
    """

    global_id: str
    name: str
    ifc_class: str
    top: Array
    axis: Array
    lowest_mm: float
    diameter_mm: float
    length_mm: float
    over_ribs_mm: float | None
    wholes: frozenset[int]
    why: str

    @classmethod
    def of(
        cls,
        element: Any,
        bar: Course,
        top: tuple[Array, Array],
        why: str,
        diameter_mm: float,
        over_ribs_mm: float | None = None,
        wholes: frozenset[int] = frozenset(),
    ) -> BarEnd:
        """One end (top, axis) of a bar of an element of any kind of model, under the attribute names of IFC."""
        name = element.Name
        return cls(
            global_id=element.GlobalId,
            name=name.strip() if isinstance(name, str) else "",
            ifc_class=str(element.is_a()),
            top=top[0],
            axis=top[1],
            lowest_mm=float(bar.points[:, 2].min()),
            diameter_mm=diameter_mm,
            length_mm=bar.length_mm,
            over_ribs_mm=over_ribs_mm,
            wholes=wholes,
            why=why,
        )

    def point(self, why: str) -> AssemblyPoint:
        """The assembly point of this end, in the model frame, without a label."""
        return AssemblyPoint(
            label="",
            kind=Kind.REBAR,
            centre=self.top,
            axis=self.axis,
            diameter_mm=self.diameter_mm,
            global_id=self.global_id,
            why=in_one([self.why, why]),
            length_mm=self.length_mm,
        )


@dataclass(frozen=True, eq=False)
class FoundBars:
    """Upright ends, the bars that were left out, and what attributes say against the geometry."""

    ends: tuple[BarEnd, ...]
    not_taken: tuple[NotTaken, ...]
    warnings: tuple[str, ...]

    @cached_property
    def tops(self) -> Crowd:
        """The upper ends of all, by place."""
        return Crowd.of([end.top for end in self.ends])


def find_bars(
    opened: OpenedIfc, shapes: Shapes, selector: str | None, near: Callable[[Array], bool] | None = None
) -> FoundBars:
    """All upright bar ends of a model; one element may hold several bars.

    ``near`` tells for the end (3,) mm of a bar whether it is of interest; elements without such an end are passed over.

    Elements are chosen by class and PredefinedType, then by name, or by the selector instead of both; what the
    geometry does not support is not taken even so: bars that lean, closed ones, fragments.
    """
    ends: list[BarEnd] = []
    left: list[NotTaken] = []
    contradictions = Contradictions(opened)
    for element, evidence in _candidates(opened, selector):
        with shapes.guarded(element):
            bars, is_axis = _bars_of(opened, element, shapes)
            if near is not None and not any(near(leg) for bar in bars for leg in (bar.legs[0].start, bar.legs[-1].end)):
                continue
            evidence = Reason("ifc.axis_of", what=evidence) if is_axis else evidence
            taken, refused = _ends_of(opened, shapes, element, bars, evidence, selector, contradictions)
            ends += taken
            left += refused
            continue
        left.append(NotTaken.of("rebar", element, shapes.undrawn(element)))
    return FoundBars(tuple(ends), tuple(left), tuple(contradictions.lines()))


def _ends_of(
    opened: OpenedIfc,
    shapes: Shapes,
    element: Any,
    bars: Sequence[Course],
    evidence: str,
    selector: str | None,
    contradictions: Contradictions,
) -> tuple[list[BarEnd], list[NotTaken]]:
    """The upright ends of the bars of one element, and those of its bars that have none."""
    ends: list[BarEnd] = []
    left: list[NotTaken] = []
    refused = None
    if not selector:
        refused = opened.naming.of(element).why_not_connecting(opened.naming.predefined_type(element))
    if not bars:
        left.append(_without_bars(element, shapes, refused))
    lengths_mm = [bar.length_mm for bar in bars]
    for bar in bars:
        sizes = contradictions.compare_bar(element, bar.diameter_mm, lengths_mm)
        reason = refused or not_a_bar(bar)
        tops = [] if reason else upright_ends(list(bar.legs))
        wholes = frozenset(whole.id() for whole in ifc_names.wholes(element)) if tops else frozenset()
        said = opened.naming.said(element)
        why = in_one([ifc_names.evidence_of(evidence, said) if said else evidence, *sizes[2]])
        ends += [BarEnd.of(element, bar, top, why, sizes[0], sizes[1], wholes) for top in tops]
        if not tops:
            left.append(no_end(element, bar, sizes[0], reason or geometric_reason(list(bar.legs))))
    return ends, left


def not_a_bar(bar: Course) -> str | None:
    """Why a body is no reinforcing bar whatever it is called; None where it may be one."""
    if bar.hollow:
        return Reason("ifc.hollow")
    if bar.diameter_mm > _THICKEST_MM:
        return Reason("ifc.thickness", diameter_mm=bar.diameter_mm)
    return None


def _candidates(opened: OpenedIfc, selector: str | None) -> Iterable[tuple[Any, str]]:
    if selector:
        chosen = ifc_names.select(opened.file, opened.source, "rebars", selector)
        yield from ((element, Reason("ifc.chosen")) for element in chosen)
        return
    yield from ((element, "IfcReinforcingBar") for element in opened.file.by_type("IfcReinforcingBar"))
    seen: set[int] = set()
    for ifc_class in NAMED_CLASSES:
        for element in opened.file.by_type(ifc_class):
            if element.id() in seen or element.is_a() == "IfcReinforcingBar":
                continue
            seen.add(element.id())
            if opened.naming.of(element).is_rebar:
                yield element, element.is_a()


def _bars_of(opened: OpenedIfc, element: Any, shapes: Shapes) -> tuple[Sequence[Course], bool]:
    """Bars of one element, from its body, else from its axis alone; and whether it was the latter."""
    bars = shapes.bars_of_product(element)
    if bars:
        return bars, False
    lines = shapes.axes_of_product(element)
    diameter_mm = written_diameter_mm(opened, element) if lines else None
    if diameter_mm is None:
        return (), False
    return [Course(legs, diameter_mm) for legs in lines], True


def _without_bars(element: Any, shapes: Shapes, refused: str | None) -> NotTaken:
    reason = shapes.undrawn(element)
    if shapes.axes_of_product(element):
        reason = Reason("ifc.axis_alone")
    elif shapes.of_product(element):
        reason = Reason("ifc.no_round_ends")
    return NotTaken.of("rebar", element, refused or reason)


def upright_ends(legs: list[Leg]) -> list[tuple[Array, Array]]:
    """(top, axis) of each end that rises straight and to which no other part of the bar comes up."""
    found = []
    for leg, backwards in ((legs[0], True), (legs[-1], False)):
        if not isinstance(leg, Straight) or leg.length_mm < _SHORTEST_MM:
            continue
        top, foot = (leg.start, leg.end) if backwards else (leg.end, leg.start)
        axis = (top - foot) / leg.length_mm
        if float(axis[2]) > _UPRIGHT_COS and float(top[2]) > _highest(legs) - _HIGHEST_MM:
            found.append((top, axis))
    return found


def geometric_reason(legs: list[Leg]) -> str:
    """Why a bar of this course has no upright end that a column could come down on."""
    length_mm = sum(leg.length_mm for leg in legs)
    if length_mm < _SHORTEST_MM:
        return Reason("ifc.fragment", length_mm=length_mm)
    if np.linalg.norm(legs[0].start - legs[-1].end) < 1.0:
        return Reason("ifc.closed")
    if len(legs) == 1 and isinstance(legs[0], Straight):
        lean = np.degrees(np.arccos(min(1.0, abs(float(legs[0].direction @ UP)))))
        return Reason("ifc.leans", lean_deg=lean)
    return Reason("ifc.no_end", least_mm=_SHORTEST_MM)


def no_end(element: Any, bar: Course, diameter_mm: float, reason: str) -> NotTaken:
    """A bar of an element of any kind of model that has no end to come down on."""
    top = bar.points[int(bar.points[:, 2].argmax())]
    return NotTaken.of("rebar", element, reason, top, diameter_mm, bar.length_mm)


def _highest(legs: list[Leg]) -> float:
    return max(float(leg.points[:, 2].max()) for leg in legs)
