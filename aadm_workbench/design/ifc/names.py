"""What elements are called, by themselves, their types and their property sets, and what they are parts of."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

from aadm_workbench.design.ifc.words import Said, find
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

_PIECE_MARK = frozenset(
    {"piecemark", "piece mark", "assembly/cast unit mark", "cast unit mark", "castunitmark", "构件编号", "構件編號"}
)

_MARK = frozenset({"mark", "标记", "標記", "マーク", "kennzeichen"})
"""Revit's own mark of an instance, as its languages export it; its Tag is the number of the element."""

_MACHINE_MADE = re.compile(
    r"\d+|ID[0-9a-f-]{30,}|[{(]?[0-9a-f]{8}(-?[0-9a-f]{4}){3}-?[0-9a-f]{12}[)}]?|(ID)?[-_ ]?[0-3][0-9a-z_$]{21}",
    re.IGNORECASE,
)
"""Tags that programs give (Revit's element number, Tekla's and ArchiCAD's GUID) and nobody on site says."""

_NAME = 2  # place of Name among the attributes of an object
_SAID = (_NAME, 4, 3)
"""Places of Name, ObjectType and Description among the attributes of an object; by name they take thrice as long."""

_TAG = 7  # place of the attribute in IfcElement

_PLACES: dict[str, dict[str, int]] = {}
"""Places of attributes by schema and class, such as IFC4.IfcWall."""

_CLASSES: dict[tuple[str, str], bool] = {}
"""Whether a class, such as IFC4.IfcWall, is one or below one, such as IfcElement."""


@dataclass(frozen=True, eq=False)
class Naming:
    """What the elements of one file are called; relations are followed once for the whole file."""

    file: Any
    _texts: dict[int, tuple[str, ...]] = field(default_factory=dict, repr=False)

    @cached_property
    def _types(self) -> dict[int, Any]:
        """The type of each occurrence, by the occurrence's number."""
        found: dict[int, Any] = {}
        for relation in self.file.by_type("IfcRelDefinesByType"):
            of_type, elements = relation.RelatingType, relation.RelatedObjects
            if isinstance(elements, tuple) and _is_entity(of_type) and of_type.is_a("IfcTypeObject"):
                found.update((element.id(), of_type) for element in elements if _is_entity(element))
        return found

    def type_of(self, element: Any) -> Any:
        """The type of an element; None where it has none."""
        return self._types.get(element.id())

    def texts(self, element: Any) -> tuple[str, ...]:
        """All that an element and its type are called, each text once."""
        number = element.id()
        if number not in self._texts:
            of_type = self._types.get(number)
            told = [element[place] for place in _SAID]
            if is_of(element, "IfcElement"):
                told.append(element[_TAG])
            if of_type is not None:
                told += self._texts_of_type(of_type)
            self._texts[number] = tuple(dict.fromkeys(text for told_text in told if (text := text_of(told_text))))
        return self._texts[number]

    def _texts_of_type(self, of_type: Any) -> tuple[str, ...]:
        if of_type.id() not in self._texts:
            told = (of_type.Name, optional(of_type, "ElementType"), of_type.Description)
            self._texts[of_type.id()] = tuple(text for text in told if isinstance(text, str) and text)
        return self._texts[of_type.id()]

    def said(self, element: Any) -> str:
        """All that an element and its type are called, in one line."""
        return " | ".join(self.texts(element))

    def of(self, element: Any) -> Said:
        """What an element says of itself."""
        return Said(text_of(element[_NAME]), self.texts(element))

    def find(self, pattern: re.Pattern[str], element: Any) -> str | None:
        """The first match of a pattern in what an element and its type are called."""
        return next((found for text in self.texts(element) if (found := find(pattern, text))), None)

    def told_by_property(self, pattern: re.Pattern[str]) -> dict[int, str]:
        """Elements of which a property says what the pattern looks for: by number, with that property's text."""
        found: dict[int, str] = {}
        for single in self.file.by_type("IfcPropertySingleValue"):
            text = getattr(single.NominalValue, "wrappedValue", None)
            if isinstance(text, str) and find(pattern, text):
                for element in self._owners(single):
                    found.setdefault(element.id(), text)
        return found

    def _owners(self, single: Any) -> Iterator[Any]:
        for group in self.file.get_inverse(single):
            for holder in self.file.get_inverse(group):
                if holder.is_a("IfcRelDefinesByProperties"):
                    yield from (element for element in holder.RelatedObjects or () if _is_entity(element))
                elif holder.is_a("IfcTypeObject"):
                    yield from (self.file.by_id(number) for number, kind in self._types.items() if kind == holder)

    def predefined_type(self, element: Any) -> str:
        """PredefinedType of an element or its type, or BarRole in IFC2X3; empty where there is none."""
        for holder in (element, self.type_of(element)):
            for name in ("PredefinedType", "BarRole"):
                value = optional(holder, name)
                if value and value not in ("NOTDEFINED", "USERDEFINED"):
                    return str(value)
        return ""

    def attribute(self, element: Any, name: str) -> Any:
        """An attribute of an element, or else of its type; None where neither gives it."""
        for holder in (element, self.type_of(element)):
            if value := optional(holder, name):
                return value
        return None


