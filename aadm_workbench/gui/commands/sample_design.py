"""The command Sample design: takes sleeves and rebars from the model."""

from __future__ import annotations

from typing import Any

import FreeCAD

from aadm_workbench.errors import DesignError
from aadm_workbench.gui.chosen import model_objects
from aadm_workbench.gui.command import Command
from aadm_workbench.gui.panels.sampling import of_ifc_file, sample
from aadm_workbench.gui.sentences import show_error

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

    def run(self) -> None:
        """Sample, and open the panel of the first column."""
        document = FreeCAD.ActiveDocument
        if document is None or not document.Objects:
            _offer_ifc(document)
            return
        sample(document, model_objects() or None)


def _offer_ifc(document: Any) -> None:
    """An empty document may take its columns from an IFC file; FreeCAD need not have imported it."""
    said = translate(
        "AADM_SampleDesign",
        "There is no model yet: open or import one first, or take the columns of an IFC file.",
    )
    show_error(translate("AADM_SampleDesign", "Sample design"), DesignError(said), of_ifc_file(document))
