"""The check as a process: an inspection task, the state of the approval and a link to the report, for each column."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from typing import Any
from urllib.parse import quote

from aadm_workbench.model import ColumnReport, JobReport
from aadm_workbench.report.ifc.addition import Addition, label, readable

_STATUS = {"pass": "Requested", "fail": "Not Approved"}
"""A measurement asks for the engineer's approval of what passes; it never gives it."""

_UNDECIDED = "Not Approved"
_LEVEL = "Column, before hoisting"
_NAME = "AADM column check"


def add_records(addition: Addition, report: JobReport, column: ColumnReport, element: Any) -> None:
    """An inspection task that was carried out on a column, and its approval.

    IFC2X3 cannot hold an approval without a date: there it is left out where the capture has none.
    """
    said = "; ".join(column.reasons) or "passes"
    task = _task(addition, column, element, said)
    key = (element.GlobalId,)
    addition.rooted("IfcRelAssignsToProcess", key, _NAME, RelatedObjects=[element], RelatingProcess=task)
    if not addition.is_2x3:
        project = addition.file.by_type("IfcProject")[0]
        addition.rooted("IfcRelDeclares", key, _NAME, RelatingContext=project, RelatedDefinitions=[task])
    approval = _approval(addition, report, column, said)
    if approval is not None:
        addition.rooted("IfcRelAssociatesApproval", key, _NAME, RelatedObjects=[element], RelatingApproval=approval)


def add_report_link(addition: Addition, location: str, elements: Sequence[Any]) -> None:
    """A reference to the report; ``location`` is a path relative to the model, or a URI."""
    uri = location if "://" in location else quote(location.replace("\\", "/"), safe="/#:")
    name = {"ItemReference" if addition.is_2x3 else "Identification": "AADM report"}
    reference = addition.new("IfcDocumentReference", Location=label(uri), Name=_NAME, **name)
    addition.rooted(
        "IfcRelAssociatesDocument", ("report",), _NAME, RelatedObjects=list(elements), RelatingDocument=reference
    )


def _task(addition: Addition, column: ColumnReport, element: Any, said: str) -> Any:
    identifier = label(f"AADM {column.id}")
    if addition.is_2x3:
        attributes = {"TaskId": identifier}
        described = said
    else:
        kind = "INSPECTION" if addition.is_4x3 else "USERDEFINED"
        attributes = {"Identification": identifier, "LongDescription": readable(said), "PredefinedType": kind}
        described = f"Sleeves and connecting rebars of column {column.id}"
    return addition.rooted(
        "IfcTask",
        (element.GlobalId,),
        f"{_NAME} {column.id}",
        Description=readable(described),
        ObjectType="INSPECTION",
        Status="COMPLETED",
        IsMilestone=False,
        **attributes,
    )


def _approval(addition: Addition, report: JobReport, column: ColumnReport, said: str) -> Any:
    day = _day(report)
    status = _STATUS.get(column.verdict, _UNDECIDED)
    identifier, name = label(f"AADM {column.id}"), label(f"Hoisting of column {column.id}")
    if not addition.is_2x3:
        return addition.new(
            "IfcApproval",
            Identifier=identifier,
            Name=name,
            Description=readable(said),
            TimeOfApproval=f"{day.isoformat()}T00:00:00" if day else None,
            Status=status,
            Level=_LEVEL,
            Qualifier=label(f"measured: {column.verdict.replace('_', ' ')}"),
        )
    if day is None:
        return None
    date = addition.new("IfcCalendarDate", DayComponent=day.day, MonthComponent=day.month, YearComponent=day.year)
    return addition.new(
        "IfcApproval",
        Identifier=identifier,
        Name=name,
        Description=readable(said),
        ApprovalDateTime=date,
        ApprovalStatus=status,
        ApprovalLevel=_LEVEL,
        ApprovalQualifier=label(f"measured: {column.verdict.replace('_', ' ')}"),
    )


def _day(report: JobReport) -> datetime.date | None:
    try:
        return datetime.date.fromisoformat(report.capture.get("date", "")[:10])
    except ValueError:
        return None
