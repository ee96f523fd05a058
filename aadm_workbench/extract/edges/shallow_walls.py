"""How far centres of mouths are off along the view, by the bore just behind the face.

There the wall that the camera looks at is where the edge is, but for what the line of sight moves in the plan on its
way down: light that pushes it along the ray moves it by less than a tenth of that.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.pooled.evidence import Walls
from aadm_workbench.model import Array

_DEPTH_MM = (2.0, 14.0)  # behind a chamfer, and before light has bounced twice
_FACING = 0.6  # cosine: walls seen along are mixed ones
_FEWEST = 9  # points of a bore: of fewer a median is any of them
# of one bore, and of all: bores of 30 scans of three cameras, with rings lost or not
_OWN_U_MM, _SHARED_U_MM = 0.12, 0.06


def view_by_walls(walls: Walls, centre: Array, slope: Array, radius_mm: float) -> tuple[float, float] | None:
    """What centres (k, 2) mm lack per unit of their lines of sight's ``slope`` (k, 2), mm, and its variance, mm².

    None where no bore shows its wall just behind the face.
    """
    about = walls.xy - centre[:, None]
    distance = np.maximum(np.hypot(about[..., 0], about[..., 1]), 1e-9)
    steepness = np.maximum(np.hypot(*slope.T), 1e-9)
    facing = np.einsum("kmi,ki->km", about, slope / steepness[:, None]) / distance
    low, high = _DEPTH_MM
    shown = walls.seen & (walls.depth > low) & (walls.depth < high) & (facing > _FACING)
    told = np.flatnonzero(shown.sum(axis=1) >= _FEWEST)
    squares = float((steepness[told] ** 2).sum())
    if squares <= 0.0:
        return None
    beyond = (distance - radius_mm) / np.maximum(facing, _FACING)
    off = np.array([np.median(beyond[k, shown[k]]) for k in told.tolist()])
    variance = _OWN_U_MM**2 / squares + (_SHARED_U_MM * float(steepness[told].sum()) / squares) ** 2
    return float(off @ steepness[told]) / squares, variance
