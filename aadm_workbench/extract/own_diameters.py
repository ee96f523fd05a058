"""The diameter of each bar by its own top alone.

The fit of all bars shares one radius, which is what makes centres sure; a single bar of another size is lost in it, or
not measured at all. Its own outline tells it apart. What a camera does at edges it does to all, so that what outlines
say is set against the shared diameter of the bars that were measured.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.circle import Outlines, PlanPoints, agreeing_shares, bins_for, circles_through, outlines
from aadm_workbench.extract.patches import patches_around
from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.sample import thinned
from aadm_workbench.extract.top_planes import top_planes
from aadm_workbench.model import Array, Plane, Scan
from aadm_workbench.model.measured import TO_SIGMA

_SAMPLE = 30_000  # pixels: they say where to look, within a stride
_CORE_SHARE = 0.7  # of the nominal radius: the plane of a top two sizes smaller is found in it
_BAND_MM = 0.8  # about the plane of a top: twice the noise at 2 m
_ZONE = 0.35, 1.7  # of the nominal radius: bars two sizes off either way, and nothing that stands beside them
_ROUNDS = 4  # points of ribs leave in the first two
# an outline's points lie up to a pitch within the edge, on either side of their middle; at a lost pixel a little more
_ROUND_WITHIN_PITCHES = 0.75
# ribs stand out by more; of the outline; of the turn: a choice, not tuned since
_ROUND_WITHIN_MM, _ROUND_SHARE, _COVERED_SHARE = 0.45, 0.6, 0.7
_FEWEST, _ENOUGH = 2, 4  # of fewer a median is no sign; of fewer nobody knows how much outlines of this scan scatter
# of one outline: half a pixel, and ribs that stand out on one side; a whole pixel where the scatter is not known
_LEAST_U_MM, _UNKNOWN_U_MM = 0.25, 0.5
_OF_MEDIAN = 1.57  # variance of a median against that of a mean, for the normal law


@dataclass(frozen=True, eq=False)
class OwnDiameters:
    """Diameters (k,) mm of single bars, NaN where an outline is not round or not seen, and their standard uncertainty.

    None of them is known where fewer than two bars tell what outlines of sound bars look like.
    """

    diameters_mm: Array
    u_mm: float


def own_diameters(
    scan: Scan, level: Plane, places: Array, shared_mm: Array, nominal_mm: float, rng: np.random.Generator
) -> OwnDiameters:
    """Diameters of bars that stand at some places.

    Parameters
    ----------
    level
        Plane of the tops, scan frame.
    places
        (k, 3) mm, scan frame: measured tops, and where one should be.
    shared_mm
        (k,) the diameters that all bars share; NaN where none was measured.
    """
    own_mm = 2.0 * _radii(scan, level, places, nominal_mm / 2.0, rng)
    known = np.isfinite(own_mm) & np.isfinite(shared_mm)
    if known.sum() < _FEWEST:
        return OwnDiameters(np.full(len(places), np.nan), 0.0)
    beyond = own_mm[known] - shared_mm[known]
    usual_mm = float(np.median(beyond))
    scatter_mm = TO_SIGMA * float(np.median(np.abs(beyond - usual_mm)))
    least_mm = _LEAST_U_MM if known.sum() >= _ENOUGH else _UNKNOWN_U_MM
    u_mm = max(scatter_mm, least_mm) * float(np.sqrt(1.0 + _OF_MEDIAN / known.sum()))
    return OwnDiameters(own_mm - usual_mm, u_mm)


def _radii(scan: Scan, level: Plane, places: Array, radius_mm: float, rng: np.random.Generator) -> Array:
    """Radii (k,) mm of the outlines of the tops, NaN where there is no round one."""
    centres = in_plane(places, level)[:, :2]
    patches = patches_around(scan, thinned(scan, _SAMPLE, rng), level, centres, _ZONE[1] * radius_mm + 2.0)
    planes = top_planes(patches, _CORE_SHARE * radius_mm, rng)
    if not planes.found.any():
        return np.full(len(places), np.nan)
    band_mm = np.maximum(3.0 * planes.residual_mm, _BAND_MM).astype(np.float32)[:, None]
    on_top = (np.abs(planes.height(patches)) < band_mm) & planes.found[:, None]
    top = PlanPoints.of(patches.x, patches.y, np.flatnonzero(on_top))
    inside = np.bincount(top.owner[top.distance(np.zeros_like(centres)) < radius_mm], minlength=len(places))
    pitch_mm = np.sqrt(np.pi * radius_mm**2 / np.maximum(inside, 1))
    usual_pitch_mm = float(np.median(pitch_mm[planes.found]))
    bins = bins_for(radius_mm, usual_pitch_mm)
    centre, radius = np.zeros((len(places), 2)), np.full(len(places), radius_mm)
    for _ in range(_ROUNDS):
        shape = _outlined(top, centre, radius_mm, bins)
        centre, radius = circles_through(shape, centre, radius_mm)
    within_mm = max(_ROUND_WITHIN_MM, _ROUND_WITHIN_PITCHES * usual_pitch_mm)
    round_ = agreeing_shares(shape, centre, radius, within_mm) > _ROUND_SHARE
    return np.where(round_ & (shape.coverage > _COVERED_SHARE) & planes.found, radius, np.nan)


def _outlined(top: PlanPoints, centre: Array, radius_mm: float, bins: int) -> Outlines:
    far_mm = top.distance(centre)
    wanted = (far_mm > _ZONE[0] * radius_mm) & (far_mm < _ZONE[1] * radius_mm)
    return outlines(top.where(wanted), centre, bins, innermost=False)
