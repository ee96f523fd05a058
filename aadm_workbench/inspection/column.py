"""One column, from files to report: a pure function of its task, so that any process can do it.

Whatever goes wrong with a column costs that column alone: its verdict is then ``error``, with the reason.
"""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

from aadm_workbench.errors import AadmError, DesignError
from aadm_workbench.inspection.check import check_column, report_on
from aadm_workbench.inspection.measure import ColumnScans
from aadm_workbench.inspection.tasks import ColumnTask, Stopwatch
from aadm_workbench.model import ColumnDesign, ColumnReport, Kind, Reason, Scan, Verdict
from aadm_workbench.model.reason import reason_of, renamed
from aadm_workbench.scan.plausible import check_plausible, extent_mm

_WITHOUT_MEMORY = ("Insufficient memory", "bad_alloc")  # as OpenCV and C++ say it


@dataclass(eq=False)
class ColumnOutcome:
    """A column's report, the seconds that its stages took, and where an error that nobody foresaw came from."""

    report: ColumnReport
    seconds: dict[str, float] = field(default_factory=dict)
    where: str = ""


def inspect_column(task: ColumnTask) -> ColumnOutcome:
    """Read a column's scans, check it, and measure its hoisting frames; errors become its verdict."""
    with attempt(task) as (outcome, watch):
        if task.design is None:
            raise DesignError(task.no_design)
        if task.column.sleeves or task.column.rebars:
            with watch.stage("read"):
                scans = read_scans(task, task.design)
            report = check_column(task.design, scans, task.settings, watch.stage)
            report = replace(report, id=task.column.id)
            if task.column.set_pose is not None:
                from aadm_workbench.assembly.trial.aim import with_aim

                report = with_aim(report, task.column.set_pose)
        else:
            report = _bare_report(task, Verdict.NOT_MEASURED, Reason("run.no_scan"))
        if task.column.hoisting:
            from aadm_workbench.inspection.hoisting import measure_frames

            frames, joint = measure_frames(task, task.design, report, watch)
            report = replace(report, hoisting=frames, hoisting_joint=joint)
        outcome.report = report
    return outcome


@contextmanager
def attempt(task: ColumnTask) -> Iterator[tuple[ColumnOutcome, Stopwatch]]:
    """Do some work on a column; whatever goes wrong becomes the outcome, a report with the verdict ``error``."""
    outcome, watch = lost(task, ""), Stopwatch()  # until there is a report, or what went wrong
    try:
        with watch.stage("total"):
            yield outcome, watch
    except MemoryError:
        outcome.report = lost(task, Reason("run.no_memory")).report
    except (AadmError, OSError) as error:
        outcome.report = lost(task, _as_named(task, reason_of(error) or type(error).__name__)).report
    except Exception as error:  # noqa: BLE001 - a night's batch must not end at one column
        described = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        reason = Reason("run.internal", error=_as_named(task, described))
        if any(words in str(error) for words in _WITHOUT_MEMORY):
            reason = Reason("run.no_memory")
        outcome.report, outcome.where = lost(task, reason).report, traceback.format_exc()
    outcome.seconds = watch.seconds()


def lost(task: ColumnTask, reason: str) -> ColumnOutcome:
    """The outcome for a column that could not be checked, or whose process was killed."""
    return ColumnOutcome(_bare_report(task, Verdict.ERROR, reason))


def _bare_report(task: ColumnTask, verdict: Verdict, reason: str) -> ColumnReport:
    if task.design is None:
        return ColumnReport(task.column.id, verdict, Verdict.NOT_ASSESSED, (reason,))
    return replace(report_on(task.design, verdict, Verdict.NOT_ASSESSED, (reason,)), id=task.column.id)


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
    images = (image, *[None] * len(names))
    read = (task.read(name, image=picture) for name, picture in zip(names, images, strict=False))
    return tuple(check_plausible(scan, longest_mm) for scan in read)


def _as_named(task: ColumnTask, message: str) -> str:
    """A message with files called as the job calls them: where a job lies must not show in its report."""
    for name in task.column.files():
        message = renamed(message, str(task.path_of(name)), name)
    return message
