"""The command Save picture: the 3-D view as a file, labels arranged for its size."""

from __future__ import annotations

from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.errors import AadmError
from aadm_workbench.gui.command import Command
from aadm_workbench.gui.picture import save_picture
from aadm_workbench.gui.view_camera import active_view

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class SavePicture(Command):
    """Asks for a file and saves the view into it."""

    NAME = "AADM_SavePicture"
    ICON = "save-picture"
    TEXT = QT_TRANSLATE_NOOP("AADM_SavePicture", "Save picture…")
    TOOLTIP = QT_TRANSLATE_NOOP("AADM_SavePicture", "Saves the 3-D view as it is now, for reports")

    def IsActive(self) -> bool:
        """With a 3-D view in front."""
        return active_view() is not None

    def run(self) -> None:
        """Ask and save."""
        view = active_view()
        if view is None:
            raise AadmError(translate("AADM_SavePicture", "No 3-D view is in front: open a document."))
        title = translate("AADM_SavePicture", "Save picture")
        chosen, _ = QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), title, "", "PNG (*.png)")
        if chosen:
            save_picture(view, Path(chosen).with_suffix(".png"))
