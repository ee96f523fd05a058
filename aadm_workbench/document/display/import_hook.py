"""What FreeCAD calls for files that it does not know: they are shown on a document, and what is wrong is said."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD

from aadm_workbench.document.display.messages import complain
from aadm_workbench.errors import AadmError


def import_hook(show: Callable[[Any, Path], None]) -> tuple[Callable[[str], Any], Callable[[str, str], Any]]:
    """``open`` and ``insert`` of a module that is registered as an import type: into a new document, into a named one.

    Parameters
    ----------
    show
        Shows a file on a document; its AadmError is said in the report view.
    """

    def insert(file: str, docname: str) -> Any:
        try:
            document = FreeCAD.getDocument(docname)
        except NameError:
            document = FreeCAD.newDocument(docname)
        try:
            show(document, Path(file))
        except AadmError as error:
            complain(error.reason)
        return document

    return lambda file: insert(file, FreeCAD.newDocument(Path(file).stem).Name), insert
