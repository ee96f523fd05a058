"""The hoisting frames of a column: each is measured by itself, with what the scans before hoisting have told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.hoisting.aim import aimed
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.sequence.contradiction import contradiction_of
from aadm_workbench.hoisting.sequence.joint import measure_jointly
from aadm_workbench.hoisting.sequence.sighting import SightedMeasurement
from aadm_workbench.hoisting.turn_findings import with_contradiction
from aadm_workbench.inspection.tasks import ColumnTask, Stopwatch
from aadm_workbench.model import (
    AimedPose,
    AssemblyPoint,
    ColumnDesign,
    ColumnReport,
    GroupReport,
    HoistingMeasurement,
    HoistingReport,
    Kind,
    Scan,
    Verdict,
)
from aadm_workbench.model.reason import renamed

Points = tuple[AssemblyPoint | None, ...] | None


@dataclass(frozen=True, eq=False)
class Before:
    """Where sleeves and bars were measured before hoisting, in the column frame, in the order of the design.

    None where nothing was measured, or where it is open which is which. ``target`` is where the crane is to set the
    column.
    """

    sleeves: Points = None
    rebars: Points = None
    target: AimedPose | None = None

    @classmethod
    def of(cls, report: ColumnReport) -> Before:
        """What the scans before hoisting have told of a column."""
        trial = report.trial_assembly
        target = None if trial is None else trial.target
        return cls(_points(Kind.SLEEVE, report.sleeves), _points(Kind.REBAR, report.rebars), target)


def measure_frames(
    task: ColumnTask, design: ColumnDesign, report: ColumnReport, watch: Stopwatch
) -> tuple[tuple[HoistingReport, ...], HoistingReport | None]:
    """Measure the hoisting frames that a job names for a column; a broken one costs itself alone.

    Beside the frames stands what they tell together, where two and more do.
    """
    column, before = task.column, Before.of(report)
    corners = column.hoisting_near or (column.near,) * len(column.hoisting)
    measured: list[HoistingMeasurement | HoistingReport] = []
    for name, near in zip(column.hoisting, corners, strict=True):
        try:
            with watch.stage("read"):
                scan = task.read(name)
        except AadmError as error:
            reason = renamed(error.reason, str(task.path_of(name)), name)
            measured.append(unread(name, reason, task.settings.method))
            continue
        with watch.stage("hoisting"):
            measured.append(measure_frame(task, design, scan, near, before))
    frames = [frame for frame in measured if isinstance(frame, HoistingMeasurement)]
    reports = _held_against_each_other(measured, design)
    with watch.stage("hoisting"):
        joint = None if _contradict(reports) else join_frames(task, design, frames, before)
    return reports, None if joint is None else joint.report


def measure_frame(
    task: ColumnTask,
    design: ColumnDesign,
    scan: Scan,
    near: tuple[int, int] | None,
    before: Before,
    after: HoistingMeasurement | None = None,
) -> HoistingMeasurement:
    """Measure one frame by the settings of its column's task; its correction leads to where the column is to be set.

    It begins where the frame ``after`` which it follows ended, if it does follow it.
    """
    measured = _measured(task, design, scan, near, before, after)
    return replace(measured, report=aimed(measured.report, before.target))


def _measured(
    task: ColumnTask,
    design: ColumnDesign,
    scan: Scan,
    near: tuple[int, int] | None,
    before: Before,
    after: HoistingMeasurement | None,
) -> HoistingMeasurement:
    settings = task.settings
    if settings.method != "refined":
        from aadm_workbench.hoisting.published import measure_published

        rng = np.random.default_rng(settings.seed)
        return measure_published(scan, design, settings.method, near=near, rng=rng, profile=settings.profile)
    return measure_hoisting(
        scan,
        design,
        near=near,
        sleeves_before=before.sleeves,
        rebars_before=before.rebars,
        settings=HoistingSettings(settings.profile, settings.decision, seed=settings.seed),
        after=after.sighting if isinstance(after, SightedMeasurement) else None,
    )


def join_frames(
    task: ColumnTask, design: ColumnDesign, frames: Sequence[HoistingMeasurement], before: Before
) -> HoistingMeasurement | None:
    """What frames of a column tell together, in the bars' frame of the last one; None where they tell no more."""
    joint = measure_jointly(frames, design, task.settings.profile, task.settings.decision)
    return None if joint is None else replace(joint, report=aimed(joint.report, before.target))


def _contradict(reports: Sequence[HoistingReport]) -> bool:
    return any(finding.holds_back for report in reports for finding in report.findings)


def unread(name: str, reason: str, method: str) -> HoistingReport:
    """The report on a frame that could not be read."""
    return HoistingReport(name, (), None, None, None, Verdict.ERROR, reasons=(reason,), method=method)


def _held_against_each_other(
    measured: list[HoistingMeasurement | HoistingReport], design: ColumnDesign
) -> tuple[HoistingReport, ...]:
    """The reports of a column's frames; those that contradict each other show no way to push."""
    reports = [frame if isinstance(frame, HoistingReport) else frame.report for frame in measured]
    for (i, first), (j, second) in combinations(enumerate(measured), 2):
        if isinstance(first, HoistingReport) or isinstance(second, HoistingReport):
            continue
        finding = contradiction_of(first, second, design)
        if finding is not None:
            reports[i], reports[j] = (with_contradiction(reports[k], finding) for k in (i, j))
    return tuple(reports)


def _points(kind: Kind, group: GroupReport | None) -> Points:
    if group is None or group.fit is None or group.fit.orientation == "ambiguous":
        return None
    points: list[AssemblyPoint | None] = []
    for point in group.points:
        if point.aligned_mm is None:
            points.append(None)
            continue
        u_mm = 0.1 if point.u_mm is None else point.u_mm
        covariance = np.diag([u_mm**2, u_mm**2, u_mm**2])
        up = np.array([0.0, 0.0, 1.0])
        centre = np.array(point.aligned_mm, np.float64)
        points.append(AssemblyPoint(point.label, kind, centre, up, point.diameter_mm or 0.0, covariance))
    return tuple(points)
