"""The panel that checks many columns at once: their scans by name or by a job file, in a table to confirm."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtGui

from aadm_workbench.document.checking import CHECKED, check_unchanged
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.job.floor import (
    Assigned,
    assigned_by_job,
    assigned_by_name,
    assigned_now,
    camera_file_near,
    camera_work,
    put_scans,
    save_job,
    shortest_name,
)
from aadm_workbench.document.job.opened import model_of
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.report.annotate import show_report
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.scan_cloud import UNITS
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError, JobError, ScanError
from aadm_workbench.gui import settings
from aadm_workbench.gui.chosen import look_at, select
from aadm_workbench.gui.language import language
from aadm_workbench.gui.panels.assigned_table import AssignedTable
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import WorkingPanel, is_there, show_panel
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.model import UP_DEG
from aadm_workbench.private.answers import ReadCamera
from aadm_workbench.scan.file import DEPTH_MAPS

translate = FreeCAD.Qt.translate


class CheckAllPanel(WorkingPanel):
    """A folder or a job on top, one row a column below; what is switched on is saved as a job and checked by it."""

    ICON = "check-all"

    def __init__(self, document: Any, chosen: list[Any]) -> None:
        super().__init__(translate("AADM_CheckAll", "Check all"), document)
        self.document = document
        self.after: Callable[[list[Any]], object] | None = None
        self.columns = columns_in(document)
        self.folder = FileLine(translate("AADM_CheckAll", "Folder of scans"), "")
        self.folder.setToolTip(translate("AADM_CheckAll", "Scans are found by the names of columns in their names"))
        self.job = FileLine(translate("AADM_CheckAll", "Job"), "*.toml", job_file_of(document), save=True)
        self.job.setToolTip(translate("AADM_CheckAll", "What is checked is saved here, as the command aadm reads it"))
        self.camera = FileLine(translate("AADM_CheckAll", "Intrinsics"), "*.toml *.json *.txt", settings.camera_file())
        self.units, self.up = QtGui.QComboBox(), QtGui.QComboBox()
        self.units.addItems(UNITS)
        self.units.setCurrentText(settings.scan_units())
        self.up.setEditable(True)
        self.up.addItems(["", *UP_DEG])
        self.up.setToolTip(translate("AADM_CheckAll", "Side of the column at the top of pictures, for all rows"))
        self.up.activated.connect(lambda _: self.table.set_all_up(self.up.currentText()))
        self.state = QtGui.QLabel(wordWrap=True)
        self.table = AssignedTable([column.ColumnId for column in self.columns])
        self.table.show_rows([assigned_now(column) for column in self.columns])
        wanted = [column.Name for column in chosen] or [column.Name for column in self.columns]
        self.table.switch_on([column.Name in wanted for column in self.columns])
        self.table.chosen.connect(self._go_to)
        self.table.opened.connect(self._open)
        self._lay_out()
        self.folder.changed.connect(self._folder_chosen)
        self.job.changed.connect(self._job_chosen)
        self.refresh()

    def _lay_out(self) -> None:
        form = QtGui.QFormLayout()
        for text, widget in (
            (translate("AADM_CheckAll", "Scans"), self.folder),
            (translate("AADM_CheckAll", "Camera"), self.camera),
            (translate("AADM_CheckAll", "Unit"), self.units),
            (translate("AADM_CheckAll", "Up"), self.up),
            (translate("AADM_CheckAll", "Job file"), self.job),
        ):
            form.addRow(text, widget)
        self.layout.addLayout(form)
        self.layout.addWidget(self.state)
        self.layout.addWidget(self.table, 1)
        self.add_start(translate("AADM_CheckAll", "Check all"))
        self.start_button.setDefault(True)

    def refresh(self) -> None:
        """Say how many columns have scans, and the verdicts that the document holds."""
        with_scans = sum(bool(one.files) for one in self.table.rows())
        said = translate("AADM_CheckAll", "{count} of {all} columns have scans")
        lines = [said.format(count=with_scans, all=len(self.columns))]
        if self.folder.text() and with_scans < len(self.columns):
            lines.append(
                translate(
                    "AADM_CheckAll",
                    "A scan is found where its name holds that of its column, and sleeves or bars, such as "
                    "{id}-foot.ply. Others: double-click their place in the table.",
                ).format(id=shortest_name(self.columns))
            )
        self.state.setText("\n".join(lines))
        self.table.show_verdicts([column.Result.Verdict if column.Result else "" for column in self.columns])

    def _folder_chosen(self, chosen: str) -> None:
        with sentences(self.title):
            folder = Path(chosen)
            if not chosen or not folder.is_dir():
                raise ScanError(translate("AADM_CheckAll", "Choose the folder that holds the scans."))
            found = assigned_by_name(folder, self.columns)
            self.table.show_rows([found[column.Name] for column in self.columns])
            near = camera_file_near(folder)
            if near is not None:
                self.camera.line.setText(str(near))
            if not self.job.text():
                self.job.line.setText(str(folder / "aadm-job.toml"))
            self.refresh()

    def _job_chosen(self, chosen: str) -> None:
        """A job that is there fills the table; one that is not will be written."""
        with sentences(self.title):
            if chosen and Path(chosen).is_file():
                self.take_job(Path(chosen))

    def take_job(self, job: Path) -> None:
        """Show what a job file says of the columns.

        Raises
        ------
        JobError
            Where it is none, or names columns that the document has not.
        """
        found, unknown = assigned_by_job(job, self.columns)
        self.job.line.setText(str(job))
        self.table.show_rows([found.get(column.Name, Assigned()) for column in self.columns])
        self.table.switch_on([column.Name in found for column in self.columns])
        if camera_file_near(job.parent) == job:
            self.camera.line.setText(str(job))
        self.refresh()
        if unknown:
            said = translate(
                "AADM_CheckAll", "The job has columns that this document lacks: {names}. Sample them first."
            )
            raise JobError(said.format(names=", ".join(unknown)))

    def start(self) -> None:
        """Read the camera where one is needed, then save the job and check it."""
        with sentences(self.title):
            rows = [(column, row) for column, row in zip(self.columns, self.table.rows(), strict=True) if row.wanted]
            wanted = [(column, row) for column, row in rows if row.files]
            if not wanted:
                raise ScanError(
                    translate("AADM_CheckAll", "No column that is switched on has scans: choose their folder first.")
                )
            if not self.job.text():
                raise JobError(translate("AADM_CheckAll", "Choose where the job file is written."))
            files = [file for _, row in wanted for file in row.files]
            for file in files:
                if not file.exists():
                    raise ScanError(translate("AADM_CheckAll", "{file}: there is no such file").format(file=file))
            if any(file.is_dir() or file.suffix.lower() in DEPTH_MAPS for file in files) and self.camera.text():
                self.have_done(camera_work(Path(self.camera.text())), lambda read: self._check(wanted, read))
            else:
                self._check(wanted, None)

    def _check(self, wanted: list[tuple[Any, Assigned]], read: ReadCamera | None) -> None:
        columns = [column for column, _ in wanted]
        if not all(is_there(column) for column in columns):
            raise AadmError(translate("AADM_CheckAll", "A column is not there any more: open this panel again."))
        settings.remember_camera_file(self.camera.text())
        camera: Mapping[str, float] | None = None if read is None else read["camera"]
        step_mm = None if read is None else read["depth_scale_mm"]
        job = Path(self.job.text()).absolute()
        with undo_step(self.document, translate("AADM_CheckAll", "Scans of columns")):
            for column, row in wanted:
                put_scans(column, row, units=self.units.currentText(), camera=camera, depth_scale_mm=step_mm)
            remember_job_file(self.document, str(job))
        for column in columns:
            for cloud in column.Scans:
                check_unchanged(cloud)
        save_job(columns, job, settings.camera_profile())
        out = job.with_name(f"{job.stem}-report")
        method = columns[0].Method
        arguments = ["check", str(job), "--out", str(out), "--json", "--method", method, "--language", language()]
        self.table.show_verdicts(["" for _ in self.columns])
        self.have_done(Work(arguments, codes=CHECKED), lambda _: self._take(columns, out / "report.json"))

    def stepped(self, done: int, total: int, what: str) -> None:
        """A column is done."""
        super().stepped(done, total, what)
        self.step.setText(f"{done}/{total} {what}")

    def _take(self, columns: list[Any], file: Path) -> None:
        report = load_report(file)
        with undo_step(self.document, translate("AADM_CheckAll", "Check all")):
            shown = show_report(self.document, report)
        summary = ", ".join(f"{count} {verdict}" for verdict, count in report["summary"].items() if count)
        said = translate("AADM_CheckAll", "{count} columns: {summary}. Report: {file}")
        tell(said.format(count=len(shown), summary=summary, file=file))
        self.step.setText(said.format(count=len(shown), summary=summary, file=file))
        self.refresh()
        look_at([column.Result for column in shown])
        if self.after is not None:
            self.after(columns)

    def _go_to(self, number: int) -> None:
        column = self.columns[number]
        if is_there(column):
            select([column])
            look_at([column])

    def _open(self, number: int) -> None:
        from aadm_workbench.gui.panels.check import open_panel as open_check

        if is_there(self.columns[number]):
            open_check(self.columns[number])


def job_file_of(document: Any) -> str:
    """The job file that a document's columns were last checked by, or the place beside it where one may lie."""
    for column in columns_in(document):
        if column.JobFile:
            return str(column.JobFile)
    return str(Path(document.FileName).with_suffix(".toml")) if document.FileName else ""


def remember_job_file(document: Any, job: str) -> None:
    """Keep in the document by which job file its columns are checked."""
    for column in columns_in(document):
        if column.JobFile != job:
            column.JobFile = job


def open_panel(document: Any, chosen: list[Any] | None = None) -> CheckAllPanel:
    """Show the panel for the columns of a document; only ``chosen`` are switched on, or all."""
    panel = CheckAllPanel(document, chosen or [])
    show_panel(panel)
    return panel


def open_job(document: Any, job: Path, then: Callable[[CheckAllPanel], object] | None = None) -> None:
    """Show a job on the columns of a document; where it has none yet, those of the job's model are taken first.

    ``then`` is called with the panel that shows it.
    """
    from aadm_workbench.gui.panels.sampling import sample

    def show(_: object = None) -> None:
        panel = open_panel(document)
        with sentences(panel.title):
            panel.take_job(job)
            if then is not None:
                then(panel)

    with sentences(translate("AADM_CheckAll", "Check all")):
        model = model_of(job)
        if columns_in(document) or model is None:
            show()
        else:
            sample(document, None, model).after = show
