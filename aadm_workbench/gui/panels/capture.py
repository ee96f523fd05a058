"""The panel in which a live camera takes a scan: which camera, of what, and where the capture is kept."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.private_process import Work
from aadm_workbench.document.scan_cloud import KINDS
from aadm_workbench.document.scan_reading import AskedScan, take_scan
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import CaptureError, ScanError
from aadm_workbench.gui import settings
from aadm_workbench.gui.chosen import select
from aadm_workbench.gui.language import in_language
from aadm_workbench.gui.panels.file_line import FileLine
from aadm_workbench.gui.panels.task_panel import WorkingPanel, is_there, show_panel
from aadm_workbench.gui.sentences import sentences
from aadm_workbench.private.answers import ReadScan

translate = FreeCAD.Qt.translate

ADDRESSES = ("gentl:FILE.cti#SERIAL", "gige://IP", "mecheye://IP", "replay:FOLDER")
_MM = "mm"  # what captures are written in, whatever the camera's own unit is


class CapturePanel(WorkingPanel):
    """Has the camera write a capture, then has that read, then puts it into the document in one undo step.

    It stays open: foot and bars are taken one after the other.
    """

    ICON = "capture"

    def __init__(self, document: Any, column: Any = None) -> None:
        super().__init__(translate("AADM_Capture", "Capture"), document)
        self.document = document
        self.columns = columns_in(document)
        self.column = QtGui.QComboBox()
        self.column.addItems([one.Label for one in self.columns])
        if column in self.columns:
            self.column.setCurrentIndex(self.columns.index(column))
        self.camera = QtGui.QLineEdit(settings.camera_address())
        self.camera.setPlaceholderText(ADDRESSES[1])
        self.camera.setToolTip("\n".join(ADDRESSES))
        self.kind = QtGui.QComboBox()
        self.kind.addItem(translate("AADM_Import", "sleeves (the foot)"), KINDS[0])
        self.kind.addItem(translate("AADM_Import", "rebars (the bars below)"), KINDS[1])
        self.folder = FileLine(translate("AADM_Capture", "Folder of the captures"), "", _folder_beside(document))
        form = QtGui.QFormLayout()
        for text, widget in (
            (translate("AADM_Import", "Column"), self.column),
            (translate("AADM_Import", "Camera"), self.camera),
            (translate("AADM_Import", "It shows"), self.kind),
            (translate("AADM_Capture", "Kept in"), self.folder),
        ):
            form.addRow(text, widget)
        self.layout.addLayout(form)
        self.add_start(translate("AADM_Capture", "Capture"))
        self.start_button.setDefault(True)
        self.layout.addStretch(1)

    def start(self) -> None:
        """Have the camera write a capture."""
        with sentences(self.title):
            address, folder, column = self.camera.text().strip(), self.folder.text(), self._column()
            if not address:
                raise CaptureError(
                    translate("AADM_Capture", "Name a camera: {forms}.").format(forms=", ".join(ADDRESSES))
                )
            if not folder:
                raise CaptureError(
                    translate("AADM_Capture", "Choose the folder that captures are kept in: they are the record.")
                )
            settings.remember_camera_address(address)
            kind = self.kind.currentData()
            capture = Path(folder).resolve() / _name_of(column.Label, kind)
            work = Work(("capture", address, "--out", str(capture), "--quiet"))
            self.have_done(work, lambda _: self._read(column, AskedScan(kind, capture, _MM)))

    def _column(self) -> Any:
        column = self.columns[self.column.currentIndex()] if self.columns else None
        if column is None or not is_there(column):
            raise ScanError(translate("AADM_Import", "The column is not there any more: choose another."))
        return column

    def _read(self, column: Any, asked: AskedScan) -> None:
        self.have_done(asked.work(), lambda read: self._take(column, asked, read))

    def _take(self, column: Any, asked: AskedScan, read: ReadScan) -> None:
        if not is_there(column):
            raise ScanError(translate("AADM_Import", "The column is not there any more: choose another."))
        with undo_step(self.document, translate("AADM_Capture", "Capture")):
            cloud = take_scan(column, asked, read)
        said = translate("AADM_Import", "{file}: {count} points, imported to {column}")
        said = said.format(file=asked.file.name, count=cloud.PointCount, column=column.Label)
        tell(said)
        self.step.setText("\n".join([said, *map(in_language, read["notes"])]))
        select([column])
        FreeCADGui.SendMsgToActiveView("ViewFit")


def _folder_beside(document: Any) -> str:
    """Where the captures of a document are kept: beside its file; empty until it has one."""
    return str(Path(document.FileName).parent / "captures") if document.FileName else ""


def _name_of(column: str, kind: str) -> str:
    """What a capture is called: by its column, what it shows and when; in the order of time for each of them."""
    safe = "".join(sign if sign.isalnum() or sign in "-_" else "_" for sign in column)
    return f"{safe}-{kind}-{datetime.now(UTC):%Y%m%dT%H%M%SZ}"


def open_panel(document: Any, column: Any = None) -> CapturePanel:
    """Show the panel, for some column of a document."""
    panel = CapturePanel(document, column)
    show_panel(panel)
    return panel
