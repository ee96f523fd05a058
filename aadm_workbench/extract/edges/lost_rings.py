"""Whether a camera drops the pixels beside depth steps, by the gaps that surfaces leave to what lies behind them.

Without such a filter a surface touches what lies behind it, in neighbouring pixels, wherever that is lit. Where rings
are dropped from both sides of every step, no such pair is left, and the shortest gaps are two pixels wide for each.
Gaps before what returns nothing tell nothing, and are not counted.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, FloatArray, IntArray

_NEAR_PITCHES = 4.5  # of an edge: three rings, and what the corner of a pixel adds
_ON_MM = 1.5  # of a surface: how far it bends at its edges
_STEP_MM = 5.0  # what filters take for a step; chamfers and ribs are lower
_LONGEST = 8  # pixels from a surface to what lies behind: three rings of both, and one that was lost anyhow
_FEWEST = 30  # gaps: with fewer, what lies behind is dark, and surfaces touch nothing for that reason
_TOUCHING = 0.02  # of the steps, where rings are dropped: none on all scans tried; without a filter 0.3 to 0.9
_SHORT, _SHORT_SHARE = 3, 0.05  # fewer pixels than two rings leave; that two rings leave on scans tried: at most 0.03


def gaps_at_steps(patches: Patches, height: FloatArray, centre: Array, radius_mm: float, pitch_mm: float) -> IntArray:
    """How many steps (8,) about edges of discs have 0, 1, ... 7 empty pixels between a surface and what lies behind.

    ``height`` (k, n) mm is that over each feature's own surface, ``centre`` (k, 2) mm. All zero for clouds.
    """
    counts = np.zeros(_LONGEST, np.int64)
    if not patches.columns or patches.seen_x is None or patches.seen_y is None:
        return counts
    x = patches.seen_x - centre[:, :1].astype(np.float32)
    y = patches.seen_y - centre[:, 1:].astype(np.float32)
    near_mm = _NEAR_PITCHES * pitch_mm
    squared = x * x + y * y
    near = (squared > max(radius_mm - near_mm, 0.0) ** 2) & (squared < (radius_mm + near_mm) ** 2)
    at = np.flatnonzero(near & (np.abs(height) < _ON_MM))
    flat = height.ravel()
    for step in (-patches.columns, -1, 1, patches.columns):
        counts += _gaps(flat, at, step)
    return counts


def _gaps(height: FloatArray, at: IntArray, step: int) -> IntArray:
    """The same of surface points ``at`` (m,) along one direction, given as a stride of the flattened heights."""
    counts = np.zeros(_LONGEST, np.int64)
    alive = at
    for empty in range(_LONGEST):
        there = alive + step * (empty + 1)
        inside = (there >= 0) & (there < len(height))
        alive, there = alive[inside], there[inside]
        behind = height[there]
        counts[empty] = int((height[alive] - behind > _STEP_MM).sum())
        alive = alive[np.isnan(behind)]
    return counts


def tells_of_rings(gaps: IntArray) -> bool:
    """Whether enough lies lit behind steps to tell whether a camera drops rings there."""
    return int(gaps.sum()) >= _FEWEST


def rings_dropped(gaps: IntArray) -> int:
    """How many rings a camera drops at depth steps: 0 (or nobody knows), 1, or 2 for two and more."""
    total = int(gaps.sum())
    if not tells_of_rings(gaps) or gaps[0] > _TOUCHING * total:
        return 0
    return 1 if gaps[:_SHORT].sum() > _SHORT_SHARE * total else 2
