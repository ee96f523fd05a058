"""What the crane must do: the move of the column that leaves the smallest largest distance, and how sure it is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, turn
from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.assembly.pose.minimax_spread import minimax_covariance
from aadm_workbench.hoisting.offsets import HungFit, Offsets
from aadm_workbench.model import BoolArray, CameraMove, Correction, Rule

_KNOWN_MM, _FEWEST_DECIDE = 0.25, 3  # as well as what is seen (hoisting/bars/fit.py); a pose has three unknowns


def correction_of(hung: HungFit, found: Offsets, rule: Rule | None, labels: Sequence[str]) -> Correction | None:
    """The move of the column that leaves the smallest largest distance, and how sure it is."""
    foot = hung.foot
    across = found.to_bars[:2] @ hung.face.axes[:2].T
    source = (foot.centres - foot.pose[:2]) @ across.T
    limit_mm = 1.0 if rule is None else rule.upper
    target = source + found.offsets
    known = np.flatnonzero(_well_known(hung, found))
    pose = fit_minimax(source[known], target[known], np.full(len(known), limit_mm))
    if isinstance(pose, NoFit):
        return None
    rows = (2 * known[:, None] + np.arange(2)).ravel()
    generator = np.random.default_rng(0)  # the same frame is reported alike
    covariance = found.covariance[np.ix_(rows, rows)]
    spread = minimax_covariance(source[known], target[known], covariance, pose, generator)
    left_mm = float(np.hypot(*(source @ turn(pose.yaw).T + pose.shift - target).T).max())
    move = pose.shift @ found.to_bars[:2]
    ahead = np.array([0.0, 0.0, 1.0]) - found.to_bars[2, 2] * found.to_bars[2]
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, found.to_bars[2])
    yaw_deg = float(np.degrees(pose.yaw))
    return Correction(
        dx_mm=float(pose.shift[0]),
        dy_mm=float(pose.shift[1]),
        yaw_deg=yaw_deg,
        left_mm=left_mm,
        margin=None if rule is None else 1.0 - left_mm / limit_mm,
        u_mm=float(np.sqrt(np.trace(spread[:2, :2]) / 2.0)),
        u_yaw_deg=float(np.degrees(np.sqrt(spread[2, 2]))),
        camera=CameraMove(float(move @ right), float(move @ ahead), yaw_deg),
        over=tuple(labels[k] for k in known.tolist()),
    )


def _well_known(hung: HungFit, found: Offsets) -> BoolArray:
    """Pairs (k,) that decide the move: those that are seen, or known closely from before hoisting; at least three."""
    spread_mm = np.sqrt(np.diag(found.covariance).reshape(-1, 2).mean(axis=1))
    known = hung.seen | (spread_mm < _KNOWN_MM)
    return known if known.sum() >= _FEWEST_DECIDE else np.ones(len(known), bool)
