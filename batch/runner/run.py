"""The runner: a job in, its report out. The model is read once; columns are checked here or in other processes.

Every result goes through its record, as exact text, whether it was made here, by a worker or by an earlier run: so the
report is the same.
"""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from aadm_workbench.errors import AadmError
from aadm_workbench.inspection.job import Job
from aadm_workbench.inspection.tasks import ColumnTask, JobPlan, Stopwatch, chosen_columns, plan_job, report_of
from aadm_workbench.model import ColumnReport, JobReport
from aadm_workbench.model.made import Made
from aadm_workbench.report.json import encode

from ..job.inputs import Looks, looks, order_key, program_key
from .engine import Death, Pool, work_through
from .journal import Journal, Unkept
from .pools import PoolOptions, opened_pool
from .record import CheckOrder, Record, fill_order, give_up, ship_order


@dataclass(frozen=True)
class RunOptions:
    """What the command line adds to a job: method, which columns (empty: all), where they are checked.

    ``verify``: whether the files of results that were kept are read again, also where they look as they did.
    """

    method: str = "refined"
    only: tuple[str, ...] = ()
    pool: PoolOptions = field(default_factory=PoolOptions)
    verify: bool = False


@dataclass(frozen=True, eq=False)
class JobRun:
    """The outcome of a job: ``seconds`` as timing.json holds them; traces of unforeseen errors by id.

    ``columns`` are read from the journal whenever they are needed. ``basis`` is a hash of all that the report follows
    from; empty where a column may come out differently the next time.
    """

    plan: JobPlan
    columns: Sequence[ColumnReport]
    seconds: dict[str, object]
    traces: dict[str, str] = field(default_factory=dict)
    basis: str = ""

    @cached_property
    def report(self) -> JobReport:
        """The report, which only all columns together make."""
        return report_of(self.plan, self.columns)


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
    with watch.stage("total"), ExitStack() as held:
        pools = _Pools(options.pool, job, folder, follower, held)
        if not journal.keys:
            # All are to be checked: workers load their packages while the model is read.
            pools.open(len(chosen_columns(job, options.only)), apart=bool(journal.interrupted))
        with watch.stage("model"):
            plan = plan_job(job, only=options.only, method=options.method)
        follower.started(len(plan.tasks))
        if plan.model is not None:
            for warning in plan.model.warnings:
                follower.message(f"{plan.model.source}: {warning}")
        orders = _orders(plan.tasks, journal)
        kept = set() if options.verify else _look_as_they_did(orders, journal)
        for place in sorted(kept):
            follower.column(journal.record(plan.tasks[place].column.id), kept=True)
        left = [order for place, order in enumerate(orders) if place not in kept]
        doubtful = _places_of(journal.interrupted, left)
        pool = pools.open(len(left), apart=bool(doubtful))
        watcher = _Watcher(left, follower, journal)
        for place, record in work_through(left, pool, fill_order, give_up, watcher, doubtful):
            watcher.keep(place, record)
            follower.column(journal.record(left[place].task.column.id), kept=record is None)
        held.close()
        done = _collected(plan, journal)
    return replace(done, seconds=done.seconds | watch.seconds())


@dataclass(eq=False)
class _Pools:
    """Opens the pool of a job once, for as long as ``held`` is held."""

    options: PoolOptions
    job: Job
    folder: Path | None
    follower: Follower
    held: ExitStack
    opened: bool = False
    pool: Pool | None = None

    def open(self, columns: int, *, apart: bool) -> Pool | None:
        """The pool for so many columns; where it is open already, the one that is."""
        if not self.opened:
            options, say = replace(self.options, apart=apart), self.follower.message
            context = opened_pool(options, columns, self.job, self.folder, ship_order, say)
            self.pool, self.opened = self.held.enter_context(context), True
        return self.pool


def _orders(tasks: tuple[ColumnTask, ...], journal: Journal | Unkept) -> list[CheckOrder]:
    """An order for each column."""
    program, known = program_key(), journal.keys
    shared: dict[int, str] = {}
    return [CheckOrder(task, order_key(task, program, shared), known.get(task.column.id, "")) for task in tasks]


def _places_of(names: Collection[str], orders: Sequence[CheckOrder]) -> set[int]:
    return {place for place, order in enumerate(orders) if order.task.column.id in names}


def _look_as_they_did(orders: Sequence[CheckOrder], journal: Journal | Unkept) -> set[int]:
    """Places of the columns whose results still hold, as far as their files tell without being read."""
    found = set()
    for place, order in enumerate(orders):
        seen = journal.seen(order.task.column.id)
        if order.known and seen and seen == looks(order.task, order.order).hash:
            found.add(place)
    return found


@dataclass(frozen=True, eq=False)
class _Watcher:
    """Notes in the journal, and tells who follows, what becomes of columns."""

    orders: Sequence[CheckOrder]
    follower: Follower
    journal: Journal | Unkept
    looked: dict[int, Looks] = field(default_factory=dict)

    def began(self, place: int) -> None:
        order = self.orders[place]
        self.journal.began(order.task.column.id)
        found = looks(order.task, order.order)
        self.looked[place] = found if found.tell_at(self.journal.now_ns) else Looks("")

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        self.follower.lost(self.orders[place].task.column.id, death, tries_left)

    def keep(self, place: int, record: Record | None) -> None:
        """Keep a result, or, for None, the one that still holds, with what its files look like now."""
        order, before = self.orders[place], self.looked.pop(place, Looks(""))
        seen = before.hash if before.hash and looks(order.task, order.order) == before else ""
        if record is not None:
            self.journal.add(replace(record, seen=seen))
        elif seen != self.journal.seen(order.task.column.id):
            self.journal.add(replace(self.journal.record(order.task.column.id), seen=seen))


def _collected(plan: JobPlan, journal: Journal | Unkept) -> JobRun:
    """The run of a job whose results are kept."""
    names = [task.column.id for task in plan.tasks]
    seconds: dict[str, object] = {}
    traces: dict[str, str] = {}
    basis, holds = hashlib.sha256(encode(report_of(plan, ()))), True
    for record in map(journal.record, names):
        seconds[record.id] = record.seconds
        if record.where:
            traces[record.id] = record.where
        holds = holds and record.key != ""
        basis.update(f"{record.key} {record.id}\n".encode(errors="surrogatepass"))
    columns = Made(len(names), lambda place: _column(journal.record(names[place])))
    return JobRun(plan, columns, {"columns": seconds}, traces, basis.hexdigest() if holds else "")


def _column(record: Record) -> ColumnReport:
    try:
        return record.column()
    except ValueError as error:
        raise AadmError.because("run.kept", id=record.id, why=error) from error
