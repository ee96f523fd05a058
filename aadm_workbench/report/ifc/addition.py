"""What is added to an IFC model: entities with ids behind the model's own, and GlobalIds that repeat."""

from __future__ import annotations

import math
import re
import uuid
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.ifc.text.step import StepText
from aadm_workbench.model import Array

Scalar: TypeAlias = str | float | int | bool

GLOBAL_ID_PREFIX = "3AADM"
"""Every GlobalId that this program gives begins like this; the rest follows from what the entity is about."""

APPLICATION = "aadm"
"""What an owner history calls this program."""

ENUMERATED = "IfcPropertyEnumeratedValue"
"""In place of a measure: a value out of a list that buildingSMART has fixed."""

_IDS = uuid.UUID("5d0d3d6e-3c1c-5a39-8f8e-2a2f4a1d7b60")
_LABEL_LENGTH = 255  # of an IfcLabel (ISO 10303-11 leaves it open, IFC does not)
_UNREADABLE = re.compile("[\x00\ud800-\udfff]")
_OURS_ALREADY = re.compile(rb"'(3AADM[0-9A-Za-z_$]{17})'")
_DECIMALS = 9
"""Of directions, and of lengths in any unit: a nanometre of a metre; digits are bytes."""
_LENGTHS = {"IfcLengthMeasure", "IfcPositiveLengthMeasure"}
_LENGTH_DECIMALS = 3
"""Of mm: a tenth of the smallest uncertainty that a camera states, and what is equal is written once."""
_ANGLE_DECIMALS = 3
"""Of degrees: 0.05 mm at the end of three metres, where tilts are known to 0.02° at best."""
_RADIAN_DECIMALS = 11  # what is read back as degrees is the same to eight decimals
_ROUNDED = {**dict.fromkeys(_LENGTHS, _LENGTH_DECIMALS), "IfcPlaneAngleMeasure": _ANGLE_DECIMALS}


class Property(NamedTuple):
    """A property: its name, its IFC type, its value in mm, degrees or as it is."""

    name: str
    measure: str
    value: Scalar


