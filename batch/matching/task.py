"""The points of one column of a job, measured once, to be tried with those of all others."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from aadm_workbench.errors import DesignError
from aadm_workbench.inspection.check import Measured, measure_column
from aadm_workbench.inspection.column import attempt, read_scans
from aadm_workbench.inspection.tasks import ColumnTask
from aadm_workbench.model import ColumnDesign, Kind, ShipmentProblem, Verdict


@dataclass(frozen=True, eq=False)
class MeasuredColumn:
    """What was measured of a column: its foot, the bars of its position, each None where there is none.

    ``problems`` says what could not be measured; ``where`` an error that nobody foresaw came from.
    """

    id: str
    design: ColumnDesign | None
    sleeves: Measured | None = None
    rebars: Measured | None = None
    problems: tuple[ShipmentProblem, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)
    where: str = ""


def measure_task(task: ColumnTask) -> MeasuredColumn:
    """Read a column's scans and measure what they show; a scan that is broken costs itself alone."""
    measured: dict[Kind, Measured] = {}
    problems: list[ShipmentProblem] = []
    seconds: dict[str, float] = {}
    where = ""
    for kind in _scanned(task):
        alone, found = _task_of(task, kind), None
        with attempt(alone) as (outcome, watch):
            if alone.design is None:
                raise DesignError(alone.no_design)
            with watch.stage("read"):
                scans = read_scans(alone, alone.design)
            found = measure_column(alone.design, scans, alone.settings, watch.stage)[kind]
        for stage, value in outcome.seconds.items():
            seconds[stage] = round(seconds.get(stage, 0.0) + value, 4)
        where = where or outcome.where
        if found is None:
            problems.append(ShipmentProblem(task.column.id, kind.plural, Verdict.ERROR, outcome.report.reasons))
        elif not found.match:
            reason = f"{kind.plural}: {found.match.reason}"
            problems.append(ShipmentProblem(task.column.id, kind.plural, Verdict.NOT_MEASURED, (reason,)))
        else:
            measured[kind] = found
    sleeves, rebars = measured.get(Kind.SLEEVE), measured.get(Kind.REBAR)
    return MeasuredColumn(task.column.id, task.design, sleeves, rebars, tuple(problems), seconds, where)


def lost_measurement(task: ColumnTask, reason: str) -> MeasuredColumn:
    """The outcome for a column whose process was killed."""
    problem = ShipmentProblem(task.column.id, "column", Verdict.ERROR, (reason,))
    return MeasuredColumn(task.column.id, task.design, problems=(problem,))


def _scanned(task: ColumnTask) -> tuple[Kind, ...]:
    names = {Kind.SLEEVE: task.column.sleeves, Kind.REBAR: task.column.rebars}
    return tuple(kind for kind in Kind if names[kind])


def _task_of(task: ColumnTask, kind: Kind) -> ColumnTask:
    """The part of a task that is about one kind of point."""
    column = task.column
    alone = replace(column, rebars=(), control_points=()) if kind is Kind.SLEEVE else replace(column, sleeves=())
    return replace(task, column=alone)
