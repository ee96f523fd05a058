"""FreeCAD's import hook for report.json: a batch's results on the columns of the model that is open."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.display.import_hook import import_hook
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.report.annotate import show_report
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.undo_step import undo_step

translate = FreeCAD.Qt.translate


def _show(document: Any, file: Path) -> None:
    """In one undo step."""
    with undo_step(document, translate("AADM", "AADM report")):
        columns = show_report(document, load_report(file))
    tell(translate("AADM", "{count} columns of {file} are shown").format(count=len(columns), file=file.name))


open, insert = import_hook(_show)  # noqa: A001 - the names that FreeCAD calls
