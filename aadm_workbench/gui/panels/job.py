"""The panel in which a job is run: a whole floor, with progress and cancel, while the window stays alive."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.document.checking import CHECKED
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.report.annotate import show_report
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import JobError
from aadm_workbench.gui.language import language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import WorkingPanel, show_panel
from aadm_workbench.gui.sentences import sentences

translate = FreeCAD.Qt.translate


class JobPanel(WorkingPanel):
    """A job file, a bar, a list of finished columns; ``after`` is called with the columns that were shown."""

    ICON = "run-job"

    def __init__(self, job: str = "", after: Callable[[list[Any]], None] | None = None) -> None:
        super().__init__(translate("AADM_Job", "Run job"))
        self.after = after
        self.job = FileLine(translate("AADM_Job", "Job"), "*.toml", job)
        self.folder = FileLine(translate("AADM_Job", "Report folder"), "")
        self.folder.setToolTip(translate("AADM_Job", "Empty: a folder beside the job file, called after it"))
        self.lines = QtGui.QListWidget()
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Job", "Job file"), self.job)
        form.addRow(translate("AADM_Job", "Report folder"), self.folder)
        self.layout.addLayout(form)
        self.add_start(translate("AADM_Job", "Run"))
        self.layout.addWidget(self.lines, 1)

    def start(self) -> None:
        """Run the job in a process of its own."""
        with sentences(self.title):
            job = Path(self.job.text())
            if not self.job.text() or not job.is_file():
                raise JobError(translate("AADM_Job", "Choose the job file: a .toml as the manual describes it."))
            job = job.resolve()
            out = Path(self.folder.text() or job.with_name(f"{job.stem}-report")).resolve()
            self.lines.clear()
            arguments = ["check", str(job), "--out", str(out), "--json", "--language", language()]
            self.have_done(Work(arguments, codes=CHECKED), lambda _: self._show(out / "report.json"))

    def stepped(self, done: int, total: int, what: str) -> None:
        """A column is done."""
        super().stepped(done, total, what)
        self.said(what)

    def said(self, line: str) -> None:
        """A line more."""
        self.lines.addItem(line)
        self.lines.scrollToBottom()

    def _show(self, file: Path) -> None:
        report = load_report(file)
        document = FreeCAD.ActiveDocument or FreeCAD.newDocument("AADM")
        with undo_step(document, translate("AADM_Job", "Results of a job")):
            columns = show_report(document, report)
        summary = ", ".join(f"{count} {verdict}" for verdict, count in report["summary"].items() if count)
        said = translate("AADM_Job", "{count} columns: {summary}. Report: {file}")
        tell(said.format(count=len(columns), summary=summary, file=file))
        self.said(said.format(count=len(columns), summary=summary, file=file))
        if FreeCADGui.activeDocument() is not None:
            FreeCADGui.SendMsgToActiveView("ViewFit")
        if self.after is not None:
            self.after(columns)


def open_panel(job: str = "", after: Callable[[list[Any]], None] | None = None) -> JobPanel:
    """Show the panel."""
    panel = JobPanel(job, after)
    show_panel(panel)
    return panel
