"""What an element of a model that is no IFC file says of itself, by class and by name; the words are those of all."""

from __future__ import annotations

import re

from aadm_workbench.design.elements import Element
from aadm_workbench.design.ifc.bars import NAMED_CLASSES
from aadm_workbench.design.ifc.columns import COLUMN_CLASSES, THINNEST_MM
from aadm_workbench.design.ifc.words import COUPLERS, NOT_COLUMN, NOT_REBAR, NOT_SLEEVE, REBAR, SLEEVE, Said, find
from aadm_workbench.model import Reason

_GENERIC = frozenset(
    {"", "IfcBuildingElementProxy", "IfcBuildingElementPart", "IfcMember", "IfcElementAssembly", "IfcDiscreteAccessory"}
)
"""Classes that say nothing: FreeCAD's own solids, and what exporters use for everything."""

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
        return not (_said(element).is_sleeve_or_bar and is_thin(element, THINNEST_MM))
    return (generic(element) or element.ifc_class in COLUMN_CLASSES) and Said(element.Name, (element.Name,)).is_column


def is_rebar(element: Element) -> bool:
    """Whether class or name says reinforcing bar of any kind."""
    if element.ifc_class == "IfcReinforcingBar":
        return True
    may_be = generic(element) or element.ifc_class in NAMED_CLASSES
    said = Said(element.Name, (element.said,)) if is_hollow(element) else _said(element)
    return may_be and bool(said.find(REBAR)) and not find(SLEEVE, element.Name)


def not_connecting(element: Element) -> str | None:
    """Why a reinforcing bar is none that a column stands on; None where it may be one."""
    return _said(element).why_not_connecting(element.predefined_type)


def sleeve_word(element: Element) -> str | None:
    """The word for a sleeve that an element is called by, or what its class says; None for none."""
    if is_column(element):
        return None
    if element.predefined_type in COUPLERS:
        return element.predefined_type
    if is_hollow(element):
        return find(SLEEVE, words(element))
    # Bars are called after the sleeve that they go into.
    return None if element.ifc_class == "IfcReinforcingBar" else find(SLEEVE, element.said)


def _said(element: Element) -> Said:
    return Said(element.Name, (words(element),))


def not_a_sleeve(element: Element) -> str | None:
    """The word that says pipe sleeve, lifting or bracing socket; None for none."""
    return find(NOT_SLEEVE, words(element))


def generic(element: Element) -> bool:
    """Whether its class leaves open what it is."""
    return element.ifc_class in _GENERIC


def may_hold_sleeves(element: Element) -> bool:
    """Whether it may be a column by its shape: of no telling class, neither bar, sleeve, stirrup nor capital."""
    if not generic(element) or is_rebar(element) or sleeve_word(element) or not_a_sleeve(element):
        return False
    return not find(NOT_REBAR, words(element)) and not find(NOT_COLUMN, element.Name)


def is_hollow(element: Element) -> bool:
    """Whether anything in it has a bore."""
    return any(tube.bore_mm != (None, None) for tube in element.tubes)


def is_thin(element: Element, thinnest_mm: float = THINNEST_COLUMN_MM) -> bool:
    """Whether all its bodies are bars or tubes, too thin for a column of any name."""
    return all(
        solid.bars or (len(solid.tubes) == 1 and (solid.tubes[0].outer_mm or thinnest_mm) < thinnest_mm)
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
