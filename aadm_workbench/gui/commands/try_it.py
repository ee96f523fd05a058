"""The command Try it: the sample floor at one click, checked, with a column that fails."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.private_process import command
from aadm_workbench.errors import AadmError
from aadm_workbench.gui.command import Command
from aadm_workbench.private.pins import ROOT

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_FLOOR = ROOT / "samples" / "floor"


class TryIt(Command):
    """Opens a new document with the sample floor, and checks it; no file of the user is touched."""

    NAME = "AADM_TryIt"
    ICON = "try-it"
    TEXT = QT_TRANSLATE_NOOP("AADM_TryIt", "Try it")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "AADM_TryIt", "Opens a floor of eight sample columns, checks their synthetic scans, and shows which ones fail"
    )

    def run(self) -> None:
        """Open the sample's job: the columns of its model, their scans; then check it."""
        from aadm_workbench.gui.panels.check_all import open_job

        if not (_FLOOR / "job.toml").is_file():
            raise AadmError(
                translate("AADM_TryIt", "{folder}: the samples are not there; install the addon as a clone").format(
                    folder=_FLOOR
                )
            )
        command([])  # before a document is opened: what is missing is offered first
        # A copy of all of it, so that neither the job nor its results lie in the addon.
        folder = Path(tempfile.mkdtemp(prefix="aadm-sample-")) / _FLOOR.name
        shutil.copytree(_FLOOR, folder)
        open_job(FreeCAD.newDocument("AADM_sample_floor"), folder / "job.toml", _check)


def _check(panel: Any) -> None:
    panel.after = _show_worst
    panel.start()


def _show_worst(columns: list[Any]) -> None:
    """Open the result of the first column that fails."""
    from aadm_workbench.gui.chosen import select
    from aadm_workbench.gui.panels.check import open_panel

    failing = next((column for column in columns if column.Result.GoesOn == "fail"), columns[0])
    select([failing])
    open_panel(failing)
