"""Where a column comes to stand against the bars under it: from its trial, or from the frame it hangs in."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from aadm_workbench.assembly.pose.planar import planar_of
from aadm_workbench.model import Array, Verdict
from aadm_workbench.stack.measured import MeasuredColumn, rigid_motion

Origin = Literal["trial", "told", "hoisting"]


@dataclass(frozen=True, eq=False)
class OnBars:
    """Displacement of a column from where its bars have its design place: ``planar`` (3,) dx, dy mm, yaw radians.

    ``covariance`` (3, 3) is what the measurement of the pairs leaves open; ``origin`` says what it was taken from.
    """

    planar: Array
    covariance: Array
    origin: Origin


def pose_on_bars(column: MeasuredColumn) -> OnBars | None:
    """The displacement of a column that goes on its bars; None where it does not, or nobody knows.

    A good hoisting frame is the last word; else the column goes where the job told it to go, else where the trial
    leaves most of its limits.
    """
    if column.T_bars_sleeves is None or column.goes_on not in (Verdict.PASS, Verdict.INCONCLUSIVE):
        return None
    if column.hung is not None:
        hung = column.hung
        planar = rigid_motion(hung.sleeves, hung.over, hung.u_mm**-2.0)
        return OnBars(_unturned(planar, column.turn_deg), _scatter(hung.sleeves, hung.u_mm), "hoisting")
    known = [pair for pair in column.pairs if pair.u_mm]
    covariance = np.zeros((3, 3))
    if len(known) > 1:
        covariance = _scatter(np.array([pair.place for pair in known]), np.array([pair.u_mm for pair in known]))
    if column.told is not None:
        dx, dy, yaw_deg = column.told
        return OnBars(np.array([dx, dy, math.radians(yaw_deg)]), covariance, "told")
    return OnBars(_unturned(planar_of(column.T_bars_sleeves), column.turn_deg), covariance, "trial")


def turned_by(planar: Array, turn_deg: float) -> float:
    """The turn, radians, by which a symmetric column was chosen to be set: of both signs the one that explains more."""
    turns = (math.radians(turn_deg), -math.radians(turn_deg))
    return min(turns, key=lambda turn: abs(math.remainder(planar[2] - turn, math.tau)))


def _unturned(planar: Array, turn_deg: float) -> Array:
    """The displacement without that turn: the rest of it is small."""
    rest = math.remainder(planar[2] - turned_by(planar, turn_deg), math.tau)
    return np.array([planar[0], planar[1], rest])


def _scatter(places: Array, u_mm: Array) -> Array:
    """Covariance (3, 3) of a least squares motion of points (n, 2) known with ``u_mm`` (n,) per axis.

    The inverse of Σ JᵀJ/u², with J = [[1, 0, −y], [0, 1, x]].
    """
    information = np.zeros((3, 3))
    for (x, y), u in zip(places, u_mm, strict=True):
        jacobian = np.array([[1.0, 0.0, -y], [0.0, 1.0, x]])
        information += jacobian.T @ jacobian / u**2
    return np.asarray(np.linalg.pinv(information))
