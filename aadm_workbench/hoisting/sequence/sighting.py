"""What a frame of a hanging column leaves behind beside its report: all that was fitted in it, without its points.

Later frames of the same column are put together with it (:mod:`.joint`), or begin where it ended (:mod:`.track`).
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.offsets import HungFit
from aadm_workbench.hoisting.pattern_fit import Pattern
from aadm_workbench.model import BoolArray, HoistingMeasurement, Scan


@dataclass(frozen=True, eq=False)
class Sighting:
    """All that was fitted in one frame.

    ``scan`` and ``frame`` are without points; ``sleeves`` and ``rebars`` the patterns that were believed, in the order
    of the design; ``shown`` (k,) about which sleeves the picture holds anything; ``near`` the corner that was declared,
    ``off_declared`` as in :class:`.match.Matched`. ``tracked`` counts the frames since all was searched, ``shape`` are
    the rows and columns of the picture.
    """

    scan: Scan
    frame: HoistingFrame
    hung: HungFit
    sleeves: Pattern
    rebars: Pattern
    shown: BoolArray
    near: tuple[int, int] | None
    orientation: str
    off_declared: float = 0.0
    tracked: int = 0
    shape: tuple[int, int] = (0, 0)


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class SightedMeasurement(HoistingMeasurement):
    """A frame that was measured, with its sighting."""

    sighting: Sighting


def with_sighting(measured: HoistingMeasurement, sighting: Sighting) -> SightedMeasurement:
    """The measurement of a frame, with all that was fitted in it but its points."""
    nothing = np.empty((0, 0, 3))
    sighting = replace(
        sighting, scan=replace(sighting.scan, points=nothing, image=None), frame=replace(sighting.frame, points=nothing)
    )
    known = {field.name: getattr(measured, field.name) for field in fields(HoistingMeasurement)}
    return SightedMeasurement(**known, sighting=sighting)
