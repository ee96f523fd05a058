"""The command Check all: one, several or all columns of a document at once."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.chosen import NoColumnError, check_columns, chosen_columns
from aadm_workbench.gui.command import Command, has_document

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class CheckAll(Command):
    """Opens the panel in which the scans of many columns are found and checked."""

    NAME = "AADM_CheckAll"
    ICON = "check-all"
    SHORTCUT = "A, A"
    TEXT = QT_TRANSLATE_NOOP("AADM_CheckAll", "Check all…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_CheckAll",
        "Finds the scans of all columns in a folder, or of several that are selected, and checks them at once",
    )

    def IsActive(self) -> bool:
        """Where a document is open; what it lacks is said and offered."""
        return has_document()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.check_all import open_panel

        document = FreeCAD.ActiveDocument
        if document is None:
            raise NoColumnError(translate("AADM", "No document is open: open the model first."))
        check_columns(document)
        chosen = chosen_columns()
        open_panel(document, chosen if len(chosen) > 1 else [])
