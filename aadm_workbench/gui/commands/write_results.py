"""The command Write results to model: onto the model's objects, and into its IFC file."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.report.of_document import report_of
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.command import Command

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class WriteResults(Command):
    """Opens the panel that says where results are written to."""

    NAME = "AADM_WriteResults"
    ICON = "write-results"
    SHORTCUT = "A, W"
    TEXT = QT_TRANSLATE_NOOP("AADM_WriteResults", "Write results to model…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_WriteResults", "Writes the results onto the objects of the model, and into its IFC file"
    )

    def IsActive(self) -> bool:
        """Where a column has a result."""
        return has_results()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.write import open_panel

        if FreeCAD.ActiveDocument is None:
            raise AadmError(translate("AADM", "No document is open: open the model first."))
        report_of(FreeCAD.ActiveDocument)
        open_panel(FreeCAD.ActiveDocument)


def has_results() -> bool:
    """Whether a column of the document in front has a result."""
    document = FreeCAD.ActiveDocument
    return document is not None and any(column.Result is not None for column in columns_in(document))
