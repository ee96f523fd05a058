"""Columns and beams of an IFC model as bodies, and which of them the model relates to each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.design.floor import Floor, FloorBeam, FloorColumn, How, supports_of
from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.columns import ColumnBody, concrete_parts, find_columns, names
from aadm_workbench.design.ifc.geometry.kernel import closing_kernel
from aadm_workbench.design.ifc.geometry.shapes import Shapes, evaluator
from aadm_workbench.design.ifc.text.file import OpenedIfc, open_ifc
from aadm_workbench.design.ifc.words import BEAM, COLUMN, NOT_BEAM, REBAR, SLEEVE
from aadm_workbench.design.recognise.shapes import edges
from aadm_workbench.model import Array, Reason

_PROXIES = ("IfcBuildingElementProxy", "IfcMember", "IfcElementAssembly")
"""Classes that programs export beams as which they do not know to be beams."""

_LEVEL_SINE = 0.35  # 20 degrees: what runs more steeply is a brace or a stair
_ALONG_Y = 1e-3  # 0.06 degrees: rounding of what runs along y
_AT_END_MM = 5.0  # chamfers of end faces
_SHORTEST_MM = 500.0
"""No beam between two columns is shorter; what is called a beam and is shorter is a part of one, or a corbel."""


def read_floor(path: str | Path) -> Floor:
    """Columns and beams of a model, and which column carries which end of a beam.

    Raises
    ------
    DesignError
        Where the file is no complete IFC model.
    MissingDependencyError
        Where ifcopenshell is not installed.
    """
    opened = open_ifc(path)
    shapes = evaluator(opened.mm, opened.radians, coarse=opened.draws_coarsely)
    # Numbers that overflow are looked at where they come out.
    with np.errstate(all="ignore"), closing_kernel(shapes.solids.kernel):
        return _read(opened, shapes)


def _read(opened: OpenedIfc, shapes: Shapes) -> Floor:
    bodies, lost = find_columns(opened, shapes, None)
    standing = [body for body in bodies if body.feet[0].stands]
    columns = tuple(_column(body) for body in standing)
    left_out = [(one.name or one.global_id, one.reason) for one in lost]
    relations = Relations(opened.file, standing)
    beams, supports = [], []
    for element in _beam_elements(opened):
        beam = _beam(opened, shapes, element)
        if isinstance(beam, str):
            left_out.append((ifc_names.called(element), beam))
            continue
        beams.append(beam)
        supports.append(supports_of(beam, columns, relations.of(element)))
    return Floor(opened.source, opened.sha256, columns, tuple(beams), tuple(supports), tuple(left_out))


def _column(body: ColumnBody) -> FloorColumn:
    foot, element = body.feet[0], body.element
    return FloorColumn(
        body.called, element.GlobalId, names(element), foot.T_model_foot, foot.half_size_mm, foot.height_mm
    )


def _beam_elements(opened: OpenedIfc) -> Iterator[Any]:
    """Every beam once: by its class, or by its name where a program did not know it to be one."""
    found = {element.id(): element for element in opened.file.by_type("IfcBeam")}
    for ifc_class in _PROXIES:
        for element in opened.file.by_type(ifc_class):
            if _is_called_beam(opened, element) and not _is_told_by_class(opened, element):
                found[element.id()] = element
    for element in found.values():
        # The parts of a beam are often called like it.
        if not any(whole.id() in found for whole in ifc_names.wholes(element)):
            yield element


def _is_told_by_class(opened: OpenedIfc, element: Any) -> bool:
    """Whether an IfcBeam stands for it: one among its parts, or among those of the beam that it is a part of."""
    whole_beams = [whole for whole in ifc_names.wholes(element) if _is_called_beam(opened, whole)]
    return any(part.is_a("IfcBeam") for one in (element, *whole_beams) for part in ifc_names.parts(one))


def _is_called_beam(opened: OpenedIfc, element: Any) -> bool:
    others = (NOT_BEAM, COLUMN, SLEEVE, REBAR)
    return bool(opened.naming.find(BEAM, element)) and not any(opened.naming.find(word, element) for word in others)


def _beam(opened: OpenedIfc, shapes: Shapes, element: Any) -> FloorBeam | str:
    """A beam with its ends; else why it is none."""
    ends: Array | str = shapes.undrawn(element)
    with shapes.guarded(element):
        drawn = [element] if shapes.of_product(element) else concrete_parts(opened, element)
        ends = _ends(edges([shape for part in drawn for shape in shapes.of_product(part)]))
    if isinstance(ends, str):
        return ends if len(ends) else shapes.undrawn(element)
    return FloorBeam(ifc_names.called(element), element.GlobalId, ends)


def _ends(drawn: Array) -> Array | str:
    """The middle of the lower edge of both end faces (2, 3), of a body of edges (m, 2, 3); else why it is no beam.

    It runs as its longest level edge does; its first end is the one with the smaller x, or y where it runs along y.
    """
    if not len(drawn):
        return ""
    ways = drawn[:, 1] - drawn[:, 0]
    lengths_mm = np.linalg.norm(ways, axis=1)
    level = np.abs(ways[:, 2]) <= _LEVEL_SINE * lengths_mm
    if not level.any():
        return Reason("ifc.beam_not_level")
    along = _forwards(ways[level][int(lengths_mm[level].argmax())])
    corners = drawn.reshape(-1, 3)
    reach = (corners - corners[0]) @ along
    if np.ptp(reach) < np.ptp(corners[:, 2]):
        return Reason("ifc.beam_upright", high_mm=np.ptp(corners[:, 2]), long_mm=np.ptp(reach))
    if np.ptp(reach) < _SHORTEST_MM:
        return Reason("ifc.beam_short", long_mm=np.ptp(reach))
    ends = (corners[reach < reach.min() + _AT_END_MM], corners[reach > reach.max() - _AT_END_MM])
    return np.array([_lower_middle(face, along) for face in ends])


def _forwards(way: Array) -> Array:
    """A direction in the plan, (3,) unit, of the two that a line has: exporters draw beams either way."""
    unit = np.array([way[0], way[1], 0.0]) / np.hypot(way[0], way[1])
    backwards = unit[1] < 0.0 if abs(unit[0]) < _ALONG_Y else unit[0] < 0.0
    return np.asarray(-unit if backwards else unit)


def _lower_middle(face: Array, along: Array) -> Array:
    """The middle of the lower edge of an end face (n, 3), (3,) mm."""
    across = np.array([-along[1], along[0], 0.0])
    sides = face @ across
    middle = face[0] + (0.5 * (sides.min() + sides.max()) - sides[0]) * across
    return np.array([middle[0], middle[1], float(face[:, 2].min())])


class Relations:
    """Which columns a model relates to an element, itself or what it is a part of."""

    def __init__(self, file: Any, bodies: Sequence[ColumnBody]) -> None:
        self._place = {number: k for k, body in enumerate(bodies) for number in _own_numbers(body)}
        self._parts = {k: set(body.own_ids) for k, body in enumerate(bodies)}
        self._connected: dict[int, set[int]] = {}
        for relation in file.by_type("IfcRelConnectsElements"):
            first, second = relation.RelatingElement, relation.RelatedElement
            if first is not None and second is not None:
                self._connected.setdefault(first.id(), set()).add(second.id())
                self._connected.setdefault(second.id(), set()).add(first.id())

    def of(self, element: Any) -> dict[int, How]:
        """Columns by their places, and how they are related to an element."""
        own = [element, *ifc_names.parts(element)]
        wholes = ifc_names.wholes(element)
        found = {k: How.ASSEMBLED for k, numbers in self._parts.items() if numbers & {whole.id() for whole in wholes}}
        for one in (*own, *wholes):
            for other in self._connected.get(one.id(), ()):
                if other in self._place:
                    found[self._place[other]] = How.CONNECTED
        return found


def _own_numbers(body: ColumnBody) -> Iterator[int]:
    """Numbers of a column, of its parts, and of the assemblies that hold no other column."""
    yield from (body.element.id(), *(part.id() for part in ifc_names.parts(body.element)))
    for whole in body.wholes:
        if sum(part.is_a("IfcColumn") for part in ifc_names.parts(whole)) <= 1:
            yield whole.id()
