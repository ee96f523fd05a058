"""The command Check column: from scans to a verdict that stands on the column."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.chosen import has_columns, the_column
from aadm_workbench.gui.command import Command

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
        """Where there are columns; which one is asked for is said when it runs."""
        return has_columns()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.check import open_panel

        open_panel(the_column())
