"""Round walls of a mesh, found in plane sections and measured on the vertices of the facets that the sections cross.

A section shows what is round whatever the mesh is like at its rims: chamfered, torn, cut by vents, with facets that do
not meet. Its own points lie on chords, so they find a wall and do not measure it: the vertices lie on the drawn circle.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.flat_circle import flat_circle, plane_across, widest_gap
from aadm_workbench.design.recognise.round_faces import RoundFace
from aadm_workbench.model import Array, BoolArray, IntArray

_DEPTHS_MM = (1.3, 3.1, 7.3, 13.7, 24.9, 41.3, 77.7, 131.3, 211.7, 303.1)
"""Sections below either end of a body, odd enough to miss its vertices; sleeves are 100 to 600 mm long."""

_PARTS = (0.2371, 0.5137, 0.7713)  # odd shares of the height, which no edge of a drawn part happens to lie on
_SAME_POINT_MM = 1e-3  # ends of neighbouring cuts, up to rounding
_FEWEST_FACETS = 6  # a hexagon is the coarsest circle that exporters draw as one
_ROUND_RATIO = 0.02  # of the radius: corners are on the circle, up to rounding and a taper
_ROUND_MM = 0.02  # rounding of coordinates
_WIDEST_GAP = np.radians(75.0)  # less than a quarter of its circle may be missing
_WIDEST_MM = 3000.0  # a radius: a rounded wall of a building is no part of a column
_STEPS = 4  # of an axis that is straightened by both ends of its facets: each halves what is left at least; a choice
_ON_CIRCLE_MM = 0.01  # of the outermost corners: rounding
_MOSTLY = 0.3  # of the corners lie on the circle, where the rest are those of triangles that cut it
_MIXED = 0.2
"""Where more of a wall's facets look one way and more of them the other, the mesh does not say what is inside."""


_Loop = tuple[IntArray, Array]
"""An outline of a section: the facets (k,) that it crosses, and its points (p, 3) mm."""


@dataclass(frozen=True, eq=False)
class _Wall:
    """The facets (k,) of one round wall, its axis through ``centre`` (3,) along ``axis`` (3,), from low to high mm."""

    facets: IntArray
    centre: Array
    axis: Array
    low: float
    high: float
    low_mm: float
    high_mm: float


def round_walls(vertices: Array, corners: IntArray, axis: Array) -> list[RoundFace]:
    """Walls of holes, tubes and bars along an axis, of a body of triangles.

    Parameters
    ----------
    vertices
        (n, 3) float64, mm.
    corners
        (m, 3) the vertices of each triangle; whether they close, or all turn the same way, does not matter.
    axis
        (3,) unit; walls may lean from it by some degrees.
    """
    height = vertices @ axis
    low, high = float(height.min()), float(height.max())
    outward = _outward(vertices, corners)
    seen: list[set[int]] = []
    found: list[RoundFace] = []
    for level in _levels(low, high):
        loops = _merged(vertices, corners, axis, list(_loops(vertices, corners, height, level)))
        for facets, points in loops:
            members = {int(facet) for facet in facets}
            if any(len(members & other) > 0.5 * len(members) for other in seen):
                continue
            wall = _wall(vertices, corners, facets, axis)
            if wall is not None:
                seen.append(members)
                turned = _turned_outwards(vertices, corners[facets], wall, outward)
                inside = _is_inside(points, [other for _, other in loops], axis)
                found.append(_as_face(wall, inner=inside if turned is None else not turned))
    return found


def _outward(vertices: Array, corners: IntArray) -> float:
    """1 where the facets of a body turn outwards, -1 where all turn inwards: the sign of its volume."""
    a, b, c = (vertices[corners[:, k]] - vertices.mean(axis=0) for k in range(3))
    return 1.0 if float((a * np.cross(b, c)).sum()) >= 0.0 else -1.0


def _turned_outwards(vertices: Array, corners: IntArray, wall: _Wall, outward: float) -> bool | None:
    """Whether the facets of a wall look away from its axis; None where they look both ways."""
    a, b, c = (vertices[corners[:, k]] for k in range(3))
    normals = outward * np.cross(b - a, c - a)
    spokes = (a + b + c) / 3.0 - wall.centre
    spokes = spokes - (spokes @ wall.axis)[:, np.newaxis] * wall.axis
    away = float(((normals * spokes).sum(axis=1) > 0.0).mean())
    if _MIXED < away < 1.0 - _MIXED:
        return None
    return away > 0.5


def _levels(low: float, high: float) -> list[float]:
    middle = (low + high) / 2.0
    near_ends = [low + depth for depth in _DEPTHS_MM if low + depth < middle]
    near_ends += [high - depth for depth in _DEPTHS_MM if high - depth > middle]
    return sorted([*near_ends, *(low + part * (high - low) for part in _PARTS)])


def _merged(vertices: Array, corners: IntArray, axis: Array, loops: list[_Loop]) -> list[_Loop]:
    """Outlines whose facets lie on one circle made one: where facets are missing a wall falls to pieces."""
    merged: list[tuple[tuple[Array, float] | None, _Loop]] = []
    for facets, points in loops:
        rim = _rim(_lower_half(vertices[np.unique(corners[facets])], axis), axis, most_apart=2.0 * np.pi)
        same = next((k for k, (other, _) in enumerate(merged) if _one_circle(rim, other, axis)), None)
        if same is None:
            merged.append((rim, (facets, points)))
        else:
            known, whole = merged[same]
            merged[same] = (known, (np.concatenate([whole[0], facets]), np.concatenate([whole[1], points])))
    return [loop for _, loop in merged if len(loop[0]) >= _FEWEST_FACETS]


