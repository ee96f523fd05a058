"""Round faces of an exact shape, read from FreeCAD's kernel: cylinders, cones and the bends of bars."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.design.recognise.flat_circle import flat_circle, widest_gap
from aadm_workbench.design.recognise.round_faces import Bend, RoundFace
from aadm_workbench.model import Array

_SAMPLES = 7  # points along an edge, or across a face: enough to tell a circle from a spline
_ROUND_MM = 1e-4  # the kernel's own tolerance is 1e-7; files round to this
_ON_WALL_MM = 1e-3  # points of a spline that stands for a cylinder
_SAME_DIAMETER_MM = 0.02  # ends of one bend, up to rounding
_FLAT = frozenset({"Plane"})
_BENT = frozenset({"Toroid", "SurfaceOfRevolution", "Sphere"})


def round_faces(shape: Any) -> tuple[list[RoundFace], list[Bend]]:
    """The round faces of a solid or a shell, mm, in the frame that it is drawn in.

    Surfaces of other kinds (splines, as sweeps and imports leave them) count where their points lie on a cylinder.
    """
    faces: list[RoundFace] = []
    bends: list[Bend] = []
    inside_out = getattr(shape, "Volume", 0.0) < 0.0
    for face in shape.Faces:
        kind = _kind(face)
        if kind in _FLAT:
            continue
        if kind == "Cylinder":
            found = _cylinder(face, _vector(face.Surface.Center), _vector(face.Surface.Axis), face.Surface.Radius)
        elif kind == "Cone":
            found = _cone(face)
        elif kind in _BENT:
            found = _rounded(face, kind)
            bends += _bend(face, kind) if found is None else []
        else:
            found = _fitted(face)
        if found is not None:
            faces.append(_turned_out(found) if inside_out else found)
    return faces, bends


def _kind(face: Any) -> str:
    try:
        return type(face.Surface).__name__
    except TypeError:  # a surface that Part has no name for
        return ""


def _vector(vector: Any) -> Array:
    return np.array([vector.x, vector.y, vector.z])


def _turned_out(face: RoundFace) -> RoundFace:
    return RoundFace(face.start, face.end, face.start_mm, face.end_mm, face.turn, not face.inner)


def _cylinder(face: Any, centre: Array, axis: Array, radius_mm: float, turn: float | None = None) -> RoundFace | None:
    axis = axis / np.linalg.norm(axis)
    low, high = _reach(face, centre, axis)
    if high - low <= 0.0:
        return None
    u0, u1, v0, v1 = face.ParameterRange
    u, v = (u0 + u1) / 2.0, (v0 + v1) / 2.0
    outward = _vector(face.valueAt(u, v)) - centre
    inner = float(_vector(face.normalAt(u, v)) @ (outward - float(outward @ axis) * axis)) < 0.0
    diameter_mm = 2.0 * radius_mm
    return RoundFace(
        start=centre + low * axis,
        end=centre + high * axis,
        start_mm=diameter_mm,
        end_mm=diameter_mm,
        turn=abs(u1 - u0) if turn is None else turn,
        inner=inner,
    )


def _reach(face: Any, centre: Array, axis: Array) -> tuple[float, float]:
    """Where a face begins and ends along its axis, mm from its centre.

    A round edge counts by its centre, which is where the axis meets a plane that cuts the face at an angle.
    """
    levels = []
    for edge in face.Edges:
        middle = getattr(edge.Curve, "Center", None) if _has_curve(edge) else None
        if middle is not None:
            level = float((_vector(middle) - centre) @ axis)
            off_mm = float(np.linalg.norm(_vector(middle) - centre - level * axis))
            if off_mm < _ROUND_MM:
                levels.append(level)
    if len(levels) >= 2 and max(levels) - min(levels) > _ROUND_MM:
        return min(levels), max(levels)
    points = np.array(
        [_vector(point) for edge in face.Edges if _has_curve(edge) for point in edge.discretize(_SAMPLES)]
    )
    if not len(points):
        return 0.0, 0.0
    along = [*levels, *((points - centre) @ axis)]
    return float(min(along)), float(max(along))


def _has_curve(edge: Any) -> bool:
    try:
        return edge.Curve is not None and not edge.Degenerated
    except TypeError:  # an edge without a curve, such as the tip of a cone
        return False


def _cone(face: Any) -> RoundFace | None:
    apex, axis = _vector(face.Surface.Apex), _vector(face.Surface.Axis)
    axis = axis / np.linalg.norm(axis)
    low, high = _reach(face, apex, axis)
    slope = float(np.tan(abs(face.Surface.SemiAngle)))
    found = _cylinder(face, apex, axis, 1.0)
    if found is None:
        return None
    start_mm, end_mm = (2.0 * abs(level) * slope for level in (low, high))
    return RoundFace(found.start, found.end, start_mm, end_mm, found.turn, found.inner)


def _rounded(face: Any, kind: str) -> RoundFace | None:
    """A face that is turned about its own axis: a fillet at a mouth, a rib in a sleeve, the round end of a bar."""
    point, axis = _axis_of(face, kind)
    ends: list[tuple[float, float]] = []
    for centre, diameter_mm in _round_edges(face):
        level = float((centre - point) @ axis)
        if float(np.linalg.norm(centre - point - level * axis)) < _ROUND_MM:
            ends.append((level, diameter_mm))
    tips = [float((_vector(vertex.Point) - point) @ axis) for vertex in face.Vertexes]
    off_mm = [float(np.linalg.norm(np.cross(_vector(vertex.Point) - point, axis))) for vertex in face.Vertexes]
    ends += [(level, 0.0) for level, off in zip(tips, off_mm, strict=True) if off < _ROUND_MM]
    low, high = min(ends, default=(0.0, 0.0)), max(ends, default=(0.0, 0.0))
    found = _cylinder(face, point, axis, 1.0) if high[0] - low[0] > _ROUND_MM else None
    if found is None:
        return None
    return RoundFace(point + low[0] * axis, point + high[0] * axis, low[1], high[1], found.turn, found.inner)


def _axis_of(face: Any, kind: str) -> tuple[Array, Array]:
    surface = face.Surface
    if kind == "SurfaceOfRevolution":
        return _vector(surface.Location), _vector(surface.Direction)
    return _vector(surface.Center), _vector(surface.Axis)


def _round_edges(face: Any) -> list[tuple[Array, float]]:
    """Centre and diameter of each circular edge."""
    return [
        (_vector(edge.Curve.Center), 2.0 * edge.Curve.Radius)
        for edge in face.Edges
        if _has_curve(edge) and type(edge.Curve).__name__ == "Circle"
    ]


def _bend(face: Any, kind: str) -> list[Bend]:
    """The bend that a face is a part of: between the centres of its two round ends, whose diameters are the bar's."""
    ends = _round_edges(face)
    point, axis = _axis_of(face, kind)
    if kind == "Toroid":
        minor_mm = 2.0 * face.Surface.MinorRadius
        ends = [(centre, mm) for centre, mm in ends if abs(mm - minor_mm) < _SAME_DIAMETER_MM]
    centres = _distinct([centre for centre, _ in ends])
    if len(centres) != 2:
        return []
    return [Bend(centres[0], centres[1], point, axis, ends[0][1])]


