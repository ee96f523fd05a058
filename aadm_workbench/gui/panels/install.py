"""Installing a missing Python package into FreeCAD's own folder, from the message that names it."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.packages import Package, install_command, make_importable, package_called, package_folder
from aadm_workbench.errors import MissingDependencyError

translate = FreeCAD.Qt.translate
_LAST_LINES = 12  # the last ones say what went wrong


def offer_to_install(box: Any, error: MissingDependencyError) -> None:
    """Put a button into a message that installs the package which it names."""
    package = package_called(error.package)
    if package is not None:
        button = box.addButton(translate("AADM_Install", "Install it now"), QtGui.QMessageBox.ActionRole)
        button.setObjectName("AADM_InstallNow")
        button.clicked.connect(lambda: install(package))
        box.addButton(QtGui.QMessageBox.Close)


def install(package: Package) -> InstallWindow:
    """Run pip beside the window, and show what it says."""
    window = InstallWindow(package)
    window.show()
    window.start()
    return window


class InstallWindow(QtGui.QDialog):
    """Runs pip for one package; its lines are shown as they come, and it can be cancelled."""

    def __init__(self, package: Package, command: list[str] | None = None) -> None:
        super().__init__(FreeCADGui.getMainWindow())
        self.setObjectName("AADM_Install")
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setWindowTitle(translate("AADM_Install", "Installing {package}").format(package=package.pip_name))
        self.resize(640, 320)
        self._package = package
        self._command = command or install_command(package)
        self.lines = QtGui.QPlainTextEdit(readOnly=True)
        self.lines.appendPlainText(" ".join(self._command))
        self.close_button = QtGui.QPushButton(translate("AADM", "Cancel"))
        self.close_button.clicked.connect(self.close)
        layout = QtGui.QVBoxLayout(self)
        layout.addWidget(self.lines)
        layout.addWidget(self.close_button)
        self.process = QtCore.QProcess(self)
        self.process.setProcessChannelMode(QtCore.QProcess.MergedChannels)
        self.process.readyReadStandardOutput.connect(self._read)
        self.process.finished.connect(self._finished)
        self.process.errorOccurred.connect(self._failed)

    def start(self) -> None:
        """Begin."""
        package_folder().mkdir(parents=True, exist_ok=True)
        self.process.start(self._command[0], self._command[1:])

    def _read(self) -> None:
        said = bytes(self.process.readAllStandardOutput()).decode(errors="replace").rstrip()
        if said:
            self.lines.appendPlainText(said)

    def _failed(self, error: Any) -> None:
        self._end(
            translate("AADM_Install", "{command} cannot be run: name a Python in the settings").format(
                command=self._command[0]
            )
        )

    def _finished(self, code: int, status: Any) -> None:
        if code == 0:
            make_importable()
            said = translate("AADM_Install", "{package} is installed. Repeat the command.")
            tell(said.format(package=self._package.pip_name))
        else:
            said = translate("AADM_Install", "{package} could not be installed; the lines above say why.")
            last = "\n".join(self.lines.toPlainText().splitlines()[-_LAST_LINES:])
            complain(f"{said.format(package=self._package.pip_name)}\n{last}")
        self._end(said.format(package=self._package.pip_name))

    def _end(self, said: str) -> None:
        self.lines.appendPlainText(said)
        self.close_button.setText(translate("AADM", "Close"))

    def closeEvent(self, event: Any) -> None:
        """Closing it while pip runs cancels that."""
        if self.process.state() != QtCore.QProcess.NotRunning:
            self.process.kill()
            self.process.waitForFinished(2000)
        super().closeEvent(event)
