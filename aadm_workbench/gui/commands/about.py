"""The command About and doctor: which version this is, what it runs on, which packages are there and which are not."""

from __future__ import annotations

import platform
from importlib import import_module
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench import __version__
from aadm_workbench.document.packages import PACKAGES, Package, install_command
from aadm_workbench.gui.command import Command
from aadm_workbench.gui.panels.install import install
from aadm_workbench.gui.resources import icon_path

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class About(Command):
    """Shows versions and packages."""

    NAME = "AADM_About"
    TEXT = QT_TRANSLATE_NOOP("AADM_About", "About AADM and doctor")
    TOOLTIP = QT_TRANSLATE_NOOP("AADM_About", "Shows the version, and which Python packages are missing for what")

    def run(self) -> None:
        """Open the window; it does not block FreeCAD."""
        AboutWindow().show()


class AboutWindow(QtGui.QDialog):
    """Versions, packages, and a button for each package that is missing."""

    def __init__(self) -> None:
        super().__init__(FreeCADGui.getMainWindow())
        self.setObjectName("AADM_About")
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setWindowTitle(translate("AADM_About", "About AADM"))
        self.resize(760, 420)
        self.text = QtGui.QLabel(about_text())
        self.text.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        picture = QtGui.QLabel()
        picture.setPixmap(FreeCADGui.getIcon(icon_path("aadm")).pixmap(64, 64))
        head = QtGui.QHBoxLayout()
        head.addWidget(picture)
        head.addWidget(self.text, 1)
        layout = QtGui.QVBoxLayout(self)
        layout.addLayout(head)
        layout.addWidget(self._packages())
        close = QtGui.QPushButton(translate("AADM", "Close"))
        close.clicked.connect(self.close)
        layout.addWidget(close)

    def _packages(self) -> Any:
        table = QtGui.QTableWidget(len(PACKAGES), 4)
        table.setHorizontalHeaderLabels(
            [
                translate("AADM_About", "Package"),
                translate("AADM_About", "Version"),
                translate("AADM_About", "Needed for"),
                "",
            ]
        )
        table.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
        table.verticalHeader().hide()
        for row, package in enumerate(PACKAGES):
            found, problem = version_of(package)
            needed_for = translate("AADM_Packages", package.needed_for)
            for column, text in enumerate((package.pip_name, found or problem, needed_for)):
                table.setItem(row, column, QtGui.QTableWidgetItem(text))
            if not found:
                button = QtGui.QPushButton(translate("AADM_Install", "Install"))
                button.setToolTip(" ".join(install_command(package)))
                button.clicked.connect(lambda checked=False, package=package: install(package))
                table.setCellWidget(row, 3, button)
        table.resizeColumnsToContents()
        table.horizontalHeader().setSectionResizeMode(2, QtGui.QHeaderView.Stretch)
        return table


def version_of(package: Package) -> tuple[str, str]:
    """Version of a package, and what keeps it from being used; one of the two is empty."""
    try:
        module = import_module(package.module)
    except ModuleNotFoundError:
        return "", translate("AADM_About", "missing")
    except (ImportError, AttributeError, OSError) as error:
        return "", translate("AADM_About", "broken: {reason}").format(reason=error)
    return str(getattr(module, "__version__", "") or getattr(module, "version", "") or "✓"), ""


def about_text() -> str:
    """Versions, one a line: what a report of a fault should quote."""
    freecad_version = ".".join(FreeCAD.Version()[:3])
    purpose = translate("AADM_About", "Checks precast columns against their connecting rebars.")
    return f"AADM {__version__}\nFreeCAD {freecad_version}, Python {platform.python_version()}\n\n{purpose}"