def _distinct(points: list[Array]) -> list[Array]:
    found: list[Array] = []
    for point in points:
        if all(float(np.linalg.norm(point - other)) > _ROUND_MM for other in found):
            found.append(point)
    return found


def _fitted(face: Any) -> RoundFace | None:
    """A face of another kind as a part of a cylinder, where its points and normals are those of one."""
    u0, u1, v0, v1 = face.ParameterRange
    if not np.isfinite([u0, u1, v0, v1]).all():
        return None
    grid = [(u, v) for u in np.linspace(u0, u1, 2 * _SAMPLES) for v in np.linspace(v0, v1, _SAMPLES)]
    points = np.array([_vector(face.valueAt(u, v)) for u, v in grid])
    normals = np.array([_vector(face.normalAt(u, v)) for u, v in grid])
    _, spread, rows = np.linalg.svd(normals, full_matrices=False)
    if spread[2] > 1e-5 * spread[0] or spread[1] < 1e-2 * spread[0]:
        return None
    axis = rows[2]
    flat = (points - points[0]) @ rows[:2].T
    centre, radius_mm = flat_circle(flat)
    spokes = flat - centre
    if np.abs(np.linalg.norm(spokes, axis=1) - radius_mm).max() > _ON_WALL_MM:
        return None
    gap = widest_gap(spokes)
    step = 2.0 * np.pi / (2 * _SAMPLES - 1)
    turn = 2.0 * np.pi if gap < 1.5 * step else 2.0 * np.pi - gap
    return _cylinder(face, points[0] + centre @ rows[:2], axis, radius_mm, turn)
