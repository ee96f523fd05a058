"""The panel that writes results to the model: onto its objects, and into the IFC file that it came from."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtGui

from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.model_properties import write_onto_model
from aadm_workbench.document.packages import naming_packages
from aadm_workbench.document.report.of_document import report_of
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import TaskPanel, show_panel
from aadm_workbench.gui.sentences import sentences, show_error
from aadm_workbench.gui.worker import Worker

translate = FreeCAD.Qt.translate


class WritePanel(TaskPanel):
    """Two places to write to, each with its own switch."""

    ICON = "write-results"

    def __init__(self, document: Any) -> None:
        super().__init__(translate("AADM_Write", "Write results to model"))
        self.document = document
        self.worker: Worker | None = None
        self.onto_objects = QtGui.QCheckBox(
            translate("AADM_Write", "As properties of the model's objects"), checked=True
        )
        self.save = QtGui.QCheckBox(translate("AADM_Write", "Then save the document"), checked=bool(document.FileName))
        self.save.setEnabled(bool(document.FileName))
        self.into_ifc = QtGui.QCheckBox(translate("AADM_Write", "Into the model's IFC file"))
        self.changed = QtGui.QCheckBox(translate("AADM_Write", "Even if the file has changed since the check"))
        self.changed.setToolTip(translate("AADM_Write", "Columns are then found by their GlobalIds"))
        self.model = FileLine("IFC", "*.ifc", _ifc_of(document))
        self.out = FileLine("IFC", "*.ifc", save=True)
        self.out.setToolTip(translate("AADM_Write", "Empty: the file itself, changed in place"))
        self.write_button = QtGui.QPushButton(translate("AADM_Write", "Write"))
        self.write_button.clicked.connect(self.start)
        self.progress = QtGui.QProgressBar(maximum=0, visible=False)
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Write", "IFC file"), self.model)
        form.addRow(translate("AADM_Write", "Written to"), self.out)
        for part in (self.onto_objects, self.save, self.into_ifc, self.changed):
            self.layout.addWidget(part)
        self.layout.addLayout(form)
        self.layout.addWidget(self.write_button)
        self.layout.addWidget(self.progress)
        self.layout.addStretch(1)

    def start(self) -> None:
        """Write what is switched on."""
        with sentences(self.form.windowTitle()):
            report = report_of(self.document)
            if self.onto_objects.isChecked():
                with undo_step(self.document, translate("AADM_Write", "Write results to model")):
                    count = write_onto_model(self.document)
                said = translate("AADM_Write", "Results were written onto {count} objects of the model")
                tell(said.format(count=count))
                if self.save.isChecked():
                    self.document.save()
            if self.into_ifc.isChecked():
                self._write_ifc(report)

    def _write_ifc(self, report: dict[str, Any]) -> None:
        model = Path(self.model.text())
        if not self.model.text() or not model.is_file():
            raise AadmError(translate("AADM_Write", "Choose the IFC file that the model came from."))
        out = Path(self.out.text() or model)
        # Who has checked in FreeCAD has no hash of the file: columns are found by their GlobalIds.
        force = self.changed.isChecked() or report.get("model") is None
        self.write_button.setEnabled(False)
        self.progress.setVisible(True)
        self.worker = Worker(lambda stage: _write(report, model, out, force=force))
        self.worker.done.connect(lambda _: self._written(out))
        self.worker.failed.connect(self._failed)
        self.worker.begin()

    def _written(self, out: Path) -> None:
        self._idle()
        tell(translate("AADM_Write", "Results were written into {file}").format(file=out))

    def _failed(self, error: BaseException) -> None:
        self._idle()
        show_error(self.form.windowTitle(), error)

    def _idle(self) -> None:
        self.write_button.setEnabled(True)
        self.progress.setVisible(False)


def open_panel(document: Any) -> WritePanel:
    """Show the panel for a document."""
    panel = WritePanel(document)
    show_panel(panel)
    return panel


def _write(report: dict[str, Any], model: Path, out: Path, *, force: bool) -> None:
    with naming_packages():
        reader = import_module("aadm_workbench.report.read")
        writer = import_module("aadm_workbench.report.ifc.model")
        writer.write_ifc(reader.parsed_report(json.dumps(report), str(model)), model, out, force=force)


def _ifc_of(document: Any) -> str:
    """The IFC file that a document was made from, where it says so."""
    for obj in document.Objects:
        for name in ("IfcFilePath", "FilePath"):
            written = getattr(obj, name, "")
            if isinstance(written, str) and written.lower().endswith(".ifc"):
                return written
    beside = Path(document.FileName).with_suffix(".ifc") if document.FileName else None
    return str(beside) if beside is not None and beside.is_file() else ""
