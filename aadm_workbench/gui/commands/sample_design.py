"""The command Sample design: takes sleeves and rebars from the model."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.sampling import sample_columns, sample_ifc
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.chosen import model_objects, select
from aadm_workbench.gui.command import Command, has_document
from aadm_workbench.gui.sentences import WINDOW_NAME, sentences
from aadm_workbench.gui.settings import decision, method, tolerances

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class SampleDesign(Command):
    """Makes a column object of each selected column of the model, or of all where none is selected."""

    NAME = "AADM_SampleDesign"
    ICON = "sample-design"
    SHORTCUT = "A, D"
    TEXT = QT_TRANSLATE_NOOP("AADM_SampleDesign", "Sample design")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_SampleDesign",
        "Takes sleeves and rebars from the selected columns of the model, or from all columns where none is selected",
    )

    def IsActive(self) -> bool:
        """Where a document is open."""
        return has_document()

    def run(self) -> None:
        """Sample, and open the panel of the first column."""
        document = FreeCAD.ActiveDocument
        if document is None:
            raise AadmError(translate("AADM", "No document is open: open the model first."))
        if not document.Objects:
            _offer_ifc(document)
            return
        objects = model_objects() or None
        _sample(document, lambda: sample_columns(document, objects))


def _sample(document: Any, work: Callable[[], list[Any]]) -> None:
    """Sample in one undo step, and open the panel of the first column."""
    with undo_step(document, translate("AADM_SampleDesign", "Sample design")):
        columns = work()
        for column in columns:
            column.Method, column.Tolerances, column.Decision = method(), tolerances(), decision()
    tell(translate("AADM_SampleDesign", "{count} columns were sampled").format(count=len(columns)))
    select(columns[:1])
    from aadm_workbench.gui.panels.design import open_panel

    open_panel(columns[0])


def _offer_ifc(document: Any) -> None:
    """An empty document may take its columns from an IFC file; FreeCAD need not have imported it."""
    box = QtGui.QMessageBox(FreeCADGui.getMainWindow())
    box.setObjectName(WINDOW_NAME)
    box.setAttribute(QtCore.Qt.WA_DeleteOnClose)
    box.setWindowTitle(translate("AADM_SampleDesign", "Sample design"))
    said = translate(
        "AADM_SampleDesign",
        "The document is empty: open or import the model first, or take the columns of an IFC file.",
    )
    box.setText(said)
    complain(said)
    button = box.addButton(translate("AADM_SampleDesign", "IFC file…"), QtGui.QMessageBox.ActionRole)
    button.clicked.connect(lambda: _of_ifc_file(document))
    box.addButton(QtGui.QMessageBox.Close)
    box.open()


def _of_ifc_file(document: Any) -> None:
    title = translate("AADM_SampleDesign", "Take the columns of an IFC file")
    chosen, _ = QtGui.QFileDialog.getOpenFileName(FreeCADGui.getMainWindow(), title, "", "IFC (*.ifc)")
    if chosen:
        with sentences(title):
            _sample(document, lambda: sample_ifc(document, Path(chosen)))
