"""Columns of an IFC model: their bodies, their foot faces, and what they are called."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.bars import UP
from aadm_workbench.design.ifc.geometry.placement import frame
from aadm_workbench.design.ifc.geometry.shapes import Shapes
from aadm_workbench.design.ifc.names import optional
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.ifc.words import SLEEVE
from aadm_workbench.design.model_design import NotTaken
from aadm_workbench.design.recognise.paths import length_of
from aadm_workbench.design.recognise.shapes import Prism, Shape, edges
from aadm_workbench.model import Array, BoolArray

_AT_FOOT_MM = 60.0
"""Corners of the concrete this near to the foot face give its size: above its chamfers, below corbels and heads."""

COLUMN_CLASSES = ("IfcBuildingElementProxy", "IfcMember", "IfcBeam", "IfcElementAssembly", "IfcBuildingElementPart")
"""Classes that programs export columns as which they do not know to be columns."""

THINNEST_MM = 200.0
"""No column is thinner; no sleeve and no bar is thicker."""

_ON_FACE_MM = 1e-3  # rounding
_STANDING_COS = 0.7  # 45 degrees: beyond, it lies
_ALONG_COS = 0.7  # 45 degrees: local x runs along the column then, and y gives its x
_STUBBIEST_RATIO = 0.5
"""A standing column is at least half as high as wide (test pieces are short); what is flatter lies."""


@dataclass(frozen=True, eq=False)
class Foot:
    """One end face of a column. ``T_model_foot`` (4, 4): z into the column along its axis, x as the column frame's.

    Its origin is the middle of the face; ``half_size_mm`` (2,) its reach along x and y, ``height_mm`` the length of
    the column, ``sides_mm`` the sides of the smallest rectangle around the face.
    """

    T_model_foot: Array
    half_size_mm: Array
    height_mm: float
    sides_mm: tuple[float, float]

    @property
    def reach_mm(self) -> float:
        """From the middle of the face to its farthest corner, as the frame has it."""
        return length_of(self.half_size_mm)

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
    lying column; ``called`` is what messages call it.
    """

    element: Any
    drawn: tuple[Any, ...]
    feet: tuple[Foot, ...]
    wholes: tuple[Any, ...]
    called: str

    @cached_property
    def piece_marks(self) -> tuple[str | None, ...]:
        """The marks of moulds that it and the assemblies that it is a part of have; None for those without."""
        return tuple(map(ifc_names.piece_mark, (self.element, *self.wholes)))

    @cached_property
    def own_ids(self) -> frozenset[int]:
        """Numbers of the column and the assemblies that it is a part of; a GlobalId may be that of several elements."""
        return frozenset([self.element.id(), *(whole.id() for whole in self.wholes)])


def find_columns(opened: OpenedIfc, shapes: Shapes, selector: str | None) -> tuple[list[ColumnBody], list[NotTaken]]:
    """Every column of a model with its body; those without geometry are listed apart.

    By class IfcColumn and by name, or by the selector instead; an assembly stands for the IfcColumn in it.
    """
    found: list[ColumnBody] = []
    left: list[NotTaken] = []
    for element in _elements(opened, selector):
        body = None
        with shapes.guarded(element):
            if selector is None and _is_sleeve_or_bar(opened, shapes, element):
                continue
            body = _body_of(opened, shapes, element)
        if body is not None:
            found.append(body)
        else:
            left.append(not_a_column(element, shapes.undrawn(element)))
    return found, left


def _body_of(opened: OpenedIfc, shapes: Shapes, element: Any) -> ColumnBody | None:
    own = shapes.of_product(element)
    drawn = [element] if own else concrete_parts(opened, element)
    body = own or [shape for part in drawn for shape in shapes.of_product(part)]
    feet = feet_of(shapes.placements.of_product(element), body)
    if not feet:
        return None
    return ColumnBody(element, tuple(drawn), feet, tuple(ifc_names.wholes(element)), ifc_names.called(element))


def not_a_column(element: Any, reason: str) -> NotTaken:
    """A column that was left out."""
    return NotTaken.of("column", element, reason, names=names(element))


def names(element: Any, piece_marks: Sequence[str | None] | None = None) -> tuple[str, ...]:
    """All that a job may call a column by: Tag, Mark, PieceMark, Name, GlobalId, its assembly's too."""
    called: list[Any] = []
    holders = (element, *ifc_names.wholes(element))
    for holder, piece_mark in zip(holders, piece_marks or map(ifc_names.piece_mark, holders), strict=True):
        called += [optional(holder, "Tag"), ifc_names.mark(holder), piece_mark]
        called += [holder.Name, holder.GlobalId]
    return tuple(dict.fromkeys(text for name in called if (text := ifc_names.text_of(name))))


