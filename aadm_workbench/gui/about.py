"""The command About: which version this is, and what it runs on."""

import platform

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench import __version__
from aadm_workbench.gui.workbench import ICONS, translate

NAME = "AADM_About"


class About:
    """Shows the version in a small window."""

    def GetResources(self) -> dict[str, str]:
        """Icon and texts of the menu entry."""
        return {
            "Pixmap": str(ICONS / "aadm.svg"),
            "MenuText": translate("AADM_About", "About AADM"),
            "ToolTip": translate("AADM_About", "Shows the version of this workbench"),
        }

    def IsActive(self) -> bool:
        """Needs nothing."""
        return True

    def Activated(self) -> None:
        """Open the window; it does not block FreeCAD."""
        window = QtGui.QMessageBox(FreeCADGui.getMainWindow())
        window.setObjectName(NAME)
        window.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        window.setWindowTitle(translate("AADM_About", "About AADM"))
        window.setIconPixmap(FreeCADGui.getIcon(str(ICONS / "aadm.svg")).pixmap(64, 64))
        window.setText(about_text())
        window.open()


def about_text() -> str:
    """Versions, one a line: what a report of a fault should quote."""
    freecad_version = ".".join(FreeCAD.Version()[:3])
    purpose = translate("AADM_About", "Checks precast columns against their connecting rebars.")
    return f"AADM {__version__}\nFreeCAD {freecad_version}, Python {platform.python_version()}\n\n{purpose}"
