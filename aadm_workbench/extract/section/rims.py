"""What a camera leaves out at the rims of mouths in the same face, whose bores are known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.section.face_samples import Area, FaceSamples
from aadm_workbench.model import Array, BoolArray

_WITHIN_SHARE = 0.5  # of the strip on the side of the face: how densely it is found there
_FOUND_MIN, _FLUSH_MAX = 0.25, 0.15  # thinner is no face; denser is something that goes on beyond the edge
_RIMS = 3  # mouths nearest to an edge: some are plugged, or cut by the picture
_FEWEST_PLACES = 50  # a share, or a scatter, of fewer is no measure
_RIM_SECTOR = np.radians(50.0)  # of a rim about the direction of an edge
_RIM_REACH_MM = 6.0  # as of edges; less than half a mouth
_RING_PITCHES = 0.5  # wide: a third of a rim then has some twenty places in each, and an end is known to a quarter
_RING_SHARE = 0.12  # of how densely the face is found: cameras that lose pixels at steps by chance keep half of them


@dataclass(frozen=True, eq=False)
class KnownMouths:
    """Mouths in the same face: ``centres`` (k, 2) mm in its axes, ``radii`` (k,) mm of their bores."""

    centres: Array
    radii: Array


def taken_in(samples: FaceSamples, place: Array, normal: Array, band_mm: float) -> float:
    """How far, mm, beyond an edge at a place (2,) lines of sight still find the wall behind it within the band."""
    return band_mm * max(-float(samples.slope_at(place) @ normal), 0.0)


def lost_at_rim(samples: FaceSamples, mouths: KnownMouths, normal: Array, band_mm: float) -> float | None:
    """How far, mm, before the rim of a mouth that ends it towards a direction the face is lost altogether.

    That of the outermost mouth with enough of a rim; None where there is none. What a camera loses at edges by chance
    is seen at the edge itself, and is no matter of this.
    """
    for number in np.argsort(-mouths.centres @ normal, kind="stable")[:_RIMS]:
        centre, radius = mouths.centres[number], float(mouths.radii[number])
        end = _rim_end(samples, centre, radius, normal, band_mm)
        if end is not None:
            taken_mm = taken_in(samples, centre - radius * normal, normal, band_mm)
            return max(end - radius + taken_mm - _RING_PITCHES * samples.pitch_mm / 2.0, 0.0)
    return None


def _rim_end(samples: FaceSamples, centre: Array, radius_mm: float, normal: Array, band_mm: float) -> float | None:
    """Distance from the centre of the last returns before a rim, in the sector that ends it towards ``normal``."""
    reach_mm = min(_RIM_REACH_MM, 0.45 * radius_mm)  # clear of the middle, which belongs to no side
    half_mm = (radius_mm + reach_mm) / 2.0
    across = np.array([-normal[1], normal[0]])
    asked = samples.ask(Area(centre - half_mm * normal, across, 2.0 * half_mm, half_mm))
    about = asked.xy - centre
    wanted = _in_sector(about, radius_mm, reach_mm, normal)
    distance, on = np.hypot(*about[wanted].T), np.abs(asked.height[wanted]) < band_mm
    if len(on) < _FEWEST_PLACES:
        return None
    found = on[distance > radius_mm + _WITHIN_SHARE * reach_mm].mean()
    stray = on[distance < radius_mm - _WITHIN_SHARE * reach_mm].mean()
    if found < _FOUND_MIN or stray > _FLUSH_MAX:
        return None
    ring_mm = _RING_PITCHES * samples.pitch_mm
    ring = ((distance - radius_mm + reach_mm) / ring_mm).astype(int)
    asked_of, found_of = np.bincount(ring), np.bincount(ring, on)
    dense = found_of > _RING_SHARE * found * np.maximum(asked_of, 1)
    inward = np.flatnonzero(~dense)
    # The innermost ring from which on the face goes on outwards.
    first = 0 if len(inward) == 0 else int(inward[-1]) + 1
    return float(radius_mm - reach_mm + first * ring_mm)


def _in_sector(about: Array, radius_mm: float, reach_mm: float, normal: Array) -> BoolArray:
    distance = np.hypot(*about.T)
    near = np.abs(distance - radius_mm) < reach_mm
    return np.asarray(near & (-about @ normal > np.cos(_RIM_SECTOR) * distance))
