"""A column that hangs above its bars, the camera beside them: the scene of the paper's section 3.3, with its truth.

The bars stand in the *bars' frame*: their tops about z = 0, the nearest corner of the pattern on the diagonal towards
the camera. The column hangs ``height`` above, turned, moved and tilted by known amounts. The truth of a pair is the
distance of its two centres along neither axis but in the foot face: the bar's centre is projected along the foot's
normal (Eq. 11 of the paper), and the components are given in the bars' frame.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, Camera
from aadm_workbench.twin.camera import PRO_M, turned_about
from aadm_workbench.twin.meshes import bars_surface, foot_surface
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, shot, truth_of
from aadm_workbench.twin.surface import joined, moved

CAMERA_BELOW_TOPS_MM = 60.0
"""Of the reference scene: the paper gives the distance, not the height."""
AIMED_AT_GAP_SHARE = 0.45
"""Of the gap between tops and foot: the axis is aimed at a little below its middle, so that bars fill the picture."""


@dataclass(frozen=True)
class Hang:
    """How the column hangs over its bars; lengths in mm, angles in degrees.

    Parameters
    ----------
    height
        From the level of the bar tops to the foot face, at the column's axis.
    angle
        Turn of the column about the vertical, counter-clockwise from above.
    spacing
        Shift of the column across the diagonal on which the camera stands, to the side that the nearest corner turns
        to with a positive angle.
    tilt, tilt_towards
        Lean of the column, and the direction (from +x, counter-clockwise from above) to which its top leans.
    shift
        (x, y) of the column's origin in the bars' frame, beside ``spacing``.
    """

    height: float = 90.0
    angle: float = 0.0
    spacing: float = 0.0
    tilt: float = 0.0
    tilt_towards: float = 0.0
    shift: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class Stand:
    """Where the camera stands: ``distance`` mm from the first bar, as seen from above; angles in degrees.

    ``off_diagonal`` turns its place about the bars' axis, counter-clockwise from above; ``pan``, ``pitch`` and
    ``roll`` turn the camera itself about its own y, x and z axes after it was aimed; ``aside`` mm moves it along its
    own x without turning it.
    """

    distance: float = 850.0
    below_tops: float = CAMERA_BELOW_TOPS_MM
    off_diagonal: float = 0.0
    pan: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0
    aside: float = 0.0


@dataclass(frozen=True, eq=False)
class TruePair:
    """One sleeve over its bar: ``offset_mm`` (2,) is rebar minus sleeve in the bars' frame, projected on the foot."""

    sleeve: str
    rebar: str
    sleeve_scan_mm: Array
    rebar_scan_mm: Array
    offset_mm: Array
    distance_mm: float


@dataclass(frozen=True, eq=False)
class HoistingScan:
    """One frame with its truth. Transforms are (4, 4); parts are in the order of the design's labels."""

    frame: TrueScan
    foot: Foot
    bars: BarGroup
    T_bars_column: Array
    T_bars_scan: Array
    pairs: tuple[TruePair, ...]

    @property
    def tilt_deg(self) -> float:
        """Angle between the column's axis and the bars' vertical."""
        return float(np.degrees(np.arccos(np.clip(self.T_bars_column[2, 2], -1.0, 1.0))))


def hanging_pose(hang: Hang, near: tuple[int, int] = (-1, -1)) -> Array:
    """T_bars_column (4, 4) of a hanging column; ``near`` holds the signs of x and y of the nearest corner."""
    diagonal = np.array(near) / np.sqrt(2.0)
    across = np.array([-diagonal[1], diagonal[0]])
    lean, towards = float(np.radians(hang.tilt)), float(np.radians(hang.tilt_towards))
    axis = np.array([-np.sin(towards), np.cos(towards), 0.0])
    pose = np.eye(4)
    pose[:3, :3] = turned_about(axis, lean) @ turned_about(np.array([0.0, 0.0, 1.0]), np.radians(hang.angle))
    pose[:3, 3] = [*(np.asarray(hang.shift) + hang.spacing * across), hang.height]
    return pose


def standing_pose(
    stand: Stand, hang: Hang, centres: Array, near: tuple[int, int] = (-1, -1), roll_deg: float = 0.0
) -> Array:
    """T_bars_scan (4, 4) of a camera beside bars (n, 2) mm: on the diagonal, aimed at the axis in the gap."""
    diagonal = np.array(near) / np.sqrt(2.0)
    first = float((centres @ diagonal).max())
    around = turned_about(np.array([0.0, 0.0, 1.0]), np.radians(stand.off_diagonal))
    place = around @ np.array([*(first + stand.distance) * diagonal, 0.0])
    place[2] = -stand.below_tops
    forward = np.array([0.0, 0.0, AIMED_AT_GAP_SHARE * hang.height]) - place
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    rotation = np.column_stack([right, np.cross(forward, right), forward])
    own = (
        turned_about(np.array([0.0, 1.0, 0.0]), np.radians(stand.pan))
        @ turned_about(np.array([1.0, 0.0, 0.0]), np.radians(stand.pitch))
        @ turned_about(np.array([0.0, 0.0, 1.0]), np.radians(stand.roll + roll_deg))
    )
    pose = np.eye(4)
    pose[:3, :3] = rotation @ own
    pose[:3, 3] = place + stand.aside * rotation[:, 0]
    return pose


def hoisting_scan(
    foot: Foot,
    bars: BarGroup,
    hang: Hang,
    stand: Stand,
    noise: CameraNoise,
    rng: np.random.Generator,
    *,
    near: tuple[int, int] = (-1, -1),
    camera: Camera = PRO_M,
) -> HoistingScan:
    """Scan a hanging foot and the bars under it in one frame.

    Raises
    ------
    MissingDependencyError
        Where the ray caster is not installed.
    """
    T_bars_column = hanging_pose(hang, near)
    centres = np.array([[bar.x, bar.y] for bar in bars.bars])
    T_bars_scan = standing_pose(stand, hang, centres, near)
    surface = joined([moved(foot_surface(foot), T_bars_column), bars_surface(bars)])
    frame = shot(surface, (*truth_of(foot), *truth_of(bars)), T_bars_scan, noise, rng, camera)
    pairs = true_pairs(foot, bars, T_bars_column, T_bars_scan)
    return HoistingScan(frame, foot, bars, T_bars_column, T_bars_scan, pairs)


def true_pairs(foot: Foot, bars: BarGroup, T_bars_column: Array, T_bars_scan: Array) -> tuple[TruePair, ...]:
    """The truth of every pair of a hanging column; the poses place the column and the camera in the bars' frame."""
    rotation, origin = T_bars_column[:3, :3], T_bars_column[:3, 3]
    normal = rotation[:, 2]
    T_scan_bars = np.linalg.inv(T_bars_scan)
    pairs = []
    for sleeve, rebar in zip(truth_of(foot), truth_of(bars), strict=True):
        mouth = rotation @ sleeve.centre + origin
        apart = rebar.centre - mouth
        apart = apart - normal * float(normal @ apart)
        at, bar_at = (T_scan_bars[:3, :3] @ point + T_scan_bars[:3, 3] for point in (mouth, rebar.centre))
        pairs.append(TruePair(sleeve.label, rebar.label, at, bar_at, apart[:2], float(np.linalg.norm(apart))))
    return tuple(pairs)
