"""From fitted sleeves and bars to the offset of every pair, with what is not known of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.hoisting.bars.fit import BarFit
from aadm_workbench.hoisting.foot.face import FootFace
from aadm_workbench.hoisting.foot.fit import FootFit
from aadm_workbench.hoisting.frame import LocalAxes
from aadm_workbench.model import Array, BoolArray

_NORMAL_U = 1.5e-4  # rad: what the warp of a camera does to the normal of a face
WARP_MM = 0.025
"""Of a place in the picture, rms: the reference camera warps by 0.05 mm."""


@dataclass(frozen=True, eq=False)
class HungFit:
    """All that was fitted in one frame: the foot in the axes of its face, the bars in axes along their vertical.

    ``floor`` (3,) is its normal in the axes of the face, None where too little of it is seen; ``before`` are the labels
    of what was measured before hoisting, ``missing`` those of what is seen not to be there.
    """

    face: FootFace
    foot: FootFit
    axes: LocalAxes
    bars: BarFit
    floor: Array | None = None
    before: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()

    @property
    def seen(self) -> BoolArray:
        """Which pairs (k,) have evidence of their own for the sleeve and for the bar."""
        return np.asarray(self.foot.seen & self.bars.seen)


@dataclass(frozen=True, eq=False)
class Offsets:
    """Pairs in the bars' frame. ``to_bars`` (3, 3) rows are its axes in the frame; ``origin`` (3,) its origin there.

    ``sleeves``, ``rebars`` (k, 3) mm are centres in the frame, ``offsets`` (k, 2) mm, with the joint ``covariance``
    (2k, 2k); ``distances`` (k,) mm.
    """

    to_bars: Array
    origin: Array
    sleeves: Array
    rebars: Array
    offsets: Array
    distances: Array
    covariance: Array
    height_mm: float

    def of_pair(self, k: int) -> Array:
        """Covariance (2, 2) mm² of one pair's offset."""
        return self.covariance[2 * k : 2 * k + 2, 2 * k : 2 * k + 2]


def offsets_of(hung: HungFit, scale_error: float) -> Offsets:
    """Offsets of all pairs of a frame whose lengths may be off by the share ``scale_error``."""
    face, bars = hung.face, hung.bars
    tops = bars.tops.copy()
    level = float(np.nanmedian(np.where(bars.seen, tops[:, 2], np.nan)))
    tops[~bars.seen, 2] = level
    in_frame = hung.axes.to_frame(tops)
    local = face.local(in_frame)
    apart = local[:, :2] - hung.foot.centres
    to_bars = _bar_axes(hung)
    across = to_bars[:2] @ face.axes[:2].T
    origin = hung.axes.to_frame(np.array([*bars.pose[:2], level]))
    gap_mm = np.abs(local[:, 2])
    count = len(apart)
    covariance = hung.foot.covariance + bars.covariance
    # what tilts the face moves all bars' projections alike; what stretches the camera's lengths, each offset
    gaps = np.repeat(gap_mm, 2)
    covariance = covariance + _NORMAL_U**2 * np.outer(gaps, gaps) * np.kron(np.ones((count, count)), np.eye(2))
    covariance = covariance + scale_error**2 * np.outer(apart.ravel(), apart.ravel()) + WARP_MM**2 * np.eye(2 * count)
    # the directions of the bars' frame are those of bars that scatter about their places
    turning = np.column_stack([-apart[:, 1], apart[:, 0]]).ravel()
    covariance = covariance + bars.turn_u**2 * np.outer(turning, turning)
    turned = np.kron(np.eye(count), across)
    return Offsets(
        to_bars=to_bars,
        origin=origin,
        sleeves=face.to_frame(np.column_stack([hung.foot.centres, np.zeros(count)])),
        rebars=in_frame,
        offsets=apart @ across.T,
        distances=np.hypot(apart[:, 0], apart[:, 1]),
        covariance=turned @ covariance @ turned.T,
        height_mm=float(np.median(gap_mm)),
    )


def _bar_axes(hung: HungFit) -> Array:
    """Axes (3, 3) of the bars' frame, rows in the frame: z the floor's normal or the mean of the bars, x their own."""
    seen = hung.bars.seen
    if hung.floor is not None:
        vertical = hung.axes.axes @ hung.face.axes.T @ hung.floor
    else:
        lean = np.median(hung.bars.leans[seen], axis=0) if seen.any() else np.zeros(2)
        vertical = np.array([*lean, 1.0]) / np.linalg.norm([*lean, 1.0])
    x = np.append(turn(float(hung.bars.pose[2]))[:, 0], 0.0)
    x = x - (x @ vertical) * vertical
    x /= np.linalg.norm(x)
    return np.asarray(np.vstack([x, np.cross(vertical, x), vertical]) @ hung.axes.axes)
