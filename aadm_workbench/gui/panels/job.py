"""The panel in which a job is run: a whole floor, with progress and cancel, while the window stays alive."""

from __future__ import annotations

import tempfile
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.packages import require
from aadm_workbench.document.report.annotate import show_report
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import JobError
from aadm_workbench.gui.aadm_process import AadmProcess
from aadm_workbench.gui.language import language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import TaskPanel, show_panel
from aadm_workbench.gui.sentences import sentences, show_error

translate = FreeCAD.Qt.translate
_CHECKED = frozenset({0, 10, 11, 12})
"""Exit codes of a job whose columns were looked at: report.json is there."""


class JobPanel(TaskPanel):
    """A job file, a bar, a list of finished columns."""

    ICON = "run-job"

    def __init__(self, job: str = "") -> None:
        super().__init__(translate("AADM_Job", "Run job"))
        self.process: AadmProcess | None = None
        self.last_words: list[str] = []
        self.job = FileLine(translate("AADM_Job", "Job"), "*.toml", job)
        self.folder = FileLine(translate("AADM_Job", "Report folder"), "")
        self.folder.setToolTip(translate("AADM_Job", "Empty: a folder beside the job file, called after it"))
        self.run_button = QtGui.QPushButton(translate("AADM_Job", "Run"))
        self.run_button.clicked.connect(self.start)
        self.cancel_button = QtGui.QPushButton(translate("AADM", "Cancel"), enabled=False)
        self.cancel_button.clicked.connect(self.cancel)
        self.progress = QtGui.QProgressBar(visible=False)
        self.lines = QtGui.QListWidget()
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Job", "Job file"), self.job)
        form.addRow(translate("AADM_Job", "Report folder"), self.folder)
        buttons = QtGui.QHBoxLayout()
        buttons.addWidget(self.run_button, 1)
        buttons.addWidget(self.cancel_button)
        self.layout.addLayout(form)
        self.layout.addLayout(buttons)
        self.layout.addWidget(self.progress)
        self.layout.addWidget(self.lines, 1)

    def start(self) -> None:
        """Run the job in a process of its own."""
        with sentences(self.form.windowTitle()):
            job = Path(self.job.text())
            if not self.job.text() or not job.is_file():
                raise JobError(translate("AADM_Job", "Choose the job file: a .toml as the manual describes it."))
            require("numpy", "scipy", "cv2")
            out = self.folder.text() or str(job.with_name(f"{job.stem}-report"))
            self.report = Path(out) / "report.json"
            self.lines.clear()
            self.last_words.clear()
            self._busy(True)
            self.process = AadmProcess(
                ["check", str(job), "--out", out, "--json", "--language", language()], tempfile.gettempdir()
            )
            self.process.stepped.connect(self._stepped)
            self.process.said.connect(self._said)
            self.process.ended.connect(self._ended)
            self.process.start()

    def cancel(self) -> None:
        """End the job; the report of an earlier run stays."""
        if self.process is not None:
            self.process.cancel()

    def _stepped(self, done: int, total: int, what: str) -> None:
        self.progress.setMaximum(total)
        self.progress.setValue(done)
        self.lines.addItem(what)
        self.lines.scrollToBottom()

    def _said(self, line: str) -> None:
        self.last_words.append(line)
        self.lines.addItem(line)

    def _ended(self, code: int) -> None:
        self._busy(False)
        process, self.process = self.process, None
        if process is not None:
            process.deleteLater()
        if code == -1 and not self.last_words:
            self.lines.addItem(translate("AADM_Job", "cancelled"))
            return
        if code not in _CHECKED:
            said = "\n".join(self.last_words[-3:]) or translate("AADM_Job", "The job ended with {code}").format(
                code=code
            )
            show_error(self.form.windowTitle(), JobError(said))
            return
        with sentences(self.form.windowTitle()):
            self._show()

    def _show(self) -> None:
        report = load_report(self.report)
        document = FreeCAD.ActiveDocument or FreeCAD.newDocument("AADM")
        with undo_step(document, translate("AADM_Job", "Results of a job")):
            columns = show_report(document, report)
        summary = ", ".join(f"{count} {verdict}" for verdict, count in report["summary"].items() if count)
        said = translate("AADM_Job", "{count} columns: {summary}. Report: {file}")
        tell(said.format(count=len(columns), summary=summary, file=self.report))
        self.lines.addItem(said.format(count=len(columns), summary=summary, file=self.report))
        if FreeCADGui.activeDocument() is not None:
            FreeCADGui.SendMsgToActiveView("ViewFit")

    def _busy(self, busy: bool) -> None:
        self.run_button.setEnabled(not busy)
        self.cancel_button.setEnabled(busy)
        self.progress.setVisible(busy)
        self.progress.setMaximum(0)

    def closing(self) -> None:
        """A job that still runs is ended."""
        if self.process is not None:
            complain(translate("AADM_Job", "The job was cancelled: its panel was closed"))
            self.cancel()


def open_panel(job: str = "") -> JobPanel:
    """Show the panel."""
    panel = JobPanel(job)
    show_panel(panel)
    return panel
