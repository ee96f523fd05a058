"""The runner: a job in, its report out. The model is read once; columns are checked here or in other processes.

Every result goes through its record, as exact text, whether it was made here, by a worker or by an earlier run: so the
report is the same.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from aadm_workbench.errors import AadmError
from aadm_workbench.inspection.job import Job
from aadm_workbench.inspection.stopwatch import Stopwatch
from aadm_workbench.inspection.tasks import ColumnTask, JobPlan, plan_job, report_of
from aadm_workbench.model import ColumnReport, JobReport

from ..program import program_key
from .engine import Death, work_through
from .journal import Journal, Unkept
from .pools import PoolOptions, opened_pool
from .record import CheckOrder, Record, fill_order, give_up, ship_order


@dataclass(frozen=True)
class RunOptions:
    """What the command line adds to a job: method, which columns (empty: all), where they are checked."""

    method: str = "refined"
    only: tuple[str, ...] = ()
    pool: PoolOptions = field(default_factory=PoolOptions)


@dataclass(frozen=True, eq=False)
class JobRun:
    """The outcome of a job: its report; ``seconds`` as timing.json holds them; traces of unforeseen errors by id."""

    report: JobReport
    seconds: dict[str, object]
    traces: dict[str, str] = field(default_factory=dict)


class Follower:
    """Is told how a check goes; this one does not listen."""

    def started(self, total: int) -> None:
        """So many columns are to be checked."""

    def column(self, record: Record, kept: bool) -> None:
        """A column is finished, or its kept result still holds."""

    def lost(self, name: str, death: Death, tries_left: int) -> None:
        """The process that checked a column died."""

    def message(self, text: str) -> None:
        """Something that a person should know."""


def run_job(
    job: Job,
    options: RunOptions,
    follower: Follower | None = None,
    journal: Journal | Unkept | None = None,
    folder: Path | None = None,
) -> JobRun:
    """Check the columns of a job.

    Parameters
    ----------
    journal
        Where results are kept as they come; those that it holds already are used where nothing has changed since.
    folder
        Where workers log (``workers.log``) and keep what they need; by default a temporary one.

    Returns
    -------
    JobRun
        With the columns in the order of the job.

    Raises
    ------
    JobError
        Where a column is asked for that the job does not have, or no scheduler answers.
    DesignError
        Where the model cannot be read.
    MissingDependencyError
        Where several processes are asked for without Dask.
    AadmError
        Where results can no longer be kept, or there are no workers any more.
    """
    watch = Stopwatch()
    follower = follower or Follower()
    journal = journal or Unkept()
    with watch.stage("total"):
        with watch.stage("model"):
            plan = plan_job(job, only=options.only, method=options.method)
        tasks, model = plan.tasks, plan.model
        follower.started(len(tasks))
        if model is not None:
            for warning in model.warnings:
                follower.message(f"{model.source}: {warning}")
        orders, doubtful = _orders(tasks, journal)
        pool_options = replace(options.pool, apart=bool(doubtful))
        with opened_pool(pool_options, tasks, folder, ship_order, follower.message) as pool:
            watcher = _Watcher(tasks, follower, journal)
            for place, record in work_through(orders, pool, fill_order, give_up, watcher, doubtful):
                if record is not None:
                    journal.add(record)
                follower.column(record or journal.record(tasks[place].column.id), kept=record is None)
        done = _collected(plan, (journal.record(task.column.id) for task in tasks))
    return replace(done, seconds=done.seconds | watch.seconds())


def _orders(tasks: tuple[ColumnTask, ...], journal: Journal | Unkept) -> tuple[list[CheckOrder], set[int]]:
    """An order for each column, and which of them an earlier run did not survive, perhaps."""
    program, known, interrupted = program_key(), journal.keys, journal.interrupted
    orders = [CheckOrder(task, program, known.get(task.column.id, "")) for task in tasks]
    return orders, {place for place, task in enumerate(tasks) if task.column.id in interrupted}


@dataclass(frozen=True, eq=False)
class _Watcher:
    """Notes in the journal, and tells who follows, what becomes of columns."""

    tasks: tuple[ColumnTask, ...]
    follower: Follower
    journal: Journal | Unkept

    def began(self, place: int) -> None:
        self.journal.began(self.tasks[place].column.id)

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        self.follower.lost(self.tasks[place].column.id, death, tries_left)


def _collected(plan: JobPlan, records: Iterable[Record]) -> JobRun:
    columns: list[ColumnReport] = []
    seconds: dict[str, object] = {}
    traces: dict[str, str] = {}
    # One after the other: the texts of all of them would take as much memory as the reports.
    for record in records:
        columns.append(_column(record))
        seconds[record.id] = record.seconds
        if record.where:
            traces[record.id] = record.where
    return JobRun(report_of(plan, columns), {"columns": seconds}, traces)


def _column(record: Record) -> ColumnReport:
    try:
        return record.column()
    except ValueError as error:
        raise AadmError.because("run.kept", id=record.id, why=error) from error
