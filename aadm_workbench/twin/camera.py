"""Where the virtual camera stands, and with which lens."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, Camera

# Mech-Eye PRO M as logged by one of its users (1920 x 1200, distortion already removed)
PRO_M = Camera(fx=2425.4796, fy=2425.3285, cx=959.7418, cy=632.7028, width=1920, height=1200)


def facing(
    target: Array, forward: Array, image_up: Array, distance: float, tilt: tuple[float, float], roll: float
) -> Array:
    """Pose T_column_scan (4, 4) of a camera that looks along ``forward`` at a target.

    Parameters
    ----------
    target
        (3,) mm, column frame: what lies on the optical axis.
    forward, image_up
        (3,) unit, column frame: viewing direction and the direction at the top of the picture, before tilting.
    distance
        mm from the camera to the target.
    tilt
        rad, turn of the view about the picture's x and y axis; the camera moves so that it still sees the target.
    roll
        rad, turn about the optical axis.
    """
    down = -image_up
    upright = np.column_stack([np.cross(down, forward), down, forward])
    rotation = upright @ _turn(0, tilt[0]) @ _turn(1, tilt[1]) @ _turn(2, roll)
    pose = np.eye(4)
    pose[:3, :3] = rotation
    pose[:3, 3] = target - distance * rotation[:, 2]
    return pose


def _turn(axis: int, angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def turned_about(axis: Array, angle: float) -> Array:
    """Rotation (3, 3) by an angle, rad, about a unit axis (3,), by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross)


DEPTH_SCALE_MM = 0.03
"""Step of the depth maps: 65,535 of them reach 1.9 m, beyond the floor under the bars."""


def capture_tables(camera: Camera, depth_scale_mm: float) -> str:
    """What a job says of a virtual camera and of its depth maps."""
    return f"""\
[camera]
fx = {camera.fx}
fy = {camera.fy}
cx = {camera.cx}
cy = {camera.cy}
width = {camera.width}
height = {camera.height}
depth_scale_mm = {depth_scale_mm:g}
scale_error = {camera.scale_error}

[capture]
operator = "virtual camera"
settings = "synthetic scans, no real camera was used"
"""


CAPTURE_TABLES = capture_tables(PRO_M, DEPTH_SCALE_MM)
"""What a job says of the virtual camera's scans."""
