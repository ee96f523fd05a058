"""The virtual cameras by name: what is done with a part and a pose until there is a scan."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.twin.filters import Filters, filtered
from aadm_workbench.twin.finite_pixel import FinitePixel
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, scan_of

Shoot: TypeAlias = Callable[[Foot | BarGroup, Array, np.random.Generator], TrueScan]
"""From a part, the pose T_column_scan (4, 4) and a generator to a scan with its truth."""


def ray_camera(noise: CameraNoise) -> Shoot:
    """The ray caster with a law of noise."""
    return lambda part, pose, rng: scan_of(part, pose, noise, rng)


def fringe_camera(distance: float) -> Shoot:
    """Fringe projection, path-traced; its lenses are set for a distance in mm.

    Raises
    ------
    MissingDependencyError
        Where Mitsuba, or the LLVM that it compiles with, is not installed.
    """
    from aadm_workbench.twin.fringe.renderer import mitsuba_ready
    from aadm_workbench.twin.fringe.rig import rig_for
    from aadm_workbench.twin.fringe.shot import FringeCamera, fringe_scan_of

    mitsuba_ready()
    fringe = FringeCamera(rig_for(distance))
    return lambda part, pose, rng: fringe_scan_of(part, pose, fringe, rng)


def with_filters(shoot: Shoot, filters: Filters) -> Shoot:
    """A camera that filters its depth maps."""

    def shot(part: Foot | BarGroup, pose: Array, rng: np.random.Generator) -> TrueScan:
        scan = shoot(part, pose, rng)
        return replace(scan, depth=filtered(scan.depth, filters, scan.brightness))

    return shot


def pixel_camera(noise: CameraNoise) -> Shoot:
    """The ray caster, its pixels with a size: it loses and mixes at edges what they see, and nothing by chance."""
    return ray_camera(replace(noise, pixel=FinitePixel(), step_loss=0.0, step_fly=0.0))


CAMERAS: Mapping[str, Callable[[float, CameraNoise], Shoot]] = MappingProxyType(
    {
        "ray": lambda _distance, noise: ray_camera(noise),
        "pixel": lambda _distance, noise: pixel_camera(noise),
        "fringe": lambda distance, _noise: fringe_camera(distance),
    }
)
"""Cameras from a name, by the distance in mm that they are set for and the ray caster's law of noise."""
