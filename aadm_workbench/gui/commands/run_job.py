"""The command Run job: checks a whole floor beside the window, and shows the results on its columns."""

from __future__ import annotations

import FreeCAD

from aadm_workbench.gui.command import Command

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class RunJob(Command):
    """Opens the panel in which a job is run."""

    NAME = "AADM_RunJob"
    ICON = "run-job"
    SHORTCUT = "A, J"
    TEXT = QT_TRANSLATE_NOOP("AADM_RunJob", "Run job…")
    TOOLTIP = QT_TRANSLATE_NOOP("AADM_RunJob", "Checks all columns of a job file, and shows the results on the columns")

    def run(self) -> None:
        """Open the panel."""
        from aadm_workbench.gui.panels.job import open_panel

        open_panel()
