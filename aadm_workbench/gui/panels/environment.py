"""Installing the private environment: one button, a bar, a log that can be copied, and an end that can be asked for."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.private_process import around, named_python
from aadm_workbench.gui.aadm_process import AadmProcess
from aadm_workbench.private.environment import make_command
from aadm_workbench.private.pythons import candidates, find_python, plain_environment

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_PROBLEMS = {
    "busy": QT_TRANSLATE_NOOP("AADM_Install", "Another window is installing it: wait until that is done."),
    "in-use": QT_TRANSLATE_NOOP("AADM_Install", "A check is running with it: wait until that is done, then try again."),
    "network": QT_TRANSLATE_NOOP(
        "AADM_Install", "The network cannot be reached. Try again later, or install from a folder of wheels."
    ),
    "no-wheel": QT_TRANSLATE_NOOP(
        "AADM_Install",
        "A package was not found. Without a network this is what is said, too: look at the connection, or whether the "
        "folder of wheels holds all that requirements/freecad.txt names, for this Python.",
    ),
    "certificate": QT_TRANSLATE_NOOP(
        "AADM_Install", "The server's certificate is not trusted here: name your company's in pip's settings (cert)."
    ),
    "proxy": QT_TRANSLATE_NOOP("AADM_Install", "The proxy refuses: name it in pip's settings (proxy)."),
    "space": QT_TRANSLATE_NOOP("AADM_Install", "The disk is full: 1 GB is needed."),
    "broken": QT_TRANSLATE_NOOP(
        "AADM_Install", "A package cannot be loaded on this machine; the last line of the log says which and why."
    ),
    "pip": QT_TRANSLATE_NOOP("AADM_Install", "pip could not install it; the log says why."),
    "folder": QT_TRANSLATE_NOOP("AADM_Install", "The folder cannot be written; the last line of the log says which."),
}
"""What the words behind ``!`` mean, see ``private/make.py``."""


class EnvironmentWindow(QtGui.QDialog):
    """Makes the environment, beside the window of FreeCAD; ``after`` is called once it is there."""

    def __init__(self, wheels: str = "", after: Callable[[], object] | None = None) -> None:
        super().__init__(FreeCADGui.getMainWindow())
        self.setObjectName("AADM_Install")
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setWindowTitle(translate("AADM_Install", "Installing what AADM needs"))
        self.resize(700, 380)
        self.wheels, self.after = wheels, after
        self.process: AadmProcess | None = None
        self.problem = ""
        self.state = QtGui.QLabel(wordWrap=True)
        self.progress = QtGui.QProgressBar(maximum=0)
        self.lines = QtGui.QPlainTextEdit(readOnly=True)
        self.copy_button = QtGui.QPushButton(translate("AADM_Install", "Copy the log"))
        self.copy_button.clicked.connect(self.copy)
        self.wheels_button = QtGui.QPushButton(translate("AADM_Install", "From a folder of wheels…"), enabled=False)
        self.wheels_button.clicked.connect(self.choose_wheels)
        self.again_button = QtGui.QPushButton(translate("AADM_Install", "Try again"), enabled=False)
        self.again_button.clicked.connect(self.start)
        self.close_button = QtGui.QPushButton(translate("AADM", "Cancel"))
        self.close_button.clicked.connect(self.reject)
        buttons = QtGui.QHBoxLayout()
        for button in (self.copy_button, self.wheels_button, self.again_button, self.close_button):
            buttons.addWidget(button)
        layout = QtGui.QVBoxLayout(self)
        for part in (self.state, self.progress):
            layout.addWidget(part)
        layout.addWidget(self.lines, 1)
        layout.addLayout(buttons)

    def start(self) -> None:
        """Begin, or begin again."""
        if self.process is not None:
            return
        self.problem = ""
        self.lines.clear()
        program = self._python()
        if program is None:
            return
        self._busy(True)
        self.state.setText(
            translate("AADM_Install", "About 30 packages, 180 MB from the network. FreeCAD itself is not changed.")
        )
        variables = plain_environment(os.environ)
        self.process = AadmProcess(make_command(program, self.wheels), tempfile.gettempdir(), variables, output=True)
        self.process.stepped.connect(self._stepped)
        self.process.said.connect(self._said)
        self.process.ended.connect(self._ended)
        self.process.start()

    def _python(self) -> Any:
        """The Python that makes it; None, and a sentence, where there is none."""
        found, refused = find_python(candidates(named_python(), around(), os.environ.get("PATH", "")))
        for one in refused:
            self.lines.appendPlainText(f"{one.program}: {one.problem}")
        if found is not None:
            return found.program
        self._say(
            translate(
                "AADM_Install",
                "No Python from 3.11 to 3.14 was found: install one (on Debian: apt-get install python3), "
                "or name one in the settings of AADM.",
            )
        )
        self._busy(False)
        return None

    def _stepped(self, done: int, total: int, what: str) -> None:
        if self.process is None:
            return
        self.progress.setMaximum(total)
        self.progress.setValue(done)
        self.lines.appendPlainText(f"{done}/{total} {what}")

    def _said(self, line: str) -> None:
        if self.process is None:
            return
        if line.startswith("!"):
            self.problem, _, line = line[1:].partition(" ")
        self.lines.appendPlainText(line)

    def _ended(self, code: int) -> None:
        if self.process is None:
            return
        self.process = None
        self._busy(False)
        if code == 0:
            self._say(translate("AADM_Install", "Installed. Repeat the command."))
            if self.after is not None:
                super().reject()  # what follows says by itself that it is there, and must not lie behind this window
                self.after()
        elif self.problem:
            self._say(translate("AADM_Install", _PROBLEMS.get(self.problem, _PROBLEMS["pip"])), bad=True)
        else:
            self._say(translate("AADM_Install", "It was not installed; nothing is left of it."), bad=True)

    def _say(self, said: str, *, bad: bool = False) -> None:
        self.state.setText(said)
        (complain if bad else tell)(said)

    def _busy(self, busy: bool) -> None:
        self.progress.setVisible(busy)
        self.progress.setMaximum(0)
        self.wheels_button.setEnabled(not busy)
        self.again_button.setEnabled(not busy)
        self.close_button.setText(translate("AADM", "Cancel") if busy else translate("AADM", "Close"))

    def copy(self) -> None:
        """Put the log onto the clipboard."""
        QtGui.QApplication.clipboard().setText(self.lines.toPlainText())

    def choose_wheels(self) -> None:
        """Install from a folder that somebody has filled elsewhere: pip download -r requirements/freecad.txt."""
        chosen = QtGui.QFileDialog.getExistingDirectory(self, translate("AADM_Install", "Folder of wheels"))
        if chosen:
            self.wheels = chosen
            self.start()

    def reject(self) -> None:
        """Close it, by whatever way; while it works that cancels the work."""
        if self.process is not None:
            process, self.process = self.process, None  # what it still says has nowhere to go
            process.cancel()
        super().reject()


def install(wheels: str = "", after: Callable[[], object] | None = None) -> EnvironmentWindow:
    """Show the window and begin; one that is open is brought to the front."""
    window = FreeCADGui.getMainWindow().findChild(EnvironmentWindow)
    if window is None:
        window = EnvironmentWindow(wheels, after)
        window.show()
        window.start()
    window.raise_()
    return window
