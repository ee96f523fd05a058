"""Captures of a plate by a virtual camera, with the truth beside them: what `aadm camera learn` is tried on."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from aadm_workbench.calibration.plate.file import plate_text
from aadm_workbench.calibration.plate.plate import Place, Plate
from aadm_workbench.model import Array, Kind
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import DEPTH_SCALE_MM, PRO_M, capture_tables, facing
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.pair import CAMERAS, Taken, with_filters
from aadm_workbench.twin.parts import BarAsBuilt, Foot, PlateAsBuilt, SleeveAsBuilt
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import UP

DISTANCES_MM = (1300.0, 1450.0)
"""Where a plate of 600 mm fills the picture of the reference camera, and somewhat farther."""

_TILT_DEG = 5.0  # at most: as columns are scanned
_OFF_MM = 15.0  # of the plate's middle from the optical axis: nobody aims better by hand


@dataclass(frozen=True)
class MadePlate:
    """A plate as a workshop made it: true ``places`` by label, (3,) mm, and the plate that was measured."""

    part: PlateAsBuilt
    places: dict[str, Array]
    measured: Plate


def made_plate(plate: Plate, rng: np.random.Generator) -> MadePlate:
    """A plate whose places are off the drawing by its u, and a measuring machine's table off them by a tenth of it."""
    true = [_off(np.array([one.x_mm, one.y_mm, one.z_mm]), one.u_mm, one.kind, rng) for one in plate.places]
    found = [_off(at, one.u_mm / 10.0, one.kind, rng) for at, one in zip(true, plate.places, strict=True)]
    places = tuple(
        replace(one, x_mm=float(at[0]), y_mm=float(at[1]), z_mm=float(at[2]), u_mm=one.u_mm / 10.0)
        for one, at in zip(plate.places, found, strict=True)
    )
    holes = [(one, at) for one, at in zip(plate.places, true, strict=True) if one.kind is Kind.SLEEVE]
    pins = [(one, at) for one, at in zip(plate.places, true, strict=True) if one.kind is Kind.REBAR]
    sleeves = tuple(SleeveAsBuilt(float(at[0]), -float(at[1]), one.diameter_mm, plate.bore_mm) for one, at in holes)
    bars = tuple(_pin(one, at) for one, at in pins)
    part = PlateAsBuilt(Foot((plate.size_mm, plate.size_mm), sleeves, plate.bore_mm), bars)
    labels = dict(zip((one.label for one in plate.places), true, strict=True))
    return MadePlate(part, labels, replace(plate, places=places, calibrated=True))


def _pin(one: Place, at: Array) -> BarAsBuilt:
    return BarAsBuilt(float(at[0]), float(at[1]), float(at[2]), one.diameter_mm, rib_height=0.0)


def _off(at: Array, u_mm: float, kind: Kind, rng: np.random.Generator) -> Array:
    """A place off by its u: a hole stays on the face."""
    return at + rng.normal(0.0, u_mm, 3) * [1.0, 1.0, float(kind is Kind.REBAR)]


def plate_pose(number: int, rng: np.random.Generator) -> Array:
    """Pose T_plate_scan (4, 4) of one of several captures: distances in turn, turned by 0, 90, 180, 270 degrees."""
    tilt, towards = np.radians(_TILT_DEG) * np.sqrt(rng.uniform()), rng.uniform(0.0, 2.0 * np.pi)
    target = np.array([*rng.uniform(-_OFF_MM, _OFF_MM, 2), 0.0])
    roll = np.radians(90.0 * (number % 4) + rng.uniform(-3.0, 3.0))
    distance = DISTANCES_MM[number // 4 % len(DISTANCES_MM)]
    leaning = (tilt * np.cos(towards), tilt * np.sin(towards))
    return facing(target, np.array([0.0, 0.0, -1.0]), UP, distance, leaning, roll)


def plate_captures(
    made: MadePlate, count: int, noise: CameraNoise, taken: Taken, rng: np.random.Generator
) -> Iterator[TrueScan]:
    """So many captures of a plate by one camera."""
    shoot = with_filters(CAMERAS[taken.camera](DISTANCES_MM[0], noise), taken.filters)
    for number in range(count):
        yield shoot(made.part, plate_pose(number, rng), rng)


def make_plate(folder: Path, plate: Plate, seed: int, count: int, taken: Taken) -> Iterator[str]:
    """Write plate.toml with its table, captures, camera.toml and truth.json into a folder; a line of each capture."""
    rng = np.random.default_rng(seed)
    made, noise = made_plate(plate, rng), replace(CameraNoise.drawn(rng), scale=rng.choice([-1.0, 1.0]) * 5e-4)
    text = plate_text(plate).replace("\n\n[[places]]", '\ntable = "plate.csv"\n\n[[places]]', 1)
    write_atomically(folder / "plate.toml", text.encode())
    write_atomically(folder / "plate.csv", table_text(made.measured).encode())
    write_atomically(folder / "camera.toml", capture_tables(PRO_M, DEPTH_SCALE_MM).split("\n[capture]")[0].encode())
    poses = []
    for number, scan in enumerate(plate_captures(made, count, noise, taken, rng), 1):
        write_depth_tiff(folder / f"plate-{number}.tiff", scan.depth, DEPTH_SCALE_MM)
        poses.append(np.round(scan.T_column_scan, 9).tolist())
        yield f"plate-{number}.tiff"
    truth = {
        "synthetic": True,
        "seed": seed,
        "scale": noise.scale if taken.camera != "fringe" else 0.0,
        "places_mm": {label: np.round(at, 5).tolist() for label, at in made.places.items()},
        "T_plate_scan": poses,
    }
    write_atomically(folder / "truth.json", (json.dumps(truth, indent=1) + "\n").encode())


def table_text(plate: Plate) -> str:
    """A measuring machine's table: CSV."""
    lines = ["label,x_mm,y_mm,z_mm,diameter_mm,u_mm"]
    lines += [
        f"{one.label},{one.x_mm:.5f},{one.y_mm:.5f},{one.z_mm:.5f},{one.diameter_mm:.5f},{one.u_mm:.5f}"
        for one in plate.places
    ]
    return "\n".join(lines) + "\n"
