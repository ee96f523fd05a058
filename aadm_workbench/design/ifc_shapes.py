"""Shapes of an IFC product: what is drawn, evaluated in float64 millimetres without tessellation."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design.circles import Circle
from aadm_workbench.design.ifc_curve import Curves
from aadm_workbench.design.ifc_placement import Placements, UnreadableGeometryError, unit
from aadm_workbench.design.ifc_profile import Profiles
from aadm_workbench.design.shapes import Cut, HalfSpace, Loop, Mesh, Prism, Shape, SweptDisk, Turned
from aadm_workbench.design.tubes import Tube, moved, tubes
from aadm_workbench.model import Array, IntArray

_NOT_BODIES = frozenset(
    {"Annotation", "Axis", "Box", "Clearance", "CoG", "FootPrint", "Lighting", "Plan", "Profile", "Reference"}
)

_BROKEN = (UnreadableGeometryError, TypeError, ValueError, IndexError, AttributeError, np.linalg.LinAlgError)
"""What numbers and references that are missing or make no sense raise, in a file by strangers."""


@dataclass(frozen=True, eq=False)
class Shapes:
    """Evaluates the shapes of products and keeps those that are drawn many times.

    ``problems`` collects what could not be evaluated, one line for each kind.
    """

    placements: Placements
    curves: Curves
    profiles: Profiles
    problems: list[str] = field(default_factory=list)
    _known: dict[int, tuple[Shape, ...]] = field(default_factory=dict, repr=False)
    _tubes: dict[int, tuple[Tube, ...]] = field(default_factory=dict, repr=False)
    _products: dict[int, tuple[Shape, ...]] = field(default_factory=dict, repr=False)

    def of_product(self, product: Any) -> tuple[Shape, ...]:
        """The bodies of a product, mm, in the model frame; none where it has none or they are broken."""
        if product.id() not in self._products:
            self._products[product.id()] = self._placed(product)
        return self._products[product.id()]

    def _placed(self, product: Any) -> tuple[Shape, ...]:
        try:
            T = self.placements.of_product(product)
            return tuple(shape.moved(T) for item in _body_items(product) for shape in self.of_item(item))
        except _BROKEN as error:
            self.problems.append(f"{product.is_a()} {product.GlobalId}: its geometry was left out: {error}")
            return ()

    def tubes_of_product(self, product: Any) -> tuple[Tube, ...]:
        """Straight round bodies and holes of a product, mm, in the model frame."""
        if not self.of_product(product):
            return ()
        T = self.placements.of_product(product)
        return tuple(moved(tube, T) for item in _body_items(product) for tube in self._tubes_of_item(item))

    def _tubes_of_item(self, item: Any) -> tuple[Tube, ...]:
        """Found once for all occurrences of a type: facets by the thousand take their time."""
        if item.id() not in self._tubes:
            if item.is_a("IfcMappedItem"):
                T = self._mapping(item)
                parts = item.MappingSource.MappedRepresentation.Items
                found = [moved(tube, T) for part in parts for tube in self._tubes_of_item(part)]
            else:
                found = [tube for shape in self.of_item(item) for tube in tubes(shape)]
            self._tubes[item.id()] = tuple(found)
        return self._tubes[item.id()]

    def of_item(self, item: Any) -> tuple[Shape, ...]:
        """The solids of one representation item, mm, in the item's own frame."""
        if item.id() not in self._known:
            try:
                shapes = tuple(self._evaluated(item))
            except _BROKEN:
                shapes = (self._tessellated(item),)
            self._known[item.id()] = shapes
        return self._known[item.id()]

    def _evaluated(self, item: Any) -> Sequence[Shape]:
        for ifc_class, evaluate in self._evaluators.items():
            if item.is_a(ifc_class):
                return evaluate(item)
        raise UnreadableGeometryError(f"#{item.id()} {item.is_a()} is not evaluated")

    @cached_property
    def _evaluators(self) -> dict[str, Callable[[Any], Sequence[Shape]]]:
        return {
            "IfcMappedItem": self._mapped,
            "IfcSweptDiskSolid": self._swept_disk,
            "IfcExtrudedAreaSolid": self._extruded,
            "IfcRevolvedAreaSolid": self._revolved,
            "IfcRightCircularCylinder": self._cylinder,
            "IfcBooleanResult": self._boolean,
            "IfcCsgSolid": lambda item: self.of_item(item.TreeRootExpression),
            "IfcHalfSpaceSolid": self._half_space,
            "IfcManifoldSolidBrep": lambda item: [self._faces(item.Outer.CfsFaces)],
            "IfcFaceBasedSurfaceModel": lambda item: [self._faces(_faces_of(item.FbsmFaces))],
            "IfcShellBasedSurfaceModel": lambda item: [self._faces(_faces_of(item.SbsmBoundary))],
            "IfcTriangulatedFaceSet": self._triangles,
            "IfcPolygonalFaceSet": self._polygons,
        }

    def _mapped(self, item: Any) -> list[Shape]:
        T = self._mapping(item)
        parts = item.MappingSource.MappedRepresentation.Items
        return [shape.moved(T) for part in parts for shape in self.of_item(part)]

    def _mapping(self, item: Any) -> Array:
        origin = self.placements.of_axes(item.MappingSource.MappingOrigin)
        return self.placements.of_operator(item.MappingTarget) @ origin

    def _swept_disk(self, item: Any) -> list[Shape]:
        mm = self.placements.mm
        legs = self.curves.swept(item.Directrix, item.StartParam, item.EndParam)
        inner_mm = None if item.InnerRadius is None else mm * item.InnerRadius
        return [SweptDisk(tuple(legs), mm * item.Radius, inner_mm)]

    def _extruded(self, item: Any) -> list[Shape]:
        if item.is_a("IfcExtrudedAreaSolidTapered"):
            raise UnreadableGeometryError(f"#{item.id()} tapers")
        T = self.placements.of_axes(item.Position)
        sweep = T[:3, :3] @ (self.placements.mm * item.Depth * unit(item.ExtrudedDirection.DirectionRatios))
        areas = [area.moved(T) for area in self.profiles.areas(item.SweptArea)]
        return [Prism(area.outer, area.holes, sweep) for area in areas]

    def _revolved(self, item: Any) -> list[Shape]:
        if item.is_a("IfcRevolvedAreaSolidTapered") or abs(item.Angle * self.curves.radians) < 2.0 * math.pi - 1e-6:
            raise UnreadableGeometryError(f"#{item.id()} is no full turn")
        origin = self.placements.point(item.Axis.Location)
        axis = unit(item.Axis.Axis.DirectionRatios) if item.Axis.Axis else np.array([0.0, 0.0, 1.0])
        T = self.placements.of_axes(item.Position)
        turned: list[Shape] = []
        for area in self.profiles.areas(item.SweptArea):
            spokes = area.outer.points - origin
            height = spokes @ axis
            radius = np.linalg.norm(spokes - height[:, np.newaxis] * axis, axis=1)
            turned.append(Turned(origin, axis, np.column_stack([radius, height])).moved(T))
        return turned

    def _cylinder(self, item: Any) -> list[Shape]:
        T = self.placements.of_axes(item.Position)
        mm = self.placements.mm
        angle = np.radians(np.arange(0.0, 360.0, 5.0))[:, np.newaxis]
        ring = T[:3, 3] + mm * item.Radius * (np.cos(angle) * T[:3, 0] + np.sin(angle) * T[:3, 1])
        circle = Circle(T[:3, 3], T[:3, 2], mm * item.Radius)
        return [Prism(Loop(ring, circle), (), mm * item.Height * T[:3, 2])]

    def _boolean(self, item: Any) -> list[Shape]:
        bodies = list(self.of_item(item.FirstOperand))
        if item.Operator == "UNION":
            return bodies + list(self.of_item(item.SecondOperand))
        if item.Operator == "DIFFERENCE":
            for tool in self.of_item(item.SecondOperand):
                bodies = [Cut(body, tool) for body in bodies]
        return bodies

    def _half_space(self, item: Any) -> list[Shape]:
        surface = item.BaseSurface
        if not surface.is_a("IfcPlane"):
            raise UnreadableGeometryError(f"#{item.id()} is bounded by {surface.is_a()}")
        T = self.placements.of_axes(surface.Position)
        towards = -T[:3, 2] if item.AgreementFlag else T[:3, 2]
        return [HalfSpace(T[:3, 3], towards, bounded=item.is_a() != "IfcHalfSpaceSolid")]

    def _faces(self, faces: Sequence[Any]) -> Mesh:
        vertices: list[Array] = []
        index: dict[int, int] = {}
        found = []
        for face in faces:
            if face.is_a("IfcAdvancedFace") and not face.FaceSurface.is_a("IfcPlane"):
                raise UnreadableGeometryError(f"#{face.id()} is curved")
            bounds = sorted(face.Bounds, key=lambda bound: not bound.is_a("IfcFaceOuterBound"))
            loops: list[IntArray] = []
            for bound in bounds:
                for point in bound.Bound.Polygon:
                    if point.id() not in index:
                        index[point.id()] = len(vertices)
                        vertices.append(self.placements.point(point))
                loops.append(np.array([index[point.id()] for point in bound.Bound.Polygon], dtype=np.int64))
            found.append(tuple(loops))
        return Mesh(np.array(vertices), tuple(found))

    def _triangles(self, item: Any) -> list[Shape]:
        corners = np.array(item.CoordIndex, dtype=np.int64) - 1
        if renumbered := getattr(item, "PnIndex", None):
            corners = np.array(renumbered, dtype=np.int64)[corners] - 1
        return [Mesh(self._coordinates(item), tuple((triangle,) for triangle in corners))]

    def _polygons(self, item: Any) -> list[Shape]:
        renumbered = None if item.PnIndex is None else np.array(item.PnIndex, dtype=np.int64)
        faces = []
        for face in item.Faces:
            inner = face.InnerCoordIndices if face.is_a("IfcIndexedPolygonalFaceWithVoids") else ()
            loops = [np.array(loop, dtype=np.int64) - 1 for loop in (face.CoordIndex, *inner)]
            faces.append(tuple(loop if renumbered is None else renumbered[loop] - 1 for loop in loops))
        return [Mesh(self._coordinates(item), tuple(faces))]

    def _coordinates(self, item: Any) -> Array:
        return self.placements.mm * np.array(item.Coordinates.CoordList, dtype=np.float64)

    def _tessellated(self, item: Any) -> Shape:
        """The solid as ifcopenshell's geometry kernel facets it: for whatever is not evaluated here."""
        import ifcopenshell.geom

        kernel: Any = ifcopenshell.geom
        try:
            drawn = kernel.create_shape(kernel.settings(), item)
        except RuntimeError as error:
            raise UnreadableGeometryError(f"#{item.id()} {item.is_a()} cannot be evaluated") from error
        vertices = 1000.0 * np.array(drawn.verts, dtype=np.float64).reshape(-1, 3)
        corners = np.array(drawn.faces, dtype=np.int64).reshape(-1, 3)
        if not len(corners):
            raise UnreadableGeometryError(f"#{item.id()} {item.is_a()} encloses nothing")
        return Mesh(vertices, tuple((triangle,) for triangle in corners))


def _body_items(product: Any) -> list[Any]:
    """Representation items of what a product is, not of its axis, box or footprint."""
    representation = getattr(product, "Representation", None)
    if representation is None:
        return []
    drawn = [shape for shape in representation.Representations if shape.RepresentationIdentifier not in _NOT_BODIES]
    bodies = [shape for shape in drawn if shape.RepresentationIdentifier == "Body"] or drawn[:1]
    return [item for shape in bodies for item in shape.Items]


def _faces_of(shells: Sequence[Any]) -> list[Any]:
    return [face for shell in shells for face in shell.CfsFaces]


def evaluator(mm: float, radians: float) -> Shapes:
    """An evaluator for a file whose units of length and angle are given in millimetres and radians."""
    placements = Placements(mm)
    curves = Curves(placements, radians)
    return Shapes(placements, curves, Profiles(placements, curves))