class Addition:
    """Entities under construction at the end of a model; lengths come in mm and are written in the model's unit."""

    def __init__(self, opened: OpenedIfc, text: StepText) -> None:
        self.file = opened.file
        self.mm = opened.mm
        self.is_2x3 = opened.file.schema == "IFC2X3"
        self.is_4x3 = opened.file.schema.startswith("IFC4X3")
        self.first = max(text.places, default=0) + 1
        self.altered: dict[int, bytes] = {}
        self._text = text
        self._radians = opened.radians
        self._taken = {found.decode() for found in _OURS_ALREADY.findall(text.content)}
        self._known: dict[tuple[object, ...], int] = {}
        # By name, measure and type, then by value: a floor has half a million, too many for a key of each.
        self._properties: dict[tuple[str, str, str], dict[Scalar, int]] = {}
        self._history = self._owner_history()

    def once(self, ifc_class: str, key: Sequence[object], **attributes: Any) -> Any:
        """An entity without an identity of its own, which all that say the same share: half of the bytes of a floor."""
        known = (ifc_class, *key)
        number = self._known.get(known)
        if number is not None:
            return self.file.by_id(number)
        made = self.new(ifc_class, **attributes)
        self._known[known] = made.id()  # an entity of ifcopenshell takes ten times the memory of its number
        return made

    def new(self, ifc_class: str, **attributes: Any) -> Any:
        """An entity."""
        return self.file.create_entity(ifc_class, **attributes)

    def rooted(self, ifc_class: str, key: Sequence[str], name: str | None, **attributes: Any) -> Any:
        """An entity with a GlobalId that follows from its key, and a name where it needs one."""
        return self.new(
            ifc_class,
            GlobalId=self.global_id(key_of(ifc_class, key)),
            OwnerHistory=self._history,
            Name=None if name is None else label(name),
            **attributes,
        )

    def global_id(self, key: str) -> str:
        """A GlobalId that is the same in each run, and not in the model yet."""
        while (found := derived_id(key)) in self._taken:
            key += "'"
        self._taken.add(found)
        return found

    def alter(self, entity: Any, **attributes: Any) -> None:
        """Change an entity of the model; its text as it was is kept for the way back."""
        self.altered.setdefault(entity.id(), self._text.statement(entity.id()))
        for name, value in attributes.items():
            setattr(entity, name, value)

    def length(self, mm: float) -> float:
        """A length in the model's unit; never a minus before a zero."""
        return round(round(float(mm), _LENGTH_DECIMALS) / self.mm, _DECIMALS) + 0.0

    def value(self, measure: str, value: Scalar) -> Any:
        """A typed value; lengths are given in mm, angles in degrees."""
        if measure in _LENGTHS:
            value = self.length(float(value))
        elif measure == "IfcPlaneAngleMeasure":
            value = round(math.radians(float(value)) / self._radians, _RADIAN_DECIMALS)
        elif measure == "IfcLabel":
            value = label(str(value))
        elif isinstance(value, str):
            value = readable(value)
        return self.file.create_entity(measure, value)

    def property_set(self, key: Sequence[str], name: str, properties: Iterable[Property], more: Sequence[Any]) -> Any:
        """A set of properties, with some that exist already behind them."""
        own = [self._property(*item) for item in properties]
        return self.rooted("IfcPropertySet", key, name, HasProperties=[*own, *more])

    def _property(self, name: str, measure: str, value: Scalar) -> Any:
        if measure == ENUMERATED:
            return self.new(measure, Name=name, EnumerationValues=[self.value("IfcLabel", value)])
        if measure in _ROUNDED:
            value = round(float(value), _ROUNDED[measure]) + 0.0
        alike = self._properties.setdefault((name, measure, type(value).__name__), {})
        if value in alike:
            return self.file.by_id(alike[value])
        made = self.new("IfcPropertySingleValue", Name=name, NominalValue=self.value(measure, value))
        alike[value] = made.id()
        return made

    def point(self, *xyz_mm: float) -> Any:
        """A point, given in mm."""
        place = [self.length(value) for value in xyz_mm]
        return self.once("IfcCartesianPoint", place, Coordinates=place)

    def direction(self, vector: Array) -> Any:
        """A direction."""
        ratios = [round(float(value), _DECIMALS) + 0.0 for value in vector]
        return self.once("IfcDirection", ratios, DirectionRatios=ratios)

    def axes(self, T_parent_own: Array) -> Any:
        """A frame (4, 4), its shift in mm; the directions are left out where they are the parent's."""
        z, x = T_parent_own[:3, 2], T_parent_own[:3, 0]
        turned = not np.allclose(T_parent_own[:3, :3], np.eye(3), atol=1e-12)
        return self.new(
            "IfcAxis2Placement3D",
            Location=self.point(*T_parent_own[:3, 3]),
            Axis=self.direction(z) if turned else None,
            RefDirection=self.direction(x) if turned else None,
        )

    def lines(self) -> Iterator[bytes]:
        """The added entities as lines of the file, in the order of their ids; a floor has a million."""
        return (line_of(self.file.by_id(number)) for number in range(self.first, self.file.get_max_id() + 1))

    def _owner_history(self) -> Any:
        """IFC2X3 asks for one: the project's own, or one that names this program."""
        if not self.is_2x3:
            return None
        project = self.file.by_type("IfcProject")[0]
        if project.OwnerHistory is not None:
            return project.OwnerHistory
        from aadm_workbench import __version__

        organization = self.new("IfcOrganization", Name="AADM workbench")
        return self.new(
            "IfcOwnerHistory",
            OwningUser=self.new(
                "IfcPersonAndOrganization",
                ThePerson=self.new("IfcPerson", FamilyName="AADM workbench"),
                TheOrganization=organization,
            ),
            OwningApplication=self.new(
                "IfcApplication",
                ApplicationDeveloper=organization,
                Version=__version__,
                ApplicationFullName="AADM workbench",
                ApplicationIdentifier=APPLICATION,
            ),
            ChangeAction="ADDED",
            CreationDate=0,
        )


def key_of(ifc_class: str, parts: Sequence[str]) -> str:
    """What a GlobalId follows from: the class, and what the entity is about."""
    return "/".join([ifc_class, *parts])


def derived_id(key: str) -> str:
    """A GlobalId that follows from a key and says by its first signs whose it is."""
    from ifcopenshell.guid import compress

    return GLOBAL_ID_PREFIX + str(compress(uuid.uuid5(_IDS, key).hex))[len(GLOBAL_ID_PREFIX) :]


def line_of(entity: Any) -> bytes:
    """An entity as a line of a STEP file."""
    text: str = entity.to_string()
    return f"{text};".encode("ascii")


def label(text: str) -> str:
    """A text as IfcLabel and IfcIdentifier allow it: 255 signs."""
    text = readable(text)
    return text if len(text) <= _LABEL_LENGTH else f"{text[: _LABEL_LENGTH - 1]}…"


def readable(text: str) -> str:
    """A text without what STEP cannot hold: a NUL ends it, and half of a surrogate pair is no sign."""
    return _UNREADABLE.sub("\ufffd", text)
