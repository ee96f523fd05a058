"""How the side of a bar leans, roughly: what decides which points are looked at, not what is measured from them."""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.plan_points import PlanPoints, thinned_rows
from aadm_workbench.model import Array, FloatArray

LEAN_MAX = float(np.radians(4.5))
"""What is looked for each way: 60 mm of side then move by 5 mm, nearly the room beside a bar in its patch."""

_LEANS = np.linspace(-LEAN_MAX, LEAN_MAX, 13)  # steps of 0.75 degrees move the end of a side by half of its band
_TRIED = np.stack(np.meshgrid(_LEANS, _LEANS), axis=-1).reshape(-1, 2).astype(np.float32)  # 13 × 13 leans, mm per mm
_TRIED = _TRIED[np.argsort((_TRIED**2).sum(axis=1), kind="stable")]
_SIDE_MM, _HALF_MM = 0.3, 1.5  # about the nominal radius: cores are a little smaller, ribs stand out by 1.5 mm
_POINTS_MAX = 150  # of a side, for a choice in steps of 0.75 degrees
_MORE, _MORE_POINTS = 1.1, 8.0  # ribs, strays and strips of a few points win less by another lean


def leans_that_hold(points: PlanPoints, depth: FloatArray, centre: Array, radius_mm: float) -> Array:
    """Of each bar the lean (k, 2) that most points of its side agree with; upright where no other is markedly better.

    ``points`` (n,) and their ``depth`` (n,) mm are below the tops; ``centre`` (k, 2) mm is that of the tops.
    Followed from fit to fit instead, a side of few points may run after its noise.
    """
    some = thinned_rows(points.owner, points.features, _POINTS_MAX)
    owner, below = points.owner[some], depth[some]
    x, y = (points.x - centre[points.owner, 0])[some], (points.y - centre[points.owner, 1])[some]
    score = np.empty((len(_TRIED), points.features))
    for row, lean in enumerate(_TRIED):
        off_mm = np.hypot(x - lean[0] * below, y - lean[1] * below) - (radius_mm + _SIDE_MM)
        agreeing = np.maximum(1.0 - (off_mm / _HALF_MM) ** 2, 0.0)
        score[row] = np.bincount(owner, weights=agreeing, minlength=points.features)
    best = score.argmax(axis=0)
    upright, most = score[0], score.max(axis=0)
    return np.where((most > _MORE * upright + _MORE_POINTS)[:, None], _TRIED[best], 0.0)
