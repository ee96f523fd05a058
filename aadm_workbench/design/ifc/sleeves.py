"""Grouting sleeves of an IFC model: what may be one, and which of them open in a column's foot face."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.bars import UP
from aadm_workbench.design.ifc.columns import ColumnBody, Foot
from aadm_workbench.design.ifc.geometry.shapes import Shapes
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.ifc.words import COUPLERS, NOT_SLEEVE, SLEEVE
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.recognise.paths import length_of
from aadm_workbench.design.recognise.tubes import Tube, stacked
from aadm_workbench.model import Array, AssemblyPoint, Kind, Reason

BORE_MM = (18.0, 100.0)
"""Inner diameters of grouting sleeves: 23 mm for bars of 12 mm to 80 mm for bars of 40 mm, ducts somewhat wider."""

SHORTEST_MM = 100.0
"""A bore shorter than this is no grouting sleeve: half sleeves take eight diameters of a bar, 96 mm of the thinnest."""
SLENDEREST_RATIO = 3.0
"""A sleeve is at least so many bores long; sockets for lifting and bracing are stubbier."""

MOUTH_TO_FOOT_MM = 50.0
"""Plugs and chamfers set a sleeve's body back from the foot face by no more than this."""

FEWEST_UNNAMED = 3
"""So many like holes in a foot face are sleeves even without a name; fewer may be vents or sockets."""

SAME_MOUTH_MM = 5.0
"""Mouths nearer to each other are one sleeve, drawn in parts: two sleeves are their own width apart."""

BESIDE_MM = 100.0
"""What lies further beside a foot face than this has no mouth in it."""

_LONGEST_MM = 6000.0  # above a foot face: sleeves and their tubes end within a storey
_ALONG_COS = float(np.cos(np.radians(5.0)))  # 5 degrees: sleeves stand along their column
OPENING_CLASSES = ("IfcFeatureElementSubtraction",)
_COUPLER_CLASSES = ("IfcMechanicalFastener", "IfcTendonAnchor", "IfcTendonConduit")
_UNNAMED_CLASSES = (
    "IfcElementComponent",
    "IfcBuildingElementProxy",
    "IfcFeatureElementSubtraction",
    "IfcFastener",
    "IfcMechanicalFastener",
    "IfcFlowSegment",
    "IfcFlowFitting",
    "IfcMember",
    "IfcBeam",
    "IfcPlate",
)


class Evidence(IntEnum):
    """What speaks for a sleeve, the strongest first."""

    SELECTOR = 0
    CLASS = 1
    NAME = 2
    GEOMETRY = 3


@dataclass(frozen=True, eq=False)
class Candidate:
    """A round body or hole of the model, model frame, that may be a sleeve."""

    element: Any
    tube: Tube
    evidence: Evidence
    why: str

    @cached_property
    def is_opening(self) -> bool:
        """Whether it is drawn as what is taken away, so that a solid cylinder is a hole."""
        return self.tube.is_hole or bool(self.element.is_a("IfcFeatureElementSubtraction"))

    @property
    def is_hollow(self) -> bool:
        """Whether it is drawn with a bore."""
        return self.tube.bore_mm != (None, None)


@dataclass(frozen=True, eq=False)
class Mouth:
    """A sleeve's mouth on a foot face. ``centre`` (2,) mm and ``axis`` (3,) in the frame of that face."""

    candidate: Candidate
    centre: Array
    axis: Array
    bore_mm: float
    length_mm: float
    behind_mm: float
    solid: bool


def named_candidates(opened: OpenedIfc, shapes: Shapes, selector: str | None) -> tuple[list[Candidate], list[NotTaken]]:
    """Candidates by the selector, else by class and PredefinedType and by name; what names exclude is listed apart."""
    if selector:
        chosen = ifc_names.select(opened.file, opened.source, "sleeves", selector)
        return [c for e in chosen for c in _candidates(e, shapes, Evidence.SELECTOR, Reason("ifc.chosen"))], []
    found, left = _by_name(opened, shapes)
    return (found, left) if found else _by_property(opened, shapes, left)


