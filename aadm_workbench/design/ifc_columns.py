"""Columns of an IFC model: their bodies, their foot faces, and what they are called."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.design import ifc_names
from aadm_workbench.design.ifc_bars import UP
from aadm_workbench.design.ifc_file import OpenedIfc
from aadm_workbench.design.ifc_placement import UnreadableGeometryError, frame
from aadm_workbench.design.ifc_shapes import Shapes
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.shapes import Prism, Shape, edges
from aadm_workbench.model import Array, BoolArray

_AT_FOOT_MM = 10.0
"""Corners of the concrete this near to the foot face give its size; corbels and heads are further up."""

_ON_FACE_MM = 1e-3
_STANDING_COS = 0.7
_ALONG_COS = 0.7
_STUBBIEST_RATIO = 0.5
"""A standing column is at least half as high as wide (test pieces are short); what is flatter lies."""


@dataclass(frozen=True, eq=False)
class Foot:
    """One end face of a column. ``T_model_foot`` (4, 4): z into the column along its axis, x as the column frame's.

    Its origin is the middle of the face; ``half_size_mm`` (2,) its reach along x and y, ``height_mm`` the length of
    the column.
    """

    T_model_foot: Array
    half_size_mm: Array
    height_mm: float

    def local(self, points: Array) -> Array:
        """Points (..., 3) of the model frame in this frame; large map coordinates cancel before they are turned."""
        turned: Array = (points - self.T_model_foot[:3, 3]) @ self.T_model_foot[:3, :3]
        return turned

    def encloses(self, points: Array) -> BoolArray:
        """Which points (n, 3) of the model frame lie in the column's concrete, its end faces included."""
        middle = np.array([0.0, 0.0, self.height_mm / 2.0])
        half_mm = np.array([*self.half_size_mm, self.height_mm / 2.0]) + _ON_FACE_MM
        within: BoolArray = np.all(np.abs(self.local(points) - middle) <= half_mm, axis=1)
        return within

    @property
    def stands(self) -> bool:
        """Whether the column stands on this face in the model, as it does on site."""
        return bool(self.T_model_foot[2, 2] > _STANDING_COS)


@dataclass(frozen=True, eq=False)
class ColumnBody:
    """A column of the model before its sleeves are known.

    ``drawn`` are the elements that draw its concrete, itself or its parts; ``feet`` has one face, or both ends of a
    lying column.
    """

    element: Any
    drawn: tuple[Any, ...]
    feet: tuple[Foot, ...]
    wholes: tuple[Any, ...]

    @property
    def own_ids(self) -> frozenset[str]:
        """GlobalIds of the column and the assemblies that it is a part of."""
        return frozenset([self.element.GlobalId, *(whole.GlobalId for whole in self.wholes)])


def find_columns(opened: OpenedIfc, shapes: Shapes, selector: str | None) -> tuple[list[ColumnBody], list[NotTaken]]:
    """Every column of a model with its body; those without geometry are listed apart.

    By class IfcColumn and by name, or by the selector instead; an assembly stands for the IfcColumn in it.
    """
    found: list[ColumnBody] = []
    left: list[NotTaken] = []
    for element in _elements(opened, selector):
        drawn = [element] if shapes.of_product(element) else _concrete_parts(element)
        body = [shape for part in drawn for shape in shapes.of_product(part)]
        try:
            feet = _feet(shapes.placements.of_product(element), body)
        except UnreadableGeometryError:
            feet = ()
        if feet:
            found.append(ColumnBody(element, tuple(drawn), feet, tuple(ifc_names.wholes(element))))
        else:
            left.append(not_a_column(element, "has no geometry that could be evaluated"))
    return found, left


def not_a_column(element: Any, reason: str) -> NotTaken:
    """A column that was looked at and left out."""
    return NotTaken(
        what="column",
        ifc_class=element.is_a(),
        global_id=element.GlobalId,
        name=element.Name or "",
        reason=reason,
        names=names(element),
    )


