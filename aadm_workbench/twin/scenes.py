"""Random scenes of the two settings that accuracy figures refer to: the laboratory model and the field column.

The ranges are those of the reference camera: as-built errors of 0.5 mm, camera up to 5 degrees off the
normal and off centre, sleeves that lean, with ribs and chamfers, bars that lean and end at different heights.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.pattern import label_order
from aadm_workbench.model import Array, Camera
from aadm_workbench.twin.camera import PRO_M, facing
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Foot, SleeveAsBuilt, ring
from aadm_workbench.twin.scene import TrueScan, scan_of

UP = np.array([0.0, 1.0, 0.0])  # of the picture, column frame


@dataclass(frozen=True)
class Setting:
    """Nominal sizes in mm of a column foot with its bars, and the distance of the camera."""

    name: str
    size: float
    half_width: float
    per_side: int
    sleeve_diameter: float
    bar_diameter: float
    bar_core: float
    exposed: float
    distance: float

    def centres(self) -> Array:
        """Design centres (n, 2), in the order of their labels."""
        centres = ring(self.half_width, self.half_width, self.per_side)
        return np.asarray(centres[label_order(centres)])


LAB = Setting("lab", 250.0, 90.0, 4, 26.0, 18.0, 18.0, 120.0, 800.0)
FIELD = Setting("field", 600.0, 240.0, 4, 36.0, 20.0, 19.3, 160.0, 1300.0)


_NONE = np.zeros(2)  # upright, square


def _off(value: Array, spread: float, rng: np.random.Generator) -> tuple[float, float]:
    """Two numbers off their nominal values by a normal error."""
    x, y = value + rng.normal(0.0, spread, 2)
    return float(x), float(y)


def random_foot(setting: Setting, rng: np.random.Generator, spread: float = 0.5) -> Foot:
    """A foot whose sleeves are off by ``spread`` mm per axis (one standard deviation)."""
    lean = np.radians(0.3)
    chamfer, rib = rng.uniform(0.0, 1.0, 2)
    sleeves = tuple(
        SleeveAsBuilt(
            *_off(centre, spread, rng),
            diameter=setting.sleeve_diameter + rng.normal(0.0, 0.1),
            lean=_off(_NONE, lean, rng),
            chamfer=chamfer,
            rib_height=rib,
            rib_start=rng.uniform(15.0, 40.0),
        )
        for centre in setting.centres()
    )
    return Foot((setting.size, setting.size), sleeves)


def random_bars(setting: Setting, rng: np.random.Generator, spread: float = 0.5) -> BarGroup:
    """Bars that are off by ``spread`` mm per axis, with tops within 3 mm of their level."""
    lean = np.radians(0.3)
    ridge = float(rng.choice([0.0, 0.9]))
    bars = tuple(
        BarAsBuilt(
            *_off(centre, spread, rng),
            top=rng.uniform(-3.0, 3.0),
            core_diameter=setting.bar_core + rng.normal(0.0, 0.1),
            lean=_off(_NONE, lean, rng),
            rib_phase=rng.uniform(),
            rib_turn=rng.uniform(0.0, 2 * np.pi),
            longitudinal_rib=ridge,
            slant=_off(_NONE, 0.01, rng),
        )
        for centre in setting.centres()
    )
    return BarGroup(bars, -setting.exposed)


def random_pose(
    setting: Setting, looking_up: bool, rng: np.random.Generator, tilt_deg: float = 5.0, distance: float | None = None
) -> Array:
    """Pose T_column_scan (4, 4) of a camera in front of the foot, or above the bars."""
    forward = np.array([0.0, 0.0, 1.0 if looking_up else -1.0])
    tilt_by, tilt_to = np.radians(tilt_deg) * np.sqrt(rng.uniform()), rng.uniform(0, 2 * np.pi)
    target = np.array([*rng.uniform(-0.05, 0.05, 2) * setting.size, 0.0])
    tilt = (tilt_by * np.cos(tilt_to), tilt_by * np.sin(tilt_to))
    distance = setting.distance if distance is None else distance
    return facing(target, forward, UP, distance, tilt, np.radians(rng.uniform(-3.0, 3.0)))


def random_sleeve_scan(setting: Setting, rng: np.random.Generator, camera: Camera = PRO_M) -> TrueScan:
    """A random foot as the reference camera sees it."""
    foot = random_foot(setting, rng)
    return scan_of(foot, random_pose(setting, True, rng), CameraNoise.drawn(rng), rng, camera)


def random_bar_scan(setting: Setting, rng: np.random.Generator, camera: Camera = PRO_M) -> TrueScan:
    """A random group of bars as the reference camera sees it."""
    bars = random_bars(setting, rng)
    return scan_of(bars, random_pose(setting, False, rng), CameraNoise.drawn(rng), rng, camera)
