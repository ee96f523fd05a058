"""The command Import scan: gives a column a scan of its sleeves or of its rebars."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.chosen import the_column
from aadm_workbench.gui.command import Command, has_document

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class ImportScan(Command):
    """Opens the panel in which a file is chosen and what it shows is said."""

    NAME = "AADM_ImportScan"
    ICON = "import-scan"
    SHORTCUT = "A, I"
    TEXT = QT_TRANSLATE_NOOP("AADM_ImportScan", "Import scan…")
    TOOLTIP = QT_TRANSLATE_NOOP("AADM_ImportScan", "Gives the selected column a scan of its sleeves or of its rebars")

    def IsActive(self) -> bool:
        """Where a document is open; what it lacks is said and offered when it runs."""
        return has_document()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.import_scan import open_panel

        column = the_column()
        open_panel(column.Document, [], column)
