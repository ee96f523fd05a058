"""The runner: a job in, its report out. The model is read once; columns are checked here or in other processes.

Every result goes through its record, as exact text, whether it was made here, by a worker or by an earlier run: so the
report is the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from aadm_workbench.as_designed import read_design
from aadm_workbench.assembly.findings.same_scan import with_same_scans
from aadm_workbench.assembly.findings.shape import design_shape
from aadm_workbench.check import CheckSettings
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.errors import AadmError, DesignError, JobError
from aadm_workbench.model import ColumnDesign, ColumnReport, JobReport
from aadm_workbench.own_files import remove

from ..entries import report_of
from ..job.inputs import ShippedFile
from ..job.model import Job, JobColumn
from ..job.table import did_you_mean
from ..program import program_key
from ..stopwatch import Stopwatch
from ..unforeseen import unforeseen_in
from .engine import Death, Pool, work_through
from .journal import Journal, Unkept
from .order import CheckOrder, fill_order, give_up, ship_order
from .pools import PoolOptions, open_pool
from .record import Record
from .task import ColumnTask
from .workers_log import WorkersLog

SCRATCH_NAME = ".aadm-workers"


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
        model, settings, tasks = plan_tasks(job, options, watch)
        follower.started(len(tasks))
        if model is not None:
            for warning in model.warnings:
                follower.message(f"{model.source}: {warning}")
        _check_all(tasks, options.pool, follower, journal, folder)
        kept = (journal.record(task.column.id) for task in tasks)
        report, seconds, traces = _collected(job, model, settings, kept)
    return JobRun(report, {"columns": seconds, **watch.seconds()}, traces)


def _check_all(
    tasks: Sequence[ColumnTask],
    options: PoolOptions,
    follower: Follower,
    journal: Journal | Unkept,
    folder: Path | None,
) -> None:
    program = program_key()
    known, interrupted = journal.keys, journal.interrupted
    orders = [CheckOrder(task, program, known.get(task.column.id, "")) for task in tasks]
    doubtful = {place for place, task in enumerate(tasks) if task.column.id in interrupted}
    watcher = _Watcher(tasks, follower, journal)
    options = replace(options, apart=bool(doubtful))
    with opened_pool(options, tasks, folder, ship_order, follower.message) as pool:
        for place, record in work_through(orders, pool, fill_order, give_up, watcher, doubtful):
            if record is not None:
                journal.add(record)
                follower.column(record, kept=False)
            else:
                follower.column(journal.record(tasks[place].column.id), kept=True)


@contextmanager
def opened_pool(
    options: PoolOptions,
    tasks: Sequence[ColumnTask],
    folder: Path | None,
    ship: Callable[[Any], tuple[ShippedFile, ...]],
    say: Callable[[str], None],
) -> Iterator[Pool]:
    """The pool for some columns; what its workers write goes into a folder, or is forgotten with them."""
    with ExitStack() as stack:
        scratch = _scratch(stack, folder)
        log = (lambda line: None) if folder is None else WorkersLog(folder).write
        job_folder = tasks[0].folder if tasks else Path()
        yield stack.enter_context(
            open_pool(options, len(tasks), job_folder, ship=ship, say=say, log=log, log_folder=scratch)
        )


def _scratch(stack: ExitStack, folder: Path | None) -> Path:
    """A folder for what workers write while they work, gone afterwards; that of a killed run is removed first."""
    if folder is None:
        return Path(stack.enter_context(TemporaryDirectory(prefix="aadm-workers-", ignore_cleanup_errors=True)))
    scratch = folder / SCRATCH_NAME
    stack.callback(remove, scratch)
    remove(scratch)
    try:
        # Nobody else may write into it, whoever may write beside it.
        scratch.mkdir(mode=0o700)
    except OSError as error:
        reason = f"cannot be made ({error.strerror}); remove what is there, or name another folder with --out"
        raise AadmError(f"{scratch}: the folder of the workers {reason}") from error
    return scratch


class _Watcher:
    """Notes in the journal, and tells who follows, what becomes of columns."""

    def __init__(self, tasks: Sequence[ColumnTask], follower: Follower, journal: Journal | Unkept) -> None:
        self._names = [task.column.id for task in tasks]
        self._follower = follower
        self._journal = journal

    def began(self, place: int) -> None:
        self._journal.began(self._names[place])

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        self._follower.lost(self._names[place], death, tries_left)


def _collected(
    job: Job, model: ModelDesign | None, settings: CheckSettings, records: Iterable[Record]
) -> tuple[JobReport, dict[str, object], dict[str, str]]:
    columns: list[ColumnReport] = []
    seconds: dict[str, object] = {}
    traces: dict[str, str] = {}
    # One after the other: the texts of all of them would take as much memory as the reports.
    for record in records:
        columns.append(_column(record))
        seconds[record.id] = record.seconds
        if record.where:
            traces[record.id] = record.where
    return report_of(job, model, settings, with_same_scans(columns)), seconds, traces


def _column(record: Record) -> ColumnReport:
    try:
        return record.column()
    except ValueError as error:
        message = f"{record.id}: its kept result cannot be used ({error}); check again without --resume"
        raise AadmError(message) from error


def plan_tasks(
    job: Job, options: RunOptions, watch: Stopwatch
) -> tuple[ModelDesign | None, CheckSettings, list[ColumnTask]]:
    """The job's model, the settings, and a task for each chosen column; errors as :func:`run_job`."""
    columns = chosen_columns(job, options.only)
    with watch.stage("model"):
        model, unreadable = _model_for(job, columns)
    if model is not None:
        check_named_once(job, model)
    settings = CheckSettings(job.profile, options.method, job.decision, job.checks, job.turns)
    return model, settings, _tasks(job, columns, model, settings, unreadable)