def _lower_half(points: Array, axis: Array) -> Array:
    height = points @ axis
    lower: Array = points[height <= height.mean()]
    return lower


def _one_circle(first: tuple[Array, float] | None, second: tuple[Array, float] | None, axis: Array) -> bool:
    if first is None or second is None or abs(first[1] - second[1]) > _ROUND_RATIO * first[1]:
        return False
    apart = first[0] - second[0]
    return float(np.linalg.norm(apart - float(apart @ axis) * axis)) < _ROUND_RATIO * first[1]


def _loops(vertices: Array, corners: IntArray, height: Array, level: float) -> Iterator[_Loop]:
    """Connected outlines of a section: the facets (k,) that each crosses, and its points (p, 3) mm."""
    above = height[corners] > level
    crossing = np.flatnonzero(above.any(axis=1) & ~above.all(axis=1))
    if len(crossing) < _FEWEST_FACETS:
        return
    ends = np.stack([_crossings(vertices, corners[crossing], height, level, above[crossing], side) for side in (0, 1)])
    from scipy.sparse import coo_matrix  # slow to import, and only meshes need it
    from scipy.sparse.csgraph import connected_components

    keys = np.round((ends - ends.reshape(-1, 3).min(axis=0)) / _SAME_POINT_MM).astype(np.int64)
    _, number = np.unique(keys.reshape(-1, 3), axis=0, return_inverse=True)
    first, second = number.reshape(2, -1)
    count = int(number.max()) + 1
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(count, count))
    label = connected_components(graph, directed=False)[1][first]
    for outline in range(int(label.max()) + 1):
        members = np.flatnonzero(label == outline)
        if len(members) > 1:
            yield crossing[members], ends[:, members].reshape(-1, 3)


def _crossings(vertices: Array, corners: IntArray, height: Array, level: float, above: BoolArray, side: int) -> Array:
    """Where a section leaves each facet: on one of the two edges at the corner that is alone on its side."""
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(corners))
    start = corners[rows, alone]
    end = corners[rows, (alone + 1 + side) % 3]
    # From the lower vertex to the upper one, so that neighbours find the same point to the last digit.
    lower = np.where(height[start] < height[end], start, end)
    upper = np.where(height[start] < height[end], end, start)
    part = (level - height[lower]) / (height[upper] - height[lower])
    crossed: Array = vertices[lower] + part[:, np.newaxis] * (vertices[upper] - vertices[lower])
    return crossed


def _wall(vertices: Array, corners: IntArray, facets: IntArray, axis: Array) -> _Wall | None:
    """The cylinder or cone through the vertices of some facets; None where they are on none."""
    points = vertices[np.unique(corners[facets])]
    origin = points.mean(axis=0)
    local = points - origin
    upper = local @ axis > 0.0
    if min(int(upper.sum()), int((~upper).sum())) < _FEWEST_FACETS // 2:
        return None
    along = axis
    for _ in range(_STEPS):
        rims = [_rim(local[part], along) for part in (~upper, upper)]
        if rims[0] is None or rims[1] is None:
            return None
        way = rims[1][0] - rims[0][0]
        along = way / np.linalg.norm(way)
    low_rim, high_rim = rims
    if low_rim is None or high_rim is None:
        return None
    levels = local @ along
    return _Wall(
        facets=facets,
        centre=origin + low_rim[0] - float(low_rim[0] @ along) * along,
        axis=along,
        low=float(levels.min()),
        high=float(levels.max()),
        low_mm=2.0 * low_rim[1],
        high_mm=2.0 * high_rim[1],
    )


def _rim(points: Array, along: Array, most_apart: float = _WIDEST_GAP) -> tuple[Array, float] | None:
    """Centre (3,) and radius of the circle that points make, seen along an axis; None where they make none."""
    if len(points) < 3:
        return None
    plane = plane_across(along)
    flat = points @ plane.T
    centre, radius_mm = flat_circle(flat)
    # Where a vent cuts a wall its vertices lie on the facets, inside the circle that the others lie on.
    reach_mm = np.linalg.norm(flat - centre, axis=1)
    drawn = reach_mm > reach_mm.max() - _ON_CIRCLE_MM
    if 3 <= drawn.sum() < len(flat) and drawn.mean() > _MOSTLY:
        flat = flat[drawn]
        centre, radius_mm = flat_circle(flat)
    spokes = flat - centre
    off_mm = float(np.abs(np.linalg.norm(spokes, axis=1) - radius_mm).max())
    if off_mm > _ROUND_RATIO * radius_mm + _ROUND_MM or widest_gap(spokes) > most_apart or radius_mm > _WIDEST_MM:
        return None
    level = float((points @ along).mean())
    return centre @ plane + level * along, radius_mm


def _as_face(wall: _Wall, *, inner: bool) -> RoundFace:
    return RoundFace(
        start=wall.centre + wall.low * wall.axis,
        end=wall.centre + wall.high * wall.axis,
        start_mm=wall.low_mm,
        end_mm=wall.high_mm,
        turn=2.0 * np.pi,
        inner=inner,
    )


def _is_inside(points: Array, others: Sequence[Array], axis: Array) -> bool:
    """Whether an outline of a section lies inside an odd number of others: then it bounds a hole."""
    plane = plane_across(axis)
    flat = points @ plane.T
    low, high = flat.min(axis=0), flat.max(axis=0)
    around = 0
    for other in others:
        box = other @ plane.T
        around += bool((box.min(axis=0) < low).all() and (box.max(axis=0) > high).all())
    return around % 2 == 1
