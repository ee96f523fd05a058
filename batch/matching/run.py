"""The matcher: which column of a job's shipment goes on which bars. Every scan is read and measured once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from aadm_workbench.assembly.matching.assign import best_assignment
from aadm_workbench.assembly.trial.shipment import interchangeable, joined_design, try_margin
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.errors import DesignError, JobError
from aadm_workbench.inspection.column import attempt, read_scans
from aadm_workbench.inspection.job import Job
from aadm_workbench.inspection.measure import CheckSettings, Measured, measure_column
from aadm_workbench.inspection.tasks import ColumnTask, Stopwatch, job_entry, plan_job, tool_entry
from aadm_workbench.model import ColumnDesign, Kind, Verdict
from aadm_workbench.model.across import Assignment, FitCell, ShipmentGroup, ShipmentProblem, ShipmentReport

from ..job.inputs import read_for_shipping
from ..runner.engine import Unwatched, work_through
from ..runner.pools import opened_pool
from ..runner.run import RunOptions


@dataclass(frozen=True, eq=False)
class MatchRun:
    """The outcome of a match; ``seconds`` and ``traces`` as of a :class:`~.run.JobRun`."""

    report: ShipmentReport
    seconds: dict[str, object]
    traces: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _Group:
    """A scan that was measured, with the design it belongs to: a column's foot, or the bars of a position."""

    id: str
    design: ColumnDesign
    measured: Measured


def run_match(job: Job, options: RunOptions, started: Callable[[int], Callable[[str], None]]) -> MatchRun:
    """Match the columns of a job to the bars of a job.

    Parameters
    ----------
    started
        Called with the number of columns before the first is measured; what it returns is called with the id of
        each as it is finished, in any order.

    Raises
    ------
    JobError
        Where the job has nothing to match, or a column is asked for that it does not have.
    DesignError, MissingDependencyError
        As :func:`~.run.run_job`.
    """
    watch = Stopwatch()
    with watch.stage("total"):
        with watch.stage("model"):
            plan = plan_job(job, only=options.only, method=options.method)
        settings, tasks = plan.settings, plan.tasks
        feet = sum(bool(task.column.sleeves) for task in tasks)
        if not feet or not any(task.column.rebars for task in tasks):
            raise JobError.because("command.nothing_to_match", job=job.source)
        finished = started(len(tasks))
        found: dict[int, MeasuredColumn] = {}
        with opened_pool(options.pool, len(tasks), job, None, read_for_shipping, lambda text: None) as pool:
            for place, outcome in work_through(tasks, pool, measure_task, lost_measurement, Unwatched()):
                found[place] = outcome
                finished(outcome.id)
        columns = [found[place] for place in sorted(found)]
        with watch.stage("matching"):
            groups = _groups(columns, settings)
    report = ShipmentReport(
        tool=tool_entry(),
        job=job_entry(plan),
        profile=job.profile.name,
        turns=job.turns,
        groups=groups,
        problems=tuple(problem for column in columns for problem in column.problems),
    )
    seconds = {"columns": {column.id: column.seconds for column in columns}, **watch.seconds()}
    return MatchRun(report, seconds, {column.id: column.where for column in columns if column.where})


def _groups(columns: Sequence[MeasuredColumn], settings: CheckSettings) -> tuple[ShipmentGroup, ...]:
    """Columns that may take each other's place, in the order of the job, each group matched."""
    kinds: list[list[MeasuredColumn]] = []
    for column in columns:
        if column.design is None or (column.sleeves is None and column.rebars is None):
            continue
        first = next((kind for kind in kinds if _same_kind(kind[0], column)), None)
        if first is None:
            kinds.append([column])
        else:
            first.append(column)
    return tuple(_matched(kind, settings) for kind in kinds)


def _same_kind(first: MeasuredColumn, other: MeasuredColumn) -> bool:
    return first.design is not None and other.design is not None and interchangeable(first.design, other.design)


def _matched(columns: Sequence[MeasuredColumn], settings: CheckSettings) -> ShipmentGroup:
    feet = [_Group(one.id, one.design, one.sleeves) for one in columns if one.design and one.sleeves]
    bars = [_Group(one.id, one.design, one.rebars) for one in columns if one.design and one.rebars]
    cells = tuple(tuple(_cell(foot, position, settings) for position in bars) for foot in feet)
    margins = np.array([[np.nan if cell.margin is None else cell.margin for cell in row] for row in cells])
    chosen = best_assignment(margins.reshape(len(feet), len(bars)))
    assignments = tuple(_assignment(feet[row], bars[column], cells[row][column], settings) for row, column in chosen)
    used = [assignment.margin for assignment in assignments]
    return ShipmentGroup(
        piece_mark=columns[0].design.piece_mark if columns[0].design else None,
        columns=tuple(foot.id for foot in feet),
        positions=tuple(position.id for position in bars),
        cells=cells,
        assignments=assignments,
        smallest_margin=min(used, default=None),
        sum_of_margins=sum(used) if used else None,
        as_listed_margin=_as_listed(feet, bars, cells),
        spare_columns=tuple(foot.id for row, foot in enumerate(feet) if row not in {pair[0] for pair in chosen}),
        open_positions=tuple(bar.id for place, bar in enumerate(bars) if place not in {pair[1] for pair in chosen}),
    )


def _cell(foot: _Group, bars: _Group, settings: CheckSettings) -> FitCell:
    return try_margin(
        joined_design(foot.design, bars.design),
        (foot.measured.extraction, foot.measured.match),
        (bars.measured.extraction, bars.measured.match),
        settings.profile,
        turns=settings.turns,
    )


def _assignment(foot: _Group, bars: _Group, cell: FitCell, settings: CheckSettings) -> Assignment:
    """The chosen pair with the verdict that a check of it would come to."""
    trial = try_scans(
        joined_design(foot.design, bars.design),
        (foot.measured.extraction, foot.measured.match),
        (bars.measured.extraction, bars.measured.match),
        settings.profile,
        np.random.default_rng([settings.seed, 2]),
        decision=settings.decision,
        turns=settings.turns,
    )
    return Assignment(
        column=foot.id,
        position=bars.id,
        turn_deg=cell.turn_deg,
        margin=cell.margin or 0.0,
        max_mm=cell.max_mm,
        verdict=trial.verdict,
        probability=trial.probability,
        reasons=trial.reasons,
    )


def _as_listed(feet: Sequence[_Group], bars: Sequence[_Group], cells: Sequence[Sequence[FitCell]]) -> float | None:
    """The smallest margin of the pairs that the job itself lists; None where one of them is not known."""
    place_of = {position.id: place for place, position in enumerate(bars)}
    listed = [cells[row][place_of[foot.id]].margin for row, foot in enumerate(feet) if foot.id in place_of]
    known = [margin for margin in listed if margin is not None]
    return min(known) if known and len(known) == len(listed) else None


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
