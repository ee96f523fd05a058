"""A scan as the job names it, and how to look again at what it shows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.model import AssemblyPoint, Extraction, Kind

FITS_SHARE = 0.75
"""Of the points of a design: with so many on their places a scan shows it. Half may lie on some pattern by chance."""

FEWEST = 4  # three points lie on some pattern by chance

Look = Callable[[Kind, Sequence[float]], Extraction]
"""Looks for points of a kind, of some diameters, mm, in one scan."""


@dataclass(frozen=True, eq=False)
class NamedScan:
    """The first scan of a group: its file as the job names it, and how to look for other things in it.

    ``stretched`` gives the scan with lengths across the view, and along it, times a factor each. ``distance_mm`` is
    that of most of its points from the camera.
    """

    source: str
    look: Look
    stretched: Callable[[float, float], NamedScan]
    distance_mm: float = 0.0


def fits(points: Sequence[AssemblyPoint], extraction: Extraction, within_mm: float = math.inf) -> bool:
    """Whether an extraction lies on a design, mirrored or not, and scatters about it by less than so much, rms."""
    match = match_extraction(points, extraction)
    needed = max(FEWEST, FITS_SHARE * len(points))
    if match.contradiction == "mirrored":
        return math.isinf(within_mm)
    return bool(match) and match.placements[0].found >= needed and match.placements[0].rms_mm < within_mm
