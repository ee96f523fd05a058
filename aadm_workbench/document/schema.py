"""Which form the objects in a document have, and how those of an earlier form are brought to today's."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any

import FreeCAD

from aadm_workbench.document.properties import HIDDEN, Property, apply_properties

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
translate = FreeCAD.Qt.translate

SCHEMA = 1
"""Form of the objects that this version writes."""

SCHEMA_PROPERTY = Property(
    "App::PropertyInteger",
    "Schema",
    "AADM",
    QT_TRANSLATE_NOOP("App::Property", "Form of this object; newer versions of the workbench bring it up to date"),
    0,
    mode=HIDDEN,
)

Step = Callable[[Any], None]

MIGRATIONS: Mapping[int, Step] = MappingProxyType({})
"""What brings an object of schema n to n + 1, by n, where new properties with their defaults are not enough."""


def bring_up_to_date(obj: Any, properties: Iterable[Property], migrations: Mapping[int, Step] = MIGRATIONS) -> bool:
    """Bring a restored object to today's form.

    Returns
    -------
    bool
        False for an object of a newer version: it is left as it is, and a sentence says so.
    """
    apply_properties(obj, (SCHEMA_PROPERTY,))
    if obj.Schema > SCHEMA:
        FreeCAD.Console.PrintWarning(
            translate(
                "AADM",
                "{label} was saved by a newer version of the AADM workbench: update it before changing this object",
            ).format(label=obj.Label)
            + "\n"
        )
        return False
    for step in range(obj.Schema, SCHEMA):
        if step in migrations:
            migrations[step](obj)
    apply_properties(obj, properties)
    if obj.Schema != SCHEMA:
        obj.Schema = SCHEMA
    return True
