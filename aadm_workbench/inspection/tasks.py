"""The two ends of an inspection: what the columns of a job are checked from, and the report of all of them.

The model is read once; then each column has all that any process needs for it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from aadm_workbench import __version__
from aadm_workbench.assembly.findings.finding import scans_of, with_same_scans
from aadm_workbench.errors import DesignError, JobError, did_you_mean
from aadm_workbench.inspection.job import Job, JobColumn
from aadm_workbench.inspection.measure import CheckSettings
from aadm_workbench.model import (
    Array,
    Camera,
    CameraProfile,
    ColumnDesign,
    ColumnReport,
    JobReport,
    Kind,
    MouldDrift,
    Profile,
    Scan,
)
from aadm_workbench.model.made import learn
from aadm_workbench.model.reports import verdict_of
from aadm_workbench.scan.read import read_scan

_DECIMALS = 4  # 0.1 ms


class Stopwatch:
    """Seconds spent in each stage, summed over all times it was entered."""

    def __init__(self) -> None:
        self._seconds: dict[str, float] = {}

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Count what happens inside towards a stage."""
        began = perf_counter()
        try:
            yield
        finally:
            self._seconds[name] = self._seconds.get(name, 0.0) + perf_counter() - began

    def seconds(self) -> dict[str, float]:
        """Seconds by stage, in the order in which the stages were first left."""
        return {name: round(value, _DECIMALS) for name, value in self._seconds.items()}


if TYPE_CHECKING:
    from aadm_workbench.design.model_design import ModelDesign

_STEP_MM = 1.0  # no two patterns that are built differ by less

_NUMERICAL_PACKAGES = ("numpy", "scipy", "opencv-python-headless", "ifcopenshell")


@dataclass(frozen=True, eq=False)
class ColumnTask:
    """All that is needed to check one column.

    ``folder`` is where relative paths start; ``places`` says where files lie that are not found from there;
    ``design`` None means that the job's model gives none, for the reason ``no_design``. ``others`` are the designs of
    the job that are unlike this one. ``learned`` is the profile of its camera, and what speaks against using it.
    """

    column: JobColumn
    folder: Path
    design: ColumnDesign | None
    settings: CheckSettings
    units: str = "mm"
    camera: Camera | None = None
    depth_scale_mm: float | None = None
    no_design: str = ""
    places: Mapping[str, Path] = field(default_factory=dict)
    others: tuple[ColumnDesign, ...] = ()
    learned: CameraProfile | None = None
    learned_notes: tuple[str, ...] = ()

    def path_of(self, name: str) -> Path:
        """Where a file lies that the job names."""
        return self.places.get(name, self.folder / name)

    def read(self, name: str, *, path: Path | None = None, image: str | None = None) -> Scan:
        """Read a file as the job declares the column's scans; ``path`` is where one lies that the job does not name.

        Raises
        ------
        ScanError
            Where it cannot be read.
        """
        scan = read_scan(
            path or self.path_of(name),
            units=self.units,
            camera=self.camera,
            depth_scale_mm=self.depth_scale_mm,
            source=name,
            image=None if image is None else self.path_of(image),
            axes=self.column.axes,
        )
        return replace(scan, learned=self.learned, notes=(*scan.notes, *self.learned_notes)) if self.learned else scan

    def at(self, places: Mapping[str, Path]) -> ColumnTask:
        """The same task where its files lie elsewhere."""
        return replace(self, places=places)


@dataclass(frozen=True, eq=False)
class JobPlan:
    """A job with its model, where it has one that can be read, its settings, and a task for each chosen column."""

    job: Job
    model: ModelDesign | None
    settings: CheckSettings
    tasks: tuple[ColumnTask, ...]


def plan_job(job: Job, *, only: Sequence[str] = (), method: str = "refined") -> JobPlan:
    """Read a job's model, and make a task for each of its columns, or for those that are named.

    Raises
    ------
    JobError
        Where a column is asked for that the job does not have, or two of its columns are one.
    DesignError
        Where the model cannot be read, and no column brings a design along.
    """
    columns = chosen_columns(job, only)
    model, unreadable = None, ""
    try:
        model = model_of(job, [column.id for column in columns if column.design is None])
    except DesignError as error:
        # It costs only the columns that are looked up in it.
        if not any(column.design is not None for column in columns):
            raise
        unreadable = error.reason
    if model is not None:
        _check_named_once(job, model)
    settings = CheckSettings(job.profile, method, job.decision, job.checks, job.turns)
    tasks = [_task(job, column, model, settings, unreadable) for column in columns]
    return JobPlan(job, model, settings, tuple(_with_others(tasks)))


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
            raise JobError.because("command.no_such_column", job=job.source, name=name, meant=did_you_mean(name, ids))
    return tuple(column for column in job.columns if not only or column.id in only)


