"""How the hanging column moves from frame to frame, and what that leaves to do: the correction is that of its rest.

A frame shows the column at one moment of its swing. Its displacement from frame to frame is the rigid move that its
pairs share; from three frames on these tell where it would come to rest (:mod:`.pendulum`).

A running estimate over frames of a hanging column: frames are combined while it is still, and begun anew when not. All
frames share what a camera does to lengths and walls, so combining them removes noise and not that: the part of the
uncertainty that a single frame's noise makes up shrinks with the number of frames, the rest stays.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.hoisting.swing.pendulum import Swing, swing_of
from aadm_workbench.model import Array, BoolArray, Correction, HoistingMeasurement

_MOST_LOOKS, _LONGEST_S = 10, 40.0  # three swings of the longest rope; older frames say little of today's rest
_APART_S = 0.5  # of the quickest rope's swing of 1.5 s a third: at video rate ten frames in a row tell of no swing
_FEWEST_PAIRS = 3  # two leave a turn open to noise
_NOISE_FLOOR_MM = 0.04  # of a place from frame to frame: the bars' own frame is found anew in each
_MOVED_SIGMAS, _MOVED_MIN_MM = 4.0, 0.25  # beyond noise; less than a crane can move by
_SURE_SIGMAS = 1.645  # one-sided, 95 %

_NOISE_SHARE = 0.5  # of a frame's variance: what differs from frame to frame
_MOVED_SIGMAS = 4.0  # a column at rest seems to move once in 16,000 frames
_MOVED_MIN_MM = 0.25  # less than a crane moves by, and a twelfth of the limit
_MOST_FRAMES = 400  # beyond them the mean forgets: memory and weights stay as they are


@dataclass(frozen=True, eq=False)
class Look:
    """A frame as the motion needs it: its time, offsets (k, 2) mm, their variances (k,) and which pairs are seen."""

    time_s: float
    offsets_mm: Array
    variances: Array
    seen: BoolArray


@dataclass(frozen=True)
class Motion:
    """What the newest frames say of the column's motion.

    ``still`` tells whether no pair leaves its limit during the swing; None without a limit, or while ``swing`` is None:
    fewer than three frames since the last push. ``moving`` tells that the column moved and its rest is not known well
    enough for a correction. ``rest`` is the correction from the rest, ``largest_mm`` the largest distance there; while
    nobody knows whether it swings, the correction has no uncertainty that could be told.
    """

    swing: Swing | None
    moving: bool
    still: bool | None
    rest: Correction | None
    largest_mm: float | None


def look_at(measurement: HoistingMeasurement, time_s: float) -> Look:
    """What the motion needs of a measured frame."""
    variances = np.trace(measurement.covariances, axis1=1, axis2=2) / 2.0
    return Look(time_s, measurement.offsets_mm, variances, np.array([pair.seen for pair in measurement.report.pairs]))


def with_look(looks: tuple[Look, ...], newest: Look) -> tuple[Look, ...]:
    """The frames that still matter: half a second apart but for the newest; a time that goes back begins anew."""
    if looks and newest.time_s <= looks[-1].time_s:
        return (newest,)
    kept = [look for look in looks if newest.time_s - look.time_s < _LONGEST_S]
    if len(kept) > 1 and newest.time_s - kept[-2].time_s < _APART_S:
        kept.pop()
    return (*kept[-(_MOST_LOOKS - 1) :], newest)


def motion_of(looks: tuple[Look, ...], places: Array, correction: Correction | None, limit_mm: float | None) -> Motion:
    """The motion that frames show.

    Parameters
    ----------
    looks
        Oldest first; the last is the one that ``correction`` belongs to.
    places
        (k, 2) mm, of the bars, in their frame.
    limit_mm
        Of the distance of a sleeve from its bar.
    """
    now = looks[-1]
    largest_mm = float(np.hypot(*now.offsets_mm.T).max())
    places = places - now.offsets_mm
    moves, noise_mm = _moves(looks, places)
    unsure = None if correction is None else replace(correction, u_mm=None, u_yaw_deg=None)
    if len(moves) < 2:
        return Motion(None, False, None, unsure, largest_mm)
    times_s = np.array([look.time_s for look in looks[-len(moves) :]])
    swing = swing_of(times_s, moves[:, :2], noise_mm)
    if swing is None:
        limit = max(_MOVED_SIGMAS * np.sqrt(2.0) * noise_mm, _MOVED_MIN_MM)
        moved = bool(np.abs(moves[-2]).max() > limit)
        return Motion(None, moved, None, None if moved else unsure, largest_mm)
    turning = swing_of(times_s[-swing.frames :], moves[-swing.frames :, 2:], noise_mm)
    if turning is None or correction is None:
        return Motion(swing, turning is None, None, None, largest_mm)
    return _from_rest(now, places, swing, turning, correction, limit_mm)


def _from_rest(
    now: Look, places: Array, swing: Swing, turning: Swing, correction: Correction, limit_mm: float | None
) -> Motion:
    """The motion with three frames and more: what remains to be done from the rest."""
    reach_mm = _reach_mm(places)
    yaw = float(turning.rest[0]) / reach_mm
    at_rest = now.offsets_mm - swing.rest - yaw * np.column_stack([-places[:, 1], places[:, 0]])
    largest_mm = float(np.hypot(*at_rest.T).max())
    u_mm = math.hypot(swing.rest_u_mm, turning.rest_u_mm)
    swing = replace(swing, amplitude_mm=swing.amplitude_mm + turning.amplitude_mm, rest_u_mm=u_mm)
    still = None if limit_mm is None else swing.amplitude_mm + largest_mm + _SURE_SIGMAS * u_mm <= limit_mm
    # a correction that is no surer than half of what it has to keep may as well push away
    unsure = limit_mm is not None and _SURE_SIGMAS * u_mm > limit_mm / 2.0
    rest = None if unsure else moved_correction(correction, swing.rest, math.degrees(yaw))
    rest = None if rest is None else replace(rest, u_mm=math.hypot(rest.u_mm or 0.0, swing.rest_u_mm))
    return Motion(swing, unsure, still, rest, largest_mm)


def _moves(looks: tuple[Look, ...], places: Array) -> tuple[Array, float]:
    """Displacements (n, 3) of the column against the newest frame: x, y, and turn at its rim, all mm; and their noise.

    Only of the newest frames that see three pairs in common: each pair stands off its place by its own amount, which
    must not look like a move.
    """
    now, common = looks[-1], looks[-1].seen.copy()
    reach_mm = _reach_mm(places)
    chosen = [now]
    for look in reversed(looks[:-1]):
        if len(look.seen) != len(common) or (common & look.seen).sum() < _FEWEST_PAIRS:
            break
        common &= look.seen
        chosen.append(look)
    if common.sum() < _FEWEST_PAIRS:
        return np.zeros((1, 3)), _NOISE_FLOOR_MM
    about = places[common]
    system = np.zeros((2 * len(about), 3))
    system[0::2, 0] = system[1::2, 1] = 1.0
    system[0::2, 2], system[1::2, 2] = -about[:, 1] / reach_mm, about[:, 0] / reach_mm
    solve = np.linalg.pinv(system)
    moves = [solve @ (now.offsets_mm - look.offsets_mm)[common].ravel() for look in reversed(chosen)]
    # half of a frame's variance is what its neighbours share with it, as in the running estimate below
    noise = 0.5 * float(np.median(now.variances[common])) / len(about)
    return np.array(moves), float(np.sqrt(noise + _NOISE_FLOOR_MM**2))


def _reach_mm(places: Array) -> float:
    return float(np.hypot(*places.T).max())


def moved_correction(correction: Correction, displacement: Array | tuple[float, float], yaw_deg: float) -> Correction:
    """The correction of a column that stands displaced against where it was measured."""
    dx, dy = correction.dx_mm - displacement[0], correction.dy_mm - displacement[1]
    camera = correction.camera
    if camera is not None:
        about = math.atan2(camera.away_mm, camera.right_mm) - math.atan2(correction.dy_mm, correction.dx_mm)
        right = dx * math.cos(about) - dy * math.sin(about)
        away = dx * math.sin(about) + dy * math.cos(about)
        camera = replace(camera, right_mm=right, away_mm=away, yaw_deg=camera.yaw_deg - yaw_deg)
    return replace(correction, dx_mm=float(dx), dy_mm=float(dy), yaw_deg=correction.yaw_deg - yaw_deg, camera=camera)


@dataclass(frozen=True, eq=False)
class Running:
    """What has been seen since the column last moved.

    ``frames`` counts them; ``offsets_mm`` (k, 2) is the weighted mean of the pairs' offsets, ``weights`` (k,) their
    sums of weights, ``variances`` (k,) mm² those of single frames; ``moved_mm`` how far the last move was.
    """

    frames: int
    offsets_mm: Array
    weights: Array
    variances: Array
    moved_mm: float | None = None

    @property
    def u_mm(self) -> Array:
        """Standard uncertainty (k,) per axis of the mean."""
        shared = (1.0 - _NOISE_SHARE) * self.variances
        return np.asarray(np.sqrt(shared + _NOISE_SHARE / np.maximum(self.weights, 1e-12)))

    @property
    def distances_mm(self) -> Array:
        """Distance (k,) of the mean offsets."""
        return np.asarray(np.hypot(self.offsets_mm[:, 0], self.offsets_mm[:, 1]))


def combined(running: Running | None, measurement: HoistingMeasurement) -> Running:
    """The estimate with one more frame; a new one where the column has moved."""
    variances = np.trace(measurement.covariances, axis1=1, axis2=2) / 2.0
    weights = 1.0 / variances
    if running is None or len(running.weights) != len(weights):
        return Running(1, measurement.offsets_mm.copy(), weights, variances)
    off = measurement.offsets_mm - running.offsets_mm
    seen = np.array([pair.seen for pair in measurement.report.pairs])
    chosen = seen if seen.sum() >= 2 else np.ones(len(weights), bool)
    moved_mm, limit_mm = _common_move(off[chosen], variances[chosen])
    if moved_mm > limit_mm:
        return Running(1, measurement.offsets_mm.copy(), weights, variances, moved_mm)
    kept = running.weights * (1.0 - 1.0 / _MOST_FRAMES) if running.frames >= _MOST_FRAMES else running.weights
    total = kept + weights
    mean = running.offsets_mm + (weights / total)[:, None] * off
    smallest = np.minimum(running.variances, variances)
    return replace(
        running, frames=running.frames + 1, offsets_mm=mean, weights=total, variances=smallest, moved_mm=None
    )


def _common_move(off: Array, variances: Array) -> tuple[float, float]:
    """How far the pairs moved, mm, the largest of them by the median, and how far noise alone may move them."""
    middle = np.median(off, axis=0)
    farthest = float(np.hypot(*off.T)[np.argsort(np.hypot(*off.T))[-(len(off) // 3 + 1)]])
    noise_mm = float(np.sqrt(2.0 * _NOISE_SHARE * np.median(variances)))
    return max(float(np.hypot(*middle)), farthest), max(_MOVED_SIGMAS * noise_mm, _MOVED_MIN_MM)