def _elements(opened: OpenedIfc, selector: str | None) -> Iterator[Any]:
    if selector:
        chosen = ifc_names.select(opened.file, opened.source, "columns", selector)
    else:
        chosen = list(opened.file.by_type("IfcColumn"))
        for ifc_class in COLUMN_CLASSES:
            named = [e for e in opened.file.by_type(ifc_class) if opened.naming.of(e).is_column]
            # Columns inside an assembly speak for themselves.
            chosen += [e for e in named if not any(part.is_a("IfcColumn") for part in ifc_names.parts(e))]
    columns = {column.id(): column for column in (_column_in(element) or element for element in chosen)}
    for column in columns.values():
        # The parts of a column are often called like it.
        if not any(whole.id() in columns for whole in ifc_names.wholes(column)):
            yield column


def _is_sleeve_or_bar(opened: OpenedIfc, shapes: Shapes, element: Any) -> bool:
    """Whether a thin round body is called a sleeve or a bar: a program exports whatever stands upright as a column."""
    if not opened.naming.of(element).is_sleeve_or_bar:
        return False
    outer_mm = [tube.outer_mm for tube in shapes.tubes_of_product(element, coarse=True) if tube.outer_mm is not None]
    return bool(outer_mm) and max(outer_mm) < THINNEST_MM


def _column_in(element: Any) -> Any:
    """The IfcColumn that an assembly is about; None where it has none or several."""
    if not element.is_a("IfcElementAssembly"):
        return None
    columns = [part for part in ifc_names.parts(element) if part.is_a("IfcColumn")]
    return columns[0] if len(columns) == 1 else None


def concrete_parts(opened: OpenedIfc, element: Any) -> list[Any]:
    """The parts of an element that draw its concrete: neither steel nor sleeves."""
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
        if not any(part.is_a(ifc_class) for ifc_class in no_concrete) and not opened.naming.find(SLEEVE, part)
    ]


def feet_of(T_model_element: Array, body: Sequence[Shape]) -> tuple[Foot, ...]:
    """Faces that a column may stand on: its lower end, or both ends where it is drawn lying; none without a body."""
    corners = edges(body).reshape(-1, 3)
    if not len(corners):
        return ()
    axis, stands = _column_axis(T_model_element, body, corners)
    if stands:
        return (_foot(T_model_element, corners, axis),)
    # A column drawn lying, as in the mould: its sleeves will tell which end is the foot.
    return _foot(T_model_element, corners, axis), _foot(T_model_element, corners, -axis)


def head_of(T_model_element: Array, body: Sequence[Shape]) -> Foot | None:
    """The upper end of a standing column as if it were its foot; None of a lying one."""
    corners = edges(body).reshape(-1, 3)
    axis, stands = _column_axis(T_model_element, body, corners)
    return _foot(T_model_element, corners, -axis) if stands else None


def _column_axis(T_model_element: Array, body: Sequence[Shape], corners: Array) -> tuple[Array, bool]:
    """The direction that a column runs along, upwards where it stands, and whether it does."""
    axes = _axes(T_model_element, body)
    reach_mm = [float(np.ptp((corners - corners[0]) @ axis)) for axis in axes]
    upright = [k for k, axis in enumerate(axes) if abs(float(axis @ UP)) > _STANDING_COS]
    if upright and reach_mm[upright[0]] > _STUBBIEST_RATIO * max(reach_mm):
        axis = axes[upright[0]]
        return axis if float(axis @ UP) > 0.0 else -axis, True
    return axes[int(np.argmax(reach_mm))], False


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
    return Foot(T, (high - low) / 2.0, float(np.ptp(local[:, 2])), _sides(face))


def _sides(face: Array) -> tuple[float, float]:
    """Sides of the smallest rectangle around a face (n, 2) mm, the one that runs more along x first.

    Exporters without placements leave the face turned in its frame.
    """
    outline = _outline(face)
    ways = np.roll(outline, -1, axis=0) - outline
    ways = ways[np.linalg.norm(ways, axis=1) > 1.0]
    turns = np.mod(np.arctan2(ways[:, 1], ways[:, 0]) + np.pi / 4.0, np.pi / 2.0) - np.pi / 4.0
    turns = np.concatenate([[0.0], turns])
    across = np.ptp(outline @ np.array([np.cos(turns), np.sin(turns)]), axis=0)
    along = np.ptp(outline @ np.array([-np.sin(turns), np.cos(turns)]), axis=0)
    areas = across * along
    best = int(np.flatnonzero(areas <= areas.min() * (1.0 + 1e-6))[0])  # a sphere's foot is a point
    return float(across[best]), float(along[best])


def _outline(face: Array) -> Array:
    """Corners (k, 2) of the convex outline of points (n, 2), in order (Andrew's monotone chain)."""
    points = np.unique(np.round(face, 6), axis=0).tolist()

    def chain(ordered: Iterable[list[float]]) -> list[list[float]]:
        kept: list[list[float]] = []
        for x, y in ordered:
            while len(kept) > 1 and _turns_right(kept[-2], kept[-1], (x, y)):
                kept.pop()
            kept.append([x, y])
        return kept[:-1]

    return np.array(chain(points) + chain(reversed(points)) or points)


def _turns_right(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> bool:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0
