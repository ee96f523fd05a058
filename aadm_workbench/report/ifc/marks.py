"""As-built centres in the model: small disks with arrows, in the storey of the column, coloured by verdict.

Each mark is an IfcAnnotation whose placement is the measured centre, its x axis along the deviation. It is drawn twice:
as solids, which every viewer shows, and as curves, which is what FreeCAD draws of an annotation. Marks of one verdict
and length share what is drawn: a floor has far more points than lengths. Layers and a group switch them off together.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from aadm_workbench.model import Array, ColumnReport, Kind, PointResult
from aadm_workbench.report.ifc.addition import Addition
from aadm_workbench.report.words.labels import COLOUR

MAGNIFIED = 20.0
"""Arrows are this many times as long as the deviation."""

_DISK_RADIUS_MM, _THICKNESS_MM = 6.0, 2.0  # smaller than any bar, and seen from a room away
_ARROW_MM = 100.0
"""Length of the arrow as drawn once; each length scales it."""
_STEP_MM = 0.1
"""Deviations are drawn in steps, so that marks share what is drawn: an arrow of 40 mm is 1 mm off at most, a sixth of
the disk that it begins at. The property sets hold the values."""
# per cent of its length: a shaft, and a head of 30
_ARROW = ((0.0, -3.0), (70.0, -3.0), (70.0, -11.0), (100.0, 0.0), (70.0, 11.0), (70.0, 3.0), (0.0, 3.0))
_STEP_DEG = 3.0
"""And so are their directions: the end of an arrow of 40 mm is 1 mm off at most."""
_LAYERS = {Kind.SLEEVE: "AADM as-built sleeves", Kind.REBAR: "AADM as-built bars"}
_BELOW = {Kind.SLEEVE: -_THICKNESS_MM, Kind.REBAR: 0.0}
"""Marks of sleeves hang below the foot face, those of bars lie on their tops: outside of concrete and steel."""


@dataclass(frozen=True, eq=False)
class _Seen:
    """A point that was measured: its deviation in steps, and where its mark stands in the frame of its storey."""

    kind: Kind
    point: PointResult
    steps: int
    T_parent_mark: Array

    @property
    def drawn_mm(self) -> float:
        """The deviation as it is drawn."""
        return self.steps * _STEP_MM


@dataclass
class Marks:
    """Draws marks and, at the end, what holds them together."""

    addition: Addition
    drawn: list[Any] = field(default_factory=list)
    _shapes: dict[str, list[Any]] = field(default_factory=dict)
    _contained: dict[int, tuple[Any, list[Any]]] = field(default_factory=dict)
    _maps: dict[tuple[str, ...], Any] = field(default_factory=dict)
    _drawings: dict[tuple[object, ...], list[list[Any]]] = field(default_factory=dict)
    _definitions: dict[tuple[object, ...], Any] = field(default_factory=dict)
    _once: dict[str, Any] = field(default_factory=dict)

    def draw(self, column: ColumnReport, element: Any, T_model_column: Array) -> None:
        """Mark every measured centre of a column; ``T_model_column`` (4, 4), mm, world coordinate system included."""
        from ifcopenshell.util.element import get_container

        container = get_container(element)
        context = _context_of(element, self.addition.file)
        T_parent_column = _relative(self._frame_of(container, context), T_model_column)
        for kind in Kind:
            for point in column.points(kind):
                if point.aligned_mm is not None and point.offset_mm is not None:
                    steps = round(float(np.hypot(*point.offset_mm)) / _STEP_MM)
                    T_column_mark = _along(point.offset_mm) if steps else np.eye(4)
                    T_column_mark[:3, 3] = point.aligned_mm
                    seen = _Seen(kind, point, steps, T_parent_column @ T_column_mark)
                    mark = self._mark(column, element, seen, container, context)
                    self.drawn.append(mark)
                    if container is not None:
                        self._contained.setdefault(container.id(), (container, []))[1].append(mark)

    def finish(self) -> None:
        """Contain the marks in their storeys, group them, and put them on layers."""
        add = self.addition
        for container, marks in self._contained.values():
            add.rooted(
                "IfcRelContainedInSpatialStructure",
                ("marks", container.GlobalId),
                "AADM as-built centres",
                RelatingStructure=container,
                RelatedElements=marks,
            )
        if self.drawn:
            group = add.rooted(
                "IfcGroup",
                ("marks",),
                "AADM as-built centres",
                Description=f"Disks stand at measured centres; arrows start at designed ones and are {MAGNIFIED:g} "
                "times as long as the deviation.",
                ObjectType="AADM as-built centres",
            )
            add.rooted(
                "IfcRelAssignsToGroup",
                ("marks",),
                "AADM as-built centres",
                RelatedObjects=self.drawn,
                RelatingGroup=group,
            )
        for layer, shapes in self._shapes.items():
            add.new("IfcPresentationLayerAssignment", Name=layer, AssignedItems=shapes)

    def _frame_of(self, container: Any, context: Any) -> Array:
        """``T_model_container`` (4, 4), mm: the world coordinate system, then the container's placement."""
        from ifcopenshell.util.placement import get_axis2placement, get_local_placement

        world = getattr(context, "WorldCoordinateSystem", None)
        T_model_world = np.eye(4) if world is None else np.array(get_axis2placement(world), dtype=float)
        placement = getattr(container, "ObjectPlacement", None)
        T = np.array(T_model_world @ np.array(get_local_placement(placement)) if placement else T_model_world)
        T[:3, 3] *= self.addition.mm
        return T

    def _mark(
        self,
        column: ColumnReport,
        element: Any,
        seen: _Seen,
        container: Any,
        context: Any,
    ) -> Any:
        add, point = self.addition, seen.point
        placement = add.new(
            "IfcLocalPlacement",
            PlacementRelTo=getattr(container, "ObjectPlacement", None),
            RelativePlacement=add.axes(seen.T_parent_mark),
        )
        said = (
            f"Column {column.id}, {point.label}: {point.deviation_mm or 0.0:.2f} mm from design, "
            f"{point.verdict.replace('_', ' ')}"
        )
        attributes = {"PredefinedType": "USERDEFINED"} if add.is_4x3 else {}
        return add.rooted(
            "IfcAnnotation",
            (element.GlobalId, point.label),
            f"{point.label} as-built",
            Description=said,
            ObjectType="AADM as-built centre",
            ObjectPlacement=placement,
            Representation=self._drawing(seen, context),
            **attributes,
        )

    def _drawing(self, seen: _Seen, context: Any) -> Any:
        """What a mark looks like. IFC2X3 wants a definition for each mark; there the items alone are shared."""
        key = (seen.kind, seen.point.verdict, seen.steps, context.id())
        if key not in self._drawings:
            self._drawings[key] = [list(self._solids(seen, context)), [self._curves(seen.drawn_mm)]]
        if self.addition.is_2x3 or key not in self._definitions:
            kinds = (("Body", "MappedRepresentation"), ("Annotation", "GeometricCurveSet"))
            shapes = [
                self._shape(context, *kind, items) for kind, items in zip(kinds, self._drawings[key], strict=True)
            ]
            self._shapes.setdefault(_LAYERS[seen.kind], []).extend(shapes)
            self._definitions[key] = self.addition.new("IfcProductDefinitionShape", Representations=shapes)
        return self._definitions[key]

    def _shape(self, context: Any, identifier: str, kind: str, items: Sequence[Any]) -> Any:
        return self.addition.new(
            "IfcShapeRepresentation",
            ContextOfItems=context,
            RepresentationIdentifier=identifier,
            RepresentationType=kind,
            Items=items,
        )

    def _solids(self, seen: _Seen, context: Any) -> Iterator[Any]:
        """A disk at the measured centre, and the arrow from the designed one."""
        add = self.addition
        in_place = self._once.get("in place")
        if in_place is None:
            in_place = add.new("IfcCartesianTransformationOperator3D", LocalOrigin=add.point(0.0, 0.0, 0.0))
            self._once["in place"] = in_place
        yield add.new("IfcMappedItem", MappingSource=self._map("disk", seen, context), MappingTarget=in_place)
        if seen.steps:
            target = add.new(
                "IfcCartesianTransformationOperator3D",
                LocalOrigin=add.point(-seen.drawn_mm, 0.0, 0.0),
                Scale=round(MAGNIFIED * seen.drawn_mm / _ARROW_MM, 9),
            )
            yield add.new("IfcMappedItem", MappingSource=self._map("arrow", seen, context), MappingTarget=target)

    def _map(self, what: str, seen: _Seen, context: Any) -> Any:
        """A disk or an arrow of one colour, drawn once and used by all marks."""
        key = (what, seen.kind, seen.point.verdict, str(context.id()))
        if key not in self._maps:
            add = self.addition
            lower = np.eye(4)
            lower[2, 3] = _BELOW[seen.kind]
            solid = add.new(
                "IfcExtrudedAreaSolid",
                SweptArea=self._profile(what),
                Position=add.axes(lower),
                ExtrudedDirection=add.direction(np.array([0.0, 0.0, 1.0])),
                Depth=add.length(_THICKNESS_MM),
            )
            add.new("IfcStyledItem", Item=solid, Styles=[self._style(seen.point.verdict)])
            shape = self._shape(context, "Body", "SweptSolid", [solid])
            self._maps[key] = add.new(
                "IfcRepresentationMap", MappingOrigin=add.axes(np.eye(4)), MappedRepresentation=shape
            )
        return self._maps[key]

    def _profile(self, what: str) -> Any:
        add = self.addition
        if what not in self._once:
            if what == "disk":
                flat = add.new("IfcAxis2Placement2D", Location=add.point(0.0, 0.0))
                profile = add.new(
                    "IfcCircleProfileDef", ProfileType="AREA", Position=flat, Radius=add.length(_DISK_RADIUS_MM)
                )
            else:
                corners = [add.point(*corner) for corner in _ARROW]
                outline = add.new("IfcPolyline", Points=[*corners, corners[0]])
                profile = add.new("IfcArbitraryClosedProfileDef", ProfileType="AREA", OuterCurve=outline)
            self._once[what] = profile
        return self._once[what]

    def _style(self, verdict: str) -> Any:
        add, key = self.addition, f"style {verdict}"
        if key not in self._once:
            red, green, blue = (part / 255.0 for part in bytes.fromhex(COLOUR[verdict].removeprefix("#")))
            colour = add.new("IfcColourRgb", Red=red, Green=green, Blue=blue)
            shading = add.new("IfcSurfaceStyleRendering", SurfaceColour=colour, ReflectanceMethod="FLAT")
            style = add.new("IfcSurfaceStyle", Name=f"AADM {verdict}", Side="BOTH", Styles=[shading])
            self._once[key] = add.new("IfcPresentationStyleAssignment", Styles=[style]) if add.is_2x3 else style
        return self._once[key]

    def _curves(self, drawn_mm: float) -> Any:
        """The rim of the disk, and the arrow as one line; they have no colour, and all of a length share them."""
        add, key = self.addition, f"curves {drawn_mm:.3f}"
        if key in self._once:
            return self._once[key]
        if "rim" not in self._once:
            flat = add.axes(np.eye(4))
            self._once["rim"] = add.new("IfcCircle", Position=flat, Radius=add.length(_DISK_RADIUS_MM))
        elements = [self._once["rim"]]
        if drawn_mm > 0.0:
            length, wide = MAGNIFIED * drawn_mm, 0.11 * MAGNIFIED * drawn_mm
            tip, neck = length - drawn_mm, 0.7 * length - drawn_mm
            ends = ((-drawn_mm, 0.0), (tip, 0.0), (neck, wide), (tip, 0.0), (neck, -wide))
            elements.append(add.new("IfcPolyline", Points=[add.point(x, y, 0.0) for x, y in ends]))
        self._once[key] = add.new("IfcGeometricCurveSet", Elements=elements)
        return self._once[key]


