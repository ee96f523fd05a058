"""Results as properties of the model's own objects, where schedules, filters and exports of FreeCAD find them."""

from __future__ import annotations

from typing import Any

import FreeCAD

from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.properties import READ_ONLY, Property, apply_properties

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP
_COPIED = (
    ("Verdict", "App::PropertyString"),
    ("GoesOn", "App::PropertyString"),
    ("Reasons", "App::PropertyStringList"),
    ("LargestSleeveDeviation", "App::PropertyDistance"),
    ("LargestRebarDeviation", "App::PropertyDistance"),
    ("LargestPairDistance", "App::PropertyDistance"),
    ("CheckedAt", "App::PropertyString"),
    ("Tool", "App::PropertyString"),
)
_TEXT = QT_TRANSLATE_NOOP("App::Property", "From the column's check by AADM")


def write_onto_model(document: Any) -> int:
    """Write the result of each column onto the object of the model that it is; returns how many were written.

    Writing twice leaves what writing once does.
    """
    count = 0
    for column in columns_in(document):
        if column.Model is None or column.Result is None:
            continue
        properties = [Property(kind, f"AADM_{name}", "AADM", _TEXT, mode=READ_ONLY) for name, kind in _COPIED]
        apply_properties(column.Model, properties)
        for name, _ in _COPIED:
            value = getattr(column.Result, name)
            if getattr(column.Model, f"AADM_{name}") != value:
                setattr(column.Model, f"AADM_{name}", value)
        count += 1
    return count
