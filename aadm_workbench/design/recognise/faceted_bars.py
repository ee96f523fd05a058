"""Bars drawn as facets: where their axes run, from their two round ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.design.recognise.circles import Circle
from aadm_workbench.design.recognise.paths import Leg, Straight, joined
from aadm_workbench.design.recognise.rims import area_mm2, pieces_of, round_ends
from aadm_workbench.design.recognise.shapes import Mesh
from aadm_workbench.model import Array

_ON_WALL_RATIO = 0.02  # of the radius: corners are on the circle, up to rounding and a taper
_ONE_LEVEL_MM = 0.05  # rounding of a level
_FEWEST_SIDES = 4  # FreeCAD draws circles with four

FacetedBar = tuple[tuple[Leg, ...], float, float]
"""Legs, diameter mm and length mm of a bar."""


def faceted_bars(mesh: Mesh) -> list[FacetedBar]:
    """Every piece of a mesh that is a round bar with two ends; bends are cut short between its straight ends."""
    return [bar for piece in pieces_of(mesh) if (bar := _bar(piece)) is not None]


def _bar(piece: Mesh) -> FacetedBar | None:
    ends = round_ends(piece, _FEWEST_SIDES)
    if len(ends) != 2 or abs(ends[0][0].radius_mm - ends[1][0].radius_mm) > _ON_WALL_RATIO * ends[0][0].radius_mm:
        return None
    first, second = ends[0][0], ends[1][0]
    diameter_mm = first.radius_mm + second.radius_mm
    way = second.centre - first.centre
    across_mm = np.linalg.norm(way - float(way @ first.normal) * first.normal)
    if across_mm < _ON_WALL_RATIO * first.radius_mm + _ONE_LEVEL_MM:
        return (Straight(first.centre, second.centre),), diameter_mm, float(np.linalg.norm(way))
    inner = [_inner_end(piece.vertices, circle, len(outline)) for circle, outline, _ in ends]
    legs: list[Leg] = [Straight(first.centre, inner[0])]
    if np.linalg.norm(inner[1] - inner[0]) > _ONE_LEVEL_MM:
        legs.append(Straight(inner[0], inner[1]))
    legs.append(Straight(inner[1], second.centre))
    return tuple(joined(legs)), diameter_mm, _length(piece, ends)


def _inner_end(vertices: Array, end: Circle, sides: int) -> Array:
    """Where the straight part that begins at an end goes over into a bend: the last whole ring on its cylinder."""
    spokes = vertices - end.centre
    depth_mm = spokes @ end.normal
    off_axis_mm = np.linalg.norm(spokes - depth_mm[:, np.newaxis] * end.normal, axis=1)
    on_wall = np.abs(off_axis_mm - end.radius_mm) < _ON_WALL_RATIO * end.radius_mm
    levels = np.sort(depth_mm[on_wall])
    first = np.searchsorted(levels, levels - _ONE_LEVEL_MM)
    last = np.searchsorted(levels, levels + _ONE_LEVEL_MM)
    whole = levels[last - first >= 0.9 * sides]
    inside_mm = float(whole[np.abs(whole).argmax()]) if len(whole) else 0.0
    inner: Array = end.centre + inside_mm * end.normal
    return inner


def _length(piece: Mesh, ends: Sequence[tuple[Circle, Array, bool]]) -> float:
    """Length of a bar's axis: the area of its wall over its girth (Pappus)."""
    girths_mm = [float(np.linalg.norm(rim - np.roll(rim, 1, axis=0), axis=1).sum()) for _, rim, _ in ends]
    caps_mm2 = sum(_area(rim) for _, rim, closed in ends if closed)
    return (area_mm2(piece) - caps_mm2) / float(np.mean(girths_mm))


def _area(outline: Array) -> float:
    local = outline - outline.mean(axis=0)
    return float(np.linalg.norm(np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)) / 2.0)
