"""Why a point that the design expects was not found in a scan: what the scan shows at its place."""

from __future__ import annotations

import numpy as np

from aadm_workbench.extract.plane import in_plane
from aadm_workbench.extract.sample import Thinned, point_pitch_mm, thinned
from aadm_workbench.model import Array, Extraction, Kind, Reason, Scan

_SAMPLE = 250_000  # every third row and column of 1920 × 1200
_FACE_BAND_MM = 3.0  # twice that of what is measured: a plug may stand a little before the face or behind it
_BAR_HEIGHT_MM = 10.0  # what stands higher than this below the level of the tops is no bar


def explain_missing(
    scan: Scan, extraction: Extraction, places: Array, diameter_mm: float, rng: np.random.Generator
) -> tuple[str, ...]:
    """Reasons for some expected centres (k, 3) mm, scan frame, that were not found.

    The extraction gives the plane that the other centres lie in; without it nothing can be said.
    """
    if extraction.plane is None:
        return (extraction.reason or Reason("extract.not_found"),) * len(places)
    sample = thinned(scan, _SAMPLE, rng)
    local = in_plane(sample.points, extraction.plane)
    expected = in_plane(np.atleast_2d(places), extraction.plane)[:, :2]
    explain = _explain_sleeve if extraction.kind is Kind.SLEEVE else _explain_bar
    return tuple(explain(sample, local, place, diameter_mm / 2) for place in expected)


def _explain_sleeve(sample: Thinned, local: Array, place: Array, radius_mm: float) -> str:
    on_face = local[np.abs(local[:, 2]) < _FACE_BAND_MM, :2]
    # Clear of the rim on both sides: the mouth may lie a quarter of a radius beside its place.
    within, without = (0.0, 0.7 * radius_mm), (1.2 * radius_mm, 1.8 * radius_mm)
    closed, around = (_filled(sample, on_face, place, *ring) for ring in (within, without))
    if around < 0.3:  # less than a third of the face around it is in the picture
        return Reason("extract.foot_out_of_view")
    if closed > 0.5:
        return Reason("extract.plugged")
    return Reason("extract.rim_unseen")


def _explain_bar(sample: Thinned, local: Array, place: Array, radius_mm: float) -> str:
    distance = np.hypot(*(local[:, :2] - place).T)
    near = local[distance < 4.0 * radius_mm]
    tops = (np.abs(near[:, 2]) < 4.0 * _BAR_HEIGHT_MM) & (np.hypot(*(near[:, :2] - place).T) < radius_mm)
    if len(near) == 0:
        return Reason("extract.out_of_view")
    if tops.sum() < 8:  # strays; a top that is seen has more points than that
        return Reason("extract.no_bar")
    return Reason("extract.top_unseen")


def _filled(sample: Thinned, on_plane: Array, place: Array, inner_mm: float, outer_mm: float) -> float:
    """Share of a ring that holds points, against the density of the points elsewhere on the plane."""
    distance = np.hypot(*(on_plane - place).T)
    found = int(((distance >= inner_mm) & (distance < outer_mm)).sum())
    spacing_mm = point_pitch_mm(sample, on_plane) / np.sqrt(sample.share)
    return float(found * spacing_mm**2 / (np.pi * (outer_mm**2 - inner_mm**2)))
