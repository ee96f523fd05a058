"""Round rims of a faceted solid: the circles in which its plane ends meet its walls."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.circles import FEWEST_VERTICES, Circle, circle_through
from aadm_workbench.design.recognise.shapes import Mesh
from aadm_workbench.model import Array, IntArray

_SAME_VERTEX_MM = 1e-3  # corners of neighbouring facets, up to rounding
_SAME_PLANE_COS = 1.0 - 1e-7  # 0.03 degrees: facets of one plane, up to rounding


@dataclass(frozen=True, eq=False)
class Rim:
    """A round rim; ``hole`` where it is an inner outline of its face: the mouth of a bore."""

    circle: Circle
    hole: bool


def rims(mesh: Mesh, fewest: int = FEWEST_VERTICES) -> list[Rim]:
    """All round rims of a mesh: outlines of its plane faces, and its open ends where it is a mere shell.

    A rim has at least ``fewest`` vertices.
    """
    vertices, edges, face_of = _edges(mesh)
    patch_of = _plane_patches(_normals(mesh), edges, face_of)
    found: list[Rim] = []
    for border in _borders(edges, patch_of[face_of], fewest):
        loops = _loops(border)
        widths = [float(np.ptp(vertices[loop], axis=0).max()) for loop in loops]
        circles = [circle_through(vertices[loop], fewest) for loop in loops]
        found += [
            Rim(circle, hole=width < max(widths))
            for circle, width in zip(circles, widths, strict=True)
            if circle is not None
        ]
    for border in _borders(edges, np.zeros(len(edges), dtype=np.int64), fewest):
        circles = [circle_through(vertices[loop], fewest) for loop in _loops(border)]
        found += [Rim(circle, hole=False) for circle in circles if circle is not None]
    return found


def pieces_of(mesh: Mesh) -> list[Mesh]:
    """The parts of a mesh that share no vertex: several bars are often drawn as one body."""
    vertices, edges, face_of = _edges(mesh)
    labels = _connected(len(vertices), edges[:, 0], edges[:, 1])
    piece_of_face = np.full(len(mesh.faces), -1, dtype=np.int64)
    piece_of_face[face_of] = labels[edges[:, 0]]
    if len(np.unique(piece_of_face)) == 1:
        return [mesh]
    return [
        _with_own_vertices(mesh, np.flatnonzero(piece_of_face == number))
        for number in np.unique(piece_of_face[piece_of_face >= 0])
    ]


def _with_own_vertices(mesh: Mesh, faces: IntArray) -> Mesh:
    kept = [mesh.faces[int(face)] for face in faces]
    used = np.unique(np.concatenate([loop for face in kept for loop in face]))
    number = np.zeros(len(mesh.vertices), dtype=np.int64)
    number[used] = np.arange(len(used))
    return Mesh(mesh.vertices[used], tuple(tuple(number[loop] for loop in face) for face in kept))


def round_ends(mesh: Mesh, fewest: int) -> list[tuple[Circle, Array, bool]]:
    """Round plane ends of a piece of no holes: circle, outline (n, 3) mm, and whether a face closes it.

    Outlines have at least ``fewest`` vertices.
    """
    vertices, edges, face_of = _edges(mesh)
    patch_of = _plane_patches(_normals(mesh), edges, face_of)
    found = []
    for patches, closed in ((patch_of[face_of], True), (np.zeros(len(edges), dtype=np.int64), False)):
        for border in _borders(edges, patches, fewest):
            for loop in _loops(border):
                circle = circle_through(vertices[loop], fewest)
                if circle is not None:
                    found.append((circle, np.asarray(vertices[loop]), closed))
    return found


def area_mm2(mesh: Mesh) -> float:
    """Area of all faces without holes."""
    return float(np.linalg.norm(_area_vectors(mesh), axis=1).sum())


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
    """(n, 3) unit normals of the faces; zero for one without area."""
    vectors = _area_vectors(mesh)
    areas = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: Array = vectors / np.where(areas > 1e-9, areas, np.inf)
    return unit


def _area_vectors(mesh: Mesh) -> Array:
    """(n, 3) mm², along the normals of the faces, by Newell's sum."""
    edges, face_of = mesh.edges
    local = mesh.vertices - mesh.vertices[0]
    a, b = local[edges[:, 0]], local[edges[:, 1]]
    # Holes run against their face's outline or with it, as exporters please: their share turns no normal.
    products = a[:, [1, 2, 0]] * b[:, [2, 0, 1]] - a[:, [2, 0, 1]] * b[:, [1, 2, 0]]
    vectors: Array = np.column_stack([np.bincount(face_of, products[:, k], len(mesh.faces)) for k in range(3)])
    return 0.5 * vectors


def _plane_patches(normals: Array, edges: IntArray, face_of: IntArray) -> IntArray:
    """Number of the patch of each face: faces that share an edge and lie in one plane."""
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    one_edge = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    first, second = face_of[order][:-1][one_edge], face_of[order][1:][one_edge]
    level = np.abs((normals[first] * normals[second]).sum(axis=1)) > _SAME_PLANE_COS
    first, second = first[level], second[level]
    return _connected(len(normals), first, second)


def _connected(count: int, first: IntArray, second: IntArray) -> IntArray:
    """Number of the group that each of so many things is in, joined in pairs; groups in the order of their first.

    Each takes the smallest number of its neighbours, then the one that this has come to, until nothing changes. scipy
    has it too, but FreeCAD, which samples meshes by this, need not bring scipy.
    """
    smallest = np.arange(count)
    while True:
        before = smallest.copy()
        least = np.minimum(smallest[first], smallest[second])
        np.minimum.at(smallest, before[first], least)
        np.minimum.at(smallest, before[second], least)
        smallest = smallest[smallest]
        if np.array_equal(smallest, before):
            break
    labels: IntArray = np.unique(smallest, return_inverse=True)[1].reshape(-1).astype(np.int64)
    return labels


def _borders(edges: IntArray, patch_of: IntArray, fewest: int = FEWEST_VERTICES) -> list[IntArray]:
    """The outline (k, 2) of each patch: edges that only one of its faces has; those too short to be round left out."""
    keyed = np.column_stack([patch_of, edges])
    unique, times = np.unique(keyed, axis=0, return_counts=True)
    outline = unique[times == 1]
    cuts = np.flatnonzero(np.diff(outline[:, 0])) + 1
    return [part[:, 1:] for part in np.split(outline, cuts) if len(part) >= fewest]


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
