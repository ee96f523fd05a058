"""The ``[stack]`` of a job: what setting adds that no scan tells."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping

from aadm_workbench.errors import JobError
from aadm_workbench.model import StackSettings, Vector3

from .table import JobTable, Lines

_LENGTHS = ("plumb_u_mm", "fit_u_mm", "bars_u_mm", "level_u_mm")
LARGEST_SET_POSE = 20.0
"""Of each of its three numbers, mm or degrees: sleeves have 5 to 20 mm of room, and what is more is a slip."""

STACK = (*_LENGTHS, "braced", "height_mm")


def read_stack(top: JobTable) -> StackSettings | None:
    """The settings of a job, the usual ones where its table leaves them out; None where it has no such table.

    Raises
    ------
    JobError
        For keys that are not known and values that are none.
    """
    table = top.table("stack", "[stack]")
    if table is None:
        return None
    usual = StackSettings()
    table.allow(STACK)
    lengths = {key: table.length(key) for key in _LENGTHS}
    return StackSettings(
        **{key: getattr(usual, key) if value is None else value for key, value in lengths.items()},
        braced=table.flag("braced", usual.braced),
        height_mm=table.length("height_mm"),
    )


def read_set_pose(column: JobTable) -> Vector3 | None:
    """The pose of a column's play at which the crane is to set it: dx, dy mm and yaw degrees; None without one."""
    pose = column.numbers("set_pose", 3)
    if not pose:
        return None
    if max(abs(value) for value in pose) > LARGEST_SET_POSE:
        raise column.wrong("set_pose", "jobfile.set_pose", most=LARGEST_SET_POSE)
    dx, dy, yaw_deg = pose
    return dx, dy, yaw_deg


def carried_settings(job: Mapping[str, str]) -> StackSettings | None:
    """The settings that a report carries; None where its job had none.

    Raises
    ------
    JobError
        Where somebody has changed them to what is none.
    """
    if not (text := job.get("stack")):
        return None
    source = f"report.json of {job.get('name', 'a job')}, job.stack"
    try:
        values = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        from aadm_workbench.bounded import toml_fault

        raise JobError.because("jobfile.report_no_toml", file=source, error=toml_fault(error)) from error
    return read_stack(JobTable({"stack": values}, (), "the job", source, Lines("")))
