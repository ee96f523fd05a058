"""A plate with holes like the sleeves of a foot and pins like bars, at places that are known.

Its frame: origin on the face in the middle of the holes, x to the right and y up as the camera sees it, z out of the
face towards the camera. One corner has no pin: that says how the plate is turned, and a mirror image has no such turn.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.errors import DesignError
from aadm_workbench.model import Array, AssemblyPoint, Kind, Reason

MARGIN_MM = 60.0
"""Of the plate beyond its outer holes: as much face is seen there as about a sleeve of a foot."""

THICKNESS_MM = 20.0
"""Of the plate itself: stiff enough to stay flat, and two people still carry it."""

BORE_MM = 150.0
"""Depth of a bore: a camera that looks in at 13 degrees sees no end of a 36 mm bore that deep, as in a sleeve."""

PIN_HEIGHT_MM = 80.0
"""Of a pin over the face: longer than the 60 mm of a bar's side that are measured."""

NOMINAL_U_MM = 0.06
"""Standard uncertainty per axis of a place that was only machined: a place tolerance of 0.2 mm, taken as even."""

ALUMINIUM_PER_K = 23.8e-6
"""Expansion of EN AW-5083, by EN 573 and its data sheets: 0.14 mm over 600 mm and 10 K."""

REFERENCE_C = 20.0
"""Temperature that lengths refer to: ISO 1."""

_HOLES = range(12, 33, 4)  # a ring with a side of four to nine; fewer leave room for three pins, which tell no turn


@dataclass(frozen=True, slots=True)
class Place:
    """A hole or a pin: its middle on the face, or on the pin's end, mm; ``u_mm`` per axis and, of pins, of height."""

    label: str
    kind: Kind
    x_mm: float
    y_mm: float
    z_mm: float
    diameter_mm: float
    u_mm: float = NOMINAL_U_MM


@dataclass(frozen=True)
class Plate:
    """A plate: ``calibrated`` where its places are those of a measuring machine; ``sha256`` of its file."""

    name: str
    size_mm: float
    places: tuple[Place, ...]
    pin_height_mm: float = PIN_HEIGHT_MM
    thickness_mm: float = THICKNESS_MM
    bore_mm: float = BORE_MM
    expansion_per_k: float = ALUMINIUM_PER_K
    calibrated: bool = False
    sha256: str = ""

    def of(self, kind: Kind) -> tuple[Place, ...]:
        """The holes (``SLEEVE``) or the pins (``REBAR``)."""
        return tuple(place for place in self.places if place.kind is kind)

    def centres(self, kind: Kind) -> Array:
        """Their middles (n, 3) mm, plate frame."""
        return np.array([[one.x_mm, one.y_mm, one.z_mm] for one in self.of(kind)]).reshape(-1, 3)

    def diameter_mm(self, kind: Kind) -> float:
        """The median of their diameters."""
        return float(np.median([one.diameter_mm for one in self.of(kind)]))

    def at(self, temperature_c: float) -> Plate:
        """The plate at another temperature than that of its places."""
        longer = 1.0 + self.expansion_per_k * (temperature_c - REFERENCE_C)
        places = tuple(
            replace(one, x_mm=one.x_mm * longer, y_mm=one.y_mm * longer, z_mm=one.z_mm * longer) for one in self.places
        )
        return replace(self, places=places)

    def points(self) -> tuple[AssemblyPoint, ...]:
        """All of them as points; axes out of the face."""
        out = np.array([0.0, 0.0, 1.0])
        middles = (np.array([one.x_mm, one.y_mm, one.z_mm]) for one in self.places)
        return tuple(
            AssemblyPoint(one.label, one.kind, middle, out, one.diameter_mm)
            for one, middle in zip(self.places, middles, strict=True)
        )


def drawn_plate(holes: int, diameter_mm: float, pitch_mm: float, pin_diameter_mm: float) -> Plate:
    """A plate with a square ring of holes, and pins in the middle of each four of its grid but one corner's.

    Raises
    ------
    DesignError
        Where so many holes make no square ring, or holes and pins have no room beside each other.
    """
    if holes not in _HOLES:
        raise DesignError(Reason("calibration.holes", count=holes, most=_HOLES[-1]))
    diagonal_mm = pitch_mm / np.sqrt(2.0) - (diameter_mm + pin_diameter_mm) / 2.0
    if diagonal_mm < diameter_mm:
        raise DesignError(Reason("calibration.no_room", pitch_mm=pitch_mm, diameter_mm=diameter_mm))
    side = holes // 4 + 1
    along = (np.arange(side) - (side - 1) / 2.0) * pitch_mm
    between = (along[:-1] + along[1:]) / 2.0
    ring = [(x, y) for y in along for x in along if max(abs(x), abs(y)) == along[-1]]
    cells = [(x, y) for y in between for x in between if max(abs(x), abs(y)) == between[-1]]
    cells = [cell for cell in cells if cell != (between[-1], between[-1])]
    places = [Place(f"H{k}", Kind.SLEEVE, x, y, 0.0, diameter_mm) for k, (x, y) in enumerate(ring, 1)]
    places += [Place(f"P{k}", Kind.REBAR, x, y, PIN_HEIGHT_MM, pin_diameter_mm) for k, (x, y) in enumerate(cells, 1)]
    size_mm = float(2.0 * (along[-1] + MARGIN_MM))
    return Plate(f"{holes} x {diameter_mm:g} at {pitch_mm:g}, pins {pin_diameter_mm:g}", size_mm, tuple(places))
