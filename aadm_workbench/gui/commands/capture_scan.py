"""The command Capture: takes a scan with a live camera, and gives it to a column."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.chosen import the_column
from aadm_workbench.gui.command import Command, has_document

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class CaptureScan(Command):
    """Opens the panel in which a camera is named and what it looks at is said."""

    NAME = "AADM_CaptureScan"
    ICON = "capture"
    SHORTCUT = "A, P"
    TEXT = QT_TRANSLATE_NOOP("AADM_CaptureScan", "Capture…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_CaptureScan", "Takes a scan with a live camera and gives it to the selected column"
    )

    def IsActive(self) -> bool:
        """Where a document is open; what it lacks is said and offered when it runs."""
        return has_document()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.capture import open_panel

        column = the_column()
        open_panel(column.Document, column)