@lru_cache(maxsize=4096, typed=True)
def evidence_of(what: str, said: str) -> Reason:
    """What speaks for an element, and what it is called: a floor has thousands that are called alike."""
    return Reason("ifc.evidence", evidence=what, said=said)


def text_of(value: Any) -> str:
    """A name without the blanks around it; empty where there is none, or something else stands in its place."""
    return value.strip() if isinstance(value, str) else ""


def _is_entity(value: Any) -> bool:
    return hasattr(value, "is_a")


def properties(element: Any) -> Iterator[tuple[str, Any]]:
    """Names and values of all properties of an element and its type."""
    for group in _groups(element).values():
        yield from ((name, value) for name, value in group.items() if name != "id" and isinstance(name, str))


def _groups(element: Any, **how: bool) -> dict[str, dict[str, Any]]:
    """Property sets by name; none where one of them is broken."""
    from ifcopenshell.util.element import get_psets

    try:
        found: dict[str, dict[str, Any]] = get_psets(element, **how)
    except (AttributeError, TypeError, ValueError, LookupError, RuntimeError):
        return {}
    return found


def piece_mark(element: Any) -> str | None:
    """The mark of the mould that a precast piece comes from, shared by all pieces cast in it."""
    marks = (str(value) for name, value in properties(element) if name.strip().lower() in _PIECE_MARK and value)
    return next(marks, None)


def mark(element: Any) -> str | None:
    """What people call this one element in a property of its own, where their program gives them no Tag for it."""
    groups = _groups(element, psets_only=True, should_inherit=False).values()
    named = (value for group in groups for name, value in group.items() if text_of(name).lower() in _MARK)
    return next((str(value) for value in named if isinstance(value, str | int) and str(value).strip()), None)


def is_machine_made(name: str) -> bool:
    """Whether a program made a name up, so that nobody says it."""
    return _MACHINE_MADE.fullmatch(name.strip()) is not None


def called(element: Any) -> str:
    """What a person calls an element, in a message: its Tag, unless a program made that up, else its Name."""
    told = (text for name in (optional(element, "Tag"), mark(element), element.Name) if (text := text_of(name)))
    return str(next((name for name in told if not is_machine_made(name)), element.GlobalId))


def storey_name(element: Any) -> str | None:
    """Name of the storey that holds an element, or the assembly that it is a part of."""
    from ifcopenshell.util.element import get_container

    try:
        storey = get_container(element, ifc_class="IfcBuildingStorey")
    except (RecursionError, AttributeError, TypeError):  # wholes that are parts of each other
        return None
    return None if storey is None else text_of(storey.Name) or text_of(storey.LongName) or None


