"""What a command works on: the selection, in the words of this workbench."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui

from aadm_workbench.document.groups import columns_in, owner_of
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.view_camera import active_view

translate = FreeCAD.Qt.translate


class NoColumnError(AadmError):
    """There is no column to work on yet: what leads to one is offered."""


def chosen_columns() -> list[Any]:
    """Columns that are selected, themselves or through their scan, their result or their object in the model.

    The only column of a document need not be selected.
    """
    document = FreeCAD.ActiveDocument
    if document is None:
        return []
    known = columns_in(document)
    selected = FreeCADGui.Selection.getSelection(document.Name)
    found = []
    for obj in selected:
        column = owner_of(obj) or next((one for one in known if one.Model is obj), None)
        if column is not None and column not in found:
            found.append(column)
    return known if not selected and len(known) == 1 else found


def the_column() -> Any:
    """The one column to work on.

    Raises
    ------
    AadmError
        Where none or several are selected; says what to do.
    """
    found = chosen_columns()
    if len(found) == 1:
        return found[0]
    if found:
        raise AadmError(translate("AADM", "Several columns are selected: select one."))
    document = FreeCAD.ActiveDocument
    if document is None:
        raise NoColumnError(translate("AADM", "No document is open: open the model first."))
    check_columns(document)
    raise AadmError(translate("AADM", "Select an AADM column, or the object of the model that it belongs to."))


def check_columns(document: Any) -> None:
    """Raise NoColumnError where a document has no column of this workbench."""
    if not columns_in(document):
        raise NoColumnError(
            translate("AADM", "This document has no AADM column yet: select a column of the model, then Sample design.")
        )


def model_objects() -> list[Any]:
    """Selected objects of the model: what is no object of this workbench."""
    document = FreeCAD.ActiveDocument
    if document is None:
        return []
    return [obj for obj in FreeCADGui.Selection.getSelection(document.Name) if owner_of(obj) is None]


def select(objects: list[Any]) -> None:
    """Make these the selection."""
    FreeCADGui.Selection.clearSelection()
    for obj in objects:
        FreeCADGui.Selection.addSelection(obj)


def look_at(objects: list[Any]) -> None:
    """Turn the view to these objects, and to no others; what is selected stays."""
    view = active_view()
    if view is None or not objects:
        return
    selected = FreeCADGui.Selection.getSelection()
    select(objects)
    FreeCADGui.SendMsgToActiveView("ViewSelection")
    select(selected)
