"""The IFC file behind a document: the one that its columns were taken from, or that FreeCAD says it shows."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from aadm_workbench.document.groups import columns_in

_SUFFIX = ".ifc"
_PROPERTIES = ("IfcFilePath", "FilePath")
"""Where FreeCAD 1.0 and later write it, on the document or on its project, and where others do."""


def ifc_file_of(document: Any) -> Path | None:
    """The file, where it is to be found; a model that was moved together with its document is."""
    written = [column.ModelFile for column in columns_in(document)]
    written += [getattr(holder, name, "") for holder in (document, *document.Objects) for name in _PROPERTIES]
    written += [str(Path(document.FileName).with_suffix(_SUFFIX))] if document.FileName else []
    for path in dict.fromkeys(one for one in written if isinstance(one, str) and one.lower().endswith(_SUFFIX)):
        beside = Path(document.FileName).parent / Path(path).name if document.FileName else Path(path)
        for found in (Path(path), beside):
            if found.is_file():
                return found
    return None


def native_file_of(document: Any) -> Path | None:
    """The file of a document that FreeCAD shows natively: what it has loaded may be a part of it; None of any other."""
    if not any(getattr(holder, "IfcFilePath", "") for holder in (document, *document.Objects)):
        return None
    return ifc_file_of(document)
