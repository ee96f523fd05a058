"""Bodies of FreeCAD's objects in plain numbers: what is round in them and how far they reach."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.design.elements import Solid
from aadm_workbench.design.recognise.facets import facet_solid
from aadm_workbench.design.recognise.round_faces import bar_of, tubes_of
from aadm_workbench.design.recognise.shapes import Mesh
from aadm_workbench.design.recognise.tubes import tubes
from aadm_workbench.document.sample.faces import round_faces
from aadm_workbench.model import Array

_ROUND_EDGE_POINTS = 25
"""Every 15 degrees of a full circle: its quarters are among them, so that round columns get their exact width."""

_FEWEST_FACES = 4
"""So many loose faces may be a solid that lost its shell; fewer are the inside of a wire or a section plane."""

_FEWEST_FACETS = 10
"""A body of fewer plane faces holds no faceted circle."""


def solids_of(shape: Any) -> list[Solid]:
    """The bodies of a shape, mm, in the frame that it is drawn in; open shells count as bodies too."""
    if shape.isNull():
        return []
    owned = {shell.hashCode() for body in shape.Solids for shell in body.Shells}
    loose = [shell for shell in shape.Shells if shell.hashCode() not in owned and len(shell.Faces) >= _FEWEST_FACES]
    bodies = [*shape.Solids, *loose]
    if not bodies and len(shape.Faces) >= _FEWEST_FACES:
        bodies = [shape]
    return [solid for body in bodies if (solid := _solid(body)) is not None]


def solids_of_mesh(mesh: Any) -> list[Solid]:
    """The bodies of a mesh object, mm, where it stands."""
    found = []
    for part in mesh.getSeparateComponents():
        points, corners = part.Topology
        vertices = np.array([[point.x, point.y, point.z] for point in points]).reshape(-1, 3)
        if len(corners):
            found.append(facet_solid(vertices, np.array(corners, dtype=np.int64)))
    return found


def _solid(body: Any) -> Solid | None:
    lines = [line for edge in body.Edges if len(line := _line(edge)) > 1]
    if not lines:
        return None
    faces, bends = round_faces(body)
    bar = bar_of(faces, bends) if bends else None
    found = [] if bar is not None else tubes_of(faces)
    if not faces and not bends and len(body.Faces) >= _FEWEST_FACETS:
        found = tubes(_facets(body))
    return Solid(tuple(found), () if bar is None else (bar,), tuple(lines))


def _line(edge: Any) -> Array:
    """Points of an edge: the ends of a straight one."""
    try:
        straight = edge.Degenerated or type(edge.Curve).__name__ == "Line"
    except TypeError:  # an edge without a curve, such as the tip of a cone
        straight = True
    points = [vertex.Point for vertex in edge.Vertexes] if straight else edge.discretize(_ROUND_EDGE_POINTS)
    return np.array([[point.x, point.y, point.z] for point in points]).reshape(-1, 3)


def _facets(body: Any) -> Mesh:
    """A body of plane faces as a mesh: the outline of each face, then its holes."""
    vertices: list[Array] = []
    faces = []
    count = 0
    for face in body.Faces:
        loops = []
        outer = face.OuterWire
        for wire in [outer, *(wire for wire in face.Wires if not wire.isSame(outer))]:
            points = np.array([[v.X, v.Y, v.Z] for v in wire.OrderedVertexes]).reshape(-1, 3)
            loops.append(np.arange(count, count + len(points)))
            vertices.append(points)
            count += len(points)
        faces.append(tuple(loops))
    return Mesh(np.concatenate(vertices), tuple(faces))
