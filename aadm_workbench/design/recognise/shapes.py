"""The few kinds of solid that models are made of, in numbers: millimetres, in whatever frame they are asked for.

Cones and other turned solids: how wide they are where something ends in them, and what a plane leaves of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.circles import Circle
from aadm_workbench.design.recognise.paths import Leg
from aadm_workbench.model import Array, IntArray

_ACROSS_COS = 1.0 - 1e-9  # 0.003 degrees: exporters write six digits
_INSIDE_MM = 1e-6  # a thousandth of what designs are read to


@dataclass(frozen=True, eq=False)
class Loop:
    """A closed outline: ``points`` (n, 3) mm in order, first not repeated, and its circle where it is one."""

    points: Array
    circle: Circle | None = None

    def moved(self, T: Array) -> Loop:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        return Loop(_moved(self.points, T), self.circle.moved(T) if self.circle else None)


@dataclass(frozen=True, eq=False)
class SweptDisk:
    """A bar or pipe: a disk swept along a path. ``inner_radius_mm`` is that of a pipe, None of a bar."""

    legs: tuple[Leg, ...]
    radius_mm: float
    inner_radius_mm: float | None = None

    def moved(self, T: Array) -> SweptDisk:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        factor = scale_across(T, self.legs[0].points[1] - self.legs[0].points[0]) if self.legs else 1.0
        inner_mm = None if self.inner_radius_mm is None else factor * self.inner_radius_mm
        return SweptDisk(tuple(leg.moved(T) for leg in self.legs), factor * self.radius_mm, inner_mm)


@dataclass(frozen=True, eq=False)
class Prism:
    """An extrusion: an outline with holes, swept by the vector ``sweep`` (3,) mm."""

    outer: Loop
    holes: tuple[Loop, ...]
    sweep: Array

    def moved(self, T: Array) -> Prism:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        return Prism(self.outer.moved(T), tuple(hole.moved(T) for hole in self.holes), T[:3, :3] @ self.sweep)


@dataclass(frozen=True, eq=False)
class Turned:
    """A full turn of an outline about an axis: ``outline_rz`` (n, 2) mm holds radius and height over ``origin``."""

    origin: Array
    axis: Array
    outline_rz: Array

    def moved(self, T: Array) -> Turned:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        axis = T[:3, :3] @ self.axis
        factor = float(np.linalg.norm(axis))
        return Turned(_moved(self.origin, T), axis / factor, factor * self.outline_rz)


@dataclass(frozen=True, eq=False)
class Mesh:
    """Plane faces: ``vertices`` (n, 3) mm; a face is its outer loop of vertex indices, then its holes."""

    vertices: Array
    faces: tuple[tuple[IntArray, ...], ...]

    @property
    def edges(self) -> tuple[IntArray, IntArray]:
        """Vertex indices (m, 2) of the edges around all faces, and the number (m,) of the face of each."""
        loops = [loop for face in self.faces for loop in face]
        lengths = np.array([len(loop) for loop in loops], dtype=np.int64)
        starts = np.concatenate(loops)
        onwards = np.arange(1, len(starts) + 1)
        lasts = np.cumsum(lengths) - 1
        onwards[lasts] = lasts + 1 - lengths  # the last vertex of a loop goes back to its first
        owners = np.repeat(np.arange(len(self.faces)), [sum(map(len, face)) for face in self.faces])
        return np.column_stack([starts, starts[onwards]]), owners

    def moved(self, T: Array) -> Mesh:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        return Mesh(_moved(self.vertices, T), self.faces)


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """All x with ``(x - point) @ towards > 0``; ``bounded`` where it reaches only so far sideways."""

    point: Array
    towards: Array
    bounded: bool = False

    def moved(self, T: Array) -> HalfSpace:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        towards = T[:3, :3] @ self.towards
        return HalfSpace(_moved(self.point, T), towards / np.linalg.norm(towards), self.bounded)


@dataclass(frozen=True, eq=False)
class Cut:
    """A solid from which another was taken away."""

    body: Shape
    tool: Shape

    def moved(self, T: Array) -> Cut:
        """The same after a motion (4, 4), which may scale alike in all directions."""
        return Cut(self.body.moved(T), self.tool.moved(T))


Shape = SweptDisk | Prism | Turned | Mesh | HalfSpace | Cut


def pieces(shape: Shape) -> int:
    """How many solids one is made of."""
    left, found = [shape], 0
    while left and found < _MOST_COUNTED:
        piece = left.pop()
        if isinstance(piece, Cut):
            left += [piece.body, piece.tool]
        else:
            found += 1
    return found


_MOST_COUNTED = 10_000
"""A solid cut by itself again and again has more pieces than can be counted."""


def edges(shapes: Iterable[Shape]) -> Array:
    """(m, 2, 3) mm, edges of what shapes enclose: their ends span the extent of a column's concrete."""
    found = [_edges(shape) for shape in shapes]
    return np.concatenate(found) if found else np.zeros((0, 2, 3))


