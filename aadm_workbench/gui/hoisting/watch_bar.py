"""The bar that starts and stops ``aadm watch`` beside the hoisting window: of which column, with which camera."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from pathlib import Path

import FreeCAD
from PySide import QtGui

from aadm_workbench.document.checking import CHECKED
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.private_process import command, environment
from aadm_workbench.errors import AadmError, JobError
from aadm_workbench.gui import settings
from aadm_workbench.gui.aadm_process import CANCELLED, AadmProcess
from aadm_workbench.gui.language import in_language
from aadm_workbench.gui.panels.capture import ADDRESSES
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.sentences import sentences, show_error

translate = FreeCAD.Qt.translate
_CORNERS = ("-x-y", "+x-y", "-x+y", "+x+y")
_LAST_WORDS = 3  # lines; what went wrong stands at the end


class WatchBar(QtGui.QWidget):
    """Job, column, corner and camera, a button, and what the watch says; ``folder`` tells where the frames lie.

    One watch at a time: it ends with :meth:`stop`, which the window calls when it is closed.
    """

    def __init__(self, folder: Callable[[], str]) -> None:
        super().__init__()
        self._folder = folder
        self._process: AadmProcess | None = None
        self._said: deque[str] = deque(maxlen=_LAST_WORDS)
        self.job = FileLine(translate("AADM_Job", "Job"), "*.toml")
        self.column = QtGui.QComboBox()
        self.column.setEditable(True)
        document = FreeCAD.ActiveDocument
        self.column.addItems([column.ColumnId for column in columns_in(document)] if document else [])
        self.corner = QtGui.QComboBox()
        self.corner.addItem(translate("AADM_Hoisting", "as in the job"), "")
        for corner in _CORNERS:
            self.corner.addItem(corner, corner)
        self.corner.setToolTip(translate("AADM_Hoisting", "The corner of the bars that the camera stands at"))
        self.camera = QtGui.QLineEdit(settings.camera_address())
        self.camera.setPlaceholderText(translate("AADM_Hoisting", "none: the folder alone"))
        self.camera.setToolTip("\n".join(ADDRESSES))
        self.button = QtGui.QPushButton()
        self.button.clicked.connect(lambda: self.start() if self._process is None else self.stop())
        self.state = QtGui.QLabel(translate("AADM_Hoisting", "Nothing is watched from here"), wordWrap=True)
        self.state.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Preferred)
        self._lay_out()
        self._busy(False)

    def _lay_out(self) -> None:
        rows = QtGui.QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        parts = (
            (translate("AADM_Job", "Job file"), self.job, 3),
            (translate("AADM_Import", "Column"), self.column, 1),
            (translate("AADM_Hoisting", "Corner"), self.corner, 0),
            (translate("AADM_Import", "Camera"), self.camera, 2),
        )
        first = QtGui.QHBoxLayout()
        for text, part, stretch in parts:
            first.addWidget(QtGui.QLabel(text))
            first.addWidget(part, stretch)
        second = QtGui.QHBoxLayout()
        second.addWidget(self.button)
        second.addWidget(self.state, 1)
        rows.addLayout(first)
        rows.addLayout(second)

    def start(self) -> None:
        """Have frames measured in a process of its own, until it is stopped."""
        with sentences(translate("AADM_Hoisting", "Hoisting guidance")):
            job, column, folder = Path(self.job.text()), self.column.currentText().strip(), self._folder()
            if not self.job.text() or not job.is_file():
                raise JobError(translate("AADM_Job", "Choose the job file: a .toml as the manual describes it."))
            if not column:
                raise JobError(translate("AADM_Hoisting", "Name the column that hangs."))
            if not folder:
                raise JobError(translate("AADM_Hoisting", "Choose the folder that is measured into"))
            Path(folder).mkdir(parents=True, exist_ok=True)
            words = command(self._arguments(job.resolve(), Path(folder).resolve(), column))
            self._run(AadmProcess(words, str(job.resolve().parent), environment(), output=True))

    def stop(self) -> None:
        """End the watch; the state that it has written stays, and grows old."""
        if self._process is not None:
            self.state.setText(translate("AADM_Hoisting", "Stopping…"))
            self._process.cancel()

    def leave(self) -> None:
        """End the watch, and do not wait to hear of it."""
        process, self._process = self._process, None
        if process is not None:
            process.cancel()

    def is_watching(self) -> bool:
        """Whether a watch runs that was started here."""
        return self._process is not None

    def _arguments(self, job: Path, folder: Path, column: str) -> list[str]:
        camera, corner = self.camera.text().strip(), self.corner.currentData()
        if camera:
            settings.remember_camera_address(camera)
        # a corner begins with a sign, as switches do
        more = [f"--near={corner}"] if corner else []
        more += ["--camera", camera] if camera else []
        return ["watch", str(job), str(folder), "--column", column, *more]

    def _run(self, process: AadmProcess) -> None:
        self._process = process
        self._said.clear()
        # who has left, or started another, hears nothing more of this one
        process.said.connect(lambda line: self._process is process and self._hear(line))
        process.ended.connect(lambda code: self._process is process and self._ended(code))
        self._busy(True)
        self.state.setText(translate("AADM_Hoisting", "Starting…"))
        process.start()

    def _hear(self, line: str) -> None:
        said = in_language(line)
        self._said.append(said)
        self.state.setText(translate("AADM_Hoisting", "Watching: {line}").format(line=said))
        self.state.setToolTip(said)

    def _ended(self, code: int) -> None:
        self._process = None
        self._busy(False)
        self.state.setText(translate("AADM_Hoisting", "The watch has ended"))
        if code not in CHECKED | {CANCELLED}:
            said = "\n".join(self._said) or translate("AADM_Hoisting", "The watch has ended")
            show_error(translate("AADM_Hoisting", "Hoisting guidance"), AadmError(said))

    def _busy(self, busy: bool) -> None:
        start, stop = translate("AADM_Hoisting", "Start watching"), translate("AADM_Hoisting", "Stop watching")
        self.button.setText(stop if busy else start)
        for part in (self.job, self.column, self.corner, self.camera):
            part.setEnabled(not busy)
