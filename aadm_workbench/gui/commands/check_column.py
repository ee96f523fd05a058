"""The command Check column: from scans to a verdict that stands on the column."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.chosen import the_column
from aadm_workbench.gui.command import Command, has_document

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class CheckColumn(Command):
    """Opens the panel of the check."""

    NAME = "AADM_CheckColumn"
    ICON = "check-column"
    SHORTCUT = "A, C"
    TEXT = QT_TRANSLATE_NOOP("AADM_CheckColumn", "Check column")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_CheckColumn", "Measures the selected column in its scans, and shows the verdict on it"
    )

    def IsActive(self) -> bool:
        """Where a document is open; what it lacks is said and offered when it runs."""
        return has_document()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.check import open_panel

        open_panel(the_column())
