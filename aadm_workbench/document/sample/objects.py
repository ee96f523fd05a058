"""Which objects of a FreeCAD document draw something of their own, each once, and where they stand."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.words import REBAR, SLEEVE, find
from aadm_workbench.document.places import transform_of
from aadm_workbench.model import Array, Reason

_MADE_FROM = (
    "Base",
    "Tool",
    "Tools",
    "Shapes",
    "Source",
    "Sources",
    "Additions",
    "Subtractions",
    "Profile",
    "Sections",
    "Spine",
    "AuxillerySpine",
    "BaseFeature",
    "Originals",
    "Links",
    "Objects",
    "PathObject",
    "PathObj",
    "PointObject",
    "PointList",
)
"""Properties by which an object names what its own shape is made from; hosts, supports and references are none."""

_COPIES = {"Clone": "Objects", "Part::Mirroring": "Source"}
"""Kinds of objects that draw a copy of others, which stay what they are, and the property that names those."""

_REFERENCES = frozenset({"PartDesign::ShapeBinder", "PartDesign::SubShapeBinder", "Part::SubShapeBinder"})
_GROUPS = (
    "App::GroupExtension",
    "App::GroupExtensionPython",
    "App::GeoFeatureGroupExtension",
    "App::GeoFeatureGroupExtensionPython",
)
_LINKS = ("App::LinkBaseExtension", "App::LinkExtension", "App::LinkExtensionPython")
_FRAMES = _GROUPS[2:]
"""Groups in whose frame their children stand; in others they stand where the group does."""

_SPATIAL = frozenset(
    {"Building", "BuildingPart", "BuildingStorey", "Floor", "Project", "Site", "Space", "SpatialZone", "Storey"}
)
CLASS_PROPERTIES = ("IfcClass", "Class", "IfcType", "IfcRole")
"""Where programs keep the IFC class of an object, the newest first."""

_DEEPEST = 32  # groups and links in each other: a document that goes on is a circle
_LINKED_MATRIX = 6  # retType of getSubObject: the transform, with that of what is linked
_OBJECT = 1  # retType of getSubObject: the object itself


@dataclass(frozen=True, eq=False)
class Piece:
    """An object that draws something, as often as the document shows it.

    ``path`` names it, such as ``Link.0.Body``; ``obj`` is the object that holds the shape, ``shown`` the one that a
    person sees in the tree (a link to it, or itself); ``T_model_shape`` (4, 4) moves the shape as the object holds it
    into the document's frame; ``inside`` are the groups that it stands in, from near to far.
    """

    path: str
    obj: Any
    shown: Any
    T_model_shape: Array
    inside: tuple[Any, ...]


def pieces(document: Any, problems: list[str]) -> list[Piece]:
    """All pieces of a document; ``problems`` collects what could not be followed, in words."""
    used_up = _used_up(document)
    found: list[Piece] = []
    for root in _roots(document):
        found += _below(_Place(root, "", np.eye(4), (), (root.Name,)), used_up, problems)
    return found


def proxy_type(obj: Any) -> str:
    """What the program that made an object calls its kind: Rebar, Structure, Clone; empty for FreeCAD's own kinds."""
    return str(getattr(getattr(obj, "Proxy", None), "Type", "") or "")


def originals(obj: Any) -> list[Any]:
    """What an array, a clone or a mirrored copy repeats: its names say what they are too."""
    kind = proxy_type(obj) or obj.TypeId
    named = _COPIES.get(kind) or ("Base" if kind.endswith("Array") else None)
    if getattr(obj, "CloneOf", None) is not None:
        named = "CloneOf"
    return [obj.Document.getObject(name) for name in sorted(_names_in(obj, (named,)))] if named else []


def is_group(obj: Any) -> bool:
    """Whether an object holds others; native IFC objects do by a mere property."""
    if obj.TypeId == "PartDesign::Body":
        return False
    return "Group" in obj.PropertiesList or any(obj.hasExtension(name) for name in _GROUPS)


def _roots(document: Any) -> Iterator[Any]:
    """Objects that stand in no group."""
    held = {child.Name for obj in document.Objects if _holds(obj) for child in obj.Group}
    held |= {child.Name for obj in document.Objects for child in getattr(obj, "ElementList", ()) or ()}
    yield from (obj for obj in document.Objects if obj.Name not in held)


def _holds(obj: Any) -> bool:
    return hasattr(obj, "Group") and (is_group(obj) or obj.TypeId == "PartDesign::Body")


def _used_up(document: Any) -> frozenset[str]:
    """Names of objects that only serve to make another, and of hidden originals that only their copies show."""
    names: set[str] = set()
    copied: set[str] = set()
    for obj in document.Objects:
        if obj.TypeId in _REFERENCES or proxy_type(obj).startswith("AADM"):
            names.add(obj.Name)
        if obj.TypeId.startswith("App::Link"):
            copied |= _names_in(obj, ("LinkedObject",))
        elif (kind := proxy_type(obj) or obj.TypeId) in _COPIES:
            copied |= _names_in(obj, (_COPIES[kind],))
        elif getattr(obj, "CloneOf", None) is not None:
            copied.add(obj.CloneOf.Name)
            names |= _names_in(obj, _MADE_FROM)
        elif _makes_a_body(obj):
            names |= _names_in(obj, _MADE_FROM) - _cast_in(obj)
    shown = [obj for obj in document.Objects if _may_draw(obj) and getattr(obj, "Visibility", True)]
    if shown:  # a document that was saved without a screen may open with everything hidden
        names |= {name for name in copied if not getattr(document.getObject(name), "Visibility", True)}
    return frozenset(names)


