"""The ``[[columns]]`` of a job file, read."""

from __future__ import annotations

from dataclasses import replace

from aadm_workbench.design.recognise.pattern import inline_design
from aadm_workbench.errors import DesignError
from aadm_workbench.inspection.job import JobColumn
from aadm_workbench.model import ColumnDesign, ControlPoint, Vector3
from aadm_workbench.model.reports import LONGEST_ID
from aadm_workbench.scan.file import AXES

from .table import JobTable, near_corner, read_frames, up_deg

_SCANS = ("sleeves", "rebars", "hoisting", "sleeves_image", "rebars_image")
_COLUMN = ("id", *_SCANS, "up", "sleeves_up", "rebars_up", "axes", "near", "design", "control_points", "set_pose")
MOST_COLUMNS = 20_000
"""Ten shipments of the largest kind."""

_LENGTHS = ("embedded_length", "exposed_length")
_SIZES = ("sleeve_diameter", "rebar_diameter", "rebar_outer_diameter")
"""One length, or a list with one for each centre."""
_DESIGN = (*_LENGTHS, *_SIZES, "size", "centres")


def read_columns(top: JobTable, *, units: str, has_model: bool) -> tuple[JobColumn, ...]:
    """The columns of a job, in its order.

    Raises
    ------
    JobError
        For what is wrong with their text, two columns with one id, and a column without any design.
    """
    tables = top.tables("columns", "[[columns]]")
    if not tables:
        raise top.wrong("columns", "jobfile.no_columns")
    if len(tables) > MOST_COLUMNS:
        raise top.wrong("columns", "jobfile.many_columns", count=len(tables), most=MOST_COLUMNS)
    columns: list[JobColumn] = []
    known: dict[str, JobTable] = {}
    alike: dict[str, ColumnDesign] = {}
    for table in tables:
        column = _column(table, alike, units=units, has_model=has_model)
        earlier = known.setdefault(column.id, table)
        if earlier is not table:
            raise table.wrong("id", "jobfile.same_id", id=column.id, line=earlier.line("id"))
        columns.append(column)
    return tuple(columns)


def _column(table: JobTable, alike: dict[str, ColumnDesign], *, units: str, has_model: bool) -> JobColumn:
    table.allow(_COLUMN)
    table.require("id", 'id = "...", its Name, Tag, Mark, PieceMark or GlobalId in the model')
    name = table.text("id") or ""
    if len(name) > LONGEST_ID:
        raise table.wrong("id", "jobfile.long_id", count=len(name), most=LONGEST_ID)
    up = up_deg(table, "up")
    sleeves_up, rebars_up = up_deg(table, "sleeves_up"), up_deg(table, "rebars_up")
    hoisting, hoisting_near = read_frames(table)
    design = _design(table, name, alike)
    if design is None and not has_model:
        raise table.wrong(None, "jobfile.no_design", name=name)
    return JobColumn(
        id=name,
        sleeves=table.paths("sleeves"),
        rebars=table.paths("rebars"),
        hoisting=hoisting,
        hoisting_near=hoisting_near,
        sleeves_image=table.path("sleeves_image"),
        rebars_image=table.path("rebars_image"),
        sleeves_up_deg=up if sleeves_up is None else sleeves_up,
        rebars_up_deg=up if rebars_up is None else rebars_up,
        axes=table.one_of("axes", AXES, "") or None,
        near=near_corner(table),
        design=design,
        set_pose=_set_pose(table),
        control_points=_control_points(table, units=units, has_own_design=design is not None),
    )


def _set_pose(table: JobTable) -> Vector3 | None:
    if "set_pose" not in table.values:
        return None
    from .stack import read_set_pose

    return read_set_pose(table)


def _control_points(table: JobTable, *, units: str, has_own_design: bool) -> tuple[ControlPoint, ...]:
    if "control_points" not in table.values:
        return ()
    from .control import read_control_points

    return read_control_points(table, units=units, has_own_design=has_own_design)


def _design(column: JobTable, name: str, alike: dict[str, ColumnDesign]) -> ColumnDesign | None:
    """The design of a column as its table gives it; columns of one table share the points of the first of them."""
    table = column.table("design", "[columns.design]")
    if table is None:
        return None
    table.allow(_DESIGN)
    for key in _LENGTHS:
        table.length(key)
    table.numbers("size", 2)
    table.number_lists("centres", 2)
    for key in _SIZES:
        written = table.values.get(key)
        if isinstance(written, list):
            table.numbers(key, len(written))
        else:
            table.length(key)
    written_as = repr(table.values)
    if written_as in alike:
        return replace(alike[written_as], id=name, names=(name,))
    try:
        return alike.setdefault(written_as, inline_design(name, dict(table.values)))
    except DesignError as error:
        raise table.wrong(None, "said.sentences", parts=(error.reason,)) from error
