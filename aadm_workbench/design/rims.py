"""Round rims of a faceted solid: the circles in which its plane ends meet its walls."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.circles import FEWEST_VERTICES, Circle, circle_through
from aadm_workbench.design.shapes import Mesh
from aadm_workbench.model import Array, IntArray

_SAME_VERTEX_MM = 1e-3
_SAME_PLANE_COS = 1.0 - 1e-7


@dataclass(frozen=True, eq=False)
class Rim:
    """A round rim; ``hole`` where it is an inner outline of its face: the mouth of a bore."""

    circle: Circle
    hole: bool


def rims(mesh: Mesh) -> list[Rim]:
    """All round rims of a mesh: outlines of its plane faces, and its open ends where it is a mere shell."""
    vertices, edges, face_of = _edges(mesh)
    patch_of = _plane_patches(_normals(mesh), edges, face_of)
    found: list[Rim] = []
    for border in _borders(edges, patch_of[face_of]):
        loops = _loops(border)
        widths = [float(np.ptp(vertices[loop], axis=0).max()) for loop in loops]
        circles = [circle_through(vertices[loop]) for loop in loops]
        found += [
            Rim(circle, hole=width < max(widths))
            for circle, width in zip(circles, widths, strict=True)
            if circle is not None
        ]
    for border in _borders(edges, np.zeros(len(edges), dtype=np.int64)):
        circles = [circle_through(vertices[loop]) for loop in _loops(border)]
        found += [Rim(circle, hole=False) for circle in circles if circle is not None]
    return found


def _edges(mesh: Mesh) -> tuple[Array, IntArray, IntArray]:
    """Vertices of which no two are one point, edges (m, 2) between them, and the face that each belongs to."""
    local = np.round((mesh.vertices - mesh.vertices[0]) / _SAME_VERTEX_MM).astype(np.int64)
    _, first, index = np.unique(local, axis=0, return_index=True, return_inverse=True)
    welded = index.reshape(-1)
    around, face_of = mesh.edges
    edges = np.sort(welded[around], axis=1)
    real = edges[:, 0] != edges[:, 1]
    return mesh.vertices[first], edges[real], face_of[real]


def _normals(mesh: Mesh) -> Array:
    """(n, 3) unit normals of the faces by Newell's sum; zero for one without area."""
    edges, face_of = mesh.edges
    local = mesh.vertices - mesh.vertices[0]
    a, b = local[edges[:, 0]], local[edges[:, 1]]
    # Holes run against their face's outline or with it, as exporters please: their share turns no normal.
    products = a[:, [1, 2, 0]] * b[:, [2, 0, 1]] - a[:, [2, 0, 1]] * b[:, [1, 2, 0]]
    normals = np.column_stack([np.bincount(face_of, products[:, k], len(mesh.faces)) for k in range(3)])
    areas = np.linalg.norm(normals, axis=1, keepdims=True)
    unit: Array = normals / np.where(areas > 1e-9, areas, np.inf)
    return unit


def _plane_patches(normals: Array, edges: IntArray, face_of: IntArray) -> IntArray:
    """Number of the patch of each face: faces that share an edge and lie in one plane."""
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    one_edge = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    first, second = face_of[order][:-1][one_edge], face_of[order][1:][one_edge]
    level = np.abs((normals[first] * normals[second]).sum(axis=1)) > _SAME_PLANE_COS
    first, second = first[level], second[level]
    from scipy.sparse import coo_matrix  # slow to import, and only meshes need it
    from scipy.sparse.csgraph import connected_components

    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(len(normals), len(normals)))
    labels: IntArray = connected_components(graph, directed=False)[1].astype(np.int64)
    return labels


def _borders(edges: IntArray, patch_of: IntArray) -> list[IntArray]:
    """The outline (k, 2) of each patch: edges that only one of its faces has; those too short to be round left out."""
    keyed = np.column_stack([patch_of, edges])
    unique, times = np.unique(keyed, axis=0, return_counts=True)
    outline = unique[times == 1]
    cuts = np.flatnonzero(np.diff(outline[:, 0])) + 1
    return [part[:, 1:] for part in np.split(outline, cuts) if len(part) >= FEWEST_VERTICES]


def _loops(border: IntArray) -> list[IntArray]:
    """Closed loops of vertex indices that edges form; what does not close is left out."""
    neighbours: dict[int, list[int]] = defaultdict(list)
    for a, b in border.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    loops: list[IntArray] = []
    visited: set[int] = set()
    for start in neighbours:
        if start in visited:
            continue
        loop, current = [start], start
        visited.add(start)
        while (onward := next((n for n in neighbours[current] if n not in visited), None)) is not None:
            loop.append(onward)
            visited.add(onward)
            current = onward
        if len(loop) > 2 and start in neighbours[current]:
            loops.append(np.array(loop, dtype=np.int64))
    return loops
