"""FreeCAD's import hook for scans: a file that is opened or imported becomes a scan of a column.

``FreeCAD.loadFile`` calls :func:`insert`, the command line :func:`open`. Without a window the document must
have exactly one column.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.asking import SCAN_PANELS
from aadm_workbench.document.display.messages import complain, tell
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.job.scan_names import guessed_kind
from aadm_workbench.document.private_process import run
from aadm_workbench.document.scan_cloud import KINDS
from aadm_workbench.document.scan_reading import AskedScan, take_scan
from aadm_workbench.document.undo_step import undo_step
from aadm_workbench.errors import AadmError, ScanError

translate = FreeCAD.Qt.translate


def open(file: str) -> Any:  # noqa: A001 - the name that FreeCAD calls
    """Open a scan in a new document."""
    document = FreeCAD.newDocument(Path(file).stem)
    return insert(file, document.Name)


def insert(file: str, docname: str) -> Any:
    """Add a scan to a document; what is wrong with it is said in the report view.

    Whether it shows sleeves or rebars is taken from its name, and can be changed afterwards.
    """
    try:
        document = FreeCAD.getDocument(docname)
    except NameError:
        document = FreeCAD.newDocument(docname)
    if SCAN_PANELS:
        SCAN_PANELS[0](document, [Path(file)])
        return document
    try:
        column = _column_of(document)
        asked = AskedScan(guessed_kind(Path(file).name) or KINDS[0], Path(file))
        read = run(asked.work())
        with undo_step(document, translate("AADM_Import", "Import scan")):
            take_scan(column, asked, read)
    except AadmError as error:
        complain(str(error))
    else:
        tell(translate("AADM", "{file} was added to {column}").format(file=Path(file).name, column=column.Label))
    return document


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
