"""Properties of document objects as tables: one loop adds what is missing, at creation and after every restore."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

EDITABLE, READ_ONLY, HIDDEN = 0, 1, 2
"""Editor modes of FreeCAD: in the property editor, greyed out in it, not in it."""


@dataclass(frozen=True)
class Property:
    """One property: FreeCAD's type, name, group and tooltip; ``choices`` of an enumeration, the first is the default.

    ``text`` is marked for translation in the context ``App::Property``, where FreeCAD looks tooltips up.
    """

    type: str
    name: str
    group: str
    text: str
    default: Any = None
    choices: tuple[str, ...] = ()
    mode: int = EDITABLE


def apply_properties(holder: Any, properties: Iterable[Property]) -> None:
    """Add the properties that a document object or a view provider does not have yet, and set how they are edited.

    What a user has set stays; editor modes are not kept in files, so they are set each time.
    """
    for one in properties:
        if one.name not in holder.PropertiesList:
            holder.addProperty(one.type, one.name, one.group, one.text)
            if one.choices:
                setattr(holder, one.name, list(one.choices))
            if one.default is not None:
                setattr(holder, one.name, one.default)
        holder.setEditorMode(one.name, one.mode)
