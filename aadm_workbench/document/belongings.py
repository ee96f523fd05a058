"""What belongs to a column goes with it, and a copy of a column is known as one: in every way that FreeCAD has."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import FreeCAD

from aadm_workbench.design.design_text import read_design, write_design
from aadm_workbench.document.groups import columns_in, is_column, put_into_group
from aadm_workbench.errors import DesignError

translate = FreeCAD.Qt.translate


class _Belongings:
    """FreeCAD tells it of objects that are deleted: a group with its content, a column alone, by hand or by a macro."""

    def slotDeletedObject(self, obj: Any) -> None:
        """Scans and result go with their column, in the same undo step; undoing brings back what it took itself."""
        if not is_column(obj) or obj.Document.Transacting:
            return
        for part in (*obj.Scans, obj.Result):
            if part is not None and _is_alone(part, obj):
                part.Document.removeObject(part.Name)


_KEPT: list[_Belongings] = []


def watch_belongings() -> None:
    """Begin to watch; once is enough."""
    if not _KEPT:
        _KEPT.append(_Belongings())
        FreeCAD.addDocumentObserver(_KEPT[0])


def own_up(column: Any) -> None:
    """Make a column that was copied, or merged in from another document, a column of its own.

    Objects keep their names for life and copies get others: so a column that bears another than that which it was made
    under is a copy. It is no object of the model, so it loses the GlobalId; scans that were not copied with it stay
    with the first.
    """
    if not column.MadeAs:
        column.MadeAs = column.Name  # a document of an earlier version
    if column.MadeAs == column.Name:
        return
    column.MadeAs = column.Name
    column.ColumnId = _free_id(column)
    column.Label = f"AADM {column.ColumnId}"
    column.Model, column.GlobalId = None, ""
    try:
        design = read_design(column.Design, column.Label)
        column.Design = write_design(replace(design, id=column.ColumnId, global_id=None, names=(column.ColumnId,)))
    except DesignError:
        pass  # one without a design stays without
    column.Scans = [cloud for cloud in column.Scans if _is_alone(cloud, column)]
    if column.Result is not None and not _is_alone(column.Result, column):
        column.Result = None
    elif column.Result is not None and column.Result.Report:
        found = {**json.loads(column.Result.Report), "id": column.ColumnId, "global_id": None}
        column.Result.Report = json.dumps(found, ensure_ascii=False, separators=(",", ":"))
        column.Result.Label = f"{column.ColumnId}: {column.Result.Label.rpartition(': ')[2]}"
    put_into_group(column)


def _free_id(column: Any) -> str:
    known = {other.ColumnId for other in columns_in(column.Document) if other.Name != column.Name}
    if column.ColumnId not in known:
        return str(column.ColumnId)  # merged in from another document
    called = translate("AADM", "{column} (copy)").format(column=column.ColumnId)
    names = (called if number == 1 else f"{called} {number}" for number in range(1, len(known) + 2))
    return next(name for name in names if name not in known)


def _is_alone(part: Any, column: Any) -> bool:
    return all(parent.Name == column.Name for parent in part.InList if is_column(parent))
