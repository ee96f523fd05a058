"""The hoisting frames of a column: each is measured by itself, with what the scans before hoisting have told."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.hoisting.contradiction import contradiction_of
from aadm_workbench.hoisting.turn_findings import with_contradiction
from aadm_workbench.model import (
    AssemblyPoint,
    ColumnDesign,
    ColumnReport,
    GroupReport,
    HoistingMeasurement,
    HoistingReport,
    Scan,
    Verdict,
)
from aadm_workbench.model.reason import renamed

if TYPE_CHECKING:
    from ..stopwatch import Stopwatch
    from .task import ColumnTask

Before = tuple[AssemblyPoint | None, ...] | None


def measure_frames(task: ColumnTask, report: ColumnReport, watch: Stopwatch) -> tuple[HoistingReport, ...]:
    """Measure the hoisting frames that a job names for a column; a broken one costs itself alone."""
    if task.design is None:
        return ()
    column = task.column
    corners = column.hoisting_near or (column.near,) * len(column.hoisting)
    named = zip(column.hoisting, corners, strict=True)
    measured = [_measured(task, task.design, name, near, report, watch) for name, near in named]
    return _held_against_each_other(measured, task.design)


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


def before_hoisting(group: GroupReport | None) -> Before:
    """Where sleeves or bars were measured before hoisting, in the column frame, in the order of the design.

    None where nothing was measured, or where it is open which is which.
    """
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
        points.append(AssemblyPoint(point.label, group.kind, centre, up, point.diameter_mm or 0.0, covariance))
    return tuple(points)


def read_frame(task: ColumnTask, path: Path, name: str) -> Scan:
    """Read one hoisting frame as the column's job declares its scans; ``name`` is what reports call it."""
    from aadm_workbench.scan.read import read_scan

    return read_scan(
        path,
        units=task.units,
        camera=task.camera,
        depth_scale_mm=task.depth_scale_mm,
        source=name,
        axes=task.column.axes,
    )


def _measured(
    task: ColumnTask,
    design: ColumnDesign,
    name: str,
    near: tuple[int, int] | None,
    report: ColumnReport,
    watch: Stopwatch,
) -> HoistingMeasurement | HoistingReport:
    """A frame as it was measured; the report alone of one that could not be read."""
    from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting

    settings = task.settings
    try:
        with watch.stage("read"):
            scan = read_frame(task, task.path_of(name), name)
    except AadmError as error:
        message = renamed(error.reason, str(task.path_of(name)), name)
        return HoistingReport(name, (), None, None, None, Verdict.ERROR, reasons=(message,), method=settings.method)
    with watch.stage("hoisting"):
        if settings.method != "refined":
            from aadm_workbench.hoisting.published import measure_published

            rng = np.random.default_rng(settings.seed)
            return measure_published(scan, design, settings.method, near=near, rng=rng, profile=settings.profile)
        return measure_hoisting(
            scan,
            design,
            near=near,
            sleeves_before=before_hoisting(report.sleeves),
            rebars_before=before_hoisting(report.rebars),
            settings=HoistingSettings(settings.profile, settings.decision, seed=settings.seed),
        )
