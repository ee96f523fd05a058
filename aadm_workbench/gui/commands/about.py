"""The command About and doctor: which version this is, what it runs on, and what it runs with."""

from __future__ import annotations

import platform
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench import __version__
from aadm_workbench.document.private_process import command, made_environment
from aadm_workbench.errors import NoEnvironmentError
from aadm_workbench.gui.command import Command
from aadm_workbench.gui.panels.environment import install
from aadm_workbench.gui.resources import icon
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.private.environment import left_over, remove_folder

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class About(Command):
    """Shows versions and the private environment."""

    NAME = "AADM_About"
    TEXT = QT_TRANSLATE_NOOP("AADM_About", "About AADM and doctor")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_About", "Shows the version, tries the workbench on a sample, installs or repairs what it needs"
    )

    def run(self) -> None:
        """Open the window; it does not block FreeCAD."""
        AboutWindow().show()


class AboutWindow(QtGui.QDialog):
    """The first thing that it offers is to try the workbench; then what becomes of the private environment."""

    def __init__(self) -> None:
        super().__init__(FreeCADGui.getMainWindow())
        self.setObjectName("AADM_About")
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setWindowTitle(translate("AADM_About", "About AADM"))
        self.resize(620, 360)
        self.text = QtGui.QLabel(about_text())
        self.text.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        picture = QtGui.QLabel()
        picture.setPixmap(icon("aadm").pixmap(64, 64))
        head = QtGui.QHBoxLayout()
        head.addWidget(picture)
        head.addWidget(self.text, 1)
        self.try_button = self._button(translate("AADM_About", "Try it on a sample floor"), self._try)
        self.try_button.setDefault(True)
        self.state = QtGui.QLabel(wordWrap=True)
        self.state.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        self.install_button = self._button("", lambda: self._install(""))
        self.wheels_button = self._button(translate("AADM_Install", "From a folder of wheels…"), self._of_wheels)
        self.remove_button = self._button(translate("AADM_Install", "Remove"), self.remove)
        buttons = QtGui.QHBoxLayout()
        for button in (self.install_button, self.wheels_button, self.remove_button):
            buttons.addWidget(button)
        needed = QtGui.QGroupBox(translate("AADM_About", "What it runs with"))
        inside = QtGui.QVBoxLayout(needed)
        inside.addWidget(self.state)
        inside.addLayout(buttons)
        layout = QtGui.QVBoxLayout(self)
        layout.addLayout(head)
        layout.addWidget(self.try_button)
        layout.addWidget(needed)
        layout.addStretch(1)
        layout.addWidget(self._button(translate("AADM", "Close"), self.close))
        self.refresh()

    def _button(self, text: str, act: Any) -> Any:
        button = QtGui.QPushButton(text)
        button.clicked.connect(lambda checked=False: act())
        return button

    def refresh(self) -> None:
        """Say what is there now."""
        made = made_environment()
        self.state.setText(state_text())
        self.install_button.setText(
            translate("AADM_Install", "Install") if made is None else translate("AADM_Install", "Repair")
        )
        self.remove_button.setEnabled(made is not None or bool(left_over()))

    def remove(self) -> None:
        """Take away the environment, and those of earlier versions."""
        made = made_environment()
        folders = [*left_over(), *([made.folder] if made is not None else [])]
        kept = [folder for folder in folders if not remove_folder(folder)]
        self.refresh()
        if kept:
            said = translate("AADM_Install", "A check is running with it: wait until that is done, then try again.")
            self.state.setText(f"{said}\n{kept[0]}")

    def _try(self) -> None:
        with sentences(self.windowTitle()):
            try:
                command([])
            except NoEnvironmentError:
                install("", self._begin_to_try)
            else:
                self._begin_to_try()

    def _begin_to_try(self) -> None:
        self.close()
        FreeCADGui.runCommand("AADM_TryIt")

    def _install(self, wheels: str) -> None:
        install(wheels, self.refresh)

    def _of_wheels(self) -> None:
        chosen = QtGui.QFileDialog.getExistingDirectory(self, translate("AADM_Install", "Folder of wheels"))
        if chosen:
            self._install(chosen)


def state_text() -> str:
    """What checks run with, one fact a line."""
    made = made_environment()
    if made is not None:
        installed = translate("AADM_About", "Installed, in a folder of its own; FreeCAD itself is not changed.")
        return f"{installed}\n{made.folder}\n{made.python} (Python {made.version[0]}.{made.version[1]})"
    try:
        return translate("AADM_About", "Checks run with {program}.").format(program=command([])[0])
    except NoEnvironmentError as error:
        return str(error)


def about_text() -> str:
    """Versions, one a line: what a report of a fault should quote."""
    freecad_version = ".".join(FreeCAD.Version()[:3])
    purpose = translate("AADM_About", "Checks precast columns against their connecting rebars.")
    return f"AADM {__version__}\nFreeCAD {freecad_version}, Python {platform.python_version()}\n\n{purpose}"
