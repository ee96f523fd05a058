"""What a camera leaves out at the rims of mouths in the same face, whose bores are known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.section.face_samples import FaceSamples
from aadm_workbench.model import Array, BoolArray

_WITHIN_SHARE = 0.5  # of the strip on the side of the face: how densely it is found there
_FOUND_MIN, _FLUSH_MAX = 0.25, 0.15  # thinner is no face; denser is something that goes on beyond the edge
_RIMS = 4  # mouths nearest to an edge are asked: their median tells as much as that of twelve
_FEWEST_PLACES = 50  # a share, or a scatter, of fewer is no measure
_RIM_SECTOR = np.radians(50.0)  # of a rim about the direction of an edge
_RIM_REACH_MM = 6.0  # as of edges; less than half a mouth


@dataclass(frozen=True, eq=False)
class KnownMouths:
    """Mouths in the same face: ``centres`` (k, 2) mm in its axes, ``radii`` (k,) mm of their bores."""

    centres: Array
    radii: Array


def taken_in(samples: FaceSamples, place: Array, normal: Array, band_mm: float) -> float:
    """How far, mm, beyond an edge at a place (2,) lines of sight still find the wall behind it within the band."""
    return band_mm * max(-float(samples.slope_at(place) @ normal), 0.0)


def lost_at_rims(samples: FaceSamples, mouths: KnownMouths, normal: Array, band_mm: float) -> float:
    """By how much, mm, the face ends before the rims of mouths that end it towards a direction; 0 if it does not."""
    lost = []
    nearest = np.argsort(-mouths.centres @ normal, kind="stable")[:_RIMS]
    for centre, radius in zip(mouths.centres[nearest], mouths.radii[nearest].tolist(), strict=True):
        end = _rim_end(samples, centre, radius, normal, band_mm)
        if end is not None:
            lost.append(end - radius + taken_in(samples, centre - radius * normal, normal, band_mm))
    return max(float(np.median(lost)), 0.0) if lost else samples.pitch_mm


def _rim_end(samples: FaceSamples, centre: Array, radius_mm: float, normal: Array, band_mm: float) -> float | None:
    """Distance from the centre at which the face ends at a rim, in the sector that ends it towards ``normal``."""
    step = samples.pitch_mm
    reach_mm = min(_RIM_REACH_MM, 0.45 * radius_mm)  # clear of the middle, which belongs to no side
    # Half a step more than the reach: so that its end is among them.
    span = np.arange(-radius_mm - reach_mm - step, radius_mm + reach_mm + 1.5 * step, step)
    x, y = np.meshgrid(span, span)
    about = np.column_stack([x.ravel(), y.ravel()])
    about = about[_in_sector(about, radius_mm, reach_mm + step, normal)]
    asked = samples.ask(centre + about)
    about = asked.xy - centre
    wanted = _in_sector(about, radius_mm, reach_mm, normal)
    distance, on = np.hypot(*about[wanted].T), np.abs(asked.height[wanted]) < band_mm
    if len(on) < _FEWEST_PLACES:
        return None
    # Each ring counts alike, whatever its length.
    weight = 1.0 / distance
    outer = distance > radius_mm + _WITHIN_SHARE * reach_mm
    inner = distance < radius_mm - _WITHIN_SHARE * reach_mm
    found, stray = on[outer].mean(), on[inner].mean()
    if found < _FOUND_MIN or stray > _FLUSH_MAX:
        return None
    share = ((weight @ on) / weight.sum() - stray) / (found - stray)
    return float(radius_mm + reach_mm - 2.0 * reach_mm * share)


def _in_sector(about: Array, radius_mm: float, reach_mm: float, normal: Array) -> BoolArray:
    distance = np.hypot(*about.T)
    near = np.abs(distance - radius_mm) < reach_mm
    return np.asarray(near & (-about @ normal > np.cos(_RIM_SECTOR) * distance))