def _along(offset_mm: tuple[float, float]) -> Array:
    """A frame (4, 4) at its parent's origin, its x axis along an offset in the parent's plane."""
    dx, dy = offset_mm
    turn = np.radians(round(float(np.degrees(np.arctan2(dy, dx))) / _STEP_DEG) * _STEP_DEG)
    cos, sin = np.cos(turn), np.sin(turn)
    T = np.eye(4)
    T[:2, :2] = [[cos, -sin], [sin, cos]]
    return T


def _relative(T_model_parent: Array, T_model_own: Array) -> Array:
    """``T_parent_own``; map coordinates of thousands of kilometres cancel before they are turned."""
    turn = T_model_parent[:3, :3].T
    T = np.eye(4)
    T[:3, :3] = turn @ T_model_own[:3, :3]
    T[:3, 3] = turn @ (T_model_own[:3, 3] - T_model_parent[:3, 3])
    T[:3, :3][np.abs(T[:3, :3]) < 1e-12] = 0.0
    return T


def _context_of(element: Any, file: Any) -> Any:
    """The context in which the column is drawn, for its world coordinate system moves everything in it."""
    from ifcopenshell.util.element import get_parts

    for drawn in (element, *get_parts(element)):
        shapes = getattr(getattr(drawn, "Representation", None), "Representations", ())
        for shape in shapes:
            context = shape.ContextOfItems
            if context is not None:
                return context.ParentContext if context.is_a("IfcGeometricRepresentationSubContext") else context
    contexts = file.by_type("IfcGeometricRepresentationContext", include_subtypes=False)
    return next((context for context in contexts if context.ContextType == "Model"), contexts[0])
