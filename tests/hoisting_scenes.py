"""Frames of a hanging column that several tests look at, each rendered once per process."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from aadm_workbench.model import Array, AssemblyPoint, HoistingMeasurement
from aadm_workbench.twin.hoisting import Hang, HoistingScan, Stand, hoisting_scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import truth_of
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_foot

NEAR = (-1, -1)


def frame(
    setting: Setting,
    hang: Hang,
    stand: Stand,
    seed: int,
    *,
    half_taped: bool = False,
    near: tuple[int, int] = NEAR,
    bent: tuple[int, float, float] | None = None,
) -> HoistingScan:
    """A random foot over random bars, hung and seen as asked for; ``bent``: a bar, and by how much in x and y, mm."""
    rng = np.random.default_rng([11, seed])
    foot, bars = random_foot(setting, rng), random_bars(setting, rng)
    if bent is not None:
        number, dx, dy = bent
        moved = replace(bars.bars[number], x=bars.bars[number].x + dx, y=bars.bars[number].y + dy)
        bars = replace(bars, bars=(*bars.bars[:number], moved, *bars.bars[number + 1 :]))
    if half_taped:
        turn = rng.uniform(0.0, 2 * np.pi, len(foot.sleeves))
        sleeves = [replace(s, taped=0.5, chip_direction=float(t)) for s, t in zip(foot.sleeves, turn, strict=True)]
        foot = replace(foot, sleeves=tuple(sleeves))
    return hoisting_scan(foot, bars, hang, stand, CameraNoise.drawn(rng), rng, near=near)


@cache
def usual() -> HoistingScan:
    """The laboratory column 90 mm above its bars, the camera 850 mm away."""
    return frame(LAB, Hang(90.0, shift=(0.6, -0.7)), Stand(850.0), 1)


@cache
def from_corner(near: tuple[int, int]) -> HoistingScan:
    """The laboratory column, hanging still some way off, seen from a corner."""
    return frame(LAB, Hang(90.0, shift=(6.1, -5.1)), Stand(800.0), 6, near=near)


@cache
def bent_since() -> HoistingScan:
    """The usual column, one bar in plain sight bent by 6 mm since its scan."""
    return frame(LAB, Hang(90.0, shift=(0.6, -0.7)), Stand(850.0), 1, bent=(1, 4.0, -4.5))


@cache
def turned_and_aside() -> HoistingScan:
    """Where the paper loses the measurement: 40 degrees, 210 mm high, tilted, the camera not quite straight."""
    hang = Hang(210.0, 40.0, tilt=1.0, tilt_towards=70.0, shift=(2.0, 1.0))
    return frame(LAB, hang, Stand(750.0, off_diagonal=6.0, roll=2.0, pitch=-1.0), 2)


@cache
def field() -> HoistingScan:
    """A 600 mm column from where the paper's field test had its camera."""
    return frame(FIELD, Hang(150.0, shift=(-1.0, 0.8)), Stand(720.0), 3)


@cache
def taped() -> HoistingScan:
    """Half of every mouth under tape."""
    return frame(LAB, Hang(120.0, shift=(0.4, 0.4)), Stand(700.0), 4, half_taped=True)


def offset_errors(measured: HoistingMeasurement, truth: HoistingScan) -> Array:
    """(k, 2) mm: measured minus true offsets."""
    return np.asarray(measured.offsets_mm - np.array([pair.offset_mm for pair in truth.pairs]))


def distance_errors(measured: HoistingMeasurement, truth: HoistingScan, *, seen: bool = True) -> Array:
    """(k,) mm: absolute errors of the distances, of seen pairs or of all."""
    return np.array(
        [
            abs((pair.distance_mm or np.nan) - true.distance_mm)
            for pair, true in zip(measured.report.pairs, truth.pairs, strict=True)
            if pair.seen or not seen
        ]
    )


def before(part: Foot | BarGroup, u_mm: float, seed: int) -> tuple[AssemblyPoint, ...]:
    """What a scan before hoisting would have told of a part, with an uncertainty per axis."""
    rng = np.random.default_rng([12, seed])
    return tuple(
        replace(point, centre=point.centre + np.append(rng.normal(0.0, u_mm, 2), 0.0), covariance=u_mm**2 * np.eye(3))
        for point in truth_of(part)
    )
