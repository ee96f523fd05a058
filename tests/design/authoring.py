"""An author of small IFC models: units, placements, solids, relations, and what a yard draws."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.guid
import numpy as np

RING = [
    (x, y) for x in (-240.0, -80.0, 80.0, 240.0) for y in (-240.0, -80.0, 80.0, 240.0) if max(abs(x), abs(y)) == 240.0
]
UNITS_MM = {"mm": 1.0, "m": 1000.0, "foot": 304.8, "inch": 25.4}


class Author:
    """Writes IFC models; lengths come in millimetres and are written in the unit of the file."""

    def __init__(
        self, folder: Path, schema: str = "IFC4", unit: str = "mm", wcs: Sequence[float] = (0.0, 0.0, 0.0)
    ) -> None:
        self.file: Any = ifcopenshell.file(schema=schema)
        self.folder = folder
        self.schema = schema
        self.unit_mm = UNITS_MM[unit]
        context = self.new(
            "IfcGeometricRepresentationContext",
            ContextType="Model",
            CoordinateSpaceDimension=3,
            Precision=1e-5,
            WorldCoordinateSystem=self.axes(wcs),
        )
        self.body = self.new(
            "IfcGeometricRepresentationSubContext",
            ContextIdentifier="Body",
            ContextType="Model",
            ParentContext=context,
            TargetView="MODEL_VIEW",
        )
        self.project = self.rooted(
            "IfcProject",
            Name="test",
            RepresentationContexts=[context],
            UnitsInContext=self.new("IfcUnitAssignment", Units=self._units(unit)),
        )

    def _units(self, unit: str) -> list[Any]:
        metre = self.new("IfcSIUnit", UnitType="LENGTHUNIT", Prefix="MILLI" if unit == "mm" else None, Name="METRE")
        radian = self.new("IfcSIUnit", UnitType="PLANEANGLEUNIT", Name="RADIAN")
        degree = self.new(
            "IfcConversionBasedUnit",
            Dimensions=self.new("IfcDimensionalExponents", 0, 0, 0, 0, 0, 0, 0),
            UnitType="PLANEANGLEUNIT",
            Name="DEGREE",
            ConversionFactor=self.new(
                "IfcMeasureWithUnit", self.file.create_entity("IfcPlaneAngleMeasure", math.pi / 180.0), radian
            ),
        )
        area = self.new("IfcSIUnit", UnitType="AREAUNIT", Name="SQUARE_METRE")
        if unit not in ("foot", "inch"):
            return [metre, degree, area]
        metres = self.file.create_entity("IfcLengthMeasure", UNITS_MM[unit] / 1000.0)
        customary = self.new(
            "IfcConversionBasedUnit",
            Dimensions=self.new("IfcDimensionalExponents", 1, 0, 0, 0, 0, 0, 0),
            UnitType="LENGTHUNIT",
            Name=unit.upper(),
            ConversionFactor=self.new("IfcMeasureWithUnit", metres, metre),
        )
        return [customary, degree, area]

    def new(self, ifc_class: str, *values: Any, **attributes: Any) -> Any:
        return self.file.create_entity(ifc_class, *values, **attributes)

    def rooted(self, ifc_class: str, **attributes: Any) -> Any:
        return self.new(ifc_class, GlobalId=ifcopenshell.guid.new(), **attributes)

    def length(self, mm: float) -> float:
        return mm / self.unit_mm

    def point(self, xyz: Sequence[float]) -> Any:
        return self.new("IfcCartesianPoint", [self.length(float(value)) for value in xyz])

    def direction(self, ratios: Sequence[float] | None) -> Any:
        return None if ratios is None else self.new("IfcDirection", [float(value) for value in ratios])

    def axes(self, origin: Sequence[float] = (0.0, 0.0, 0.0), z: Sequence[float] | None = None, x: Any = None) -> Any:
        return self.new("IfcAxis2Placement3D", self.point(origin), self.direction(z), self.direction(x))

    def placement(
        self,
        parent: Any = None,
        origin: Sequence[float] = (0.0, 0.0, 0.0),
        z: Sequence[float] | None = None,
        x: Sequence[float] | None = None,
    ) -> Any:
        return self.new("IfcLocalPlacement", parent, self.axes(origin, z, x))

    def element(self, ifc_class: str, items: Sequence[Any], placement: Any, **attributes: Any) -> Any:
        shape = self.new(
            "IfcShapeRepresentation",
            ContextOfItems=self.body,
            RepresentationIdentifier="Body",
            RepresentationType="SolidModel",
            Items=items,
        )
        drawn = self.new("IfcProductDefinitionShape", Representations=[shape])
        return self.rooted(ifc_class, ObjectPlacement=placement, Representation=drawn, **attributes)

    # Solids

    def profile(self, ifc_class: str, **lengths: float) -> Any:
        written = {name: self.length(value) for name, value in lengths.items()}
        return self.new(ifc_class, ProfileType="AREA", Position=self._flat(), **written)

    def _flat(self) -> Any:
        return self.new("IfcAxis2Placement2D", self.point((0.0, 0.0)), None)

    def polygon(self, points: Sequence[Sequence[float]]) -> Any:
        corners = [self.point(point) for point in points]
        return self.new("IfcPolyline", [*corners, corners[0]])

    def extrusion(self, profile: Any, depth: float, axes: Any = None, along: Sequence[float] = (0, 0, 1)) -> Any:
        return self.new("IfcExtrudedAreaSolid", profile, axes or self.axes(), self.direction(along), self.length(depth))

    def cylinder(self, radius: float, depth: float, axes: Any = None) -> Any:
        return self.extrusion(self.profile("IfcCircleProfileDef", Radius=radius), depth, axes)

    def tube(self, inner: float = 36.0, outer: float = 48.0, depth: float = 310.0, axes: Any = None) -> Any:
        wall = (outer - inner) / 2.0
        profile = self.profile("IfcCircleHollowProfileDef", Radius=outer / 2.0, WallThickness=wall)
        return self.extrusion(profile, depth, axes)

    def disk(self, points: Sequence[Sequence[float]], diameter: float) -> Any:
        line = self.new("IfcPolyline", [self.point(point) for point in points])
        return self.new("IfcSweptDiskSolid", Directrix=line, Radius=self.length(diameter / 2.0))

    def faceted_tube(self, inner: float, outer: float, depth: float, sides: int = 24) -> Any:
        """A hollow cylinder of triangles, its vertices on the circles."""
        angle = np.arange(sides) * 2.0 * np.pi / sides
        circle = np.column_stack([np.cos(angle), np.sin(angle)])
        rings = [np.column_stack([r / 2.0 * circle, np.full(sides, z)]) for z in (0.0, depth) for r in (inner, outer)]
        vertices = np.vstack(rings) / self.unit_mm

        def band(first: int, second: int) -> list[list[int]]:
            found = []
            for k in range(sides):
                a, b = first * sides + k, first * sides + (k + 1) % sides
                c, d = second * sides + k, second * sides + (k + 1) % sides
                found += [[a + 1, b + 1, d + 1], [a + 1, d + 1, c + 1]]
            return found

        triangles = band(0, 1) + band(1, 3) + band(3, 2) + band(2, 0)
        points = self.new("IfcCartesianPointList3D", vertices.tolist())
        return self.new("IfcTriangulatedFaceSet", Coordinates=points, Closed=True, CoordIndex=triangles)

    # Relations

    def aggregate(self, whole: Any, parts: Sequence[Any]) -> None:
        self.rooted("IfcRelAggregates", RelatingObject=whole, RelatedObjects=parts)

    def void(self, element: Any, opening: Any) -> None:
        self.rooted("IfcRelVoidsElement", RelatingBuildingElement=element, RelatedOpeningElement=opening)

    def contain(self, storey: Any, elements: Sequence[Any]) -> None:
        self.rooted("IfcRelContainedInSpatialStructure", RelatingStructure=storey, RelatedElements=elements)

    def typed(self, elements: Sequence[Any], of_type: Any) -> None:
        self.rooted("IfcRelDefinesByType", RelatedObjects=elements, RelatingType=of_type)

    # What a yard draws

    def column(self, placement: Any, size: tuple[float, float] = (600.0, 600.0), **attributes: Any) -> Any:
        profile = self.profile("IfcRectangleProfileDef", XDim=size[0], YDim=size[1])
        return self.element("IfcColumn", [self.extrusion(profile, 3000.0)], placement, **attributes)

    def sleeves(self, placement: Any, centres: Sequence[tuple[float, float]] = RING, **attributes: Any) -> list[Any]:
        said = {"Name": "灌浆套筒 GTQ4Z-20"} | attributes
        return [
            self.element("IfcDiscreteAccessory", [self.tube()], self.placement(placement, (x, y, 0.0)), **said)
            for x, y in centres
        ]

    def rebars(
        self, placement: Any, centres: Sequence[tuple[float, float]] = RING, top: float = 160.0, **attributes: Any
    ) -> list[Any]:
        said = {"Name": "连接钢筋"} | attributes
        return [
            self.element("IfcReinforcingBar", [self.disk([(x, y, -400.0), (x, y, top)], 20.0)], placement, **said)
            for x, y in centres
        ]

    def write(self, name: str = "model.ifc") -> Path:
        path = self.folder / name
        self.file.write(str(path))
        return path
