"""Which objects of a document are columns, and the one folder of the tree that they lie in."""

from __future__ import annotations

from typing import Any

import FreeCAD

_NAME = "AADM"
COLUMN_TYPE = "AADM::Column"
"""What the proxy of a column calls itself; it is written into no file."""


def put_into_group(obj: Any) -> None:
    """Put an object into the document's group of this workbench, which is made where there is none."""
    document = obj.Document
    group = next((one for one in document.Objects if _is_ours(one)), None)
    if group is None:
        group = document.addObject("App::DocumentObjectGroup", _NAME)
        group.Label = FreeCAD.Qt.translate("AADM", "AADM checks")
    group.addObject(obj)


def columns_in(document: Any) -> list[Any]:
    """All columns of this workbench in a document, in its order."""
    # Asked for often, and a model has many objects: FreeCAD itself leaves out those of other types.
    return [obj for obj in document.findObjects("App::GeometryPython") if is_column(obj)]


def is_column(obj: Any) -> bool:
    """Whether an object is a column of this workbench."""
    return getattr(getattr(obj, "Proxy", None), "Type", "") == COLUMN_TYPE


def owner_of(part: Any) -> Any:
    """The column that an object is, or that a scan or a result belongs to; None for anything else."""
    if is_column(part):
        return part
    return next((parent for parent in getattr(part, "InList", ()) if is_column(parent)), None)


def _is_ours(obj: Any) -> bool:
    return obj.TypeId == "App::DocumentObjectGroup" and obj.Name.rstrip("0123456789") == _NAME
