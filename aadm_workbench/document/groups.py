"""The one folder of the tree that all columns of a document lie in."""

from __future__ import annotations

from typing import Any

import FreeCAD

_NAME = "AADM"


def put_into_group(obj: Any) -> None:
    """Put an object into the document's group of this workbench, which is made where there is none."""
    document = obj.Document
    group = next((one for one in document.Objects if _is_ours(one)), None)
    if group is None:
        group = document.addObject("App::DocumentObjectGroup", _NAME)
        group.Label = FreeCAD.Qt.translate("AADM", "AADM checks")
    group.addObject(obj)


def _is_ours(obj: Any) -> bool:
    return obj.TypeId == "App::DocumentObjectGroup" and obj.Name.rstrip("0123456789") == _NAME
