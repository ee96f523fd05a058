"""FreeCAD's import hook for report.json: a batch's results on the columns of the model that is open."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.report.annotate import show_report
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError

translate = FreeCAD.Qt.translate


def open(file: str) -> Any:  # noqa: A001 - the name that FreeCAD calls
    """Show a report in a new document."""
    return insert(file, FreeCAD.newDocument(Path(file).stem).Name)


def insert(file: str, docname: str) -> Any:
    """Show a report on the columns of a document, in one undo step; what is wrong is said in the report view."""
    try:
        document = FreeCAD.getDocument(docname)
    except NameError:
        document = FreeCAD.newDocument(docname)
    try:
        with undo_step(document, translate("AADM", "AADM report")):
            columns = show_report(document, load_report(Path(file)))
    except AadmError as error:
        complain(str(error))
    else:
        said = translate("AADM", "{count} columns of {file} are shown")
        tell(said.format(count=len(columns), file=Path(file).name))
    return document
