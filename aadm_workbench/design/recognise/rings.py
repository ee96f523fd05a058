"""Rings of a pattern of assembly points: the outline of the pattern, then the outline of what is left, and so on."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from aadm_workbench.model import Array, BoolArray, IntArray

_ON_OUTLINE_MM = 20.0  # points this near to an edge stand in its row; the ratio below narrows it for small patterns
_ON_OUTLINE_RATIO = 0.1
"""A point belongs to the outline within 20 mm, or within a tenth of the smaller extent of a small pattern: corner bars
are set in by the bend of the stirrups, bars of unlike diameter in one row stand off a common line."""

_SAME_CENTRE_RATIO = 0.25
"""Rings whose centroids differ by less than this part of the smallest spacing are concentric."""

_BETWEEN_RATIO = 0.99
"""Part of the circle over two neighbours' connecting line in which a third point stands between them."""

_ROUNDING_MM = 1e-6  # a nanometre
_TIE_MM = 0.01
"""Points whose distances from the corner differ by less are equally near."""


def rings(xy: Array) -> list[IntArray]:
    """Indices of the points ring by ring from outside, each ring counter-clockwise from its (-x, -y) corner.

    A ring is the convex outline of the points that are left, with the points on its edges: the perimeter of a
    rectangular grid, a circle, one of several concentric circles. The corner is that of the whole pattern; of two
    points equally near to it the first counter-clockwise begins.

    Parameters
    ----------
    xy
        (n, 2) float64, mm, seen from above.
    """
    if not len(xy):
        return []
    left = np.arange(len(xy), dtype=np.int64)
    corner = xy.min(axis=0)
    extent_mm = sorted(float(side) for side in np.ptp(xy, axis=0))
    narrow_mm = extent_mm[0] if extent_mm[0] > _TIE_MM else extent_mm[1]
    reach_mm = min(_ON_OUTLINE_MM, _ON_OUTLINE_RATIO * narrow_mm)
    found: list[IntArray] = []
    while len(left):
        outer = _on_outline(xy[left], reach_mm)
        found.append(_counter_clockwise(xy, left[outer], corner))
        left = left[~outer]
    return found


def distances_mm(first: Array, second: Array) -> Array:
    """Distances (n, m) between points (n, 2) and (m, 2)."""
    offset = first[:, None, :] - second[None, :, :]
    return np.asarray(np.hypot(offset[..., 0], offset[..., 1]))


def smallest_spacing(xy: Array) -> float:
    """Distance of the two nearest points, mm; 0 for fewer than two points."""
    if len(xy) < 2:
        return 0.0
    distance_mm = distances_mm(xy, xy)
    np.fill_diagonal(distance_mm, np.inf)
    return float(distance_mm.min())


def are_closed(xy: Array, found: list[IntArray]) -> bool:
    """Whether the rings are rings in the field's sense, and not the outline of some other pattern.

    They have one centre, and between two neighbours on a ring stands no third point (none inside the circle over
    their connecting line): an L-shaped pattern fails at its notch.
    """
    centres = np.array([_middle(xy[ring]) for ring in found])
    if len(found) > 1:
        off_mm = np.linalg.norm(centres - centres[0], axis=1)
        if off_mm.max() > _SAME_CENTRE_RATIO * smallest_spacing(xy):
            return False
    return not any(_stands_between(xy, first, second) for ring in found for first, second in ring_edges(xy, ring))


def ring_edges(xy: Array, ring: IntArray) -> list[tuple[int, int]]:
    """Neighbours on one ring, the last with the first; a single row has ends and is not closed."""
    members = [int(index) for index in ring]
    edges = list(pairwise(members))
    if len(members) > 2 and not _lies_on_a_line(xy[ring], 0.0):
        edges.append((members[-1], members[0]))
    return edges


def _stands_between(xy: Array, first: int, second: int) -> bool:
    middle, radius_mm = (xy[first] + xy[second]) / 2.0, np.linalg.norm(xy[first] - xy[second]) / 2.0
    inside = np.linalg.norm(xy - middle, axis=1) < _BETWEEN_RATIO * radius_mm
    return bool(inside.any())


def _middle(xy: Array) -> Array:
    """Middle of the bounding box: unlike the centroid it does not follow where the points stand close."""
    middle: Array = (xy.min(axis=0) + xy.max(axis=0)) / 2.0
    return middle


def _on_outline(xy: Array, reach_mm: float) -> BoolArray:
    """Which points lie on the convex outline or within ``reach_mm`` of it."""
    if len(xy) < 3 or _lies_on_a_line(xy, reach_mm):
        return np.ones(len(xy), dtype=np.bool_)
    on_outline: BoolArray = _heights_over_edges(xy).max(axis=1) >= -reach_mm
    return on_outline


def _heights_over_edges(xy: Array) -> Array:
    """Height (n, e) mm of each point above each edge of the convex outline; none lies above an edge.

    An edge joins two points with no third above their line. Patterns are small, so all pairs are tried: the hull
    of scipy.spatial would double the time that a check takes to start.
    """
    first, second = np.nonzero(distances_mm(xy, xy) > _TIE_MM)
    along = xy[second] - xy[first]
    outward = np.column_stack([along[:, 1], -along[:, 0]]) / np.hypot(along[:, 0], along[:, 1])[:, None]
    height_mm = xy @ outward.T - np.einsum("ij,ij->i", xy[first], outward)
    edges: Array = height_mm[:, height_mm.max(axis=0) <= _ROUNDING_MM]
    return edges


def _lies_on_a_line(xy: Array, reach_mm: float) -> bool:
    _, _, directions = np.linalg.svd(xy - xy.mean(axis=0))
    across_mm = (xy - xy.mean(axis=0)) @ directions[1]
    return bool(np.ptp(across_mm) <= max(reach_mm, 1e-6))


def _counter_clockwise(xy: Array, ring: IntArray, corner: Array) -> IntArray:
    """Order one ring counter-clockwise from above, first the point nearest to the (-x, -y) corner."""
    points = xy[ring]
    reach_mm = np.linalg.norm(points - corner, axis=1)
    if len(ring) > 1 and _lies_on_a_line(points, 0.0):
        start = points[int(reach_mm.argmin())]
        return ring[np.argsort(np.linalg.norm(points - start, axis=1), kind="stable")]
    spokes = points - _middle(points)
    # Counted from +45 degrees, far from where the first point is sought: a ring is not torn there by rounding.
    around = np.mod(np.arctan2(spokes[:, 1], spokes[:, 0]) - np.pi / 4.0 + 1e-9, 2.0 * np.pi)
    order = np.lexsort((np.linalg.norm(spokes, axis=1), around))
    nearest = reach_mm[order] <= reach_mm.min() + _TIE_MM
    turned: IntArray = ring[np.roll(order, -int(np.flatnonzero(nearest)[0]))]
    return turned
