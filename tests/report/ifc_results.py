"""Reading results back out of a model, in the units of report.json."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, TypeAlias

from aadm_workbench.design.ifc.text.file import OpenedIfc, open_ifc
from aadm_workbench.report.ifc.addition import Scalar

Sets: TypeAlias = dict[str, dict[str, Scalar]]
"""Values by property, by property set."""

_OURS = "AADM_"
_STANDARD = ("Pset_Tolerance", "Pset_Uncertainty")
_LENGTH_DECIMALS, _ANGLE_DECIMALS = 6, 8  # finer than report.json, so that what was written comes back as it was


def read_ifc_results(model: Path) -> dict[str, Sets]:
    """Results by the GlobalId of each element that has some, in mm and degrees whatever the units of the model.

    Raises
    ------
    DesignError
        Where the model cannot be read.
    MissingDependencyError
        Where ifcopenshell is not installed.
    """
    opened = open_ifc(model)
    found: dict[str, Sets] = {}
    for relation in opened.file.by_type("IfcRelDefinesByProperties"):
        definition = relation.RelatingPropertyDefinition
        name = definition.Name if definition.is_a("IfcPropertySet") else None
        if name and (name.startswith(_OURS) or name in _STANDARD):
            values = {
                item.Name: value for item in definition.HasProperties if (value := _value(opened, item)) is not None
            }
            for element in relation.RelatedObjects:
                found.setdefault(element.GlobalId, {})[name] = values
    return found


def _value(opened: OpenedIfc, item: Any) -> Scalar | None:
    """The value of a property in mm or degrees; None for kinds of property that this program does not write."""
    if item.is_a("IfcPropertyEnumeratedValue") and item.EnumerationValues:
        return str(item.EnumerationValues[0].wrappedValue)
    if not item.is_a("IfcPropertySingleValue") or item.NominalValue is None:
        return None
    value: Scalar = item.NominalValue.wrappedValue
    if item.NominalValue.is_a() in ("IfcLengthMeasure", "IfcPositiveLengthMeasure"):
        return round(float(value) * opened.mm, _LENGTH_DECIMALS)
    if item.NominalValue.is_a("IfcPlaneAngleMeasure"):
        return round(math.degrees(float(value) * opened.radians), _ANGLE_DECIMALS)
    return value
