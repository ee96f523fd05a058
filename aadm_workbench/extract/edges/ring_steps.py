"""What a camera that drops rings of pixels at depth steps took from outlines of tops, and on which sides.

Such a filter takes a pixel where a neighbour lies farther off than a step of its own. Which step that is shows in what
it left: no two neighbours that fall by more. Where few fall at all, it is anything up to the steps that are taken. Where a top ends in a step, it and what lies behind lose alike. Where it
runs on into the side that shows, the surface goes on falling: a ring is taken there only as far as neighbours fall
by that step, which is less the steeper the side is seen.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import Outlines
from aadm_workbench.extract.patches import Patches
from aadm_workbench.model import Array, FloatArray

_FALLS_MM = (1.0, 5.0)  # more than noise; what no filter leaves that drops rings (lost_rings looks for such steps)
_BEHIND_COSINE = 0.2  # lines of sight that pass a top on the side that shows end on that side, which filters took


@dataclass(frozen=True, eq=False)
class DroppedRings:
    """How far from steps a camera drops pixels, ``reach_mm``, and the smallest step at which it does, ``fall_mm``.

    ``fall_u_mm`` is the standard uncertainty of that step.
    """

    reach_mm: float
    fall_mm: float
    fall_u_mm: float

    @staticmethod
    def of(patches: Patches, height: FloatArray, reach_mm: float) -> DroppedRings:
        """Rings of a reach, and the step: no less than what heights (k, n) mm still fall by between neighbours."""
        least, most = steepest_fall_mm(patches, height), _FALLS_MM[1]
        return DroppedRings(reach_mm, 0.5 * (least + most), (most - least) / float(np.sqrt(12.0)))

    @property
    def view_u_mm(self) -> float:
        """What the uncertainty of the step does to centres along the view, mm per unit of slope.

        Half of an outline is out by the step times the slope times the cosine of the turn from the view.
        """
        return 0.5 * self.fall_u_mm

    def set_right(self, rims: Outlines, beyond: Outlines, centre: Array, slope: Array) -> tuple[Outlines, Outlines]:
        """Outlines of tops at ``centre`` (k, 2) mm where they would be without the filter, and what passed them.

        ``slope`` (k, 2) is how far the lines of sight run in the plan per mm of depth. Of what passed a top, that is
        kept which passed it where it ends in a step.
        """
        shown = _shown(rims, centre, slope)
        lost_mm = np.clip(self.reach_mm - self.fall_mm * np.maximum(shown, 0.0), 0.0, self.reach_mm)
        steep = np.maximum(np.hypot(*slope.T), 1e-9)[:, None]
        passed = beyond.only(_shown(beyond, centre, slope) < _BEHIND_COSINE * steep)
        return _moved(rims, centre, lost_mm), _moved(passed, centre, np.full(passed.seen.shape, -self.reach_mm))


def steepest_fall_mm(patches: Patches, height: FloatArray) -> float:
    """The most that heights (k, n) mm differ between neighbours, of what a filter may have left; 0 where none does."""
    raster = height.reshape(len(height), -1, patches.columns)
    low, high = _FALLS_MM
    falls = [np.abs(np.diff(raster, axis=axis)) for axis in (1, 2)]
    return max(float(np.max(fall, where=(fall > low) & (fall < high), initial=0.0)) for fall in falls)


def _shown(shape: Outlines, centre: Array, slope: Array) -> Array:
    """Slope (k, bins) at which the side below each outline point is seen; negative where it is hidden."""
    about = shape.xy - centre[:, None]
    distance = np.maximum(np.hypot(about[..., 0], about[..., 1]), 1e-9)
    return np.asarray(-np.einsum("kmi,ki->km", about, slope) / distance)


def _moved(shape: Outlines, centre: Array, outwards_mm: Array) -> Outlines:
    about = shape.xy - centre[:, None]
    distance = np.maximum(np.hypot(about[..., 0], about[..., 1]), 1e-9)
    return Outlines(shape.xy + about * (outwards_mm / distance)[..., None], shape.seen)
