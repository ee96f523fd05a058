"""Where in its play to set a column so that its top comes nearest to the grid."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.pose.planar import planar_matrix, planar_of
from aadm_workbench.assembly.pose.play import nearest_to, play_limits
from aadm_workbench.model import Array, Verdict
from aadm_workbench.report.words.labels import phrase
from aadm_workbench.stack.result import StackedColumn
from aadm_workbench.stack.set_pose import turned_by
from aadm_workbench.stack.torsor import Torsor, carried_to

WORTH_MM = 0.05
"""A displacement below this would be told as 0.0 mm."""


def chosen_aim(stacked: StackedColumn, ground: Torsor) -> tuple[Array, Array] | None:
    """The pose on the bars that leads the top of a column back to the grid, and the same from the trial's pose.

    Both (3,), dx, dy mm and yaw radians; None where nothing is known of its play.

    Parameters
    ----------
    ground
        Where the bars stand, against the grid.
    """
    column, height_mm = stacked.measured, stacked.height_mm
    limits = play_limits(column.gaps) if column.goes_on is Verdict.PASS else None
    if limits is None or column.T_bars_sleeves is None or height_mm is None:
        return None
    top = ground.through(carried_to(np.array([0.0, 0.0, height_mm]))).values
    trial = planar_of(column.T_bars_sleeves)
    # A column that is set turned by its symmetry moves in a frame that is turned against its design.
    turn = planar_matrix(np.array([0.0, 0.0, turned_by(trial, column.turn_deg)]))
    upright = planar_matrix(trial) @ np.linalg.inv(turn)
    wanted = np.linalg.inv(planar_matrix(top[[0, 1, 5]]) @ upright)
    moved = planar_matrix(nearest_to(limits, planar_of(turn.T @ wanted @ turn), column.radius_mm or height_mm))
    moved = turn @ moved @ turn.T
    return planar_of(upright @ moved), planar_of(moved)


def is_worth(moved: Array, radius_mm: float | None) -> bool:
    """Whether a displacement is one that a crew could make."""
    return bool(max(math.hypot(moved[0], moved[1]), abs(moved[2]) * (radius_mm or 0.0)) >= WORTH_MM)


def without_advice(stacked: StackedColumn, why: str) -> StackedColumn:
    """A column with the reason why no better pose is told for it."""
    return replace(stacked, reasons=(*stacked.reasons, phrase(f"stack.{why}")))
