"""Property sets onto elements; a set that others share is unshared before it is touched."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from aadm_workbench.report.ifc.addition import Addition, Property

KEPT = ("Pset_Tolerance",)
"""Sets that the engineer may have filled in: what is there already is his word, and stays."""


@dataclass
class Assigner:
    """Gives elements their property sets; counts what it gave, and what it left alone."""

    addition: Addition
    assigned: int = 0
    unshared: int = 0
    left_alone: dict[str, int] = field(default_factory=dict)

    def assign(self, element: Any, name: str, properties: Sequence[Property]) -> None:
        """Give an element a set of its own; properties of other names that it had in such a set stay with it."""
        earlier = list(_relations(element, name))
        if not properties or (earlier and name in KEPT):
            if properties:
                self.left_alone[name] = self.left_alone.get(name, 0) + 1
            return
        key = (element.GlobalId, name)
        given = self.addition.property_set(key, name, properties, list(self._others(earlier, properties)))
        self.assigned += 1
        related = False
        for relation in earlier:
            related = self._unshare(relation, element, given) or related
        if not related:
            self.addition.rooted(
                "IfcRelDefinesByProperties", key, None, RelatedObjects=[element], RelatingPropertyDefinition=given
            )

    def _unshare(self, relation: Any, element: Any, given: Any) -> bool:
        """Take an element out of a shared relation; one that is its own goes over to the new set (and is True)."""
        others = [related for related in relation.RelatedObjects if related != element]
        if others:
            self.addition.alter(relation, RelatedObjects=others)
            self.unshared += 1
            return False
        self.addition.alter(relation, RelatingPropertyDefinition=given)
        return True

    def _others(self, relations: Sequence[Any], properties: Sequence[Property]) -> Iterator[Any]:
        """Copies of the properties that are not this program's: entities are never shared between two sets."""
        known = {item.name for item in properties}
        for relation in relations:
            for held in relation.RelatingPropertyDefinition.HasProperties:
                if held.Name not in known:
                    known.add(held.Name)
                    yield self.addition.file.create_entity(held.is_a(), *held)


def _relations(element: Any, name: str) -> Iterator[Any]:
    """The relations that give an element, not its type, a property set of a name."""
    for relation in getattr(element, "IsDefinedBy", ()):
        if not relation.is_a("IfcRelDefinesByProperties"):
            continue
        definition = relation.RelatingPropertyDefinition
        if definition.is_a("IfcPropertySet") and definition.Name == name:
            yield relation
