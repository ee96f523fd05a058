"""Grid positions such as C/3: the nearest crossing of two grid axes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Literal, TypeAlias

import numpy as np

from aadm_workbench.design.ifc.geometry.shapes import Shapes
from aadm_workbench.design.ifc.geometry.solids import BROKEN
from aadm_workbench.design.ifc.names import text_of
from aadm_workbench.design.recognise.paths import Straight, joined
from aadm_workbench.model import Array, GridAxis, Reason

FARTHEST_MM = 1500.0
"""Columns stand off their grid lines by part of their own width; one further off belongs to no crossing."""

_FAMILIES: tuple[Literal["u", "v", "w"], ...] = ("u", "v", "w")
_PARALLEL_SINE = 0.05  # 3 degrees: axes that meet more flatly cross nowhere near


@dataclass(frozen=True, eq=False)
class Axis:
    """A straight grid axis seen from above: from ``point`` (2,) mm along ``along`` (2,) unit, model frame."""

    tag: str
    point: Array
    along: Array
    length_mm: float


Families: TypeAlias = tuple[list[Axis], ...]
"""The axes of one grid, U, V and W."""


@dataclass(frozen=True, eq=False)
class Crossing:
    """Where two axes meet; ``label`` such as C/3."""

    label: str
    point: Array


def grids_of(file: Any, shapes: Shapes) -> list[Families]:
    """The straight axes of each of a model's grids."""
    found: list[Families] = []
    for grid in file.by_type("IfcGrid"):
        try:
            T = shapes.placements.of_product(grid)
            found.append(tuple(_axes(axes or (), T, shapes) for axes in (grid.UAxes, grid.VAxes, grid.WAxes)))
        except BROKEN as error:
            shapes.problems.append(Reason("ifc.grid", global_id=grid.GlobalId, why=error))
    return found


def crossings(grids: Iterable[Families]) -> list[Crossing]:
    """All crossings of the axes of each grid."""
    return [
        met
        for families in grids
        for first, second in combinations(families, 2)
        for u in first
        for v in second
        if (met := _meeting(u, v)) is not None
    ]


def grid_axes(grids: Iterable[Families]) -> tuple[GridAxis, ...]:
    """The axes as reports hold them."""
    return tuple(
        GridAxis(axis.tag, name, _place(axis.point), _place(axis.point + axis.length_mm * axis.along))
        for families in grids
        for name, axes in zip(_FAMILIES, families, strict=True)
        for axis in axes
    )


def _place(point: Array) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def grid_position(found: Sequence[Crossing], point: Array) -> str | None:
    """Label of the crossing nearest to a point (2,) mm of the model's plan; None where none is near."""
    if not found:
        return None
    distance_mm = [float(np.linalg.norm(crossing.point - point)) for crossing in found]
    nearest = min(range(len(found)), key=lambda k: (round(distance_mm[k], 3), found[k].label))
    return found[nearest].label if distance_mm[nearest] <= FARTHEST_MM else None


def _axes(axes: Sequence[Any], T_model_grid: Array, shapes: Shapes) -> list[Axis]:
    found = []
    for axis in axes:
        legs = joined(leg.moved(T_model_grid) for leg in shapes.curves.legs(axis.AxisCurve))
        if len(legs) == 1 and isinstance(legs[0], Straight):
            along = (legs[0].end - legs[0].start)[:2]
            length_mm = float(np.linalg.norm(along))
            found.append(Axis(text_of(axis.AxisTag), legs[0].start[:2], along / length_mm, length_mm))
    return found


def _meeting(u: Axis, v: Axis) -> Crossing | None:
    sine = float(u.along[0] * v.along[1] - u.along[1] * v.along[0])
    if abs(sine) < _PARALLEL_SINE:
        return None
    apart = v.point - u.point
    reach_mm = float(apart[0] * v.along[1] - apart[1] * v.along[0]) / sine
    return Crossing(_label(u.tag, v.tag), u.point + reach_mm * u.along)


def _label(first: str, second: str) -> str:
    """Letters before figures, as people say it; which family is U and which V differs between programs."""
    if first[:1].isdigit() and not second[:1].isdigit():
        first, second = second, first
    return f"{first}/{second}"
