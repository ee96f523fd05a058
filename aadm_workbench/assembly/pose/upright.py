"""Poses that keep "up" up: the plane across a known vertical, and the 4×4 transforms that such poses are.

Sleeves are seen from below and bars from above. With the vertical known there is no mirror and no flip left:
what remains is a shift and a turn in the plane across it.
"""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array


def plane_basis(vertical: Array) -> Array:
    """Rotation (3, 3) whose rows are x, y across ``vertical`` and ``vertical`` itself, right-handed.

    ``plane_basis(v) @ p`` has x and y as somebody sees them who looks down against the (3,) vector v.
    """
    up = np.asarray(vertical, dtype=np.float64)
    up = up / np.linalg.norm(up)
    # The axis least along the vertical gives the best conditioned x; ties go to the first axis.
    x = np.eye(3)[int(np.argmin(np.round(np.abs(up), 9)))]
    x = x - (x @ up) * up
    x = x / np.linalg.norm(x)
    return np.stack([x, np.cross(up, x), up])


def turn(yaw: float) -> Array:
    """Rotation (2, 2) by ``yaw`` radians, counter-clockwise, for column vectors."""
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return np.array([[cosine, -sine], [sine, cosine]])


def planar_transform(yaw: float, shift: Array) -> Array:
    """T_target_source (4, 4): turned by ``yaw`` about the z axis, then moved by ``shift`` (2,) mm in the plane."""
    transform = np.eye(4)
    transform[:2, :2] = turn(yaw)
    transform[:2, 3] = shift
    return transform


def upright_transform(basis: Array, yaw: float, shift: Array, rise: float) -> Array:
    """T_column_scan (4, 4): into the plane of ``basis`` (3, 3), turned, moved in the plane and along the vertical."""
    into_plane = np.eye(4)
    into_plane[:3, :3] = basis
    transform = planar_transform(yaw, shift) @ into_plane
    transform[2, 3] = rise
    return transform


def wrap(angle: float) -> float:
    """The same direction, radians, in (−π, π]."""
    return float(np.pi - (np.pi - angle) % (2.0 * np.pi))
