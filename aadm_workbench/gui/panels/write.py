"""The panel that writes results to the model: onto its objects, and into a copy of the IFC file that it came from."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import FreeCAD
from PySide import QtGui

from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.ifc_file import ifc_file_of
from aadm_workbench.document.model_properties import write_onto_model
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.report.file import encoded
from aadm_workbench.document.report.of_document import report_of
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import WorkingPanel, show_panel
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.own_files import write_atomically

translate = FreeCAD.Qt.translate


class WritePanel(WorkingPanel):
    """Two places to write to, each with its own switch; the IFC file itself is changed only where that is chosen."""

    ICON = "write-results"

    def __init__(self, document: Any) -> None:
        super().__init__(translate("AADM_Write", "Write results to model"), document)
        self.document = document
        self.onto_objects = QtGui.QCheckBox(translate("AADM_Write", "Onto the model's objects"), checked=True)
        self.save = QtGui.QCheckBox(translate("AADM_Write", "Then save the document"), checked=bool(document.FileName))
        self.save.setEnabled(bool(document.FileName))
        self.into_ifc = QtGui.QCheckBox(translate("AADM_Write", "Into the model's IFC file"))
        self.in_place = QtGui.QCheckBox(
            translate("AADM_Write", "Change the file itself"),
            toolTip=translate("AADM_Write", "A copy of it as it was is kept beside it"),
        )
        self.changed = QtGui.QCheckBox(translate("AADM_Write", "Even if it has changed"))
        self.changed.setToolTip(translate("AADM_Write", "Since the check: columns are then found by their GlobalIds"))
        found = ifc_file_of(document)
        self.model = FileLine("IFC", "*.ifc", str(found or ""))
        self.out = FileLine("IFC", "*.ifc", save=True)
        self.out.setToolTip(translate("AADM_Write", "Empty: MODEL-checked.ifc beside the file"))
        self.in_place.toggled.connect(self.out.setDisabled)
        self.into_ifc.setChecked(found is not None)
        form = QtGui.QFormLayout()
        form.addRow(translate("AADM_Write", "IFC file"), self.model)
        form.addRow(translate("AADM_Write", "Written to"), self.out)
        for part in (self.onto_objects, self.save, self.into_ifc):
            self.layout.addWidget(part)
        self.layout.addLayout(form)
        for part in (self.in_place, self.changed):
            self.layout.addWidget(part)
        self.add_start(translate("AADM_Write", "Write"))
        self.layout.addStretch(1)

    def start(self) -> None:
        """Write what is switched on."""
        with sentences(self.title):
            report = report_of(self.document)
            if self.into_ifc.isChecked():
                # First: what it needs is looked at before anything is changed.
                self._write_ifc(report)
            if self.onto_objects.isChecked():
                self._write_onto_objects()

    def _write_onto_objects(self) -> None:
        with undo_step(self.document, translate("AADM_Write", "Write results to model")):
            count = write_onto_model(self.document)
        if count:
            said = translate("AADM_Write", "Results were written onto {count} objects of the model")
            tell(said.format(count=count))
        if self.save.isChecked():
            self.document.save()

    def _write_ifc(self, report: Mapping[str, Any]) -> None:
        model = Path(self.model.text())
        if not self.model.text() or not model.is_file():
            raise AadmError(translate("AADM_Write", "Choose the IFC file that the model came from."))
        model = model.resolve()
        out = Path(self.out.text() or model.with_name(f"{model.stem}-checked.ifc"))
        # The columns of the written model are linked to this file.
        folder = out.with_name(f"{model.stem}-report")
        folder.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / "report.json", encoded(report))
        arguments = ["writeback", str(folder / "report.json"), str(model)]
        arguments += ["--in-place"] if self.in_place.isChecked() else ["--out", str(out)]
        arguments += ["--force"] if self.changed.isChecked() else []
        written = model if self.in_place.isChecked() else out
        self.have_done(Work(arguments), lambda _: self._say_written(written))

    def _say_written(self, file: Path) -> None:
        said = translate("AADM_Write", "Results were written into {file}").format(file=file)
        tell(said)
        self.step.setText(said)


def open_panel(document: Any) -> WritePanel:
    """Show the panel for a document."""
    panel = WritePanel(document)
    show_panel(panel)
    return panel