def wholes(element: Any) -> list[Any]:
    """The assemblies that an element is a part of, from near to far."""
    from ifcopenshell.util.element import get_aggregate

    found: list[Any] = []
    whole: Any = get_aggregate(element)
    while whole is not None and whole.is_a("IfcElement") and whole not in found and whole != element:
        found.append(whole)
        whole = get_aggregate(whole)
    return found


def parts(element: Any) -> list[Any]:
    """All parts that an element is made of, of their parts too; itself is none of them."""
    found: list[Any] = []
    seen, left = {element.id()}, [element]
    while left:
        own = [
            part
            for relation in left.pop(0).IsDecomposedBy
            for part in relation.RelatedObjects or ()
            if part.id() not in seen
        ]
        seen.update(part.id() for part in own)
        found += own
        left += own
    return found


def select(file: Any, source: str, key: str, query: str) -> list[Any]:
    """Elements that a selector of the job names, in the order of the file.

    The syntax is that of ``ifcopenshell.util.selector``; a /pattern/ may match anywhere in a text, so that
    ``Name=/套筒|sleeve/`` finds "灌浆套筒 GTQ4Z-20". ``^`` binds it to the beginning.

    Raises
    ------
    DesignError
        Where the selector is not understood or nothing answers to it.
    """
    from ifcopenshell.util.selector import filter_elements
    from lark.exceptions import LarkError

    found: set[Any]
    try:
        found = filter_elements(file, _unanchored(query))
    except LarkError as error:
        reason = str(error).strip().splitlines()[0]
        raise DesignError(Reason("design.selector_unread", key=key, query=query, why=reason)) from error
    elements: list[Any] = sorted(
        (element for element in found if element.is_a("IfcElement")), key=lambda element: element.id()
    )
    if not elements:
        raise DesignError(Reason("design.selector_empty", key=key, query=query, source=source, holdings=holdings(file)))
    return elements


def _unanchored(query: str) -> str:
    def anywhere(found: re.Match[str]) -> str:
        flags, pattern = found["flags"] or "", found["pattern"]
        return f"{found['equals']}/{flags}.*(?:{pattern})/"

    return re.sub(r"(?P<equals>=\s*)/(?P<flags>\(\?[aiLmsux]+\))?(?P<pattern>[^/]+)/", anywhere, query)


def holdings(file: Any) -> str:
    """What a model holds, by class, the most frequent first: "8 IfcColumn, 96 IfcReinforcingBar"."""
    count: dict[str, int] = {}
    for element in file.by_type("IfcElement"):
        count[element.is_a()] = count.get(element.is_a(), 0) + 1
    ranked = sorted(count.items(), key=lambda item: (-item[1], item[0]))
    parts = [f"{number} {ifc_class}" for ifc_class, number in ranked]
    return Reason("said.list", parts=parts) if parts else Reason("design.no_elements")


def optional(entity: Any, name: str) -> Any:
    """An attribute of an entity; None where its class has none of that name, or the file leaves it out.

    ifcopenshell looks for an attribute that is not there in the rules of the schema, and needs three calls to find
    one that is; a floor asks for half a million.
    """
    if entity is None:
        return None
    ifc_class = entity.is_a(True)
    try:
        place = _PLACES[ifc_class].get(name)
    except KeyError:
        _PLACES[ifc_class] = {entity.attribute_name(place): place for place in range(len(entity))}
        return optional(entity, name)
    return None if place is None else entity[place]


def is_of(entity: Any, ifc_class: str) -> bool:
    """Whether an entity is of a class, or of one below it: asked of the schema once for each class that there is."""
    key = entity.is_a(True), ifc_class
    if key not in _CLASSES:
        _CLASSES[key] = bool(entity.is_a(ifc_class))
    return _CLASSES[key]