def _by_name(opened: OpenedIfc, shapes: Shapes) -> tuple[list[Candidate], list[NotTaken]]:
    found: list[Candidate] = []
    left: list[NotTaken] = []
    couplers = frozenset(element.id() for element in _couplers(opened))
    for element in opened.file.by_type("IfcElement"):
        with shapes.guarded(element):
            _take_by_name(opened, shapes, element, found, left, is_coupler=element.id() in couplers)
    return found, left


def _take_by_name(
    opened: OpenedIfc,
    shapes: Shapes,
    element: Any,
    found: list[Candidate],
    left: list[NotTaken],
    *,
    is_coupler: bool,
) -> None:
    """Put one element with what is found, or with what is left out, or with neither."""
    word = opened.naming.find(SLEEVE, element)
    if (not word and not is_coupler) or ifc_names.is_of(element, "IfcElementAssembly"):
        return
    excluded = opened.naming.find(NOT_SLEEVE, element)
    if excluded:
        left.append(NotTaken.of("sleeve", element, Reason("ifc.no_sleeve", excluded=repr(excluded))))
        return
    evidence = Evidence.CLASS if is_coupler else Evidence.NAME
    why = ifc_names.evidence_of(element.is_a(), opened.naming.said(element))
    drawn = _candidates(element, shapes, evidence, Reason("ifc.coupler", why=why) if is_coupler else why)
    if ifc_names.is_of(element, "IfcReinforcingElement"):
        # Bars are called after the sleeve that they go into.
        drawn = [candidate for candidate in drawn if candidate.is_hollow]
    elif not drawn:
        left.append(NotTaken.of("sleeve", element, _undrawn(element, shapes)))
    found += drawn


def _undrawn(element: Any, shapes: Shapes) -> str:
    if shapes.of_product(element):
        return Reason("ifc.sleeve_shape")
    return Reason("ifc.sleeve_undrawn", why=shapes.undrawn(element))


def _couplers(opened: OpenedIfc) -> Iterator[Any]:
    """Elements that their PredefinedType makes couplers of bars, or ducts that grout goes into."""
    for ifc_class in _COUPLER_CLASSES:
        try:
            elements = opened.file.by_type(ifc_class)
        except RuntimeError:  # the schema has no such class
            continue
        yield from (e for e in elements if opened.naming.predefined_type(e) in COUPLERS)


def _by_property(opened: OpenedIfc, shapes: Shapes, left: list[NotTaken]) -> tuple[list[Candidate], list[NotTaken]]:
    """Some programs call every part the same, and say what it is in a property set of their own."""
    told = opened.naming.told_by_property(SLEEVE)
    found: list[Candidate] = []
    for element in _each(opened.file, _UNNAMED_CLASSES) if told else ():
        text = told.get(element.id())
        if text is None or element.is_a("IfcReinforcingBar") or opened.naming.find(NOT_SLEEVE, element):
            continue
        if any(isinstance(value, str) and NOT_SLEEVE.search(value) for _, value in ifc_names.properties(element)):
            left.append(NotTaken.of("sleeve", element, Reason("ifc.other_sleeve")))
            continue
        why = Reason("ifc.by_property", type=element.is_a(), name=opened.naming.said(element), text=text)
        found += _candidates(element, shapes, Evidence.NAME, why)
    return found, left


