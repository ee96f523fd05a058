"""FreeCAD's import hook for scans: a file that is opened or imported becomes a scan of a column.

``FreeCAD.loadFile`` calls ``insert``, the command line ``open``. Without a window the document must have exactly one
column; whether a scan shows sleeves or rebars is taken from its name, and can be changed afterwards.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.asking import SCAN_PANELS
from aadm_workbench.document.display.import_hook import import_hook
from aadm_workbench.document.display.messages import tell
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.job.scan_names import guessed_kind
from aadm_workbench.document.private_process import run
from aadm_workbench.document.scan_cloud import KINDS
from aadm_workbench.document.scan_reading import AskedScan, take_scan
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import ScanError

translate = FreeCAD.Qt.translate


def _show(document: Any, file: Path) -> None:
    """In a panel; without a window as the one column's, in one undo step."""
    if SCAN_PANELS:
        SCAN_PANELS[0](document, [file])
        return
    column = _column_of(document)
    asked = AskedScan(guessed_kind(file.name) or KINDS[0], file)
    read = run(asked.work())
    with undo_step(document, translate("AADM_Import", "Import scan")):
        take_scan(column, asked, read)
    tell(translate("AADM", "{file} was added to {column}").format(file=file.name, column=column.Label))


open, insert = import_hook(_show)  # noqa: A001 - the names that FreeCAD calls


def _column_of(document: Any) -> Any:
    known = columns_in(document)
    if len(known) == 1:
        return known[0]
    raise ScanError(
        translate(
            "AADM",
            "{document} has {count} AADM columns, and a scan belongs to one: use Import scan with that column selected",
        ).format(document=document.Label, count=len(known))
    )
