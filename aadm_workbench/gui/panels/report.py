"""The panel that writes reports of a document's results: report.json, and what the command makes of it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtCore, QtGui

from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.report.file import encoded
from aadm_workbench.errors import ReportError
from aadm_workbench.gui.language import language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import WorkingPanel, show_panel
from aadm_workbench.gui.picture import save_picture
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.gui.view_camera import active_view
from aadm_workbench.own_files import write_atomically

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

_FORMS = (
    ("html", QT_TRANSLATE_NOOP("AADM_Report", "HTML, one file to read and keep"), True),
    ("pdf", QT_TRANSLATE_NOOP("AADM_Report", "PDF"), False),
    ("xlsx", QT_TRANSLATE_NOOP("AADM_Report", "Excel workbook"), False),
    ("csv", QT_TRANSLATE_NOOP("AADM_Report", "CSV tables"), False),
    ("bcf", QT_TRANSLATE_NOOP("AADM_Report", "BCF topics for the BIM coordinator"), False),
    ("crew", QT_TRANSLATE_NOOP("AADM_Report", "Page for the crew"), False),
    ("fcstd", QT_TRANSLATE_NOOP("AADM_Report", "FreeCAD document of the results"), False),
    ("scan-card", QT_TRANSLATE_NOOP("AADM_Report", "Card for scanning"), False),
)


class ReportPanel(WorkingPanel):
    """A folder, and what is written into it."""

    ICON = "report"

    def __init__(self, report: Mapping[str, Any], document: Any) -> None:
        super().__init__(translate("AADM_Report", "Report"), document)
        self.report = report
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
        self.add_start(translate("AADM_Report", "Write"))
        self.written = QtGui.QLabel(wordWrap=True)
        self.written.setOpenExternalLinks(True)
        self.layout.addWidget(self.written)
        self.layout.addStretch(1)

    def start(self) -> None:
        """Write report.json, then have the command make the rest."""
        with sentences(self.title):
            folder = Path(self.folder.text())
            if not self.folder.text():
                raise ReportError(translate("AADM_Report", "Choose the folder to write into."))
            wanted = [f"--{name}" for name, box in self.forms.items() if box.isChecked()]
            folder.mkdir(parents=True, exist_ok=True)
            write_atomically(folder / "report.json", encoded(self.report))
            view = active_view()
            if self.picture.isChecked() and view is not None:
                save_picture(view, folder / "view.png")
            if not wanted:
                self._say_written(folder)
                return
            arguments = ["report", str(folder / "report.json"), "--out", str(folder), *wanted]
            arguments += ["--language", language()]
            self.have_done(Work(arguments), lambda _: self._say_written(folder))

    def _say_written(self, folder: Path) -> None:
        tell(translate("AADM_Report", "Written: {folder}").format(folder=folder))
        url = QtCore.QUrl.fromLocalFile(str(folder)).toString()
        self.written.setText(f'<a href="{url}">{folder}</a>')


def open_panel(report: Mapping[str, Any], document: Any) -> ReportPanel:
    """Show the panel for a report."""
    panel = ReportPanel(report, document)
    show_panel(panel)
    return panel
