"""The faces of a body for the eye: what encloses it, light enough that a floor of columns stays fluid."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from aadm_workbench.design.recognise.shapes import Cut, Mesh, Prism, Shape
from aadm_workbench.model import Array

MOST_FACES = 2000
"""Of one body: thirty columns of so many are drawn as fluently as the points of one scan. Finer ones are left out."""


def faces(shapes: Iterable[Shape]) -> list[Array]:
    """Polygons (n, 3) around bodies, in the frame of these; without holes, and without what was cut away.

    Empty where there are more than ``MOST_FACES``, or where the bodies are drawn in another way.
    """
    found: list[Array] = []
    for shape in shapes:
        for face in _faces(shape):
            found.append(face)
            if len(found) > MOST_FACES:
                return []
    return found


def _faces(shape: Shape) -> Iterator[Array]:
    while isinstance(shape, Cut):
        shape = shape.body
    if isinstance(shape, Prism):
        foot = np.asarray(shape.outer.points)
        top, after = foot + shape.sweep, np.roll(foot, -1, axis=0)
        yield from (foot, top)
        yield from np.stack([foot, after, after + shape.sweep, top], axis=1)
    elif isinstance(shape, Mesh):
        for outline, *_ in shape.faces:
            yield np.asarray(shape.vertices[outline])
