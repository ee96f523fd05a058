"""Triangle meshes with a surface number for every triangle: what a scene is made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, IntArray

CONCRETE, SLEEVE_WALL, BAR, FLOOR, TAPE, DARK, OBJECT = range(7)
"""Kinds of surface; what is ``DARK`` (rust, oil) sends no light back."""


@dataclass(frozen=True, eq=False)
class Surface:
    """A triangle mesh: vertices (n, 3) mm, triangles (m, 3), ``kind`` and ``owner`` (m,) per triangle."""

    vertices: Array
    triangles: IntArray
    kind: IntArray
    owner: IntArray


def one_kind(vertices: Array, triangles: IntArray, kind: int, owner: int = -1) -> Surface:
    """A surface whose triangles are all of one kind and of one owner."""
    count = len(triangles)
    return Surface(vertices, triangles, np.full(count, kind), np.full(count, owner))


def joined(surfaces: list[Surface]) -> Surface:
    """One surface of several."""
    starts = np.cumsum([0] + [len(surface.vertices) for surface in surfaces[:-1]])
    return Surface(
        np.concatenate([surface.vertices for surface in surfaces]),
        np.concatenate([surface.triangles + start for surface, start in zip(surfaces, starts, strict=True)]),
        np.concatenate([surface.kind for surface in surfaces]),
        np.concatenate([surface.owner for surface in surfaces]),
    )


def moved(surface: Surface, T: Array) -> Surface:
    """The surface after a rigid transform (4, 4)."""
    return Surface(surface.vertices @ T[:3, :3].T + T[:3, 3], surface.triangles, surface.kind, surface.owner)
