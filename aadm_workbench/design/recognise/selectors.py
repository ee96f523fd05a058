"""Rules of a job that say which elements of a model are columns, sleeves or rebars, in IfcOpenShell's selector syntax.

For models that are no IFC files: classes, names and kinds are there, property sets and relations are not.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from aadm_workbench.design.elements import Element, holdings
from aadm_workbench.errors import DesignError
from aadm_workbench.model import Reason

_KEYS: dict[str, Callable[[Element], str]] = {
    "name": lambda element: element.Name,
    "label": lambda element: element.Name,
    "tag": lambda element: element.Tag,
    "object": lambda element: element.GlobalId,
    "kind": lambda element: element.kind,
    "typeid": lambda element: element.kind,
    "globalid": lambda element: element.ifc_guid or "",
    "predefinedtype": lambda element: element.predefined_type,
    "piecemark": lambda element: element.piece_mark or "",
    "location": lambda element: element.storey or "",
    "class": lambda element: element.ifc_class,
}
_FACET = re.compile(
    r"\s*(?P<key>[A-Za-z]+)\s*(?P<compare>!=|\*=|=)\s*"
    r"(?:\"(?P<quoted>[^\"]*)\"|/(?P<pattern>(?:[^/\\]|\\.)*)/|(?P<word>[^,+\"/=]+?))\s*$"
)
_CLASS = re.compile(r"\s*(?P<without>!)?\s*(?P<class>(?:Ifc|[A-Z][A-Za-z]+::)[A-Za-z0-9]+)\s*$")
_NAME = re.compile(r"\s*\"?(?P<name>[^\",+=!/]+?)\"?\s*$")
_PARTS = re.compile(r"(\"[^\"]*\"|/(?:[^/\\]|\\.)*/|[^,+\"/]+)|([,+])")

Facet = Callable[[Element], bool]


def select(elements: Sequence[Element], source: str, key: str, rule: str) -> list[Element]:
    """Elements that a rule names, in the order of the model.

    ``IfcColumn``, ``Part::Cylinder``, ``Name="Bar 1"``, ``Label*=bar``, ``Name=/套筒|sleeve/``; parts joined by a comma
    hold together, groups joined by ``+`` one beside the other. A mere name is that of one object.

    Raises
    ------
    DesignError
        Where the rule is not understood or nothing answers to it.
    """
    groups = [[_facet(text, key, rule) for text in group] for group in _groups(rule)]
    found = [element for element in elements if any(all(facet(element) for facet in group) for group in groups)]
    if not found:
        raise DesignError(
            Reason("design.selector_empty", key=key, query=rule, source=source, holdings=holdings(elements))
        )
    return found


def _groups(rule: str) -> list[list[str]]:
    groups = [[""]]
    for text, separator in _PARTS.findall(rule):
        if separator == "+":
            groups.append([""])
        elif separator == ",":
            groups[-1].append("")
        else:
            groups[-1][-1] += text
    return groups


def _facet(text: str, key: str, rule: str) -> Facet:
    if found := _CLASS.match(text):
        wanted, without = found["class"], bool(found["without"])
        return lambda element: (bool(element.is_a(wanted)) or element.kind == wanted) != without
    if found := _FACET.match(text):
        return _comparison(found, key, rule)
    if found := _NAME.match(text):
        name = found["name"].casefold()
        return lambda element: name in (called.casefold() for called in called_by(element))
    raise DesignError(Reason("design.selector_at", key=key, rule=rule, text=text.strip()))


def called_by(element: Element) -> list[str]:
    """All that people may call an element by, shortest-lived first."""
    parts = [part for part in element.GlobalId.split(".") if not part.isdigit()]
    names = (element.Tag, element.piece_mark, element.Name, element.GlobalId, *parts, element.ifc_guid)
    return list(dict.fromkeys(name.strip() for name in names if name and name.strip()))


def _comparison(found: re.Match[str], key: str, rule: str) -> Facet:
    read = _KEYS.get(found["key"].casefold())
    if read is None:
        known = "Name, Label, Tag, Object, TypeId, GlobalId, PredefinedType, PieceMark, location"
        raise DesignError(Reason("design.selector_asks", key=key, rule=rule, asked=found["key"], known=known))
    value = found["quoted"] if found["quoted"] is not None else (found["word"] or "").strip()
    compare = found["compare"]
    if found["pattern"] is not None:
        try:
            pattern = re.compile(found["pattern"])
        except re.error as error:
            raise DesignError(
                Reason("design.selector_pattern", key=key, rule=rule, why=error, pattern=found["pattern"])
            ) from error
        return lambda element: bool(pattern.search(read(element))) != (compare == "!=")
    if compare == "*=":
        return lambda element: value in read(element)
    return lambda element: (read(element) == value) != (compare == "!=")