def model_of(job: Job, ids: Sequence[str]) -> ModelDesign | None:
    """What the job's model says of columns of these ids, called as the job calls it; None where it has no model.

    Raises
    ------
    DesignError
        Where the model cannot be read.
    """
    if job.model is None:
        return None
    from aadm_workbench.inspection.as_designed import read_design, unforeseen_in

    path = job.folder / job.model.path
    rules = {"columns": job.model.columns, "sleeves": job.model.sleeves, "rebars": job.model.rebars}
    with unforeseen_in(str(path)):
        model = read_design(path, **rules, units=job.model.units, only=ids)
    return replace(model, source=job.model.path)


def _check_named_once(job: Job, model: ModelDesign) -> None:
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
            raise JobError.because(
                "command.named_twice",
                job=job.source,
                line=job.line_of(column.id),
                id=column.id,
                other=other,
                other_line=job.line_of(other),
                model=model.source,
                column=design.id,
            )


def _designed(model: ModelDesign, column: JobColumn) -> ColumnDesign | str:
    """The design of a column that brings none along; or why the model gives none."""
    try:
        return model.column(column.id)
    except DesignError as error:
        return error.reason


def _task(
    job: Job, column: JobColumn, model: ModelDesign | None, settings: CheckSettings, unreadable: str
) -> ColumnTask:
    design, no_design = column.design, unreadable
    if design is None and model is not None:
        found = _designed(model, column)
        design, no_design = (found, "") if isinstance(found, ColumnDesign) else (None, found)
    # Workers have another working folder.
    folder = job.folder.absolute()
    learned = job.camera_profile
    notes = _notes_on_profile(job)
    camera = job.camera if learned is None or job.camera is not None else learned.camera
    task = ColumnTask(column, folder, design, settings, job.units, camera, job.depth_scale_mm, no_design)
    return replace(task, learned=learned, learned_notes=notes)


def _notes_on_profile(job: Job) -> tuple[str, ...]:
    if job.camera_profile is None:
        return ()
    from aadm_workbench.inspection.learned import notes_on_profile

    return notes_on_profile(job.camera_profile, job.camera, job.capture)


def _named_profile(job: Job) -> dict[str, str]:
    if job.camera_profile is None:
        return {}
    from aadm_workbench.inspection.learned import named_profile

    return named_profile(job.camera_profile)


def _with_others(tasks: Sequence[ColumnTask]) -> Sequence[ColumnTask]:
    """The tasks, each with the designs of the job that are unlike its own."""
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


def design_shape(design: ColumnDesign) -> tuple[tuple[int, ...], ...]:
    """Sorted distances of the sleeves, and of the rebars, from their middle and from each other, in millimetres.

    The same for a pattern that is turned, moved or mirrored, and for no other that is built.
    """
    return tuple(_distances(np.array([point.centre[:2] for point in design.points(kind)])) for kind in Kind)


def _distances(places: Array) -> tuple[int, ...]:
    if not len(places):
        return ()
    apart = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    lengths = np.concatenate([apart[np.triu_indices(len(places), 1)], np.hypot(*(places - places.mean(axis=0)).T)])
    return (len(places), *np.sort(np.rint(lengths / _STEP_MM).astype(int)).tolist())


def report_of(plan: JobPlan, columns: Sequence[ColumnReport]) -> JobReport:
    """The report of a job on its columns, as they were inspected one by one."""
    job, model = plan.job, plan.model
    _learn(columns)
    columns = with_same_scans(columns)
    return JobReport(
        tool=tool_entry(),
        job=job_entry(plan),
        capture=job.capture | _named_profile(job),
        model=None if model is None else model_entry(model),
        profile=job.profile,
        columns=columns,
        mould_drift=_mould_drift(columns, job.profile),
        grid=() if model is None else model.grid,
    )


def model_entry(model: ModelDesign) -> dict[str, str]:
    """What reports say about the model: its file, and the GlobalId of the project of an IFC model."""
    project = {"ifc_project": model.project} if model.project else {}
    return {"source": model.source, "sha256": model.sha256, **project}


def _learn(columns: Sequence[ColumnReport]) -> None:
    """Find what only all columns together show while each of them is at hand: results are unpacked once for it."""
    if len(columns) < 2:  # as below
        learn(columns, scans_of, verdict_of)
        return
    from aadm_workbench.assembly.mould.moulds import foot_of

    learn(columns, scans_of, verdict_of, foot_of)


def _mould_drift(columns: Sequence[ColumnReport], profile: Profile) -> tuple[MouldDrift, ...]:
    if len(columns) < 2:  # one says nothing about its mould
        return ()
    from aadm_workbench.assembly.mould.moulds import assess_moulds

    return assess_moulds(columns, profile)


def job_entry(plan: JobPlan) -> dict[str, str]:
    """What reports say about the job, and how it was run."""
    settings = plan.settings
    return {
        "name": plan.job.name,
        "sha256": plan.job.sha256,
        "units": plan.job.units,
        "method": settings.method,
        "decision": settings.decision,
        "seed": str(settings.seed),
        **({} if plan.job.stack is None else {"stack": plan.job.stack.text}),
    }


def tool_entry() -> dict[str, str]:
    """What reports say about the program: its version and those of the packages that the numbers come from."""
    found = {"name": "aadm", "version": __version__}
    for name in _NUMERICAL_PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:  # installed under another name
            continue
    return found
