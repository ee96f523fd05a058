"""What following costs: frames of a column that swings slightly, each searched and each followed, in one run.

``python -m benchmarks.tracking --frames 6`` prints milliseconds of one core (reading excluded) and errors side by side.
"""

from __future__ import annotations

import argparse
import platform
from time import process_time

import cv2
import numpy as np

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.hoisting.measure import HoistingSettings, measure_hoisting
from aadm_workbench.hoisting.sequence.sighting import SightedMeasurement, Sighting
from aadm_workbench.model import Array, ColumnDesign, HoistingMeasurement
from aadm_workbench.twin.hoisting import Hang, HoistingScan, Stand, hoisting_scan
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_foot
from aadm_workbench.twin.study.hoisting import design_of

_NEAR = (-1, -1)
_SWING_MM, _LOWERED_MM = 1.2, 1.5  # from frame to frame, at some frames a second


def frames_of(setting: Setting, hang: Hang, stand: Stand, count: int, seed: int) -> list[HoistingScan]:
    """A column that moves by about a millimetre from frame to frame."""
    rng = np.random.default_rng([78, seed])
    foot, bars, noise = random_foot(setting, rng), random_bars(setting, rng), CameraNoise.drawn(rng)
    at, frames = rng.uniform(-3.0, 3.0, 2), []
    for number in range(count):
        now = Hang(hang.height - _LOWERED_MM * number, 0.4, shift=(float(at[0]), float(at[1])), tilt=0.2)
        frames.append(hoisting_scan(foot, bars, now, stand, noise, rng))
        at = at + rng.uniform(-_SWING_MM, _SWING_MM, 2)
    return frames


def timed(
    truth: HoistingScan, design: ColumnDesign, after: Sighting | None
) -> tuple[HoistingMeasurement, float, Array]:
    """A frame with its milliseconds, and the errors (k,) mm of the pairs that it sees."""
    scan, settings = truth.frame.scan(), HoistingSettings(load_profile("cn"))
    began = process_time()
    found = measure_hoisting(scan, design, near=_NEAR, settings=settings, after=after)
    spent_ms = 1e3 * (process_time() - began)
    seen = np.array([pair.seen for pair in found.report.pairs])
    true = np.array([pair.offset_mm for pair in truth.pairs])
    return found, spent_ms, np.hypot(*(found.offsets_mm - true)[seen].T)


def main() -> None:
    """Print it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frames", type=int, default=6)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    cv2.setNumThreads(1)
    print(f"{platform.processor() or platform.machine()}; frames of 1920 x 1200 rays; one core, reading excluded")
    print("column   searched ms  followed ms   searched mm  followed mm   followed")
    for setting, hang, stand in ((LAB, Hang(90.0), Stand(850.0)), (FIELD, Hang(150.0), Stand(720.0))):
        design, last = design_of(setting), None
        rows: list[tuple[float, float, float, float, bool]] = []
        for truth in frames_of(setting, hang, stand, options.frames, options.seed):
            _, full_ms, full_mm = timed(truth, design, None)
            found, ms, mm = timed(truth, design, last)
            last = found.sighting if isinstance(found, SightedMeasurement) else None
            rows.append((full_ms, ms, float(full_mm.mean()), float(mm.mean()), last is not None and last.tracked > 0))
        followed = [row for row in rows if row[4]]
        middle = np.median(np.array([row[:2] for row in followed]), axis=0)
        errors = np.mean(np.array([row[2:4] for row in followed]), axis=0)
        counts = f"{len(followed)} of {len(rows) - 1}"
        print(f"{setting.name:8} {middle[0]:11.0f} {middle[1]:12.0f} {errors[0]:13.3f} {errors[1]:12.3f}   {counts}")


if __name__ == "__main__":
    main()
