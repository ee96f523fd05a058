"""One column of a job, from files to report: a pure function of its task, so that any process can do it.

Whatever goes wrong with a column costs that column alone: its verdict is then ``error``, with the reason.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Generic, TypeVar

from aadm_workbench.check import ColumnScans, check_column
from aadm_workbench.design.recognise.extent import extent_mm
from aadm_workbench.errors import AadmError, DesignError
from aadm_workbench.model import ColumnDesign, ColumnReport, Kind, Reason, Scan, Verdict
from aadm_workbench.model.reason import reason_of, renamed
from aadm_workbench.scan.plausible import check_plausible
from aadm_workbench.scan.read import read_scan

from ..job.column_files import files_of
from ..stopwatch import Stopwatch
from .hoisting_task import measure_frames
from .task import ColumnTask

Result = TypeVar("Result")

_NO_MEMORY = Reason("run.no_memory")
_WITHOUT_MEMORY = ("Insufficient memory", "bad_alloc")  # as OpenCV and C++ say it


@dataclass(frozen=True, eq=False)
class ColumnOutcome:
    """A column's report, the seconds that its stages took, and where an error that nobody foresaw came from."""

    report: ColumnReport
    seconds: dict[str, float] = field(default_factory=dict)
    where: str = ""


@dataclass(frozen=True, eq=False)
class Attempt(Generic[Result]):
    """What work on a column came to: its ``result``, or ``error``, the report on why there is none."""

    result: Result | None
    error: ColumnReport | None
    seconds: dict[str, float]
    where: str = ""


def attempt(task: ColumnTask, work: Callable[[ColumnTask, Stopwatch], Result]) -> Attempt[Result]:
    """Do some work on a column; whatever goes wrong becomes a report with the verdict ``error``."""
    watch = Stopwatch()
    result, error_found, where = None, None, ""
    with watch.stage("total"):
        try:
            result = work(task, watch)
        except MemoryError:
            error_found = error_report(task, _NO_MEMORY)
        except (AadmError, OSError) as error:
            error_found = error_report(task, _as_named(task, reason_of(error) or type(error).__name__))
        except Exception as error:  # noqa: BLE001 - a night's batch must not end at one column
            reason = Reason("run.internal", error=_as_named(task, _described(error)))
            if any(words in str(error) for words in _WITHOUT_MEMORY):
                reason = _NO_MEMORY
            error_found, where = error_report(task, reason), traceback.format_exc()
    return Attempt(result, error_found, watch.seconds(), where)


def check_task(task: ColumnTask) -> ColumnOutcome:
    """Read a column's scans and check it; errors become its verdict."""
    done = attempt(task, _checked)
    report = done.result or done.error or error_report(task, Reason("run.not_checked"))
    return ColumnOutcome(report, done.seconds, done.where)


def killed(task: ColumnTask, reason: str) -> ColumnOutcome:
    """The outcome for a column whose process was killed."""
    return ColumnOutcome(error_report(task, reason))


def error_report(task: ColumnTask, reason: str) -> ColumnReport:
    """The report on a column that could not be checked."""
    report = ColumnReport(task.column.id, Verdict.ERROR, Verdict.NOT_ASSESSED, (reason,))
    return report if task.design is None else _identified(report, task.design)


def _checked(task: ColumnTask, watch: Stopwatch) -> ColumnReport:
    if task.design is None:
        raise DesignError(task.no_design)
    if not task.column.sleeves and not task.column.rebars:
        reason = Reason("run.no_scan")
        report = ColumnReport(task.column.id, Verdict.NOT_MEASURED, Verdict.NOT_ASSESSED, (reason,))
        report = _identified(report, task.design)
        return replace(report, hoisting=measure_frames(task, report, watch))
    with watch.stage("read"):
        scans = read_scans(task, task.design)
    report = check_column(task.design, scans, task.settings, watch.stage)
    return replace(report, id=task.column.id, hoisting=measure_frames(task, report, watch))


def _identified(report: ColumnReport, design: ColumnDesign) -> ColumnReport:
    return replace(
        report,
        global_id=design.global_id,
        piece_mark=design.piece_mark,
        storey=design.storey,
        grid=design.grid,
        size_mm=design.size_mm,
        T_model_column=design.T_model_column,
        notes=design.warnings,
    )


def read_scans(task: ColumnTask, design: ColumnDesign) -> ColumnScans:
    """The scans that the job names for a column.

    Raises
    ------
    AadmError
        Where one of them cannot be read, or cannot be a scan of this column.
    """
    column = task.column
    return ColumnScans(
        sleeves=_group(task, design, Kind.SLEEVE, column.sleeves, column.sleeves_image),
        rebars=_group(task, design, Kind.REBAR, column.rebars, column.rebars_image),
        sleeves_up_deg=column.sleeves_up_deg,
        rebars_up_deg=column.rebars_up_deg,
        control_points=column.control_points,
        others=task.others,
    )


def _group(
    task: ColumnTask, design: ColumnDesign, kind: Kind, names: tuple[str, ...], image: str | None
) -> tuple[Scan, ...]:
    """The scans of one kind of point; a grey picture belongs to the first view."""
    if not names:
        return ()
    if not design.points(kind):
        raise DesignError(Reason("run.no_group", kind=kind.plural, names=names[0]))
    longest_mm = extent_mm(design.points(kind))
    scans = []
    for number, name in enumerate(names):
        scan = read_scan(
            task.path_of(name),
            units=task.units,
            camera=task.camera,
            depth_scale_mm=task.depth_scale_mm,
            source=name,
            image=task.path_of(image) if image is not None and number == 0 else None,
            axes=task.column.axes,
        )
        scans.append(check_plausible(scan, longest_mm))
    return tuple(scans)


def _as_named(task: ColumnTask, message: str) -> str:
    """A message with files called as the job calls them: where a job lies must not show in its report."""
    for name in files_of(task.column):
        message = renamed(message, str(task.path_of(name)), name)
    return message


def _described(error: Exception) -> str:
    return f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
