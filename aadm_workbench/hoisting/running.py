"""A running estimate over frames of a hanging column: frames are combined while it is still, and begun anew when not.

All frames share what a camera does to lengths and walls, so combining them removes noise and not that: the part of the
uncertainty that a single frame's noise makes up shrinks with the number of frames, the rest stays.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.model import Array, HoistingMeasurement

_NOISE_SHARE = 0.5  # of a frame's variance: what differs from frame to frame
_MOVED_SIGMAS = 4.0  # a column at rest seems to move once in 16,000 frames
_MOVED_MIN_MM = 0.25  # less than a crane moves by, and a twelfth of the limit
_MOST_FRAMES = 400  # beyond them the mean forgets: memory and weights stay as they are


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
