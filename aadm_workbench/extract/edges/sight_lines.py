"""Where every line of sight of a patch crosses the surface that a feature lies in, also where it returned nothing.

A pixel without a return tells as much about an edge as one with: there was no surface that the camera accepts. An
organised scan knows its pixels; a cloud does not, and has no such lines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, BoolArray, FloatArray


@dataclass(frozen=True, eq=False)
class SightLines:
    """Crossings ``x``, ``y`` (k, n) mm, about each feature's place, with the feature's own surface.

    ``height`` (k, n) mm is that of the return over the surface, NaN where there is none; ``slope`` (k, 2) how far the
    lines run in the plan per mm of depth at the feature, away from the camera's foot point.
    """

    x: FloatArray
    y: FloatArray
    height: FloatArray
    slope: Array

    def of(self, features: BoolArray) -> SightLines:
        """Those of some of the features (k,)."""
        return SightLines(self.x[features], self.y[features], self.height[features], self.slope[features])


def sight_lines_on_face(patches: Patches) -> SightLines | None:
    """Crossings with the plane that the patches lie in; None for clouds, whose lost pixels nobody knows."""
    if patches.seen_x is None or patches.seen_y is None or patches.eye is None:
        return None
    return SightLines(patches.seen_x, patches.seen_y, patches.height, _slopes(patches.eye))


def sight_lines_on_tops(patches: Patches, normal: Array, offset: Array, height: FloatArray) -> SightLines | None:
    """Crossings with planes of their own: ``normal`` (k, 3), ``offset`` (k,) mm; ``height`` (k, n) over them."""
    if patches.seen_x is None or patches.seen_y is None or patches.eye is None:
        return None
    eye = patches.eye.astype(np.float32)
    tilt, level = normal.astype(np.float32), offset.astype(np.float32)
    over = np.einsum("ki,ki->k", tilt, eye) - level
    falling_x, falling_y = patches.seen_x - eye[:, :1], patches.seen_y - eye[:, 1:2]
    fall = falling_x * tilt[:, :1] + falling_y * tilt[:, 1:2] - eye[:, 2:] * tilt[:, 2:]
    share = -over[:, None] / np.where(np.abs(fall) < 1e-6, np.float32(-1e-6), fall)
    return SightLines(eye[:, :1] + falling_x * share, eye[:, 1:2] + falling_y * share, height, _slopes(patches.eye))


def _slopes(eye: Array) -> Array:
    """Slope (k, 2) of the line of sight at each place: from the foot point of the eye (k, 3) to the place."""
    return np.asarray(-eye[:, :2] / np.maximum(np.abs(eye[:, 2:]), 1e-9))
