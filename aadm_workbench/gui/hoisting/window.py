"""The window for hoisting: which way to push and turn the hanging column, in signs that are read from three metres."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench.document.hoisting_state import (
    BESIDE_CAMERA,
    SIDES,
    Guidance,
    Measurement,
    guidance_of,
    newest_measurement,
    read_measurement,
)
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.hoisting.picture import HoistingPicture
from aadm_workbench.gui.hoisting.watch_bar import WatchBar
from aadm_workbench.gui.language import in_language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.resources import icon
from aadm_workbench.gui.sentences import show_error

translate = FreeCAD.Qt.translate
_LOOK_EVERY_MS = 300  # a person sees no delay, and reading a small file costs nothing


class HoistingWindow(QtGui.QMainWindow):
    """Looks into a folder again and again, and shows the newest measurement."""

    def __init__(self, folder: str = "") -> None:
        super().__init__(FreeCADGui.getMainWindow(), QtCore.Qt.Window)
        self.setObjectName("AADM_Hoisting")
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self.setWindowTitle(translate("AADM_Hoisting", "Hoisting guidance"))
        self.setWindowIcon(icon("hoisting"))
        self.resize(1100, 760)
        self.folder = FileLine(translate("AADM_Hoisting", "Folder that is measured into"), "", folder)
        self.folder.changed.connect(lambda _: self.look())
        self.recorded = QtGui.QPushButton(translate("AADM_Hoisting", "Recorded result…"))
        self.recorded.clicked.connect(self._choose_recorded)
        self.standing = QtGui.QComboBox()
        self.standing.addItem(translate("AADM_Hoisting", "I stand beside the camera"), BESIDE_CAMERA)
        for side in SIDES:
            self.standing.addItem(translate("AADM_Hoisting", "I stand at the side {side}").format(side=side), side)
        self.standing.currentIndexChanged.connect(lambda _: self._show())
        self.full = QtGui.QPushButton(translate("AADM_Hoisting", "Full screen"))
        self.full.setCheckable(True)
        self.full.toggled.connect(self._fill_screen)
        self.watch = WatchBar(self.folder.text)
        self.picture = HoistingPicture()
        head = QtGui.QHBoxLayout()
        head.addWidget(QtGui.QLabel(translate("AADM_Hoisting", "Folder")))
        head.addWidget(self.folder, 1)
        for part in (self.recorded, self.standing, self.full):
            head.addWidget(part)
        middle = QtGui.QWidget()
        self.setCentralWidget(middle)
        layout = QtGui.QVBoxLayout(middle)
        layout.addLayout(head)
        layout.addWidget(self.watch)
        layout.addWidget(self.picture, 1)
        self.measurement: Measurement | None = None
        self.is_recorded = False
        self._problem = ""
        self._timer = QtCore.QTimer(self)
        self._timer.setInterval(_LOOK_EVERY_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()
        self._show()

    def closeEvent(self, event: Any) -> None:
        """A watch that was started here ends with the window."""
        self._timer.stop()
        self.watch.leave()
        super().closeEvent(event)

    def _fill_screen(self, fills: bool) -> None:
        """All of the screen for what is read from afar, without what is set beforehand."""
        self.watch.setVisible(not fills)
        if fills:
            self.showFullScreen()
        else:
            self.showNormal()

    def look(self) -> None:
        """Look for a newer measurement in the folder."""
        if self.folder.text() and not self.is_recorded:
            self._problem = ""
            try:
                self.measurement = newest_measurement(Path(self.folder.text()), _now_s())
            except AadmError as error:
                self.measurement, self._problem = None, in_language(error.reason)
        self._show()

    def show_recorded(self, file: Path) -> None:
        """Show what was measured once; it never looks live."""
        try:
            self.measurement = read_measurement(file)
            self._problem = "" if self.measurement else translate("AADM_Hoisting", "This file holds no hoisting frame")
        except AadmError as error:
            show_error(self.windowTitle(), error)
            return
        self.is_recorded = True
        self._show()

    def _choose_recorded(self) -> None:
        title = translate("AADM_Hoisting", "Recorded result")
        chosen, _ = QtGui.QFileDialog.getOpenFileName(self, title, "", "report.json (*.json)")
        if chosen:
            self.show_recorded(Path(chosen))

    def _show(self) -> None:
        if self.measurement is None:
            waiting = translate("AADM_Hoisting", "Waiting for the first measurement in the folder")
            choose = translate("AADM_Hoisting", "Choose the folder that is measured into")
            self.picture.show_text(self._problem or (waiting if self.folder.text() else choose))
            return
        now_s = None if self.is_recorded else _now_s()
        guidance = guidance_of(self.measurement, self.standing.currentData(), now_s)
        self.picture.show_guidance(guidance, self._caption(guidance, now_s))

    def _caption(self, guidance: Guidance, now_s: float | None) -> str:
        measurement: Any = self.measurement
        if now_s is None:
            when = translate("AADM_Hoisting", "RECORDED, not live")
        else:
            captured_s = measurement.captured_s
            age_s = 0.0 if captured_s is None else max(0.0, now_s - captured_s)
            ago = translate("AADM_Hoisting", "{age:.0f} s ago").format(age=age_s)
            when = in_language(guidance.reason) or ago
        name = measurement.column or measurement.file.stem
        return f"{name}  ·  {Path(str(measurement.frame.get('source') or measurement.file)).name}  ·  {when}"


def _now_s() -> float:
    return time.time()  # noqa: TID251 - compared with a frame's own time


def open_window(folder: str = "") -> HoistingWindow:
    """Show the window, or bring it to the front."""
    window = FreeCADGui.getMainWindow().findChild(HoistingWindow)
    if window is None:
        window = HoistingWindow(folder)
    window.show()
    window.raise_()
    return window