def _model_for(job: Job, columns: Sequence[JobColumn]) -> tuple[ModelDesign | None, str]:
    """The job's model, and where it cannot be read why: that costs only the columns that are looked up in it.

    Raises
    ------
    DesignError
        Where it cannot be read, and no column brings a design along.
    """
    try:
        return model_of(job), ""
    except DesignError as error:
        if not any(column.design is not None for column in columns):
            raise
        return None, error.reason


def check_named_once(job: Job, model: ModelDesign) -> None:
    """Refuse a job that names one column of its model twice, by its id and by its GlobalId for instance.

    Raises
    ------
    JobError
        With the lines of both.
    """
    first: dict[int, str] = {}
    for column in job.columns:
        design = None if column.design is not None else _designed(model, column)
        if not isinstance(design, ColumnDesign):
            continue
        other = first.setdefault(id(design), column.id)
        if other != column.id:
            raise JobError(
                f'{job.source}, line {job.lines.get(column.id, 1)}: "{column.id}" and "{other}" (line '
                f"{job.lines.get(other, 1)}) are one column of {model.source} ({design.id}); name it once"
            )


def _designed(model: ModelDesign, column: JobColumn) -> ColumnDesign | str:
    """The design of a column that brings none along; or why the model gives none."""
    try:
        return model.column(column.id)
    except DesignError as error:
        return error.reason


def chosen_columns(job: Job, only: Sequence[str]) -> tuple[JobColumn, ...]:
    """The columns of a job that are named, or all of them, in the job's order.

    Raises
    ------
    JobError
        Where the job has no such column.
    """
    ids = [column.id for column in job.columns]
    for name in only:
        if name not in ids:
            raise JobError(f'{job.source} has no column "{name}" (--only); {did_you_mean(name, ids)}')
    return tuple(column for column in job.columns if not only or column.id in only)


def model_of(job: Job) -> ModelDesign | None:
    """The job's model, called as the job calls it; None where it has none.

    Raises
    ------
    DesignError
        Where the model cannot be read.
    """
    if job.model is None:
        return None
    path = job.folder / job.model.path
    rules = {"columns": job.model.columns, "sleeves": job.model.sleeves, "rebars": job.model.rebars}
    with unforeseen_in(str(path)):
        model = read_design(path, **rules, units=job.model.units)
    return replace(model, source=job.model.path)


def _tasks(
    job: Job, columns: Sequence[JobColumn], model: ModelDesign | None, settings: CheckSettings, unreadable: str
) -> list[ColumnTask]:
    """A task for each column, each with the designs of the job that are unlike its own."""
    tasks = [_task(job, column, model, settings, unreadable) for column in columns]
    designs = [task.design for task in tasks if task.design is not None]
    patterns = {design_shape(design): design for design in reversed(designs)}
    if len(patterns) < 2:
        return tasks
    found = []
    for task in tasks:
        own = None if task.design is None else design_shape(task.design)
        others = tuple(design for shape, design in sorted(patterns.items(), key=lambda item: item[0]) if shape != own)
        found.append(replace(task, others=others))
    return found


def _task(
    job: Job, column: JobColumn, model: ModelDesign | None, settings: CheckSettings, unreadable: str
) -> ColumnTask:
    design, no_design = column.design, unreadable
    if design is None and model is not None:
        found = _designed(model, column)
        design, no_design = (found, "") if isinstance(found, ColumnDesign) else (None, found)
    # Workers have another working folder.
    folder = job.folder.absolute()
    return ColumnTask(column, folder, design, settings, job.units, job.camera, job.depth_scale_mm, no_design)
