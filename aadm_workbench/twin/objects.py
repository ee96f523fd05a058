"""Meshes of what stands about in a scene and is neither a foot nor a bar: boxes, boards, hoses."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array
from aadm_workbench.twin.parts import Box, Hose
from aadm_workbench.twin.surface import OBJECT, Surface, one_kind

_CORNERS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])  # (8, 3), of a unit box
# their numbers, counter-clockwise from outside
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_AROUND = 32  # corners of a hose's section
_STEP_MM = 4.0  # of a hose's path: a choice by eye


def object_surface(thing: Box | Hose) -> Surface:
    """Mesh of one object, in the column frame."""
    return _box(thing) if isinstance(thing, Box) else _hose(thing)


def _box(box: Box) -> Surface:
    low, high = np.asarray(box.low), np.asarray(box.high)
    quads = np.array(_SIDES)
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return one_kind(low + _CORNERS * (high - low), triangles, OBJECT)


def _hose(hose: Hose) -> Surface:
    """A tube of constant height, swept along a line through the given plan positions."""
    line = _resampled(np.asarray(hose.path))
    along = np.gradient(line, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    beside = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(line))])
    turn = np.linspace(0.0, 2 * np.pi, _AROUND, endpoint=False)
    ring = np.cos(turn)[None, :, None] * beside[:, None] + np.sin(turn)[None, :, None] * np.array([0.0, 0.0, 1.0])
    middle = np.column_stack([line, np.full(len(line), hose.height)])
    vertices = (middle[:, None] + hose.diameter / 2 * ring).reshape(-1, 3)
    grid = np.arange(len(vertices)).reshape(len(line), _AROUND)
    beyond = np.roll(grid, -1, axis=1)
    a, b, c, d = grid[:-1].ravel(), beyond[:-1].ravel(), grid[1:].ravel(), beyond[1:].ravel()
    return one_kind(vertices, np.vstack([np.column_stack([a, c, b]), np.column_stack([b, c, d])]), OBJECT)


def _resampled(path: Array) -> Array:
    """Points (n, 2) every few mm on a smooth line through the corners of a path (k, 2)."""
    from scipy.interpolate import CubicSpline

    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    line: Array = CubicSpline(length, path)(np.arange(0.0, length[-1], _STEP_MM))
    return line
