"""The runner: a job in, its report out. The model is read once; columns are checked one by one or in processes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from importlib.metadata import PackageNotFoundError, version

from aadm_workbench import __version__
from aadm_workbench.assembly.mould import assess_moulds
from aadm_workbench.check import CheckSettings
from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.design.read import read_model
from aadm_workbench.errors import DesignError, JobError
from aadm_workbench.model import ColumnReport, JobReport

from .column_task import ColumnOutcome, ColumnTask, check_task, killed
from .job import Job, JobColumn
from .job_table import did_you_mean
from .spread import in_any_order
from .stopwatch import Stopwatch

Finished = Callable[[ColumnReport], None]

_NUMERICAL_PACKAGES = ("numpy", "scipy", "opencv-python-headless", "ifcopenshell")


@dataclass(frozen=True)
class RunOptions:
    """What the command line adds to a job: method, which columns (empty: all), how many processes."""

    method: str = "refined"
    only: tuple[str, ...] = ()
    processes: int = 1


@dataclass(frozen=True, eq=False)
class JobRun:
    """The outcome of a job: its report; ``seconds`` as timing.json holds them; traces of unforeseen errors by id."""

    report: JobReport
    seconds: dict[str, object]
    traces: dict[str, str] = field(default_factory=dict)


def run_job(job: Job, options: RunOptions, started: Callable[[int], Finished]) -> JobRun:
    """Check the columns of a job.

    Parameters
    ----------
    started
        Called with the number of columns before the first is checked; what it returns is called with each report as
        it is finished, in any order.

    Returns
    -------
    JobRun
        With the columns in the order of the job.

    Raises
    ------
    JobError
        Where a column is asked for that the job does not have.
    DesignError
        Where the model cannot be read.
    MissingDependencyError
        Where several processes are asked for without Dask.
    """
    watch = Stopwatch()
    with watch.stage("total"):
        model, settings, tasks = plan_tasks(job, options, watch)
        outcomes = _outcomes(tasks, options.processes, started(len(tasks)))
    seconds = {"columns": {outcome.report.id: outcome.seconds for outcome in outcomes}, **watch.seconds()}
    traces = {outcome.report.id: outcome.where for outcome in outcomes if outcome.where}
    return JobRun(_report(job, model, settings, outcomes), seconds, traces)


def plan_tasks(
    job: Job, options: RunOptions, watch: Stopwatch
) -> tuple[ModelDesign | None, CheckSettings, list[ColumnTask]]:
    """The job's model, the settings, and a task for each chosen column; errors as :func:`run_job`."""
    columns = _chosen(job, options.only)
    with watch.stage("model"):
        model = _model(job)
    settings = CheckSettings(job.profile, options.method, job.decision, job.checks, job.turns)
    return model, settings, [_task(job, column, model, settings) for column in columns]


def _chosen(job: Job, only: Sequence[str]) -> tuple[JobColumn, ...]:
    ids = [column.id for column in job.columns]
    for name in only:
        if name not in ids:
            raise JobError(f'{job.source} has no column "{name}" (--only); {did_you_mean(name, ids)}')
    return tuple(column for column in job.columns if not only or column.id in only)


def _model(job: Job) -> ModelDesign | None:
    """The job's model, called as the job calls it; not read where every column brings its own design."""
    if job.model is None:
        return None
    path = job.folder / job.model.path
    model = read_model(path, columns=job.model.columns, sleeves=job.model.sleeves, rebars=job.model.rebars)
    return replace(model, source=job.model.path)


def _task(job: Job, column: JobColumn, model: ModelDesign | None, settings: CheckSettings) -> ColumnTask:
    design, no_design = column.design, ""
    if design is None and model is not None:
        try:
            design = model.column(column.id)
        except DesignError as error:
            no_design = str(error)
    return ColumnTask(column, job.folder, design, settings, job.units, job.camera, job.depth_scale_mm, no_design)


def _outcomes(tasks: Sequence[ColumnTask], processes: int, finished: Finished) -> list[ColumnOutcome]:
    outcomes: dict[int, ColumnOutcome] = {}
    for place, outcome in in_any_order(tasks, processes, check_task, killed):
        outcomes[place] = outcome
        finished(outcome.report)
    return [outcomes[place] for place in sorted(outcomes)]


def _report(
    job: Job, model: ModelDesign | None, settings: CheckSettings, outcomes: Sequence[ColumnOutcome]
) -> JobReport:
    columns = tuple(outcome.report for outcome in outcomes)
    return JobReport(
        tool=tool_entry(),
        job=job_entry(job, settings),
        capture=job.capture,
        model=None if model is None else {"source": model.source, "sha256": model.sha256},
        profile=job.profile,
        columns=columns,
        mould_drift=assess_moulds(columns, job.profile),
    )


def tool_entry() -> dict[str, str]:
    """What reports say about the program: its version and those of the packages that the numbers come from."""
    return {"name": "aadm", "version": __version__, **_versions()}


def job_entry(job: Job, settings: CheckSettings) -> dict[str, str]:
    """What reports say about the job, and how it was run."""
    return {
        "name": job.name,
        "sha256": job.sha256,
        "units": job.units,
        "method": settings.method,
        "decision": settings.decision,
        "seed": str(settings.seed),
    }


def _versions() -> dict[str, str]:
    """Versions of the packages that the numbers come from, where they are installed under these names."""
    found = {}
    for name in _NUMERICAL_PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found
