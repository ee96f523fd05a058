"""The paper's route to as-designed points (section 2.1.1): the model as a cloud, a pass-through filter, means of edges.

Long et al. convert the model to point cloud data, cut out the edges of the sleeves' mouths and of the bars' tops with a
pass-through filter, and take the mean of each edge's points for its centre. They name neither density nor thresholds;
what stands here for them are the constants below. It is kept to be compared with: a mean of n random points on a circle
of radius r scatters by r / sqrt(2 n) along each axis, whatever the model's exact centre is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.design.recognise.flat_circle import plane_across
from aadm_workbench.model import Array, AssemblyPoint, ColumnDesign

POINTS_PER_MM2 = 0.25
"""Density of the cloud: a point for every 2 mm x 2 mm, about 1,800,000 for a column of 600 x 600 x 3000 mm."""

SHOWN_MM = 400.0
"""How far up the column its surface is sampled: nothing above is looked at."""

SLICE_MM = 5.0
"""Thickness of what the pass-through filter lets through: from a foot face inwards, from a bar's top downwards."""

_WINDOW_RATIO = 0.75
"""Half width of the window around a point's place, in its diameters: an edge is in it, a neighbour's is not."""


@dataclass(frozen=True, eq=False)
class PublishedPoint:
    """A point by the published route: ``centre`` (3,) mm, column frame, the mean of so many edge points.

    ``centre`` is None where none were in the window.
    """

    label: str
    exact: Array
    centre: Array | None
    edge_points: int

    @property
    def difference_mm(self) -> float | None:
        """Distance in the plane from the exact centre."""
        return None if self.centre is None else float(np.linalg.norm(self.centre[:2] - self.exact[:2]))


def sampled_surfaces(design: ColumnDesign, rng: np.random.Generator) -> Array:
    """The model as a cloud: (n, 3) float64, mm, column frame.

    Foot face and sides of the column up to 400 mm, the walls of its sleeves, and its bars with their tops, all of the
    same density, at random.
    """
    parts = [_foot_face(design, rng), *_sides(design, rng)]
    parts += [_wall(sleeve, sleeve.centre, 1.0, rng) for sleeve in design.sleeves]
    for bar in design.rebars:
        parts += [_wall(bar, bar.centre, -1.0, rng), _disk(bar, rng)]
    return np.concatenate(parts)


def published_points(design: ColumnDesign, cloud: Array) -> list[PublishedPoint]:
    """Centres of a column's sleeves and bars by pass-through filter and mean of edge points, from a cloud (n, 3) mm."""
    sleeves = [_mean_of_edge(point, cloud, 0.0, SLICE_MM) for point in design.sleeves]
    return sleeves + [_mean_of_edge(point, cloud, -SLICE_MM, 0.0) for point in design.rebars]


def _mean_of_edge(point: AssemblyPoint, cloud: Array, lowest_mm: float, highest_mm: float) -> PublishedPoint:
    level = cloud[:, 2] - point.centre[2]
    passed = cloud[(level > lowest_mm) & (level < highest_mm)]
    window_mm = _WINDOW_RATIO * point.diameter_mm
    edge = passed[(np.abs(passed[:, :2] - point.centre[:2]) < window_mm).all(axis=1)]
    edge = edge[np.abs(np.linalg.norm(edge[:, :2] - point.centre[:2], axis=1) / point.diameter_mm - 0.5) < 0.1]
    centre = np.array([*edge[:, :2].mean(axis=0), point.centre[2]]) if len(edge) else None
    return PublishedPoint(point.label, point.centre, centre, len(edge))


def _half_size(design: ColumnDesign) -> Array:
    if design.size_mm is not None:
        return np.array(design.size_mm) / 2.0
    reach: Array = np.max([np.abs(sleeve.centre[:2]) + sleeve.diameter_mm for sleeve in design.sleeves], axis=0)
    return reach


def _foot_face(design: ColumnDesign, rng: np.random.Generator) -> Array:
    half = _half_size(design)
    flat = rng.uniform(-half, half, (_count(4.0 * float(np.prod(half))), 2))
    outside = np.ones(len(flat), dtype=np.bool_)
    for sleeve in design.sleeves:
        outside &= np.linalg.norm(flat - sleeve.centre[:2], axis=1) > sleeve.diameter_mm / 2.0
    return np.column_stack([flat[outside], np.zeros(int(outside.sum()))])


def _sides(design: ColumnDesign, rng: np.random.Generator) -> Sequence[Array]:
    half = _half_size(design)
    sides = []
    for across in (0, 1):
        for sign in (-1.0, 1.0):
            along = 1 - across
            points = np.zeros((_count(2.0 * float(half[along]) * SHOWN_MM), 3))
            points[:, across] = sign * half[across]
            points[:, along] = rng.uniform(-half[along], half[along], len(points))
            points[:, 2] = rng.uniform(0.0, SHOWN_MM, len(points))
            sides.append(points)
    return sides


def _wall(point: AssemblyPoint, end: Array, way: float, rng: np.random.Generator) -> Array:
    length_mm = min(point.length_mm or SHOWN_MM, SHOWN_MM)
    count = _count(np.pi * point.diameter_mm * length_mm)
    turn = rng.uniform(0.0, 2.0 * np.pi, count)
    level = way * rng.uniform(0.0, length_mm, count)
    u, v = plane_across(point.axis)
    radius_mm = point.diameter_mm / 2.0
    around = radius_mm * (np.cos(turn)[:, np.newaxis] * u + np.sin(turn)[:, np.newaxis] * v)
    points: Array = end + around + level[:, np.newaxis] * point.axis
    return points


def _disk(point: AssemblyPoint, rng: np.random.Generator) -> Array:
    count = _count(np.pi * (point.diameter_mm / 2.0) ** 2)
    turn = rng.uniform(0.0, 2.0 * np.pi, count)
    radius_mm = point.diameter_mm / 2.0 * np.sqrt(rng.uniform(0.0, 1.0, count))
    u, v = plane_across(point.axis)
    spokes = np.cos(turn)[:, np.newaxis] * u + np.sin(turn)[:, np.newaxis] * v
    points: Array = point.centre + radius_mm[:, np.newaxis] * spokes
    return points


def _count(area_mm2: float) -> int:
    return max(1, round(POINTS_PER_MM2 * area_mm2))
