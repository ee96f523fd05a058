"""Lenses, pixels and fringes of the virtual fringe-projection camera, and where its projector stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array

Rung = tuple[tuple[int, ...], int]
"""Whole-number weights of the measured phases, and how many periods their sum has over the projector's width."""


@dataclass(frozen=True)
class Fringes:
    """Vertical sinusoidal fringes in four phase steps, and how their phases are unwrapped.

    ``periods`` over the projector's width. ``ladder`` goes from a beat of one period, which needs no unwrapping, to
    the fringes that the depth is read from. 70, 64 and 59 beat to 6 and 5, these to 1 (optimum three-frequency
    selection: Towers, Towers and Jones, Optics Letters 28, 2003).
    """

    periods: tuple[int, ...] = (70, 64, 59)
    ladder: tuple[Rung, ...] = (((1, -2, 1), 1), ((1, -1, 0), 6), ((1, 0, 0), 70))

    def __post_init__(self) -> None:
        """Refuse a ladder whose beats do not have the periods that it says."""
        for weights, periods in self.ladder:
            if sum(w * p for w, p in zip(weights, self.periods, strict=True)) != periods:
                raise ValueError(f"the weights {weights} of the periods {self.periods} do not beat to {periods}")


@dataclass(frozen=True)
class Lenses:
    """Thin lenses of camera and projector. Lengths in mm.

    ``fill`` is the side of the pixel's sensitive square and ``blur`` the standard deviation of the camera's point
    spread in focus, both in pixels: sharp optics keep the sum below half a pixel. A focus is the distance along the
    optical axis that is sharp.
    """

    camera_aperture: float = 2.5
    camera_focus: float = 1200.0
    fill: float = 0.9
    blur: float = 0.35
    projector_aperture: float = 6.0
    projector_focus: float = 1150.0


@dataclass(frozen=True)
class Projector:
    """A projector on the camera's x axis, turned about y so that both optical axes meet at a distance.

    ``focal`` in pixels: 52 degrees over the width, so that the picture holds the camera's from 0.7 m on.
    """

    baseline: float = 270.0
    axes_meet: float = 1200.0
    width: int = 1920
    height: int = 1080
    focal: float = 1968.0

    def rotation(self) -> Array:
        """Rotation (3, 3) whose columns are the projector's axes in the camera frame."""
        turn = np.arctan2(self.baseline, self.axes_meet)
        z = np.array([-np.sin(turn), 0.0, np.cos(turn)])
        y = np.array([0.0, 1.0, 0.0])
        return np.column_stack([np.cross(y, z), y, z])


@dataclass(frozen=True)
class Sensor:
    """From light to counts, and which counts are trusted.

    ``full_well`` and ``read_noise`` in electrons. ``exposures`` relative to the one at which ``exposed_for`` of the
    full well is reached by the lit concrete (its 95th percentile). ``ambient`` is other light, as a share of that
    concrete's. ``least_modulation``: amplitude of the fringes over the full scale below which a pixel is dropped.
    """

    full_well: float = 16000.0
    read_noise: float = 8.0
    bits: int = 10
    exposures: tuple[float, ...] = (4.0, 1.0, 0.25)
    exposed_for: float = 0.75
    ambient: float = 0.03
    least_modulation: float = 0.02


@dataclass(frozen=True)
class FringeRig:
    """A whole camera. ``nearest`` and ``farthest`` bound the depths that it returns, mm."""

    lenses: Lenses = Lenses()
    projector: Projector = Projector()
    fringes: Fringes = Fringes()
    sensor: Sensor = Sensor()
    nearest: float = 300.0
    farthest: float = 3000.0


def rig_for(distance: float) -> FringeRig:
    """A camera that is set for a distance, mm: in whole decimetres, as one would; the projector a little nearer.

    What a slipped fringe puts far outside of the working range is not returned, as on cameras whose range one sets.
    """
    at = max(100.0 * round(distance / 100.0), 400.0)
    lenses = Lenses(camera_focus=at, projector_focus=0.96 * at)
    return FringeRig(lenses, Projector(axes_meet=at), nearest=0.5 * at, farthest=1.4 * at)
