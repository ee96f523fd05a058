"""The panel that writes reports of a document's results: report.json, and what the command makes of it."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.atomic import write_atomically
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.packages import require
from aadm_workbench.errors import ReportError
from aadm_workbench.gui.aadm_process import AadmProcess
from aadm_workbench.gui.language import language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import TaskPanel, show_panel
from aadm_workbench.gui.picture import save_picture
from aadm_workbench.gui.sentences import sentences, show_error
from aadm_workbench.gui.view_camera import active_view

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

_FORMS = (
    ("html", QT_TRANSLATE_NOOP("AADM_Report", "HTML, one file to read and keep"), True),
    ("pdf", QT_TRANSLATE_NOOP("AADM_Report", "PDF"), False),
    ("xlsx", QT_TRANSLATE_NOOP("AADM_Report", "Excel workbook"), False),
    ("csv", QT_TRANSLATE_NOOP("AADM_Report", "CSV tables"), False),
    ("bcf", QT_TRANSLATE_NOOP("AADM_Report", "BCF topics for the BIM coordinator"), False),
    ("crew", QT_TRANSLATE_NOOP("AADM_Report", "Page for the crew"), False),
    ("fcstd", QT_TRANSLATE_NOOP("AADM_Report", "FreeCAD document with the results alone"), False),
    ("scan-card", QT_TRANSLATE_NOOP("AADM_Report", "Card for scanning"), False),
)

_NEEDED = {
    "html": ("jsonschema", "jinja2", "fontTools"),
    "pdf": ("jsonschema", "reportlab"),
    "xlsx": ("jsonschema", "xlsxwriter"),
    "csv": ("jsonschema",),
    "bcf": ("jsonschema",),
    "crew": ("jsonschema", "reportlab"),
    "scan-card": ("jsonschema", "reportlab"),
    "fcstd": ("jsonschema",),
}
"""Packages of each, by the names they are imported by."""


class ReportPanel(TaskPanel):
    """A folder, and what is written into it."""

    ICON = "report"

    def __init__(self, report: Mapping[str, Any], document: Any) -> None:
        super().__init__(translate("AADM_Report", "Report"))
        self.report = report
        self.process: AadmProcess | None = None
        beside = Path(document.FileName) if document.FileName else Path.home() / f"{document.Label}.FCStd"
        self.folder = FileLine(translate("AADM_Report", "Folder"), "", str(beside.with_name(f"{beside.stem}-report")))
        self.forms = {}
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Report", "Folder"), self.folder)
        self.layout.addLayout(form)
        self.layout.addWidget(QtGui.QLabel(translate("AADM_Report", "report.json is always written. And:")))
        for name, text, chosen in _FORMS:
            self.forms[name] = QtGui.QCheckBox(translate("AADM_Report", text), checked=chosen)
            self.layout.addWidget(self.forms[name])
        self.picture = QtGui.QCheckBox(translate("AADM_Report", "Picture of the 3-D view"), checked=True)
        self.layout.addWidget(self.picture)
        self.write_button = QtGui.QPushButton(translate("AADM_Report", "Write"))
        self.write_button.clicked.connect(self.start)
        self.progress = QtGui.QProgressBar(maximum=0, visible=False)
        self.said = QtGui.QLabel(wordWrap=True)
        self.said.setOpenExternalLinks(True)
        for part in (self.write_button, self.progress, self.said):
            self.layout.addWidget(part)
        self.layout.addStretch(1)
        self._words: list[str] = []

    def start(self) -> None:
        """Write report.json, then have the command make the rest."""
        with sentences(self.form.windowTitle()):
            from aadm_workbench.report.json import encode

            folder = Path(self.folder.text())
            if not self.folder.text():
                raise ReportError(translate("AADM_Report", "Choose the folder to write into."))
            chosen = [name for name, box in self.forms.items() if box.isChecked()]
            require(*(module for name in chosen for module in _NEEDED.get(name, ())))
            folder.mkdir(parents=True, exist_ok=True)
            write_atomically(folder / "report.json", encode(self.report))
            view = active_view()
            if self.picture.isChecked() and view is not None:
                save_picture(view, folder / "view.png")
            wanted = [f"--{name}" for name in chosen]
            if not wanted:
                self._written(folder)
                return
            self._words.clear()
            self._busy(True)
            arguments = ["report", str(folder / "report.json"), "--out", str(folder), *wanted]
            arguments += ["--language", language()]
            self.process = AadmProcess(arguments, tempfile.gettempdir())
            self.process.said.connect(self._words.append)
            self.process.ended.connect(lambda code: self._ended(code, folder))
            self.process.start()

    def _ended(self, code: int, folder: Path) -> None:
        self._busy(False)
        if code == 0:
            self._written(folder)
        else:
            said = "\n".join(self._words[-3:]) or translate("AADM_Report", "aadm report ended with {code}").format(
                code=code
            )
            show_error(self.form.windowTitle(), ReportError(said))

    def _written(self, folder: Path) -> None:
        tell(translate("AADM_Report", "Written: {folder}").format(folder=folder))
        url = QtCore.QUrl.fromLocalFile(str(folder)).toString()
        self.said.setText(f'<a href="{url}">{folder}</a>')

    def _busy(self, busy: bool) -> None:
        self.write_button.setEnabled(not busy)
        self.progress.setVisible(busy)

    def closing(self) -> None:
        """What still runs is ended."""
        if self.process is not None:
            self.process.cancel()


def open_panel(report: Mapping[str, Any], document: Any) -> ReportPanel:
    """Show the panel for a report."""
    panel = ReportPanel(report, document)
    show_panel(panel)
    return panel
