"""What it costs to take sleeves by design from the corners of the foot: errors of centres beside other methods.

    python -m benchmarks.corners [--scenes 8] [--seed 1] [--methods refined fusion corners]

Scenes of the ray-casting camera. Each row is another thing that happens to a foot; all methods see the same scans.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.method import METHODS, Known, extract
from aadm_workbench.model import Extraction, Kind
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import FIELD, LAB, Setting, random_bars, random_foot, random_pose
from aadm_workbench.twin.site import left_by_site
from aadm_workbench.twin.study.errors import compared
from aadm_workbench.twin.truth import sample_design

_UP_DEG = 90.0  # of the scenes: +y at the top of the picture


@dataclass(frozen=True)
class Condition:
    """What is seen, and what the site did to it."""

    name: str
    setting: Setting
    site: tuple[str, ...] = ()


CONDITIONS = (
    Condition("all corners in view, 0.8 m", LAB),
    Condition("sleeves beside their place in the section", LAB, ("pattern-beside",)),
    Condition("one to three corners broken off", LAB, ("broken-corners",)),
    Condition("edges broken", LAB, ("broken-edges",)),
    Condition("section off size", LAB, ("off-size",)),
    Condition("face bowed", LAB, ("bowed",)),
    Condition("600 mm foot at 1.3 m, corners out of the picture", FIELD),
)


def scans_of(condition: Condition, scenes: int, seed: int) -> list[TrueScan]:
    """Scans of feet that the site left so."""
    taken = []
    for number in range(scenes):
        rng = np.random.default_rng([seed, *condition.setting.name.encode(), number])
        foot, bars = random_foot(condition.setting, rng), random_bars(condition.setting, rng)
        pose, noise = random_pose(condition.setting, True, rng), CameraNoise.drawn(rng)
        foot, _ = left_by_site(condition.site, foot, bars, rng)
        taken.append(scan_of(foot, pose, noise, rng))
    return taken


def row(condition: Condition, scans: Sequence[TrueScan], method: str) -> str:
    """Mean and largest error of centres, mm, of those found; on how many scans there were any."""
    setting = condition.setting
    known = Known(sample_design(setting), _UP_DEG)
    errors: list[float] = []
    answered = 0
    for number, truth in enumerate(scans):
        rng = np.random.default_rng(number)
        found: Extraction = extract(truth.scan(), Kind.SLEEVE, setting.sleeve_diameter, method, rng, known=known)
        answered += bool(found.points)
        features = compared(found, truth, setting.centres(), setting.sleeve_diameter / 2).features
        errors += [feature.distance_mm for feature in features if feature.distance_mm is not None]
    if not errors:
        return f"none of {len(scans)} scans"
    return f"{np.mean(errors):.2f} ({np.max(errors):.2f}), {answered} of {len(scans)} scans"


def main() -> None:
    """Run everything and print it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--methods", nargs="+", choices=list(METHODS), default=["refined", "fusion", "corners"])
    options = parser.parse_args()
    print("error of sleeve centres in the plane, mm: mean (largest)")
    for condition in CONDITIONS:
        scans = scans_of(condition, options.scenes, options.seed)
        told = (f"{method} {row(condition, scans, method)}" for method in options.methods)
        print(f"{condition.name}: {'; '.join(told)}", flush=True)


if __name__ == "__main__":
    main()
