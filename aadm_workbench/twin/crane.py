"""A column on a virtual crane over its bars, and the virtual camera beside them: what the whole chain is tried on.

The crane is as wrong as cranes are: a move comes out some percent too long or too short, and beside it by some tenths
of a millimetre. It does not swing: for that, see ``docs/hoisting.md``.
"""

from __future__ import annotations

import json
import threading
import time
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from aadm_workbench.camera.frame import Closing, Device, Frame
from aadm_workbench.errors import CaptureError, EndOfFramesError
from aadm_workbench.model import Camera
from aadm_workbench.own_files import write_atomically
from aadm_workbench.scan.write import write_depth_tiff
from aadm_workbench.twin.camera import DEPTH_SCALE_MM, PRO_M, capture_tables
from aadm_workbench.twin.hoisting import Hang, Stand, hanging_pose, hoisting_scan, standing_pose, true_pairs
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarAsBuilt, BarGroup, Foot
from aadm_workbench.twin.scene import scan_of
from aadm_workbench.twin.scenes import LAB, Setting, random_bars, random_foot, random_pose

COLUMN = "L-1"
"""What the job calls the column."""

NEAR = (-1, -1)
"""The corner that the camera stands at: signs of x and y."""

_GAIN_SIGMA = 0.03  # of a move, relatively: a slewing crane's joystick and rope
_BESIDE_SIGMA_MM, _BESIDE_SIGMA_DEG = 0.3, 0.03  # what play in hook and rope leaves
_FIRST_MM, _FIRST_DEG = 25.0, 2.0  # a crane driver brings it that near by eye
_SPREAD_MM = 0.25  # per axis, of sleeves and bars: a column that its trial before hoisting let go on
_HEIGHT_MM, _DISTANCE_MM = 90.0, 850.0  # of the reference scene (docs/hoisting.md)
_DECISION_WITHIN_S = 60.0  # a controller decides in a second; a machine that is overloaded takes longer
_FRAME_EVERY_NS = 1_500_000_000  # frames that follow each other faster tell little of a swing


@dataclass
class Crane:
    """The scene: parts as built, how the column hangs, and who waits for whom.

    The camera takes a picture when the controller has decided about the last one, as a triggered camera does: what it
    renders is then what hangs there at the time of capture. The scene has a clock of its own, which stands while light
    is calculated, so that a slow machine comes to the same end.
    """

    foot: Foot
    bars: BarGroup
    hang: Hang
    noise: CameraNoise
    rng: np.random.Generator
    camera: Camera = PRO_M
    stand: Stand = field(default_factory=lambda: Stand(_DISTANCE_MM))
    time_ns: int = field(default_factory=time.time_ns)
    moves: int = 0
    landed: bool = False
    _decided: threading.Event = field(default_factory=threading.Event)

    def largest_mm(self) -> float:
        """The true largest distance of a sleeve from its bar."""
        centres = np.array([[bar.x, bar.y] for bar in self.bars.bars])
        T_bars_scan = standing_pose(self.stand, self.hang, centres, NEAR)
        return max(p.distance_mm for p in true_pairs(self.foot, self.bars, hanging_pose(self.hang, NEAR), T_bars_scan))

    def move(self, dx_mm: float, dy_mm: float, yaw_deg: float) -> None:
        """Turn the column about its own axis, then move it, in the bars' frame, as well as the crane can."""
        gain, turn_gain = 1.0 + self.rng.normal(0.0, _GAIN_SIGMA, 2)
        beside = self.rng.normal(0.0, _BESIDE_SIGMA_MM, 2)
        x, y = np.asarray(self.hang.shift) + gain * np.array([dx_mm, dy_mm]) + beside
        angle = self.hang.angle + turn_gain * yaw_deg + self.rng.normal(0.0, _BESIDE_SIGMA_DEG)
        self.hang = replace(self.hang, shift=(float(x), float(y)), angle=float(angle))
        self.moves += 1

    def lower(self) -> None:
        """Let the column down; what is then not over its bars stands beside them."""
        self.landed = True
        self.decided()

    def decided(self) -> None:
        """Let the camera take the next picture."""
        self._decided.set()

    def frame(self) -> Frame:
        """What the camera sees now."""
        scan = hoisting_scan(
            self.foot, self.bars, self.hang, self.stand, self.noise, self.rng, near=NEAR, camera=self.camera
        ).frame
        depth_mm = np.where(scan.depth > 0, scan.depth, np.float32(np.nan))
        self.time_ns += _FRAME_EVERY_NS
        return Frame(Device("virtual"), self.time_ns / 1e9, depth_mm=depth_mm, camera=self.camera)

    def now_ns(self) -> int:
        """The time of the scene, ns since 1970."""
        return self.time_ns

    def wait_for_decision(self) -> None:
        """Wait until the controller has decided about the last picture."""
        if not self._decided.wait(_DECISION_WITHIN_S):
            raise CaptureError.because("command.twin_undecided", within_s=_DECISION_WITHIN_S)
        self._decided.clear()
        if self.landed:
            raise EndOfFramesError.because("command.twin_stands")


class VirtualCamera(Closing):
    """The camera of a scene."""

    def __init__(self, crane: Crane) -> None:
        self.device, self._crane = Device("virtual"), crane

    def capture(self) -> Frame:
        """Take a picture of the column as it hangs, once the controller has decided."""
        self._crane.wait_for_decision()
        return self._crane.frame()

    def close(self) -> None:
        """Nothing is held."""


def laboratory_crane(seed: int, camera: Camera = PRO_M) -> Crane:
    """A random laboratory column that hangs where a driver brings it by eye."""
    rng = np.random.default_rng(seed)
    foot, bars = random_foot(LAB, rng, _SPREAD_MM), random_bars(LAB, rng, _SPREAD_MM)
    x, y = rng.uniform(-_FIRST_MM, _FIRST_MM, 2)
    hang = Hang(_HEIGHT_MM, angle=float(rng.uniform(-_FIRST_DEG, _FIRST_DEG)), shift=(float(x), float(y)))
    crane = Crane(foot, bars, hang, CameraNoise.drawn(rng), rng, camera)
    crane.decided()
    return crane


def write_job(folder: Path, crane: Crane) -> Path:
    """Scan foot and bars as before hoisting, and write both with the job of the column; the job.

    What a frame of the hanging column hides is known from these scans alone.
    """
    for name, part in (("foot", crane.foot), ("bars", crane.bars)):
        pose = random_pose(LAB, name == "foot", crane.rng)
        scan = scan_of(part, pose, crane.noise, crane.rng, crane.camera)
        write_depth_tiff(folder / f"{name}.tiff", scan.depth, DEPTH_SCALE_MM)
    path = folder / "job.toml"
    write_atomically(path, _job_text(LAB, crane.camera).encode())
    return path


def _job_text(setting: Setting, camera: Camera) -> str:
    design = {
        "sleeve_diameter": setting.sleeve_diameter,
        "rebar_diameter": setting.bar_diameter,
        "rebar_outer_diameter": round(setting.bar_core + 2.0 * BarAsBuilt.rib_height, 4),
        "embedded_length": setting.exposed,
        "size": [setting.size, setting.size],
        "centres": setting.centres().tolist(),
    }
    lines = "\n".join(f"{key} = {json.dumps(value)}" for key, value in design.items())
    return f"""\
schema = 1
units = "mm"

{capture_tables(camera, DEPTH_SCALE_MM)}
[[columns]]
id = "{COLUMN}"
sleeves = "foot.tiff"
rebars = "bars.tiff"
up = "+y"
near = "-x-y"
[columns.design]
{lines}
"""
