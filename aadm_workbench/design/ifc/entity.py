"""Attributes of IFC entities, by name: those that only some classes have, and those that are asked for often."""

from __future__ import annotations

from typing import Any

_PLACES: dict[str, dict[str, int]] = {}
"""Places of attributes by schema and class, such as IFC4.IfcWall."""


def optional(entity: Any, name: str) -> Any:
    """An attribute of an entity; None where its class has none of that name, or the file leaves it out.

    ifcopenshell looks for an attribute that is not there in the rules of the schema, and needs three calls to find
    one that is; a floor asks for half a million.
    """
    if entity is None:
        return None
    ifc_class = entity.is_a(True)
    places = _PLACES.get(ifc_class)
    if places is None:
        places = _PLACES[ifc_class] = {entity.attribute_name(place): place for place in range(len(entity))}
    place = places.get(name)
    return None if place is None else entity[place]
