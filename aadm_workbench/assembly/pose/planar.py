"""Motions in the plan as three numbers, dx, dy mm and yaw radians, and as matrices that compose."""

from __future__ import annotations

import math

import numpy as np

from aadm_workbench.model import Array


def planar_of(T: Array) -> Array:
    """(3,) dx, dy mm and yaw radians of a motion in the plan, (4, 4) or (3, 3)."""
    return np.array([T[0, -1], T[1, -1], math.atan2(T[1, 0], T[0, 0])])


def planar_matrix(planar: Array) -> Array:
    """(3, 3) that acts on (x, y, 1): turned by yaw about the origin, then moved by dx, dy."""
    cosine, sine = math.cos(planar[2]), math.sin(planar[2])
    return np.array([[cosine, -sine, planar[0]], [sine, cosine, planar[1]], [0.0, 0.0, 1.0]])


def in_degrees(planar: Array) -> tuple[float, float, float]:
    """Dx, dy mm and yaw degrees."""
    return float(planar[0]), float(planar[1]), math.degrees(planar[2])
