"""Where in its play a column is guided to: the pose that a job asks for, as far as every limit is kept."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.pose.planar import in_degrees, planar_matrix, planar_of
from aadm_workbench.assembly.pose.play import pair_gaps, play_limits, within
from aadm_workbench.model import AimedPose, Array, ColumnReport, GroupReport, PointResult, TrialReport, Vector3, Verdict


def with_aim(report: ColumnReport, set_pose: Vector3 | None) -> ColumnReport:
    """A column's report with the pose that its crane is guided to, where its trial passes and the job asks for one.

    Parameters
    ----------
    set_pose
        dx, dy mm and yaw degrees of the column from where its bars have it by design: turned by yaw about the origin
        of the column frame, then moved.
    """
    trial = report.trial_assembly
    if set_pose is None or trial is None or report.sleeves is None or report.rebars is None:
        return report
    aim = _aim(trial, _points(report.sleeves), _points(report.rebars), set_pose)
    return report if aim is None else replace(report, trial_assembly=replace(trial, target=aim))


def _aim(
    trial: TrialReport, sleeves: Mapping[str, PointResult], rebars: Mapping[str, PointResult], asked: Vector3
) -> AimedPose | None:
    if trial.best is None or trial.minimax is None or trial.verdict is not Verdict.PASS or trial.turn_deg:
        return None
    rows = [
        (gap, _place(sleeves[pair.sleeve]))
        for pair in trial.best.pairs
        for gap in pair_gaps(pair, [_lean(rebars[pair.rebar]), _lean(sleeves[pair.sleeve])], trial.embedded_length_mm)
    ]
    limits = play_limits(rows)
    if limits is None:
        return None
    best, minimax = (
        planar_matrix(planar_of(np.asarray(np.linalg.inv(pose.T_sleeves_rebars))))
        for pose in (trial.best, trial.minimax)
    )
    wanted = planar_matrix(np.array([asked[0], asked[1], math.radians(asked[2])]))
    moved = within(limits, planar_of(np.asarray(np.linalg.inv(best) @ wanted)))
    reached = best @ planar_matrix(moved)
    dx, dy, yaw_deg = in_degrees(planar_of(reached))
    centres = limits.gaps(moved)[[k for k, (gap, _) in enumerate(rows) if gap.is_of_centres]]
    return AimedPose(
        dx_mm=dx,
        dy_mm=dy,
        yaw_deg=yaw_deg,
        asked=asked,
        max_mm=_longest(centres),
        from_minimax=in_degrees(planar_of(reached @ np.linalg.inv(minimax))),
    )


def _points(group: GroupReport) -> Mapping[str, PointResult]:
    return {point.label: point for point in group.points}


def _place(point: PointResult) -> Array:
    return np.array((point.aligned_mm or point.design_mm)[:2])


def _lean(point: PointResult) -> Array | None:
    return None if point.axis is None else np.array(point.axis[:2]) / point.axis[2]


def _longest(vectors: Array | Sequence[Array]) -> float:
    return float(np.hypot(*np.transpose(vectors)).max()) if len(vectors) else 0.0