def unnamed_candidates(
    opened: OpenedIfc, shapes: Shapes, feet: Sequence[Foot], classes: Sequence[str] = _UNNAMED_CLASSES
) -> list[Candidate]:
    """Hollow cylinders and round openings in feet, of classes that sleeves are modelled as, whatever their names."""
    frames = np.array([foot.T_model_foot for foot in feet]).reshape(-1, 4, 4)
    reach_mm = np.array([[*(foot.half_size_mm + BESIDE_MM), foot.height_mm] for foot in feet]).reshape(-1, 3)
    reach_mm[:, 2] = np.maximum(reach_mm[:, 2], _LONGEST_MM)

    def near(point: Array) -> bool:
        local = np.einsum("fi,fij->fj", point - frames[:, :3, 3], frames[:, :3, :3])
        return bool((np.abs(local) <= reach_mm).all(axis=1).any())

    found: list[Candidate] = []
    for element in _each(opened.file, classes):
        with shapes.guarded(element):
            if not element.is_a("IfcReinforcingBar") and not opened.naming.find(NOT_SLEEVE, element):
                why = Reason("ifc.no_name", type=element.is_a())
                found += _candidates(element, shapes, Evidence.GEOMETRY, why, near)
    return found


def own_candidates(opened: OpenedIfc, body: ColumnBody, shapes: Shapes) -> list[Candidate]:
    """Round holes in a column's own body, and the hollow cylinders and openings that are its parts or voids."""
    holes = [tube for drawn in body.drawn for tube in stacked(shapes.tubes_of_product(drawn)) if tube.is_hole]
    found = [Candidate(body.element, tube, Evidence.GEOMETRY, Reason("ifc.hole")) for tube in holes]
    related: list[Any] = []
    for holder in (body.element, *body.drawn, *body.wholes[:1]):
        related += [relation.RelatedOpeningElement for relation in holder.HasOpenings if relation.RelatedOpeningElement]
        related += ifc_names.parts(holder)
    own = {element.id(): element for element in related if element.id() != body.element.id()}
    for element in own.values():
        with shapes.guarded(element):
            if not element.is_a("IfcReinforcingBar") and not opened.naming.find(NOT_SLEEVE, element):
                found += _candidates(element, shapes, Evidence.GEOMETRY, Reason("ifc.no_name", type=element.is_a()))
    return found


def mouths_on(foot: Foot, candidates: Iterable[Candidate]) -> tuple[list[Mouth], list[tuple[Candidate, str]]]:
    """The sleeves that open in a foot face, and those that lie there but cannot be one, with the reason."""
    found: list[Mouth] = []
    refused: list[tuple[Candidate, str]] = []
    for candidate in candidates:
        mouth = _mouth(foot, candidate)
        if mouth is None:
            continue
        reason = _implausible(mouth)
        if reason:
            refused.append((candidate, reason))
        else:
            found.append(mouth)
    return _one_each(found), refused


def _mouth(foot: Foot, candidate: Candidate) -> Mouth | None:
    """Where a candidate's axis meets a foot face; None where it is elsewhere or runs across."""
    ends = foot.local(np.array([candidate.tube.start, candidate.tube.end]))
    if ends[0, 2] > ends[1, 2]:
        ends = ends[::-1]
    length_mm = length_of(ends[1] - ends[0])
    axis = (ends[1] - ends[0]) / length_mm
    too_deep_mm = -np.inf if candidate.is_opening else -MOUTH_TO_FOOT_MM
    if axis[2] < _ALONG_COS or not too_deep_mm <= ends[0, 2] <= MOUTH_TO_FOOT_MM or ends[1, 2] <= MOUTH_TO_FOOT_MM:
        return None
    centre = ends[0, :2] - ends[0, 2] / axis[2] * axis[:2]
    if (np.abs(centre) > foot.half_size_mm).any():
        return None
    tube = candidate.tube.upwards(foot.T_model_foot[:3, 2])
    bore_mm = tube.bore_mm[0]
    solid = bore_mm is None and not candidate.is_opening
    return Mouth(
        candidate=candidate,
        centre=centre,
        axis=axis,
        bore_mm=bore_mm if bore_mm is not None else tube.outer_mm or 0.0,
        length_mm=float(ends[1, 2] / axis[2]) if candidate.is_opening else length_mm,
        behind_mm=float(ends[0, 2]),
        solid=solid,
    )