def names(element: Any) -> tuple[str, ...]:
    """All that a job may call a column by: Tag, PieceMark, Name, GlobalId, its assembly's too."""
    called: list[str | None] = []
    for holder in (element, *ifc_names.wholes(element)):
        called += [getattr(holder, "Tag", None), ifc_names.piece_mark(holder), holder.Name, holder.GlobalId]
    return tuple(dict.fromkeys(name.strip() for name in called if name and name.strip()))


def _elements(opened: OpenedIfc, selector: str | None) -> Iterator[Any]:
    if selector:
        chosen = ifc_names.select(opened.file, opened.source, "columns", selector)
    else:
        chosen = list(opened.file.by_type("IfcColumn"))
        for ifc_class in ("IfcBuildingElementProxy", "IfcMember", "IfcElementAssembly", "IfcBuildingElementPart"):
            named = [e for e in opened.file.by_type(ifc_class) if ifc_names.COLUMN.search(ifc_names.texts(e))]
            # Columns inside an assembly speak for themselves.
            chosen += [e for e in named if not any(part.is_a("IfcColumn") for part in ifc_names.parts(e))]
    columns = {column.id(): column for column in (_column_in(element) or element for element in chosen)}
    for column in columns.values():
        # The parts of a column are often called like it.
        if not any(whole.id() in columns for whole in ifc_names.wholes(column)):
            yield column


def _column_in(element: Any) -> Any:
    """The IfcColumn that an assembly is about; None where it has none or several."""
    if not element.is_a("IfcElementAssembly"):
        return None
    columns = [part for part in ifc_names.parts(element) if part.is_a("IfcColumn")]
    return columns[0] if len(columns) == 1 else None


def _concrete_parts(element: Any) -> list[Any]:
    no_concrete = (
        "IfcDiscreteAccessory",
        "IfcFastener",
        "IfcFeatureElement",
        "IfcMechanicalFastener",
        "IfcReinforcingElement",
    )
    return [
        part
        for part in ifc_names.parts(element)
        if not any(part.is_a(ifc_class) for ifc_class in no_concrete)
        and not ifc_names.SLEEVE.search(ifc_names.texts(part))
    ]


def _feet(T_model_element: Array, body: Sequence[Shape]) -> tuple[Foot, ...]:
    corners = edges(body).reshape(-1, 3)
    if not len(corners):
        return ()
    axes = _axes(T_model_element, body)
    reach_mm = [float(np.ptp((corners - corners[0]) @ axis)) for axis in axes]
    upright = [k for k, axis in enumerate(axes) if abs(float(axis @ UP)) > _STANDING_COS]
    if upright and reach_mm[upright[0]] > _STUBBIEST_RATIO * max(reach_mm):
        axis = axes[upright[0]]
        return (_foot(T_model_element, corners, axis if float(axis @ UP) > 0.0 else -axis),)
    # A column drawn lying, as in the mould: its sleeves will tell which end is the foot.
    axis = axes[int(np.argmax(reach_mm))]
    return _foot(T_model_element, corners, axis), _foot(T_model_element, corners, -axis)


def _axes(T_model_element: Array, body: Sequence[Shape]) -> list[Array]:
    """Directions that a column may run along: of its extrusions first, then of its placement."""
    sweeps = [shape.sweep / np.linalg.norm(shape.sweep) for shape in body if isinstance(shape, Prism)]
    return [*sweeps, *(T_model_element[:3, axis] for axis in (2, 0, 1))]


def _foot(T_model_element: Array, corners: Array, axis: Array) -> Foot:
    x, y = T_model_element[:3, 0], T_model_element[:3, 1]
    # Some exporters let the placement's x run along the column, as for beams.
    T = frame(corners[0], axis, y if abs(float(x @ axis)) > _ALONG_COS else x)
    local = (corners - corners[0]) @ T[:3, :3]
    foot_mm = float(local[:, 2].min())
    face = local[local[:, 2] < foot_mm + _AT_FOOT_MM, :2]
    low, high = face.min(axis=0), face.max(axis=0)
    T[:3, 3] = corners[0] + T[:3, :3] @ np.array([*(low + high) / 2.0, foot_mm])
    return Foot(T, (high - low) / 2.0, float(np.ptp(local[:, 2])))
