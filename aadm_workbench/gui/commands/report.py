"""The command Report: files for people from the results of a document."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.document.report.of_document import report_of
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.command import Command
from aadm_workbench.gui.commands.write_results import has_results

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class Report(Command):
    """Opens the panel that says which reports are written, and where."""

    NAME = "AADM_Report"
    ICON = "report"
    SHORTCUT = "A, R"
    TEXT = QT_TRANSLATE_NOOP("AADM_Report", "Report…")
    TOOLTIP = QT_TRANSLATE_NOOP("AADM_Report", "Writes report.json, and from it reports for people, of all results")

    def IsActive(self) -> bool:
        """Where a column has a result."""
        return has_results()

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.report import open_panel

        if FreeCAD.ActiveDocument is None:
            raise AadmError(translate("AADM", "No document is open: open the model first."))
        open_panel(report_of(FreeCAD.ActiveDocument), FreeCAD.ActiveDocument)
