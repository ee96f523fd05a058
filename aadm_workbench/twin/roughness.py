"""Faces roughened by order: a height field that a foot's block ends in, the same for every camera."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import ndimage

from aadm_workbench.model import Array, IntArray
from aadm_workbench.twin.parts import Roughness

_STEPS_PER_GRAIN = 4.0  # a grain is drawn round by four
_FINEST_MM = 1.5  # finer meshes take minutes
_SPREADS = 2.0  # of the field's standard deviation fit into its depth on either side; what is beyond is cut off
_KEY_WALL_MM = 2.0  # slope of a key, formed to be stripped


def rough_block(size: tuple[float, float], height: float, roughness: Roughness) -> Any:
    """A block of a size whose lower face is rough; a ``manifold3d.Manifold``."""
    import manifold3d

    step_mm = max(roughness.grain / _STEPS_PER_GRAIN, _FINEST_MM)
    x, y = (np.linspace(-side / 2, side / 2, int(np.ceil(side / step_mm)) + 1) for side in size)
    below = rough_heights(x, y, roughness)
    plan = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
    vertices = np.vstack([np.column_stack([plan, below.ravel()]), np.column_stack([plan, np.full(len(plan), height)])])
    mesh = manifold3d.Mesh(vertices.astype(np.float32), _closed(len(y), len(x)).astype(np.uint32))
    return manifold3d.Manifold(mesh)


def rough_heights(x: Array, y: Array, roughness: Roughness) -> Array:
    """How far inside the foot the face lies (rows, columns) mm at the crossings of a grid, 0 to its depth."""
    if roughness.law == "keyed":
        return roughness.depth * _pocket(x, roughness.grain)[None, :] * _pocket(y, roughness.grain)[:, None]
    rng = np.random.default_rng(roughness.seed)
    step_mm = float(x[1] - x[0])
    field = ndimage.gaussian_filter(rng.standard_normal((len(y), len(x))), roughness.grain / 4.0 / step_mm)
    return np.asarray(roughness.depth * np.clip(0.5 + field / field.std() / (2.0 * _SPREADS), 0.0, 1.0))


def _pocket(along: Array, wide: float) -> Array:
    """1 within pockets, 0 between them, with walls that are not upright."""
    place = np.abs(np.mod(along, 2.0 * wide) - wide)
    return np.asarray(np.clip((wide / 2.0 - place) / _KEY_WALL_MM + 0.5, 0.0, 1.0))


def _closed(rows: int, columns: int) -> IntArray:
    """Triangles of a box whose lower and upper side are grids of that many vertices, lower ones first."""
    low = np.arange(rows * columns).reshape(rows, columns)
    high = low + rows * columns
    around = np.concatenate([low[0, :-1], low[:-1, -1], low[-1, :0:-1], low[:0:-1, 0]])
    beyond = np.roll(around, -1)
    upper, upper_beyond = around + rows * columns, beyond + rows * columns
    return np.vstack(
        [
            _sheet(low)[:, ::-1],
            _sheet(high),
            np.column_stack([around, beyond, upper]),
            np.column_stack([beyond, upper_beyond, upper]),
        ]
    )


def _sheet(grid: IntArray) -> IntArray:
    a, b, c, d = grid[:-1, :-1].ravel(), grid[:-1, 1:].ravel(), grid[1:, :-1].ravel(), grid[1:, 1:].ravel()
    return np.vstack([np.column_stack([a, b, c]), np.column_stack([b, d, c])])
