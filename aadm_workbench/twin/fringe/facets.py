"""Triangles small enough for a ray tracer to tell apart."""

from __future__ import annotations

import numpy as np

from aadm_workbench.model import Array, IntArray


def divided(vertices: Array, triangles: IntArray, longest_mm: float) -> tuple[Array, IntArray]:
    """Vertices (n, 3) and triangles (m, 3) of the same surface, with no edge longer than ``longest_mm``.

    A drilled face comes as slivers from hole to hole, whose boxes overlap by the hundred; a tracer that has to try
    them all takes ten times as long. Edges are halved, the longest of each triangle first.
    """
    done = []
    while len(triangles):
        corners = vertices[triangles]
        lengths = np.linalg.norm(corners[:, [1, 2, 0]] - corners, axis=2)
        long = lengths.max(axis=1) > longest_mm
        done.append(triangles[~long])
        # Turned so that the longest edge runs from the first corner to the second.
        turn = (lengths[long].argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(triangles[long], turn, 1).T
        edges, middle = np.unique(np.sort(np.column_stack([a, b]), axis=1), axis=0, return_inverse=True)
        halfway = middle.ravel() + len(vertices)
        vertices = np.vstack([vertices, vertices[edges].mean(axis=1)])
        triangles = np.vstack([np.column_stack([a, halfway, c]), np.column_stack([halfway, b, c])])
    return vertices, np.vstack(done)
