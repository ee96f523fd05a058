"""The ``[[columns.control_points]]`` of a job: points known in the building and measured in the scan of the rebars."""

from __future__ import annotations

from aadm_workbench.model import ControlPoint, Vector3
from aadm_workbench.scan.read import MM_PER_UNIT

from .table import JobTable

_KEYS = ("name", "model", "column", "scan", "u_mm")
_FEWEST = 2  # one point gives a place and no turn


def read_control_points(column: JobTable, *, units: str, has_own_design: bool) -> tuple[ControlPoint, ...]:
    """The control points of one column, in the order of the job.

    Parameters
    ----------
    units
        Of the job's scans: ``scan`` of a control point is in the unit of the scan that it was picked from.
    has_own_design
        Whether the column brings its design along; then there is no model frame.

    Raises
    ------
    JobError
        For what is wrong with their text, two points with one name, a single point, and points without a scan.
    """
    tables = column.tables("control_points", "[[columns.control_points]]")
    if not tables:
        return ()
    if not column.values.get("rebars"):
        raise column.wrong("control_points", "jobfile.control_scan")
    if len(tables) < _FEWEST:
        raise column.wrong("control_points", "jobfile.one_control_point")
    points: list[ControlPoint] = []
    for table in tables:
        point = _control_point(table, MM_PER_UNIT[units], has_own_design)
        if any(other.name == point.name for other in points):
            raise table.wrong("name", "jobfile.control_twice", name=point.name)
        points.append(point)
    return tuple(points)


def _control_point(table: JobTable, mm_per_unit: float, has_own_design: bool) -> ControlPoint:
    table.allow(_KEYS)
    table.require("name", 'name = "G1"')
    table.require("scan", "scan = [x, y, z], in the frame and the unit of the scan of the rebars")
    name, in_model = table.text("name") or "", "model" in table.values
    if in_model == ("column" in table.values):
        raise table.wrong(None, "jobfile.control_where", name=name)
    if in_model and has_own_design:
        raise table.wrong("model", "jobfile.control_no_model", name=name)
    known = _vector(table, "model" if in_model else "column", 1.0)
    return ControlPoint(name, known, _vector(table, "scan", mm_per_unit), in_model, table.length("u_mm"))


def _vector(table: JobTable, key: str, factor: float) -> Vector3:
    x, y, z = (factor * value for value in table.numbers(key, 3))
    return x, y, z
