"""The way in for macros and FreeCAD's Python console; works with and without a window.

Examples
--------
A column that is described in numbers, its two scans, its verdict:

>>> import FreeCAD
>>> from aadm_workbench.document import api
>>> document = FreeCAD.newDocument("yard")
>>> ring = [[x, y] for x in (-90, -30, 30, 90) for y in (-90, -30, 30, 90) if max(abs(x), abs(y)) == 90]
>>> column = api.describe(document, "L-1", {"centres": ring, "sleeve_diameter": 26.0, "rebar_diameter": 18.0,
...                       "embedded_length": 100.0, "size": [250.0, 250.0]})
>>> api.add_scan(column, "samples/lab/scans/L-1-foot.ply", "sleeves", up="+y")  # doctest: +SKIP
>>> api.add_scan(column, "samples/lab/scans/L-1-bars.pcd", "rebars", up="+y")  # doctest: +SKIP
>>> api.check(column).Verdict  # doctest: +SKIP
'pass'

A floor that was checked overnight, on the model that is open:

>>> api.show(FreeCAD.ActiveDocument, "floor3-report/report.json")  # doctest: +SKIP
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from aadm_workbench.document.checking import check_work, keep
from aadm_workbench.document.column import column_design, make_column, set_design
from aadm_workbench.document.groups import columns_in
from aadm_workbench.document.private_process import run
from aadm_workbench.document.report.annotate import show_report, write_fcstd
from aadm_workbench.document.report.file import load_report
from aadm_workbench.document.report.of_document import report_of
from aadm_workbench.document.result import found_of
from aadm_workbench.document.sampling import columns_work, file_work, take_columns
from aadm_workbench.document.scan_reading import AskedScan, take_scan
from aadm_workbench.model import Camera

__all__ = [
    "add_scan",
    "check",
    "column_design",
    "columns_in",
    "describe",
    "found_of",
    "report_of",
    "sample",
    "set_design",
    "show",
    "write_fcstd",
]


def sample(document: Any, objects: Any = None, *, file: str | Path | None = None) -> list[Any]:
    """Find columns with their sleeves and rebars in a document's model, and make a column object of each.

    Parameters
    ----------
    objects
        Only these columns of the model; all of them by default.
    file
        Take the columns of this IFC file instead.

    Raises
    ------
    DesignError
        Where an object has no body.
    AadmError
        Where there is no column; says what was looked at.
    NoEnvironmentError
        Where the private environment is not installed.
    """
    if file is not None:
        return take_columns(document, run(file_work(Path(file))), file=Path(file))
    return take_columns(document, run(columns_work(document, objects)), objects=objects)


def describe(document: Any, name: str, design: Mapping[str, Any]) -> Any:
    """Make a column whose design is given in numbers, as in ``[columns.design]`` of a job file.

    Parameters
    ----------
    design
        ``centres`` [[x, y], ...], ``sleeve_diameter``, ``rebar_diameter``, ``embedded_length``, ``size``; mm.

    Raises
    ------
    DesignError
        Where a value is missing or cannot be.
    """
    from aadm_workbench.design.recognise.pattern import inline_design

    return make_column(document, inline_design(name, design))


def add_scan(
    column: Any,
    file: str | Path,
    kind: str,
    *,
    units: str = "mm",
    camera: Camera | str | Path | None = None,
    depth_scale_mm: float | None = None,
    up: str | None = None,
    most_points: int = 60_000,
) -> Any:
    """Add a scan to a column.

    Parameters
    ----------
    kind
        ``sleeves`` or ``rebars``.
    camera
        Intrinsics, or the file that holds them; depth maps need them.
    up
        Side of the column at the top of the picture: ``+x``, ``-x``, ``+y``, ``-y``; unchanged by default.
    most_points
        The view shows no more; the check uses all.

    Raises
    ------
    AadmError
        Where the file is no scan of this column.
    """
    known = str(Path(camera).resolve()) if isinstance(camera, str | Path) else camera
    asked = AskedScan(kind, Path(file), units, known, depth_scale_mm, most_points)
    return take_scan(column, asked, run(asked.work()), up=up)


def check(column: Any) -> Any:
    """Check a column from its scans, and keep the result in its document; returns the result object.

    Raises
    ------
    AadmError
        Where it cannot be checked; the message says what to do.
    """
    return keep(column, run(check_work(column)))


def show(document: Any, report: str | Path | Mapping[str, Any]) -> list[Any]:
    """Show a batch's results on the columns of a document; returns the column objects.

    Parameters
    ----------
    report
        A report.json, or its content.

    Raises
    ------
    ReportError
        Where it is none.
    """
    content = report if isinstance(report, Mapping) else load_report(Path(report))
    return show_report(document, content)
