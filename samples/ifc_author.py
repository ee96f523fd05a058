"""An IFC file under construction: entities, placements and shapes in millimetres, with GlobalIds that repeat."""

from __future__ import annotations

import math
import uuid
from collections.abc import Sequence
from typing import Any

import ifcopenshell
import ifcopenshell.guid

_IDS = uuid.UUID("6f1d5a52-8f0e-5c1b-9a53-0f4a7d3c2e11")

Point = tuple[float, float, float]


class Model:
    """An IFC file under construction, in millimetres."""

    def __init__(self, file_name: str, project_name: str) -> None:
        self.file: Any = ifcopenshell.file(schema="IFC4")
        header = self.file.header
        header.file_name.name = file_name
        header.file_name.time_stamp = "2026-01-01T00:00:00"
        header.file_name.preprocessor_version = "samples/make_model.py"
        header.file_name.originating_system = "samples/make_model.py"
        units = [self.new("IfcSIUnit", UnitType="LENGTHUNIT", Prefix="MILLI", Name="METRE")]
        units.append(self.new("IfcSIUnit", UnitType="PLANEANGLEUNIT", Name="RADIAN"))
        context = self.new(
            "IfcGeometricRepresentationContext",
            ContextType="Model",
            CoordinateSpaceDimension=3,
            Precision=1e-5,
            WorldCoordinateSystem=self.axes(),
        )
        self.body, self.plan = (
            self.new(
                "IfcGeometricRepresentationSubContext",
                ContextIdentifier=name,
                ContextType="Model",
                ParentContext=context,
                TargetView=view,
            )
            for name, view in (("Body", "MODEL_VIEW"), ("FootPrint", "PLAN_VIEW"))
        )
        self.project = self.rooted(
            "IfcProject",
            "project",
            Name=project_name,
            RepresentationContexts=[context],
            UnitsInContext=self.new("IfcUnitAssignment", Units=units),
        )

    def new(self, ifc_class: str, **attributes: Any) -> Any:
        """An entity."""
        return self.file.create_entity(ifc_class, **attributes)

    def rooted(self, ifc_class: str, key: str, **attributes: Any) -> Any:
        """An entity with a GlobalId that follows from its key."""
        global_id = ifcopenshell.guid.compress(uuid.uuid5(_IDS, key).hex)
        return self.new(ifc_class, GlobalId=global_id, **attributes)

    def point(self, *xyz: float) -> Any:
        """A point, mm."""
        return self.new("IfcCartesianPoint", Coordinates=[float(value) for value in xyz])

    def direction(self, *ratios: float) -> Any:
        """A direction."""
        return self.new("IfcDirection", DirectionRatios=[float(value) for value in ratios])

    def axes(self, origin: Point = (0.0, 0.0, 0.0), turn_deg: float = 0.0) -> Any:
        """Axes at a point, turned about z."""
        z = x = None
        if turn_deg:
            turn = math.radians(turn_deg)
            # The schema wants both directions or none.
            z = self.direction(0.0, 0.0, 1.0)
            x = self.direction(round(math.cos(turn), 15), round(math.sin(turn), 15), 0.0)
        return self.new("IfcAxis2Placement3D", Location=self.point(*origin), Axis=z, RefDirection=x)

    def placement(self, parent: Any, origin: Point = (0.0, 0.0, 0.0), turn_deg: float = 0.0) -> Any:
        """A placement relative to another."""
        return self.new("IfcLocalPlacement", PlacementRelTo=parent, RelativePlacement=self.axes(origin, turn_deg))

    def extrusion(self, profile: Any, depth: float, axes: Any = None) -> Any:
        """A profile extruded along the z of its axes."""
        return self.new(
            "IfcExtrudedAreaSolid",
            SweptArea=profile,
            Position=axes or self.axes(),
            ExtrudedDirection=self.direction(0.0, 0.0, 1.0),
            Depth=depth,
        )

    def bar(self, points: Sequence[Point], diameter: float) -> Any:
        """A disk swept along a polyline."""
        line = self.new("IfcPolyline", Points=[self.point(*xyz) for xyz in points])
        return self.new("IfcSweptDiskSolid", Directrix=line, Radius=diameter / 2.0)

    def drawn(self, kind: str, items: Sequence[Any]) -> Any:
        """A body representation."""
        return self.new(
            "IfcShapeRepresentation",
            ContextOfItems=self.body,
            RepresentationIdentifier="Body",
            RepresentationType=kind,
            Items=items,
        )

    def type(self, ifc_class: str, key: str, kind: str, items: Sequence[Any], **attributes: Any) -> Any:
        """A type with a representation map that its occurrences share."""
        shape = self.new(
            "IfcRepresentationMap", MappingOrigin=self.axes(), MappedRepresentation=self.drawn(kind, items)
        )
        return self.rooted(ifc_class, key, RepresentationMaps=[shape], **attributes)

    def occurrence(self, ifc_class: str, key: str, of_type: Any, placement: Any, **attributes: Any) -> Any:
        """An element drawn by its type's map."""
        target = self.new("IfcCartesianTransformationOperator3D", LocalOrigin=self.point(0.0, 0.0, 0.0))
        item = self.new("IfcMappedItem", MappingSource=of_type.RepresentationMaps[0], MappingTarget=target)
        shape = self.new("IfcProductDefinitionShape", Representations=[self.drawn("MappedRepresentation", [item])])
        return self.rooted(ifc_class, key, ObjectPlacement=placement, Representation=shape, **attributes)

    def aggregate(self, key: str, whole: Any, parts: Sequence[Any]) -> None:
        """Make parts of a whole."""
        self.rooted("IfcRelAggregates", key, RelatingObject=whole, RelatedObjects=parts)

    def contain(self, key: str, storey: Any, elements: Sequence[Any]) -> None:
        """Put elements into a storey."""
        self.rooted("IfcRelContainedInSpatialStructure", key, RelatingStructure=storey, RelatedElements=elements)

    def properties(self, key: str, name: str, elements: Sequence[Any], **values: str) -> None:
        """A property set of labels."""
        singles = [
            self.new("IfcPropertySingleValue", Name=name, NominalValue=self.file.create_entity("IfcLabel", value))
            for name, value in values.items()
        ]
        group = self.rooted("IfcPropertySet", f"{key} set", Name=name, HasProperties=singles)
        self.rooted("IfcRelDefinesByProperties", key, RelatedObjects=elements, RelatingPropertyDefinition=group)
