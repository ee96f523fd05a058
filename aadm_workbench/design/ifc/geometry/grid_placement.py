"""Elements that stand on the crossing of two grid axes instead of at coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.design.ifc.geometry.curve import Curves
from aadm_workbench.design.ifc.geometry.placement import Placements, UnreadableGeometryError, frame, unit
from aadm_workbench.design.ifc.names import optional
from aadm_workbench.design.recognise.paths import Straight, joined
from aadm_workbench.model import Array, Reason

_UP = np.array([0.0, 0.0, 1.0])
_PARALLEL_SINE = 1e-6  # axes that cross beyond a thousand kilometres
_NO_LENGTH_MM = 1e-6  # a thousandth of what designs are read to


@dataclass(frozen=True, eq=False)
class _Line:
    """A straight axis in the frame of its grid: through ``point`` (3,) mm along ``along`` (3,) unit, level."""

    point: Array
    along: Array


def grid_frame(placements: Placements, placement: Any) -> Array:
    """``T_model_element`` (4, 4), mm, of an IfcGridPlacement.

    Its origin is where the two axes cross, each moved to its left by its offset, at the height of the third offset. Its
    x axis is the first axis's, unless the placement gives a direction or another crossing to point at.

    Raises
    ------
    UnreadableGeometryError
        Where an axis is curved or belongs to no grid, or the two are parallel.
    """
    at = placement.PlacementLocation
    axes = at.IntersectingAxes
    origin = _crossing(placements, at)
    towards = placement.PlacementRefDirection
    if towards is None:
        x = _line(placements, axes[0]).along
    elif towards.is_a("IfcDirection"):
        x = unit(towards.DirectionRatios)
    else:
        x = _crossing(placements, towards) - origin
        if float(np.linalg.norm(x)) < _NO_LENGTH_MM:
            raise UnreadableGeometryError(Reason("geometry.own_crossing", id=placement.id()))
        x = x / np.linalg.norm(x)
    relative_to = optional(placement, "PlacementRelTo") or _grid_of(axes).ObjectPlacement
    T: Array = placements.of_placement(relative_to) @ frame(origin, None, x)
    return T


def _crossing(placements: Placements, intersection: Any) -> Array:
    """Where two axes meet (3,) mm, in the frame of their grid."""
    offsets = [placements.mm * float(value) for value in intersection.OffsetDistances or ()]
    offsets += [0.0] * (3 - len(offsets))
    lines = [_line(placements, axis) for axis in intersection.IntersectingAxes]
    first, second = (
        _Line(line.point + offset * np.cross(_UP, line.along), line.along)
        for line, offset in zip(lines, offsets, strict=False)
    )
    sine = float(np.cross(first.along, second.along)[2])
    if abs(sine) < _PARALLEL_SINE:
        raise UnreadableGeometryError(Reason("geometry.no_crossing", id=intersection.id()))
    reach_mm = float(np.cross(second.point - first.point, second.along)[2]) / sine
    met: Array = first.point + reach_mm * first.along + offsets[2] * _UP
    return met


def _line(placements: Placements, axis: Any) -> _Line:
    # The unit of angles is of no account: axes that turn are not evaluated.
    legs = joined(Curves(placements, 1.0).legs(axis.AxisCurve))
    if len(legs) != 1 or not isinstance(legs[0], Straight):
        raise UnreadableGeometryError(Reason("geometry.grid_curved", axis=axis.AxisTag or f"#{axis.id()}"))
    leg = legs[0] if axis.SameSense is not False else legs[0].reversed()
    return _Line(leg.start, leg.direction)


def _grid_of(axes: Sequence[Any]) -> Any:
    for axis in axes:
        for name in ("PartOfU", "PartOfV", "PartOfW"):
            for grid in getattr(axis, name, ()):
                return grid
    raise UnreadableGeometryError(Reason("geometry.no_grid"))
