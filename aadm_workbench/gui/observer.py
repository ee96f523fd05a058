"""Keeps columns where their model's objects are, and labels in the unit that FreeCAD is set to."""

from __future__ import annotations

from typing import Any

import FreeCAD
from PySide import QtCore

from aadm_workbench.document.column import follow_model
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.result import is_result
from aadm_workbench.gui.panels.task_panel import close_orphans

_UNITS = "User parameter:BaseApp/Preferences/Units"


class ModelObserver:
    """FreeCAD tells it of changes in all documents."""

    def __init__(self) -> None:
        self._moved: set[str] = set()

    def slotChangedObject(self, obj: Any, prop: str) -> None:
        """An object has moved: columns follow once FreeCAD is done with what it does now."""
        if prop != "Placement" or hasattr(getattr(obj, "Proxy", None), "follow"):
            return
        document = obj.Document
        if document.Name not in self._moved:
            self._moved.add(document.Name)
            QtCore.QTimer.singleShot(0, lambda name=document.Name: self._follow(name))

    def slotDeletedDocument(self, document: Any) -> None:
        """A document is closed: the panel that was about it goes once FreeCAD is done."""
        QtCore.QTimer.singleShot(0, close_orphans)

    def slotDeletedObject(self, obj: Any) -> None:
        """An object is deleted, and with it what was about it."""
        QtCore.QTimer.singleShot(0, close_orphans)

    def _follow(self, name: str) -> None:
        self._moved.discard(name)
        if name in FreeCAD.listDocuments():
            for column in columns_in(FreeCAD.getDocument(name)):
                follow_model(column)


class UnitObserver:
    """FreeCAD tells it of changes in the settings of units."""

    def onChange(self, group: Any, name: str) -> None:
        """Draw labels anew in the new unit."""
        QtCore.QTimer.singleShot(0, redraw_results)


def redraw_results() -> None:
    """Draw all results of all documents anew."""
    for document in FreeCAD.listDocuments().values():
        for obj in document.Objects:
            if is_result(obj) and getattr(obj.ViewObject, "Proxy", None) is not None:
                obj.ViewObject.Proxy.redraw()


_KEPT: list[Any] = []


def watch_models() -> None:
    """Begin to watch; once is enough."""
    if _KEPT:
        return
    observer, units = ModelObserver(), UnitObserver()
    FreeCAD.addDocumentObserver(observer)
    group = FreeCAD.ParamGet(_UNITS)
    group.Attach(units)
    _KEPT.extend([observer, units, group])