def _cast_in(obj: Any) -> set[str]:
    """Sleeves and bars that were added to a structure: in its shape they melt into the concrete, holes and all."""
    added = {name: obj.Document.getObject(name).Label for name in _names_in(obj, ("Additions",))}
    return {name for name, label in added.items() if find(SLEEVE, label) or find(REBAR, label)}


def _names_in(obj: Any, properties: tuple[str, ...]) -> set[str]:
    """Objects of the same document that some properties of an object name."""
    found: set[str] = set()
    for name in properties:
        value = getattr(obj, name, None) if name in obj.PropertiesList else None
        for part in value if isinstance(value, list | tuple) else (value,):
            linked = part[0] if isinstance(part, tuple) else part
            if hasattr(linked, "TypeId") and linked.Document is obj.Document and linked is not obj:
                found.add(linked.Name)
    return found


def _makes_a_body(obj: Any) -> bool:
    if obj.TypeId.startswith("PartDesign::"):
        return True
    shape = getattr(obj, "Shape", None)
    return _may_draw(obj) and hasattr(shape, "Solids") and not shape.isNull() and bool(shape.Solids or shape.Shells)


def _may_draw(obj: Any) -> bool:
    return bool(obj.isDerivedFrom("Part::Feature") or obj.isDerivedFrom("Mesh::Feature"))


@dataclass(frozen=True, eq=False)
class _Place:
    """Where an object is reached: by the sub-path ``sub`` of ``root``, whose document ``T_model_root`` (4, 4) places.

    ``inside`` are the groups on the way, ``path`` what the way is called. ``made_of`` where what is there only serves
    to make what it is reached from.
    """

    root: Any
    sub: str
    T_model_root: Array
    inside: tuple[Any, ...]
    path: tuple[str, ...]
    made_of: bool = False

    @property
    def shown(self) -> Any:
        """The object there; None where a link leads nowhere."""
        return self.root.getSubObject(self.sub, retType=_OBJECT) if self.sub else self.root

    @property
    def frame(self) -> Array:
        """(4, 4): the frame of the object there, its own placement and those that links give it included."""
        matrix = self.root.getSubObject(self.sub, retType=_LINKED_MATRIX)
        T = np.array([[getattr(matrix, f"A{row}{column}") for column in range(1, 5)] for row in range(1, 5)])
        return self.T_model_root @ T

    def below(self, child: str, shown: Any) -> _Place:
        """A child by its sub-path."""
        return _Place(
            self.root, self.sub + child, self.T_model_root, (shown, *self.inside), (*self.path, child.strip("."))
        )

    def beside(self, child: Any, shown: Any) -> _Place:
        """A child of a plain group: it stands in what surrounds the group, which has no frame of its own."""
        above = self.sub.rstrip(".").rpartition(".")[0]
        surroundings = replace(self, sub=f"{above}." if above else "").frame if self.sub else self.T_model_root
        path = (*self.path[:-1], child.Name)
        return _Place(child, "", surroundings, (shown, *self.inside), path)

    def in_compound(self, child: Any, shown: Any) -> _Place:
        """A part of a compound: copied as it stands into the compound's frame, under its own name."""
        return _Place(child, "", self.frame, (shown, *self.inside), (*self.path, child.Name), made_of=True)


def _below(place: _Place, used_up: frozenset[str], problems: list[str]) -> Iterator[Piece]:
    """Pieces of an object at and below one place."""
    shown = place.shown
    called = ".".join(place.path)
    if shown is None:
        problems.append(Reason("document.left_out.link", label=called))
        return
    # What an array repeats is drawn by the array, even where it only serves to make it.
    only_serves = shown.Name in used_up and shown.Document is place.root.Document
    if only_serves and not place.made_of and not place.path[-1].isdigit():
        return
    obj = shown.getLinkedObject(True)
    if obj is None or (shown.TypeId == "App::Link" and shown.LinkedObject is None):
        problems.append(Reason("document.left_out.nothing", label=shown.Label))
        return
    if len(place.inside) > _DEEPEST:
        problems.append(Reason("document.left_out.groups", label=shown.Label))
        return
    drawn = 0
    children = _children(place, shown, obj)
    for child in children:
        for piece in _below(child, used_up, problems):
            drawn += 1
            yield piece
    if _draws_itself(obj, bool(children), drawn):
        placement = getattr(obj, "Placement", None)
        T = place.frame if placement is None else place.frame @ np.linalg.inv(transform_of(placement))
        yield Piece(called, obj, shown, T, place.inside)


def _children(place: _Place, shown: Any, obj: Any) -> list[_Place]:
    """Places of what a group, a link to one or an array of links holds."""
    if any(shown.hasExtension(name) for name in _LINKS):
        return [place.below(child, shown) for child in shown.getSubObjects()]
    if obj is shown and obj.TypeId == "Part::Compound" and all(_may_draw(part) for part in obj.Links):
        return [place.in_compound(part, shown) for part in obj.Links]
    if obj.TypeId == "PartDesign::Body" or not is_group(obj):
        return []
    if any(obj.hasExtension(name) for name in _FRAMES):
        return [place.below(child, shown) for child in shown.getSubObjects()]
    return [place.beside(child, shown) for child in obj.Group]


def _draws_itself(obj: Any, holds_others: bool, drawn: int) -> bool:
    """Whether an object has a shape of its own.

    That of a group comes after what it holds, so that what it only repeats is counted already; what is left are
    children that native IFC has not made objects of.
    """
    return _may_draw(obj) and (not holds_others or drawn == 0 or is_group(obj))


def is_spatial(obj: Any) -> bool:
    """Whether an object is a place, such as a storey, and no thing."""
    said = {str(getattr(obj, name, "") or "").removeprefix("Ifc").replace(" ", "") for name in CLASS_PROPERTIES}
    return proxy_type(obj) in _SPATIAL or bool(said & _SPATIAL)
