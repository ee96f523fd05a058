"""What the crane must do: the move of the column that leaves the smallest largest distance, and how sure it is.

How much a pair has to say falls smoothly with what is not known of it, and with how far it stands off from where all
others go together: its distance counts by a share of 1 to 0. So a hair's breadth of noise moves no pair in or out, and
the move is a continuous function of the frame. A bar that no move brings to its sleeve together with the others is
bent: it gets a repair, and the others have a move of their own.
"""

from __future__ import annotations

from itertools import compress

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, robust_offsets, turn
from aadm_workbench.assembly.pose.minimax import MinimaxPose, fit_minimax
from aadm_workbench.assembly.pose.minimax_spread import minimax_covariance
from aadm_workbench.design.recognise.pattern import side_labels
from aadm_workbench.hoisting.offsets import HungFit, Offsets
from aadm_workbench.model import Array, Bend, BoolArray, CameraMove, ColumnDesign, Correction, IntArray, Repair, Rule

# u per axis: up to three times that of a usual pair one decides wholly; from that of a place by design on, with 0.5 mm
# of scatter, it does not
_KNOWN_MM, _UNKNOWN_MM = 0.15, 0.45
_FEWEST_DECIDE = 3  # a pose has three unknowns
# limits between a pair and where the others go together: up to two a move in the middle keeps both; and one more, so
# that noise is not to decide
_REACHED_LIMITS, _BENT_LIMITS = 2.0, 3.0
_LEAST_SHARE = 0.02  # a distance of less counts as none: another of a fiftieth of it would have to be the largest
_LEAST_BEND_MM = 0.05  # a part of a bend that is less would be told as 0.0 mm
_DECIDES_SHARE = 0.5  # of those that are named as deciding
# of the pairs: with more nobody can say which of them are the others; from half of them on,
# all do
_BENT_AT_MOST, _ASTRAY = 1 / 3, 1 / 2


def correction_of(hung: HungFit, found: Offsets, rule: Rule | None, design: ColumnDesign) -> Correction | None:
    """The move of the column that leaves the smallest largest distance, and how sure it is."""
    foot = hung.foot
    across = found.to_bars[:2] @ hung.face.axes[:2].T
    source = (foot.centres - foot.pose[:2]) @ across.T
    target = source + found.offsets
    limit_mm = 1.0 if rule is None else rule.upper
    shares = _known_shares(found.covariance)
    deciding, limits_mm, pose = _moved(source, target, shares, limit_mm)
    rigid = np.ones(len(shares))
    if rule is not None and isinstance(pose, MinimaxPose) and pose.ratio > 1.0:
        rigid = _rigid_shares(source, target, shares, limit_mm)
        shares = shares * rigid
        deciding, limits_mm, pose = _moved(source, target, shares, limit_mm)
    if isinstance(pose, NoFit):
        return None
    rows = (2 * deciding[:, None] + np.arange(2)).ravel()
    generator = np.random.default_rng(0)  # the same frame is reported alike
    covariance = found.covariance[np.ix_(rows, rows)]
    spread = minimax_covariance(source[deciding], target[deciding], covariance, pose, generator, limits_mm)
    left = source @ turn(pose.yaw).T + pose.shift - target
    bent = (rigid < _DECIDES_SHARE) & (np.hypot(*left.T) > limit_mm)
    left_mm = float(np.hypot(*left.T).max())
    return Correction(
        dx_mm=float(pose.shift[0]),
        dy_mm=float(pose.shift[1]),
        yaw_deg=float(np.degrees(pose.yaw)),
        left_mm=left_mm,
        margin=None if rule is None else 1.0 - left_mm / limit_mm,
        u_mm=float(np.sqrt(np.trace(spread[:2, :2]) / 2.0)),
        u_yaw_deg=float(np.degrees(np.sqrt(spread[2, 2]))),
        camera=_seen_from_camera(pose, found.to_bars),
        over=tuple(compress((sleeve.label for sleeve in design.sleeves), shares >= _DECIDES_SHARE)),
        repairs=_repairs(design, left, bent),
    )


def _moved(source: Array, target: Array, shares: Array, limit_mm: float) -> tuple[IntArray, Array, MinimaxPose | NoFit]:
    """Which pairs (m,) have something to say, their limits by that, and the pose that they decide."""
    deciding = np.flatnonzero(shares > _LEAST_SHARE)
    limits_mm = limit_mm / shares[deciding]
    return deciding, limits_mm, fit_minimax(source[deciding], target[deciding], limits_mm)


def _known_shares(covariance: Array) -> Array:
    """How much pairs (k,) have to say by what is known of them; the three that are known best, all."""
    spread_mm = np.sqrt(np.diag(covariance).reshape(-1, 2).mean(axis=1))
    third_mm = float(np.sort(spread_mm)[min(_FEWEST_DECIDE, len(spread_mm)) - 1])
    wider = max(1.0, third_mm / _KNOWN_MM)
    return _falling(np.log(spread_mm), np.log(wider * _KNOWN_MM), np.log(wider * _UNKNOWN_MM))


def _rigid_shares(source: Array, target: Array, known: Array, limit_mm: float) -> Array:
    """How much pairs (k,) have to say by how far they stand from where most go together."""
    off_mm = np.hypot(*robust_offsets(target, source).T)
    shares = _falling(off_mm, _REACHED_LIMITS * limit_mm, _BENT_LIMITS * limit_mm)
    # with too many that stand off, nobody knows where the others go together: then all count again
    astray = float(known @ (1.0 - shares) / known.sum())
    return 1.0 - (1.0 - shares) * float(_falling(np.array(astray), _BENT_AT_MOST, _ASTRAY))


def _falling(values: Array, begin: float, end: float) -> Array:
    """From 1 up to ``begin`` to 0 from ``end`` on, without a step or a kink."""
    way = np.clip((values - begin) / (end - begin), 0.0, 1.0)
    return np.asarray(1.0 - way**2 * (3.0 - 2.0 * way))


def _repairs(design: ColumnDesign, left: Array, bent: BoolArray) -> tuple[Repair, ...]:
    """How far the bars that are bent are from their sleeves after the move, which leaves the pairs ``left`` (k, 2)."""
    chosen = np.flatnonzero(bent).tolist()
    told = [(design.rebars[k].label, float(left[k, 0]), float(left[k, 1])) for k in chosen]
    return tuple(Repair(label, dx_mm, dy_mm, _towards(design, dx_mm, dy_mm)) for label, dx_mm, dy_mm in told)


def _towards(design: ColumnDesign, dx_mm: float, dy_mm: float) -> tuple[Bend, ...]:
    """A bend as parts towards sides of the pattern, named by the bars that stand there."""
    places = {bar.label: bar.centre.tolist() for bar in design.rebars}
    parts = ((dx_mm, (float(np.sign(dx_mm)), 0.0)), (dy_mm, (0.0, float(np.sign(dy_mm)))))
    told = [(abs(mm), side_labels(places, unit)) for mm, unit in parts if abs(mm) >= _LEAST_BEND_MM]
    return tuple(Bend(mm, *ends) for mm, ends in told if ends is not None) if all(ends for _, ends in told) else ()


def _seen_from_camera(pose: MinimaxPose, to_bars: Array) -> CameraMove:
    """The move as somebody beside the camera sees it."""
    move = pose.shift @ to_bars[:2]
    ahead = np.array([0.0, 0.0, 1.0]) - to_bars[2, 2] * to_bars[2]
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, to_bars[2])
    return CameraMove(float(move @ right), float(move @ ahead), float(np.degrees(pose.yaw)))
