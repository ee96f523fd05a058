"""The block of a foot, without its sleeves: as it was cast, roughened and chipped; the same for every camera.

Faces roughened by order are a height field that the block ends in.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import ndimage

from aadm_workbench.model import Array, IntArray
from aadm_workbench.twin.parts import Break, Foot, Roughness

_STEPS_PER_GRAIN = 4.0  # a grain is drawn round by four
_FINEST_MM = 1.5  # finer meshes take minutes
_SPREADS = 2.0  # of the field's standard deviation fit into its depth on either side; what is beyond is cut off
_KEY_WALL_MM = 2.0  # slope of a key, formed to be stripped

_PATCHES = 40  # of a bent face along each side: between their corners a bow of 8 mm is off by 0.005 mm
_CUT_SEGMENTS = 64  # of a broken piece's outline


def block_of(foot: Foot) -> Any:
    """The block of a foot in the column frame; a ``manifold3d.Manifold``."""
    import manifold3d

    cast, size = foot.cast, foot.size
    if foot.roughness is not None:
        block = rough_block(size, foot.height, foot.roughness)
    else:
        block = manifold3d.Manifold.cube([*size, foot.height]).translate([-size[0] / 2, -size[1] / 2, 0.0])
    if cast.bow or cast.warp:
        if foot.roughness is None:
            block = block.refine(_PATCHES)
        block = block.warp_batch(lambda vertices: _bent(vertices, foot))
    plan = cast.plan()
    upright = np.eye(3, 4)
    upright[:2, :2], upright[:2, 3] = plan[:, :2], plan[:, 2]
    return block.transform(upright)


def _bent(vertices: Array, foot: Foot) -> Array:
    """Vertices (n, 3) of an upright block, those of its face moved along the column; its top stays."""
    level = foot.cast.level(foot.size, vertices[:, 0], vertices[:, 1])
    share = 1.0 - np.clip(vertices[:, 2] / foot.height, 0.0, 1.0)
    return np.asarray(vertices + (level * share)[:, None] * [0.0, 0.0, 1.0])


def broken_off(foot: Foot) -> list[Any]:
    """What was broken off the edges of a foot: ellipsoids about places on them."""
    return [_piece(foot, piece) for piece in foot.cast.breaks]


def _piece(foot: Foot, piece: Break) -> Any:
    import manifold3d

    plan = foot.cast.plan()
    place, sizes = _on_edge(piece, foot.size)
    x, y = (plan[:, :2] @ place + plan[:, 2]).tolist()
    ball = manifold3d.Manifold.sphere(1.0, _CUT_SEGMENTS).scale([*sizes, piece.depth])
    return ball.rotate([0.0, 0.0, float(np.degrees(foot.cast.turn))]).translate([x, y, foot.level_at(x, y)])


def _on_edge(piece: Break, size: tuple[float, float]) -> tuple[Array, tuple[float, float]]:
    """Where a piece was broken off, mm about the section's middle, and how far it reaches along x and y."""
    place = np.zeros(2)
    for sign, axis in zip(piece.side[::2], piece.side[1::2], strict=True):
        place["xy".index(axis)] = (1.0 if sign == "+" else -1.0) * size["xy".index(axis)] / 2.0
    if len(piece.side) == 4:
        return place, (piece.depth, piece.depth)
    across = "xy".index(piece.side[1])
    place[1 - across] = piece.at
    sizes = (piece.depth, piece.length / 2.0) if across == 0 else (piece.length / 2.0, piece.depth)
    return place, sizes


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
