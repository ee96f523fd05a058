"""What an element says of itself, by class and by name: column, sleeve, connecting rebar, or neither."""

from __future__ import annotations

import re

from aadm_workbench.design.elements import Element
from aadm_workbench.design.ifc.words import COLUMN, NOT_COLUMN, NOT_REBAR, NOT_SLEEVE, REBAR, SLEEVE, find
from aadm_workbench.model import Reason

_GENERIC = frozenset(
    {"", "IfcBuildingElementProxy", "IfcBuildingElementPart", "IfcMember", "IfcElementAssembly", "IfcDiscreteAccessory"}
)
"""Classes that say nothing: FreeCAD's own solids, and what exporters use for everything."""

_NOT_CONNECTING = frozenset({"LIGATURE", "SHEAR", "STUD", "RING", "SPACEBAR", "PUNCHING"})
THINNEST_COLUMN_MM = 120.0
"""A round body thinner than this is a tube or a bar: no precast column is."""
_NUMBERED = re.compile(r"[A-Za-z]+(0\d\d)?|\d+")


def words(element: Element) -> str:
    """All that speaks for what an element is.

    A bar or a tube is also what its group is called: cylinders in a group "Connecting rebars". A column is not: its
    assembly may be called "column with sleeves".
    """
    return " | ".join(dict.fromkeys([element.said, *element.wholes])) if is_thin(element) else element.said


def is_column(element: Element) -> bool:
    """Whether class or name says column, and nothing says that it is something in one."""
    if element.ifc_class == "IfcColumn":
        return True
    if not generic(element) or find(NOT_COLUMN, element.Name):
        return False
    in_steel = find(SLEEVE, element.Name) or find(REBAR, element.Name) or find(NOT_REBAR, element.Name)
    return bool(find(COLUMN, element.Name)) and not in_steel


def is_rebar(element: Element) -> bool:
    """Whether class or name says reinforcing bar of any kind."""
    if element.ifc_class == "IfcReinforcingBar":
        return True
    said = element.said if is_hollow(element) else words(element)
    return generic(element) and bool(find(REBAR, said)) and not find(SLEEVE, element.Name)


def not_connecting(element: Element) -> str | None:
    """Why a reinforcing bar is none that a column stands on; None where it may be one."""
    if element.predefined_type in _NOT_CONNECTING:
        return Reason("ifc.bar_kind", kind=element.predefined_type)
    word = find(NOT_REBAR, words(element))
    if word and not find(REBAR, words(element)):
        return Reason("ifc.bar_called", named=repr(word))
    return None


def sleeve_word(element: Element) -> str | None:
    """The word for a sleeve that an element is called by, or what its class says; None for none."""
    if element.ifc_class == "IfcReinforcingBar" or is_column(element):
        return None
    if element.predefined_type == "COUPLER":
        return "COUPLER"
    return find(SLEEVE, words(element) if is_hollow(element) else element.said)


def not_a_sleeve(element: Element) -> str | None:
    """The word that says pipe sleeve, lifting or bracing socket; None for none."""
    return find(NOT_SLEEVE, words(element))


def generic(element: Element) -> bool:
    """Whether its class leaves open what it is."""
    return element.ifc_class in _GENERIC


def may_hold_sleeves(element: Element) -> bool:
    """Whether it may be a column by its shape: of no telling class, neither bar nor sleeve nor stirrup."""
    if not generic(element) or is_rebar(element) or sleeve_word(element) or not_a_sleeve(element):
        return False
    return not find(NOT_REBAR, words(element))


def is_hollow(element: Element) -> bool:
    """Whether anything in it has a bore."""
    return any(tube.bore_mm != (None, None) for tube in element.tubes)


def is_thin(element: Element) -> bool:
    """Whether all its bodies are bars or tubes, too thin for a column of any name."""
    return all(
        solid.bars or (len(solid.tubes) == 1 and (solid.tubes[0].outer_mm or THINNEST_COLUMN_MM) < THINNEST_COLUMN_MM)
        for solid in element.solids
    )


def is_opening(element: Element) -> bool:
    """Whether it is drawn as what is taken away from another."""
    return bool(element.is_a("IfcFeatureElementSubtraction"))


def described(element: Element) -> str:
    """Class and names in one text, for the reason why a point was taken."""
    said = words(element)
    return Reason("ifc.evidence", evidence=element.is_a(), said=said) if said else str(element.is_a())


def spoken(name: str) -> bool:
    """Whether a person gave a name; programs number theirs: Body, Body001, Link.Body."""
    return not all(_NUMBERED.fullmatch(part) for part in name.split(".") if part)