def _edges(shape: Shape) -> Array:
    match shape:
        case Prism():
            top = shape.outer.points + shape.sweep
            around = [np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in (shape.outer.points, top)]
            return np.concatenate([*around, np.stack([shape.outer.points, top], axis=1)])
        case Mesh():
            return np.asarray(shape.vertices[shape.edges[0]])
        case Turned():
            return _turned_edges(shape)
        case SweptDisk():
            return np.concatenate([np.stack([leg.points[:-1], leg.points[1:]], axis=1) for leg in shape.legs])
        case Cut():
            body = _edges(shape.body)
            return _clipped(body, shape.tool) if isinstance(shape.tool, HalfSpace) else body
        case HalfSpace():
            return np.zeros((0, 2, 3))


def _turned_edges(shape: Turned) -> Array:
    _, _, rows = np.linalg.svd(shape.axis[np.newaxis, :])
    angle = np.radians(np.arange(0.0, 360.0, 5.0))[:, np.newaxis]
    spokes = np.cos(angle) * rows[1] + np.sin(angle) * rows[2]
    rings = [shape.origin + height * shape.axis + radius * spokes for radius, height in shape.outline_rz]
    return np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])


def _clipped(found: Array, away: HalfSpace) -> Array:
    """What a plane leaves of edges; the cut face's corners are the new ends, so the extent stays exact."""
    if away.bounded:
        return found
    depth_mm = (found - away.point) @ away.towards
    kept = found[(depth_mm <= 0.0).any(axis=1)].copy()
    depth_mm = depth_mm[(depth_mm <= 0.0).any(axis=1)]
    for end, other in ((0, 1), (1, 0)):
        outside = depth_mm[:, end] > 0.0
        part = depth_mm[outside, end] / (depth_mm[outside, end] - depth_mm[outside, other])
        kept[outside, end] += part[:, np.newaxis] * (kept[outside, other] - kept[outside, end])
    return kept


def _moved(points: Array, T: Array) -> Array:
    moved: Array = points @ T[:3, :3].T + T[:3, 3]
    return moved


def scale(T: Array) -> float:
    """By how much a motion (4, 4) lengthens; the mean where it differs by direction."""
    return float(abs(np.linalg.det(T[:3, :3])) ** (1.0 / 3.0))


def scale_across(T: Array, axis: Array) -> float:
    """By how much a motion (4, 4) widens what is round about an axis (3,); the mean where it becomes oval."""
    (a, b, c), (d, e, f), (g, h, i) = T[:3, :3].tolist()  # numpy takes ten times as long for so few numbers
    x, y, z = axis.tolist()
    volume = abs(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))
    grown = math.hypot(a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z) / math.hypot(x, y, z)
    return math.sqrt(volume / grown)


def as_turned(shape: Shape) -> Turned | None:
    """A solid as a full turn of an outline, where it is one, planes across its axis included; else None."""
    if isinstance(shape, Turned):
        return shape
    if isinstance(shape, Cut) and isinstance(shape.tool, HalfSpace):
        body = as_turned(shape.body)
        return None if body is None else _clipped_turned(body, shape.tool)
    return None


def radius_at(turned: Turned, height_mm: float) -> float | None:
    """Outer radius, mm, at a height over the origin along the axis; None above and below the solid."""
    low, high = float(turned.outline_rz[:, 1].min()), float(turned.outline_rz[:, 1].max())
    if not low - _INSIDE_MM < height_mm < high + _INSIDE_MM:
        return None
    height_mm = min(max(height_mm, low), high)
    found: list[float] = []
    for (r0, h0), (r1, h1) in zip(turned.outline_rz, np.roll(turned.outline_rz, -1, axis=0), strict=True):
        if min(h0, h1) <= height_mm <= max(h0, h1):
            part = 0.0 if h0 == h1 else (height_mm - h0) / (h1 - h0)
            found += [float(r0), float(r1)] if h0 == h1 else [float(r0 + part * (r1 - r0))]
    return max(found)


def _clipped_turned(turned: Turned, away: HalfSpace) -> Turned | None:
    cosine = float(turned.axis @ away.towards)
    if away.bounded or abs(cosine) < _ACROSS_COS:
        return None
    level_mm = float((away.point - turned.origin) @ turned.axis)
    side = 1.0 if cosine > 0.0 else -1.0
    outline = _below(turned.outline_rz * [1.0, side], side * level_mm) * [1.0, side]
    return Turned(turned.origin, turned.axis, outline) if len(outline) else None


def _below(outline: Array, level_mm: float) -> Array:
    """What a level leaves below it of a closed outline (n, 2) of radius and height (Sutherland and Hodgman)."""
    kept: list[Array] = []
    for here, onwards in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        if here[1] <= level_mm:
            kept.append(here)
        if (here[1] - level_mm) * (onwards[1] - level_mm) < 0.0:
            kept.append(here + (level_mm - here[1]) / (onwards[1] - here[1]) * (onwards - here))
    return np.array(kept).reshape(-1, 2)
