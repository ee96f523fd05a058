"""Bars that stand in walls: dowels too, but none that a column comes down on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from aadm_workbench.design.ifc import names as ifc_names
from aadm_workbench.design.ifc.bars import BarEnd
from aadm_workbench.design.ifc.geometry.placement import frame
from aadm_workbench.design.ifc.geometry.shapes import Shapes
from aadm_workbench.design.ifc.text.file import OpenedIfc
from aadm_workbench.design.recognise.shapes import edges
from aadm_workbench.model import Array

_BESIDE_MM = 1.0  # rounding: a dowel may touch the face of its wall
_LEVEL_SINE = 0.1  # 6 degrees: what runs more steeply is no course of a wall


def ends_in_walls(opened: OpenedIfc, shapes: Shapes, ends: Sequence[BarEnd]) -> dict[int, str]:
    """Bar ends, by their place in ``ends``, that are parts of a wall or end inside one, with the name of that wall."""
    found: dict[int, str] = {}
    if not ends:
        return found
    tops = np.array([end.top for end in ends])
    for wall in opened.file.by_type("IfcWall"):
        with shapes.guarded(wall):
            _note_ends(wall, shapes, ends, tops, found)
    return found


def _note_ends(wall: Any, shapes: Shapes, ends: Sequence[BarEnd], tops: Array, found: dict[int, str]) -> None:
    called = ifc_names.called(wall)
    own_ids = set(_own_ids(wall))
    for index in {*np.flatnonzero(_inside(wall, shapes, tops)).tolist()}:
        found.setdefault(index, called)
    for index, end in enumerate(ends):
        if end.wholes & own_ids:
            found.setdefault(index, called)


def _own_ids(wall: Any) -> Iterator[int]:
    """Numbers of a wall and of the assemblies that it is a part of and no column is."""
    yield wall.id()
    for whole in ifc_names.wholes(wall):
        if not any(part.is_a("IfcColumn") for part in ifc_names.parts(whole)):
            yield whole.id()


def _inside(wall: Any, shapes: Shapes, points: Array) -> Array:
    """Which points (n, 3) lie in the upright box around a wall, whose long side is the longest level edge."""
    drawn = edges(shapes.of_product(wall))
    ways = drawn[:, 1] - drawn[:, 0]
    lengths_mm = np.linalg.norm(ways, axis=1)
    level = np.abs(ways[:, 2]) < _LEVEL_SINE * lengths_mm
    if not level.any():
        return np.zeros(len(points), dtype=np.bool_)
    along = ways[level][int(lengths_mm[level].argmax())]
    T = frame(drawn[0, 0], None, np.array([along[0], along[1], 0.0]))
    corners, local = ((p - T[:3, 3]) @ T[:3, :3] for p in (drawn.reshape(-1, 3), points))
    low, high = corners.min(axis=0) - _BESIDE_MM, corners.max(axis=0) + _BESIDE_MM
    inside: Array = np.all((local >= low) & (local <= high), axis=1)
    return inside
