"""A batch's results in a FreeCAD document: on the columns of the model that is open, or in a file without a screen.

``freecadcmd -c "import sys, runpy; sys.argv[1:] = ['report.json', 'floor3-checked.FCStd', 'floor3.FCStd'];
runpy.run_module('aadm_workbench.document.report.annotate', run_name='__main__', alter_sys=True)" -M ADDON``
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import FreeCAD

import aadm_workbench.document.scan_cloud  # noqa: F401 - FreeCAD brings back proxies only of modules that are there
from aadm_workbench.document import gui_document
from aadm_workbench.document.column import Column, make_column
from aadm_workbench.document.display.reported_design import design_of_report
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.result import make_result
from aadm_workbench.errors import AadmError, ReportError

_GLOBAL_ID_PROPERTIES = ("GlobalId", "IfcGlobalId")


def show_report(document: Any, report: Mapping[str, Any], checked_at: str = "") -> list[Any]:
    """Put the results of a report.json onto the columns of a document.

    A column that the document already has gets its result; for others a column is made where the report places it, and
    linked to the object of the model that carries its GlobalId.

    Parameters
    ----------
    report
        The content of a report.json.
    checked_at
        When the check was made, in UTC, where that is known.

    Returns
    -------
    list
        The column objects, in the order of the report.

    Raises
    ------
    ReportError
        Where the report does not hold what it should.
    """
    known = {column.ColumnId: column for column in columns_in(document)}
    known |= {column.GlobalId: column for column in columns_in(document) if column.GlobalId}
    by_global_id = objects_by_global_id(document)
    shown = []
    for number, found in enumerate(report.get("columns") or (), start=1):
        try:
            column = known.get(found.get("global_id") or "") or known.get(found["id"])
            if column is None:
                model = by_global_id.get(found.get("global_id") or "")
                column = make_column(document, design_of_report(found), model)
            make_result(column, report, found, checked_at)
        except (AttributeError, KeyError, TypeError, ValueError, IndexError) as error:
            reason = f"{type(error).__name__}: {error}"
            raise ReportError.because("document.column_slip", number=number, why=reason) from error
        shown.append(column)
    if not shown:
        raise ReportError.because("document.empty_report")
    return shown


def write_fcstd(report: Mapping[str, Any], out: Path, model: Path | None = None) -> None:
    """Write a FreeCAD document with the results of a report.json, that opens visible and complete.

    Works with and without a screen; the model's own file is not touched unless it is ``out``.

    Parameters
    ----------
    out
        The .FCStd to write; it appears whole or not at all.
    model
        The .FCStd that the columns belong to; without one the document holds the columns alone.

    Raises
    ------
    AadmError
        Where the model cannot be opened or the file cannot be written.
    """
    document = _opened(model) if model is not None else FreeCAD.newDocument("AADM", out.stem, True)
    aside = out.with_name(f".{out.name}.{os.getpid()}.FCStd")
    try:
        show_report(document, report)
        document.recompute()
        try:
            document.saveCopy(str(aside))
            gui_document.complete(aside, model, document)
            aside.replace(out)
        except (OSError, RuntimeError, FreeCAD.Base.FreeCADError) as error:
            raise AadmError.about(out, "bounded.unwritten", why=error) from error
    finally:
        FreeCAD.closeDocument(document.Name)
        aside.unlink(missing_ok=True)


def answer(question: Mapping[str, Any]) -> str:
    """Write an annotated document for a process outside FreeCAD; what went wrong, or an empty text.

    Parameters
    ----------
    question
        ``report``, the text of a report.json; ``out`` and ``model``, paths, the latter None without one.
    """
    try:
        model = question.get("model")
        write_fcstd(json.loads(question["report"]), Path(question["out"]), Path(model) if model else None)
    except AadmError as error:
        return str(error)
    return ""


def _opened(path: Path) -> Any:
    if not path.is_file():
        raise AadmError.about(path, "document.no_document")
    try:
        return FreeCAD.openDocument(str(path), True)
    except (OSError, RuntimeError, ValueError, FreeCAD.Base.FreeCADError) as error:
        raise AadmError.about(path, "document.unopened", why=error) from error


def objects_by_global_id(document: Any) -> dict[str, Any]:
    """Objects of a model by the GlobalId that importers leave on them."""
    found = {}
    for obj in document.Objects:
        if getattr(getattr(obj, "Proxy", None), "Type", "") != Column.Type:
            for name in global_ids_of(obj):
                found.setdefault(name, obj)
    return found


def global_ids_of(obj: Any) -> list[str]:
    """GlobalIds of an object of a model: as a property, or among its IFC attributes."""
    names = [getattr(obj, name, "") for name in _GLOBAL_ID_PROPERTIES]
    written = getattr(obj, "IfcData", None)
    if isinstance(written, Mapping) and "attributes" in written:
        try:
            names.append(json.loads(written["attributes"]).get("GlobalId", ""))
        except (ValueError, AttributeError):
            return []
    return [name for name in names if isinstance(name, str) and name]


if __name__ == "__main__":
    try:
        write_fcstd(load_report(Path(sys.argv[1])), Path(sys.argv[2]), Path(sys.argv[3]) if len(sys.argv) > 3 else None)
    except AadmError as error:
        sys.stderr.write(f"{error}\n")
        raise SystemExit(2) from error
    # FreeCAD takes plain words of its command line for files to open, unless the script ends the program.
    raise SystemExit(0)
