"""Bodies of triangles: what is round in them, and the edges between their plane faces."""

from __future__ import annotations

import numpy as np

from aadm_workbench.design.elements import Solid
from aadm_workbench.design.recognise.bar_courses import courses
from aadm_workbench.design.recognise.shapes import Mesh
from aadm_workbench.design.recognise.tubes import tubes
from aadm_workbench.model import Array, IntArray

# 30 degrees: neighbouring facets of a circle of 12 sides meet at as much, and are one round face
_SHARP_COS = float(np.cos(np.radians(30.0)))


def facet_solid(vertices: Array, corners: IntArray) -> Solid:
    """A body of triangles: ``vertices`` (n, 3) mm, and the vertices ``corners`` (m, 3) of each."""
    mesh = Mesh(vertices, tuple((triangle,) for triangle in corners))
    found = tubes(mesh)
    bent = [] if found else [course for course in courses(mesh) if len(course.legs) > 1]
    return Solid(tuple(found), tuple(bent), sharp_edges(vertices, corners))


def sharp_edges(vertices: Array, corners: IntArray) -> tuple[Array, ...]:
    """Edges (2, 3) mm where faces meet at more than 30 degrees or end; all edges where there are none such."""
    sides = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    keys, first, index, times = np.unique(
        np.sort(sides, axis=1), axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    spans = vertices[corners]
    normals = np.cross(spans[:, 1] - spans[:, 0], spans[:, 2] - spans[:, 0])
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    face_of = np.tile(np.arange(len(corners)), 3)
    order = np.argsort(index.reshape(-1), kind="stable")
    last = order[np.cumsum(times) - 1]
    level = (normals[face_of[first]] * normals[face_of[last]]).sum(axis=1)
    sharp = (times != 2) | (level < _SHARP_COS)
    kept = keys[sharp] if sharp.any() else keys
    return tuple(vertices[edge] for edge in kept)
