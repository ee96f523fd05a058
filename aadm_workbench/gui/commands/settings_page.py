"""The command Settings: opens this workbench's page of FreeCAD's preferences."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from aadm_workbench.gui.command import Command

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class SettingsPage(Command):
    """Opens the preferences at this workbench's page."""

    NAME = "AADM_Settings"
    ICON = "settings"
    TEXT = QT_TRANSLATE_NOOP("AADM_Settings", "Settings…")
    TOOLTIP = QT_TRANSLATE_NOOP("AADM_Settings", "Method, tolerances, units and what the 3-D view shows")

    def run(self) -> None:
        """Open them."""
        FreeCADGui.showPreferences("AADM", 0)
