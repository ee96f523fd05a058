"""The panel in which a scan is imported: which file, what it shows, in which unit, by which camera."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.design.directions import UP_DEG
from aadm_workbench.document.column import columns_in
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.scan_cloud import KINDS, UNITS
from aadm_workbench.document.scan_reading import ReadScan, guessed_kind, read_for, take_scan
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError, ScanError
from aadm_workbench.gui import settings
from aadm_workbench.gui.chosen import select
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import TaskPanel, close_panel, show_panel
from aadm_workbench.gui.sentences import sentences, show_error
from aadm_workbench.gui.worker import Worker
from aadm_workbench.scan.file import CLOUDS, DEPTH_MAPS, TABLES

translate = FreeCAD.Qt.translate

_FORMATS = " ".join(f"*{suffix}" for suffix in (*DEPTH_MAPS, *CLOUDS, *TABLES))


class ImportPanel(TaskPanel):
    """Reads the file beside the window, then puts it into the document in one undo step."""

    ICON = "import-scan"

    def __init__(self, document: Any, files: Sequence[Path] = (), column: Any = None) -> None:
        super().__init__(translate("AADM_Import", "Import scan"))
        self.document = document
        self.columns = columns_in(document)
        self.worker: Worker | None = None
        self.column = QtGui.QComboBox()
        self.column.addItems([one.Label for one in self.columns])
        if column in self.columns:
            self.column.setCurrentIndex(self.columns.index(column))
        self.file = FileLine(translate("AADM_Import", "Scan"), _FORMATS, str(files[0]) if files else "")
        self.kind, self.units, self.up = QtGui.QComboBox(), QtGui.QComboBox(), QtGui.QComboBox()
        self.kind.addItem(translate("AADM_Import", "sleeves (the foot)"), KINDS[0])
        self.kind.addItem(translate("AADM_Import", "rebars (the bars below)"), KINDS[1])
        self.units.addItems(UNITS)
        self.units.setCurrentText(settings.scan_units())
        self.up.setEditable(True)
        self.up.addItems(["", *UP_DEG])
        self.up.setToolTip(translate("AADM_Import", "Side of the column at the top of the picture; empty: not known"))
        self.camera = FileLine(translate("AADM_Import", "Intrinsics"), "*.toml *.json *.txt", settings.camera_file())
        self.depth_scale = QtGui.QDoubleSpinBox(decimals=5, maximum=1000.0, singleStep=0.01)
        self.depth_scale.setSpecialValueText(translate("AADM_Import", "not given"))
        self.depth_scale.setSuffix(" mm")
        self._lay_out()
        self.file.changed.connect(self._file_chosen)
        self._file_chosen(self.file.text())

    def _lay_out(self) -> None:
        form = QtGui.QFormLayout()
        for text, widget in (
            (translate("AADM_Import", "Column"), self.column),
            (translate("AADM_Import", "File"), self.file),
            (translate("AADM_Import", "It shows"), self.kind),
            (translate("AADM_Import", "Its unit"), self.units),
            (translate("AADM_Import", "Up in the picture"), self.up),
            (translate("AADM_Import", "Camera"), self.camera),
            (translate("AADM_Import", "Step of a 16-bit depth map"), self.depth_scale),
        ):
            form.addRow(text, widget)
        self.import_button = QtGui.QPushButton(translate("AADM_Import", "Import"))
        self.import_button.setDefault(True)
        self.import_button.clicked.connect(self.start)
        self.progress = QtGui.QProgressBar(maximum=0, visible=False)
        self.layout.addLayout(form)
        self.layout.addWidget(self.import_button)
        self.layout.addWidget(self.progress)
        self.layout.addStretch(1)

    def _file_chosen(self, file: str) -> None:
        if file:
            self.kind.setCurrentIndex(KINDS.index(guessed_kind(file)))
        self.camera.setEnabled(True)

    def start(self) -> None:
        """Read the file in a thread."""
        with sentences(self.form.windowTitle()):
            request = self._request()
            self.import_button.setEnabled(False)
            self.progress.setVisible(True)
            self.worker = Worker(lambda stage: read_for(*request[0], **request[1]))
            self.worker.done.connect(self._take)
            self.worker.failed.connect(self._failed)
            self.worker.begin()

    def _request(self) -> tuple[tuple[str, str], dict[str, Any]]:
        if not self.columns:
            raise AadmError(
                translate("AADM_Import", "A scan belongs to a column, and this document has none: Sample design first.")
            )
        file = self.file.text()
        if not file:
            raise ScanError(translate("AADM_Import", "Choose the file of the scan."))
        camera = self.camera.text()
        if not camera and Path(file).suffix.lower() in DEPTH_MAPS:
            raise ScanError(
                translate("AADM_Import", "A depth map needs the camera's intrinsics: choose the file that holds them.")
            )
        settings.remember_camera_file(camera)
        # Of a cloud a camera says that it is in the camera's frame; that is left to depth maps here.
        used = camera if camera and Path(file).suffix.lower() in DEPTH_MAPS else None
        declared = {
            "units": self.units.currentText(),
            "camera": used,
            "depth_scale_mm": self.depth_scale.value() or None,
        }
        return (self.kind.currentData(), file), declared

    def _take(self, read: ReadScan) -> None:
        with sentences(self.form.windowTitle()):
            self._idle()
            column = self.columns[self.column.currentIndex()]
            with undo_step(self.document, translate("AADM_Import", "Import scan")):
                up = self.up.currentText().strip() or None
                cloud = take_scan(column, read, up=up, most_points=settings.most_points())
            said = translate("AADM_Import", "{file}: {count} points, imported to {column}")
            tell(said.format(file=read.file.name, count=cloud.PointCount, column=column.Label))
            close_panel(self)
            select([column])
            FreeCADGui.SendMsgToActiveView("ViewFit")

    def _failed(self, error: BaseException) -> None:
        self._idle()
        show_error(self.form.windowTitle(), error)

    def _idle(self) -> None:
        self.import_button.setEnabled(True)
        self.progress.setVisible(False)


def open_panel(document: Any, files: Sequence[Path] = (), column: Any = None) -> ImportPanel:
    """Show the panel, for some column of a document."""
    panel = ImportPanel(document, files, column)
    show_panel(panel)
    return panel