def _implausible(mouth: Mouth) -> str | None:
    if mouth.candidate.evidence is Evidence.SELECTOR:
        return None
    return implausible_size(
        mouth.bore_mm, mouth.length_mm, solid=mouth.solid and mouth.candidate.evidence is Evidence.GEOMETRY
    )


def implausible_size(bore_mm: float, length_mm: float, *, solid: bool) -> str | None:
    """Why a round body of these sizes is no grouting sleeve; None where it may be one."""
    if solid:
        return Reason("ifc.no_bore")
    if not BORE_MM[0] <= bore_mm <= BORE_MM[1]:
        return Reason("ifc.bore", bore_mm=bore_mm, least_mm=BORE_MM[0], most_mm=BORE_MM[1])
    if length_mm < max(SHORTEST_MM, SLENDEREST_RATIO * bore_mm):
        return Reason("ifc.short", length_mm=length_mm, bore_mm=bore_mm)
    return None


def _one_each(mouths: Sequence[Mouth]) -> list[Mouth]:
    """One mouth where several are drawn about one axis: a sleeve in its opening, two openings for one hole."""

    def merit(mouth: Mouth) -> tuple[int, bool, bool, float, float]:
        candidate = mouth.candidate
        return candidate.evidence, mouth.solid, candidate.is_opening, -mouth.length_mm, mouth.bore_mm

    kept: list[Mouth] = []
    for mouth in sorted(mouths, key=merit):
        if not any(math.dist(mouth.centre, other.centre) < SAME_MOUTH_MM for other in kept):
            kept.append(mouth)
    return kept


def alike(mouths: Sequence[Mouth]) -> list[Mouth]:
    """Of unnamed mouths, those that come in sufficient numbers of one bore to be a pattern of sleeves."""
    return [
        mouth for mouth in mouths if sum(abs(mouth.bore_mm - other.bore_mm) < 0.5 for other in mouths) >= FEWEST_UNNAMED
    ]


def loose_point(candidate: Candidate) -> AssemblyPoint | str:
    """A sleeve in no column's foot, in the model frame, its lower end the mouth; or why it is none."""
    tube = candidate.tube.upwards(UP)
    axis = (tube.end - tube.start) / tube.length_mm
    bore_mm = tube.bore_mm[0]
    solid = bore_mm is None and not candidate.is_opening
    if candidate.evidence is not Evidence.SELECTOR:
        if float(axis @ UP) < _ALONG_COS:
            return Reason("ifc.sleeve_aslant")
        reason = implausible_size(bore_mm or tube.outer_mm or 0.0, tube.length_mm, solid=False)
        if reason:
            return reason
    return AssemblyPoint(
        label="",
        kind=Kind.SLEEVE,
        centre=tube.start,
        axis=axis,
        diameter_mm=bore_mm or tube.outer_mm or 0.0,
        global_id=candidate.element.GlobalId,
        why=Reason("ifc.opens_nowhere.solid" if solid else "ifc.opens_nowhere", why=candidate.why),
        length_mm=tube.length_mm,
    )


def left_out(candidate: Candidate, reason: str) -> NotTaken:
    """A candidate that was looked at and left out."""
    tube = candidate.tube.upwards(UP)
    diameter_mm = tube.bore_mm[0] or tube.outer_mm
    return NotTaken.of("sleeve", candidate.element, reason, tube.start, diameter_mm, tube.length_mm)


def _candidates(
    element: Any, shapes: Shapes, evidence: Evidence, why: str, near: Callable[[Array], bool] | None = None
) -> list[Candidate]:
    found = shapes.tubes_of_product(element, near=near)
    if not found and evidence is not Evidence.GEOMETRY:
        found = shapes.tubes_of_product(element, coarse=True)
    return [Candidate(element, tube, evidence, why) for tube in stacked(found) if tube.length_mm > 1.0]


def _each(file: Any, classes: Sequence[str]) -> Iterator[Any]:
    seen: set[int] = set()
    for ifc_class in classes:
        for element in file.by_type(ifc_class):
            if element.id() not in seen:
                seen.add(element.id())
                yield element
