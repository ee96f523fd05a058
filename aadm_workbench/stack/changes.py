"""What changed between two reports of where columns come to stand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.planar import in_degrees
from aadm_workbench.model import Array, Vector3
from aadm_workbench.stack.measured import MeasuredColumn, MeasuredFloor
from aadm_workbench.stack.set_pose import pose_on_bars

COVERAGE = 2.45
"""Of the standard uncertainty per axis of a move in the plan: 95 % of those that did not move stay within (χ², two)."""


@dataclass(frozen=True)
class SetChange:
    """A column that comes to stand elsewhere: dx, dy mm and yaw degrees before and after, None where it is not known.

    ``moved_mm`` is the way of its foot, ``u_mm`` its standard uncertainty per axis; None where one of the two is not
    known, or one is told against the grid and the other against the column's bars.
    """

    id: str
    from_pose: Vector3 | None
    to_pose: Vector3 | None
    moved_mm: float | None
    u_mm: float | None


def set_changes(before: MeasuredFloor, after: MeasuredFloor) -> tuple[SetChange, ...]:
    """Columns that come to stand elsewhere than the uncertainty of the scans explains, in the order of the later."""
    first = {column.id: column for column in before.columns}
    both = [_change(first[column.id], column) for column in after.columns if column.id in first]
    return tuple(change for change in both if change is not None)


def _change(before: MeasuredColumn, after: MeasuredColumn) -> SetChange | None:
    (start, u_start), (end, u_end) = (_standing(column) for column in (before, after))
    poses = [None if pose is None else in_degrees(pose) for pose in (start, end)]
    if start is None or end is None:
        return None if start is None and end is None else SetChange(after.id, poses[0], poses[1], None, None)
    if (before.ground is None) is not (after.ground is None):
        return SetChange(after.id, poses[0], poses[1], None, None)
    moved_mm, u_mm = float(np.hypot(*(end - start)[:2])), math.hypot(u_start, u_end)
    return SetChange(after.id, poses[0], poses[1], moved_mm, u_mm) if moved_mm > COVERAGE * u_mm else None


def _standing(column: MeasuredColumn) -> tuple[Array | None, float]:
    """(3,) dx, dy mm and yaw radians of a column, against the grid where it is tied to it, and u per axis, mm."""
    on_bars = pose_on_bars(column)
    if on_bars is None:
        return None, 0.0
    covariances: Sequence[Array] = [on_bars.covariance]
    planar = on_bars.planar
    if column.ground is not None:
        planar, covariances = planar + column.ground.planar, [*covariances, column.ground.covariance]
    return planar, math.sqrt(sum(float(one[0, 0] + one[1, 1]) / 2.0 for one in covariances))
