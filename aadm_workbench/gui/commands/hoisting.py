"""The command Hoisting guidance: which way to push the hanging column, readable from three metres."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.command import Command

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class Hoisting(Command):
    """Opens the window with the big arrows."""

    NAME = "AADM_Hoisting"
    ICON = "hoisting"
    SHORTCUT = "A, H"
    TEXT = QT_TRANSLATE_NOOP("AADM_Hoisting", "Hoisting guidance…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_Hoisting", "Shows which way to push and turn the hanging column, from a folder that is measured into"
    )

    def run(self) -> None:
        """Open the window."""
        from aadm_workbench.gui.hoisting.window import open_window

        open_window()
