"""One foot and one group of bars as the virtual camera sees them, and what a method's points come to against truth."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import pytest

from aadm_workbench.extract.plane import axes_on
from aadm_workbench.model import Array, Camera, Extraction, Kind, Plane
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import LAB, random_bars, random_foot, random_pose

# Half the resolution of the reference camera: a quarter of the time, and pixels as coarse as those of a field scan.
CAMERA = Camera(PRO_M.fx / 2, PRO_M.fy / 2, PRO_M.cx / 2, PRO_M.cy / 2, PRO_M.width // 2, PRO_M.height // 2)

Scenes: TypeAlias = dict[Kind, TrueScan]


@pytest.fixture(scope="session")
def scenes() -> Scenes:
    """A foot and its bars in the laboratory setting, 800 mm from the camera."""
    rng = np.random.default_rng(20)
    foot, bars = random_foot(LAB, rng), random_bars(LAB, rng)
    return {
        Kind.SLEEVE: scan_of(foot, random_pose(LAB, True, rng), CameraNoise.drawn(rng), rng, CAMERA),
        Kind.REBAR: scan_of(bars, random_pose(LAB, False, rng), CameraNoise.drawn(rng), rng, CAMERA),
    }


@dataclass(frozen=True)
class Score:
    """What was found of the true points, mm: errors are in the plane across the true axes."""

    found: int
    false: int
    mean_mm: float
    along_mm: float
    lean_deg: float


@pytest.fixture(scope="session")
def score() -> Callable[[Extraction, Array, Array], Score]:
    """Compare an extraction with true centres (n, 3) and axes (n, 3) in the same frame."""

    def compare(extraction: Extraction, centres: Array, axes: Array) -> Score:
        vertical = axes.mean(axis=0) / np.linalg.norm(axes.mean(axis=0))
        across = axes_on(Plane(vertical, 0.0))
        offset = (np.array([p.centre for p in extraction.points])[None] - centres[:, None]) @ across.T
        distance = np.hypot(offset[..., 0], offset[..., 1])
        nearest = distance.argmin(axis=1)
        met = distance.min(axis=1) < 5.0
        along = np.abs(offset[np.arange(len(centres)), nearest, 2])
        cosine = [extraction.points[k].axis @ axis for k, axis in zip(nearest, axes, strict=True)]
        return Score(
            found=int(met.sum()),
            false=int((distance.min(axis=0) >= 5.0).sum()),
            mean_mm=float(distance.min(axis=1)[met].mean()),
            along_mm=float(along[met].mean()),
            lean_deg=float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))).max()),
        )

    return compare
