"""The command Camera profile: a plate for the workshop, what captures of it tell, the check before a shift."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.command import Command

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class CameraProof(Command):
    """Opens the panel in which a camera is learned, and verified."""

    NAME = "AADM_Camera"
    ICON = "camera-proof"
    SHORTCUT = "A, V"
    TEXT = QT_TRANSLATE_NOOP("AADM_Camera", "Camera profile…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_Camera", "Draws a plate for a workshop, learns a camera from captures of it, verifies it before a shift"
    )

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.camera_proof import open_panel

        open_panel()
