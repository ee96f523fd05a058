"""Scans of the virtual camera that several tests look at, each rendered once per process."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from aadm_workbench.extract.plane import axes_on
from aadm_workbench.model import Array, Camera, Extraction, Plane, Scan
from aadm_workbench.twin.camera import PRO_M
from aadm_workbench.twin.noise import CameraNoise
from aadm_workbench.twin.parts import BarGroup, Foot
from aadm_workbench.twin.scene import TrueScan, scan_of
from aadm_workbench.twin.scenes import (
    FIELD,
    LAB,
    Setting,
    random_bar_scan,
    random_bars,
    random_foot,
    random_pose,
    random_sleeve_scan,
)

SETTINGS = {"lab": LAB, "field": FIELD}
WARP_PERIOD = PRO_M.width / 3  # of the whole image, not of a window
SEEN_DEPTH_MM = 130.0  # of a bore: nothing behind is seen, and ribs there only cost triangles
BESIDE_MM = 44.0  # the pattern: face around the outermost mouths, floor around the outermost bars


@cache
def sleeve_scan(setting: str) -> TrueScan:
    """A foot drawn from the ranges of the reference camera."""
    return random_sleeve_scan(SETTINGS[setting], np.random.default_rng([7, 0]))


@cache
def bar_scan(setting: str) -> TrueScan:
    """A group of bars drawn from the same ranges."""
    return random_bar_scan(SETTINGS[setting], np.random.default_rng([7, 1]))


def quiet_noise() -> CameraNoise:
    """A camera in the middle of the ranges, without scale error."""
    return CameraNoise(scale=0.0)


def lab_foot(seed: int = 3) -> Foot:
    return random_foot(LAB, np.random.default_rng(seed))


def lab_bars(seed: int = 3) -> BarGroup:
    return random_bars(LAB, np.random.default_rng(seed))


def lab_scan(part: Foot | BarGroup, seed: int = 5, setting: Setting = LAB) -> TrueScan:
    """Scan a part from a random pose in front of it; of the camera's image only what shows the pattern."""
    rng = np.random.default_rng(seed)
    pose = random_pose(setting, isinstance(part, Foot), rng)
    noise = replace(quiet_noise(), warp_period=WARP_PERIOD)
    if isinstance(part, Foot):
        part = replace(part, sleeves=tuple(replace(sleeve, depth=SEEN_DEPTH_MM) for sleeve in part.sleeves))
    return scan_of(part, pose, noise, rng, window(PRO_M, pose, setting.half_width + BESIDE_MM, even=True))


def window(camera: Camera, T_column_scan: Array, reach_mm: float, *, even: bool = False) -> Camera:
    """The part of a camera's image that shows what lies within a reach of the column's axis at z = 0.

    ``even``: as far to the left of its principal point as to the right, as whole pictures are.
    """
    T = np.linalg.inv(T_column_scan)
    corners = np.array([[x, y, 0.0] for x in (-reach_mm, reach_mm) for y in (-reach_mm, reach_mm)])
    seen = corners @ T[:3, :3].T + T[:3, 3]
    u, v = camera.fx * seen[:, 0] / seen[:, 2] + camera.cx, camera.fy * seen[:, 1] / seen[:, 2] + camera.cy
    if even:
        u = np.concatenate([u, 2.0 * camera.cx - u])
    left, right = np.clip([u.min(), u.max()], 0, camera.width).astype(int).tolist()
    top, bottom = np.clip([v.min(), v.max()], 0, camera.height).astype(int).tolist()
    return replace(camera, cx=camera.cx - left, cy=camera.cy - top, width=right - left, height=bottom - top)


def in_plane_errors(found: Extraction, truth: TrueScan) -> Array:
    """Offsets (n, 2) mm, across the true mean axis, of each true centre's nearest found centre."""
    axes = truth.axes_scan()
    across = axes_on(Plane(axes.mean(axis=0) / np.linalg.norm(axes.mean(axis=0)), 0.0))[:2]
    centres = np.array([point.centre for point in found.points])
    true = truth.points_scan()
    nearest = np.linalg.norm(true[:, None] - centres[None], axis=2).argmin(axis=1)
    return np.asarray((centres[nearest] - true) @ across.T)


def as_cloud(scan: Scan, seed: int, *, viewpoint: bool = False, keep: float = 1.0) -> tuple[Scan, Array, Array]:
    """The scan as a shuffled cloud in another rigid pose, thinned: the scan, rotation (3, 3) and shift (3,)."""
    rng = np.random.default_rng(seed)
    points = scan.points.reshape(-1, 3)
    points = points[np.isfinite(points[:, 2])]
    points = points[rng.permutation(len(points))[: int(keep * len(points))]].astype(np.float64)
    rotation = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    shift = rng.uniform(-5000.0, 5000.0, 3)
    return Scan(points @ rotation.T + shift, viewpoint=shift if viewpoint else None), rotation, shift
