"""The panel in which a scan is imported: which file, what it shows, in which unit, by which camera."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.job.floor import owner_by_name
from aadm_workbench.document.job.scan_names import guessed_kind
from aadm_workbench.document.scan_cloud import KINDS, UNITS
from aadm_workbench.document.scan_reading import AskedScan, take_scan
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError, ScanError
from aadm_workbench.gui import settings
from aadm_workbench.gui.chosen import select
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.sampling import of_ifc_file
from aadm_workbench.gui.panels.task_panel import WorkingPanel, close_panel, is_there, show_panel
from aadm_workbench.gui.sentences import sentences, show_error
from aadm_workbench.model import UP_DEG
from aadm_workbench.private.answers import ReadScan
from aadm_workbench.scan.file import CLOUDS, DEPTH_MAPS, TABLES

translate = FreeCAD.Qt.translate

_FORMATS = " ".join(f"*{suffix}" for suffix in (*DEPTH_MAPS, *CLOUDS, *TABLES))


class ImportPanel(WorkingPanel):
    """Reads the file beside the window, then puts it into the document in one undo step."""

    ICON = "import-scan"

    def __init__(self, document: Any, files: Sequence[Path] = (), column: Any = None) -> None:
        super().__init__(translate("AADM_Import", "Import scan"), document)
        self.document = document
        self.columns = columns_in(document)
        self.column = QtGui.QComboBox()
        self.column.addItems([one.Label for one in self.columns])
        if column is None and files:
            column = owner_by_name(files[0], self.columns)
        if column in self.columns:
            self.column.setCurrentIndex(self.columns.index(column))
        self.file = FileLine(translate("AADM_Import", "Scan"), _FORMATS, str(files[0]) if files else "", folder=True)
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
        self.depth_scale.setToolTip(
            translate("AADM_Import", "Millimetres in one step of a 16-bit depth map, where its camera's file has none")
        )
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
            (translate("AADM_Import", "Depth step"), self.depth_scale),
        ):
            form.addRow(text, widget)
        self.layout.addLayout(form)
        self.add_start(translate("AADM_Import", "Import"))
        self.start_button.setDefault(True)
        self.layout.addStretch(1)

    def _file_chosen(self, file: str) -> None:
        if file:
            self.kind.setCurrentIndex(KINDS.index(guessed_kind(Path(file).name) or KINDS[0]))
        self.camera.setEnabled(True)

    def start(self) -> None:
        """Have the file read."""
        with sentences(self.title):
            if not self.columns:
                # The scan is not forgotten over the model.
                file = Path(self.file.text())
                back = of_ifc_file(self.document, lambda _: open_panel(self.document, [file]))
                show_error(self.title, self._no_column(), back)
                return
            asked = self._asked()
            self.have_done(asked.work(), lambda read: self._take(asked, read))

    def _no_column(self) -> AadmError:
        return AadmError(
            translate("AADM_Import", "A scan belongs to a column, and this document has none: Sample design first.")
        )

    def _asked(self) -> AskedScan:
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
        return AskedScan(
            kind=self.kind.currentData(),
            file=Path(file),
            units=self.units.currentText(),
            camera=used,
            depth_scale_mm=self.depth_scale.value() or None,
            most_points=settings.most_points(),
        )

    def _take(self, asked: AskedScan, read: ReadScan) -> None:
        column = self.columns[self.column.currentIndex()]
        if not is_there(column):
            raise ScanError(translate("AADM_Import", "The column is not there any more: choose another."))
        with undo_step(self.document, translate("AADM_Import", "Import scan")):
            up = self.up.currentText().strip() or None
            cloud = take_scan(column, asked, read, up=up)
        said = translate("AADM_Import", "{file}: {count} points, imported to {column}")
        tell(said.format(file=asked.file.name, count=cloud.PointCount, column=column.Label))
        close_panel(self)
        select([column])
        FreeCADGui.SendMsgToActiveView("ViewFit")


def open_panel(document: Any, files: Sequence[Path] = (), column: Any = None) -> ImportPanel:
    """Show the panel, for some column of a document."""
    panel = ImportPanel(document, files, column)
    show_panel(panel)
    return panel
