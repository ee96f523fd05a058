"""Solids of IFC models: what is drawn, evaluated in float64 millimetres without tessellation."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.geometry.curve import Curves, check_turn
from aadm_workbench.design.ifc.geometry.kernel import Kernel
from aadm_workbench.design.ifc.geometry.placement import (
    NothingThereError,
    Placements,
    UnreadableGeometryError,
    unit,
    within,
)
from aadm_workbench.design.ifc.geometry.profile import Profiles
from aadm_workbench.design.ifc.names import optional
from aadm_workbench.design.recognise.circles import Circle
from aadm_workbench.design.recognise.paths import Arc, rounded
from aadm_workbench.design.recognise.shapes import Cut, HalfSpace, Loop, Mesh, Prism, Shape, SweptDisk, Turned, pieces
from aadm_workbench.design.sound import FARTHEST_MM, UnsoundError, sound
from aadm_workbench.model import Array, IntArray, Reason

BROKEN = (
    UnreadableGeometryError,
    TypeError,
    ValueError,
    LookupError,
    AttributeError,
    ArithmeticError,
    RuntimeError,
    SystemError,
    np.linalg.LinAlgError,
)
"""What numbers and references that are missing, make no sense or go in circles raise, in a file by strangers."""

_MOST_PIECES = 5000
"""Solids that one is made of by cutting; programs that cut a hundred holes one by one stay far below."""


@dataclass(frozen=True, eq=False)
class Solids:
    """Evaluates representation items, and keeps those that are drawn many times."""

    placements: Placements
    curves: Curves
    profiles: Profiles
    kernel: Kernel = field(default_factory=Kernel)
    _known: dict[int, tuple[Shape, ...]] = field(default_factory=dict, repr=False)
    _begun: set[int] = field(default_factory=set, repr=False)

    def leave_out(self, item: Any) -> None:
        """Take an item for nothing: it is broken."""
        self._known[item.id()] = ()

    def anchor(self, item: Any) -> Array | None:
        """A point (3,) mm on or in a solid, in the item's own frame, before it is evaluated; None where that is cheap.

        Facets by the thousand take their time, and most of them are nowhere near a column's foot.
        """
        if item.id() in self._known:
            return None
        try:
            return self._anchor(item)
        except BROKEN:
            return None

    def _anchor(self, item: Any) -> Array | None:
        if item.is_a("IfcTessellatedFaceSet"):
            return self.placements.coordinates(item.Coordinates.CoordList[0])
        if item.is_a("IfcFacetedBrep"):
            return self.placements.point(item.Outer.CfsFaces[0].Bounds[0].Bound.Polygon[0])
        if item.is_a("IfcExtrudedAreaSolid") and item.SweptArea.is_a("IfcParameterizedProfileDef"):
            T = self.placements.of_axes(item.Position)
            middle: Array = T[:3, :3] @ self.placements.of_axes(item.SweptArea.Position)[:3, 3] + T[:3, 3]
            return middle
        return None

    def of_item(self, item: Any) -> tuple[Shape, ...]:
        """The solids of one representation item, mm, in the item's own frame.

        Raises
        ------
        UnreadableGeometryError
            Where it is broken, encloses nothing or is a part of itself.
        """
        number = item.id()
        if number not in self._known:
            with within(self._begun, item):
                self._known[number] = self._sound(item)
        return self._known[number]

    def _sound(self, item: Any) -> tuple[Shape, ...]:
        try:
            shapes = tuple(sound(shape) for shape in self._evaluated(item))
        except UnsoundError as error:
            raise NothingThereError(Reason("geometry.item", id=item.id(), type=item.is_a(), why=error)) from error
        except (RecursionError, SystemError) as error:  # the second from deep inside ifcopenshell
            raise NothingThereError(Reason("geometry.nested", id=item.id(), type=item.is_a())) from error
        except NothingThereError:
            raise
        except BROKEN:
            self._check_sizes(item)
            shapes = self._tessellated(item)
        if sum(map(pieces, shapes)) > _MOST_PIECES:
            raise NothingThereError(Reason("geometry.made_of", id=item.id(), type=item.is_a(), most=_MOST_PIECES))
        return shapes

    def _check_sizes(self, item: Any) -> None:
        """Keep a solid from the kernel that has a size beyond all maps, over which it would sit for hours."""
        for value in item:
            if isinstance(value, float) and not abs(value) * self.placements.mm < FARTHEST_MM:
                raise NothingThereError(Reason("geometry.size", id=item.id(), type=item.is_a(), size=value))

    def _evaluated(self, item: Any) -> Sequence[Shape]:
        for ifc_class, evaluate in self._evaluators.items():
            if item.is_a(ifc_class):
                return evaluate(item)
        raise UnreadableGeometryError(Reason("geometry.not_evaluated", id=item.id(), type=item.is_a()))

    @cached_property
    def _evaluators(self) -> dict[str, Callable[[Any], Sequence[Shape]]]:
        return {
            "IfcSweptDiskSolid": self._swept_disk,
            "IfcExtrudedAreaSolidTapered": self._tapered,
            "IfcExtrudedAreaSolid": self._extruded,
            "IfcFixedReferenceSweptAreaSolid": self._swept_along,
            "IfcSurfaceCurveSweptAreaSolid": self._swept_along,
            "IfcRevolvedAreaSolid": self._revolved,
            "IfcRightCircularCylinder": self._cylinder,
            "IfcRightCircularCone": self._cone,
            "IfcBooleanResult": self._boolean,
            "IfcCsgSolid": lambda item: self.of_item(item.TreeRootExpression),
            "IfcHalfSpaceSolid": self._half_space,
            "IfcManifoldSolidBrep": lambda item: [self._faces(item.Outer.CfsFaces)],
            "IfcFaceBasedSurfaceModel": lambda item: [self._faces(_faces_of(item.FbsmFaces))],
            "IfcShellBasedSurfaceModel": lambda item: [self._faces(_faces_of(item.SbsmBoundary))],
            "IfcTriangulatedFaceSet": self._triangles,
            "IfcPolygonalFaceSet": self._polygons,
        }

    def _swept_disk(self, item: Any) -> list[Shape]:
        mm = self.placements.mm
        legs = self.curves.swept(item.Directrix, item.StartParam, item.EndParam)
        inner_mm = None if item.InnerRadius is None else mm * item.InnerRadius
        if fillet := optional(item, "FilletRadius"):
            legs = rounded(legs, mm * fillet)
        return [SweptDisk(tuple(legs), mm * item.Radius, inner_mm)]

    def _extruded(self, item: Any) -> list[Shape]:
        T = self.placements.of_axes(item.Position)
        sweep = T[:3, :3] @ (self.placements.mm * item.Depth * unit(item.ExtrudedDirection.DirectionRatios))
        areas = [area.moved(T) for area in self.profiles.areas(item.SweptArea)]
        return [Prism(area.outer, area.holes, sweep) for area in areas]

    def _tapered(self, item: Any) -> list[Shape]:
        """A cone, hollow or not, about the axis of its extrusion."""
        along = self.placements.mm * item.Depth * unit(item.ExtrudedDirection.DirectionRatios)
        ends = [self.profiles.areas(profile) for profile in (item.SweptArea, item.EndSweptArea)]
        circles = [[area[0].outer.circle, *(hole.circle for hole in area[0].holes)] for area in ends]
        radii = [[circle.radius_mm for circle in end if circle is not None] for end in circles]
        first, last = (end[0] for end in circles)
        if first is None or last is None or len(radii[0]) != len(radii[1]) or len(radii[0]) > 2:
            raise UnreadableGeometryError(Reason("geometry.tapers", id=item.id()))
        upright = abs(float(unit(along) @ first.normal)) > 1.0 - 1e-12
        if not upright or np.linalg.norm(first.centre - last.centre) > 1e-9:
            raise UnreadableGeometryError(Reason("geometry.tapers_aslant", id=item.id()))
        depth_mm = float(np.linalg.norm(along))
        inner = [end[1] if len(end) == 2 else 0.0 for end in radii]
        outline = [(inner[0], 0.0), (radii[0][0], 0.0), (radii[1][0], depth_mm), (inner[1], depth_mm)]
        return [Turned(first.centre, along / depth_mm, np.array(outline)).moved(self.placements.of_axes(item.Position))]

    def _swept_along(self, item: Any) -> list[Shape]:
        """A disk or a ring that an exporter sweeps along a curve as a profile like any other."""
        (area,) = self.profiles.areas(item.SweptArea)
        circles = [area.outer.circle, *(hole.circle for hole in area.holes)]
        middles = [circle.centre for circle in circles if circle is not None]
        if len(middles) != len(circles) or len(circles) > 2 or np.abs(middles).max() > 1e-6:
            raise UnreadableGeometryError(Reason("geometry.no_disk", id=item.id()))
        radii_mm = [circle.radius_mm for circle in circles if circle is not None]
        legs = self.curves.swept(item.Directrix, item.StartParam, item.EndParam)
        disk = SweptDisk(tuple(legs), radii_mm[0], radii_mm[1] if len(radii_mm) == 2 else None)
        return [disk.moved(self.placements.of_axes(item.Position))]

    def _revolved(self, item: Any) -> list[Shape]:
        if item.is_a("IfcRevolvedAreaSolidTapered"):
            raise UnreadableGeometryError(Reason("geometry.tapers", id=item.id()))
        check_turn(item, item.Angle * self.curves.radians)
        whole = abs(item.Angle * self.curves.radians) > 2.0 * math.pi - 1e-6
        origin = self.placements.point(item.Axis.Location)
        axis = unit(item.Axis.Axis.DirectionRatios) if item.Axis.Axis else np.array([0.0, 0.0, 1.0])
        T = self.placements.of_axes(item.Position)
        turned: list[Shape] = []
        for area in self.profiles.areas(item.SweptArea):
            if area.outer.circle is not None and not area.holes:
                turned.append(self._bend(area.outer.circle, origin, axis, item.Angle).moved(T))
                continue
            if not whole:
                raise UnreadableGeometryError(Reason("geometry.no_full_turn", id=item.id()))
            spokes = area.outer.points - origin
            height = spokes @ axis
            radius = np.linalg.norm(spokes - height[:, np.newaxis] * axis, axis=1)
            turned.append(Turned(origin, axis, np.column_stack([radius, height])).moved(T))
        return turned

    def _bend(self, circle: Circle, origin: Array, axis: Array, angle: float) -> SweptDisk:
        """The bent part of a bar: a disk turned about an axis beside it."""
        centre = origin + float((circle.centre - origin) @ axis) * axis
        u = circle.centre - centre
        if float(u @ u) < circle.radius_mm**2:
            raise UnreadableGeometryError(Reason("geometry.disk_turned"))
        return SweptDisk((Arc(centre, u, np.cross(axis, u), 0.0, angle * self.curves.radians),), circle.radius_mm)

    def _cylinder(self, item: Any) -> list[Shape]:
        T = self.placements.of_axes(item.Position)
        mm = self.placements.mm
        angle = np.radians(np.arange(0.0, 360.0, 5.0))[:, np.newaxis]
        ring = T[:3, 3] + mm * item.Radius * (np.cos(angle) * T[:3, 0] + np.sin(angle) * T[:3, 1])
        circle = Circle(T[:3, 3], T[:3, 2], mm * item.Radius)
        return [Prism(Loop(ring, circle), (), mm * item.Height * T[:3, 2])]

    def _cone(self, item: Any) -> list[Shape]:
        T, mm = self.placements.of_axes(item.Position), self.placements.mm
        outline = mm * np.array([(0.0, 0.0), (item.BottomRadius, 0.0), (0.0, item.Height)])
        return [Turned(T[:3, 3], T[:3, 2], outline)]

    def _boolean(self, item: Any) -> list[Shape]:
        if item.SecondOperand.is_a("IfcPolygonalBoundedHalfSpace"):
            raise UnreadableGeometryError(Reason("geometry.cut", id=item.id()))
        bodies = list(self.of_item(item.FirstOperand))
        try:
            others = self.of_item(item.SecondOperand)
        except NothingThereError as error:
            if isinstance(error.__cause__, UnsoundError):
                return bodies  # a tool without extent takes nothing away
            raise
        if item.Operator == "UNION":
            return bodies + list(others)
        if item.Operator == "DIFFERENCE":
            for tool in others:
                bodies = [Cut(body, tool) for body in bodies]
        return bodies

    def _half_space(self, item: Any) -> list[Shape]:
        surface = item.BaseSurface
        if not surface.is_a("IfcPlane"):
            raise UnreadableGeometryError(Reason("geometry.bounded_by", id=item.id(), type=surface.is_a()))
        T = self.placements.of_axes(surface.Position)
        towards = -T[:3, 2] if item.AgreementFlag else T[:3, 2]
        return [HalfSpace(T[:3, 3], towards, bounded=item.is_a("IfcPolygonalBoundedHalfSpace"))]

    def _faces(self, faces: Sequence[Any]) -> Mesh:
        coordinates: list[Sequence[float]] = []
        index: dict[int, int] = {}
        found = []
        for face in faces:
            if face.is_a() == "IfcAdvancedFace" and not face.FaceSurface.is_a("IfcPlane"):
                raise UnreadableGeometryError(Reason("geometry.curved", id=face.id()))
            bounds = optional(face, "Bounds")
            if len(bounds) > 1:
                bounds = sorted(bounds, key=lambda bound: not bound.is_a("IfcFaceOuterBound"))
            loops: list[IntArray] = []
            for bound in bounds:
                polygon = optional(optional(bound, "Bound"), "Polygon")
                numbers = [point.id() for point in polygon]
                for number, point in zip(numbers, polygon, strict=True):
                    if number not in index:
                        index[number] = len(coordinates)
                        coordinates.append(optional(point, "Coordinates"))
                loops.append(np.array([index[number] for number in numbers], dtype=np.int64))
            found.append(tuple(loops))
        return Mesh(self.placements.mm * np.array(coordinates, dtype=np.float64), tuple(found))

    def _triangles(self, item: Any) -> list[Shape]:
        corners = np.array(item.CoordIndex, dtype=np.int64) - 1
        if renumbered := optional(item, "PnIndex"):
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

    def _tessellated(self, item: Any) -> tuple[Shape, ...]:
        """The solid as ifcopenshell's geometry kernel facets it: for whatever is not evaluated here."""
        vertices, corners = self.kernel.facets(item)
        if not len(corners):
            raise UnreadableGeometryError(Reason("geometry.nothing", id=item.id(), type=item.is_a()))
        return (sound(Mesh(vertices, tuple((triangle,) for triangle in corners))),)


def _faces_of(shells: Sequence[Any]) -> list[Any]:
    return [face for shell in shells for face in shell.CfsFaces]
