"""Columns and beams of a model as bodies, and which column carries which end of a beam, with the reason."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from aadm_workbench.model import Array

REACH_MM = 100.0
"""From the end of a beam to the outline of the column that carries it, in the plan, and from its underside to the head
above it: beams end 10 to 20 mm inside a column's face, or as far before it where the node is cast on site. A choice."""

RELATED_REACH_MM = 1000.0
"""The same where the model itself relates the two: what is further off is a mistake of the model."""

_UPPER_SHARE = 0.5
"""Corbels that carry beams stand in the upper half of a column; a beam that is lower runs by, or belongs to a stair."""


class How(StrEnum):
    """What says that a column carries the end of a beam."""

    CONNECTED = "connected"
    """A relation of the model, IfcRelConnectsElements or one of its kind."""
    ASSEMBLED = "assembled"
    """Both are parts of one assembly, IfcRelAggregates."""
    GEOMETRY = "geometry"
    """The end lies over the head of the column, or on its corbel."""


@dataclass(frozen=True, eq=False)
class FloorColumn:
    """A column as a body: its foot face in the model (4, 4), half of its sides (2,) mm, its height.

    ``names`` is all that a job may call it by.
    """

    id: str
    global_id: str
    names: tuple[str, ...]
    T_model_foot: Array
    half_size_mm: Array
    height_mm: float

    def outside_mm(self, point: Array) -> float:
        """How far a point (3,) of the model lies outside of its outline, in the plan, mm."""
        local = (point - self.T_model_foot[:3, 3]) @ self.T_model_foot[:3, :3]
        return float(np.linalg.norm(np.maximum(np.abs(local[:2]) - self.half_size_mm, 0.0)))

    def is_under(self, point: Array) -> bool:
        """Whether a point (3,) of the model, the underside of a beam, is at a height where a column carries one."""
        above_mm = float((point - self.T_model_foot[:3, 3]) @ self.T_model_foot[:3, 2])
        return _UPPER_SHARE * self.height_mm <= above_mm <= self.height_mm + REACH_MM


@dataclass(frozen=True, eq=False)
class FloorBeam:
    """A beam as a body: ``ends`` (2, 3) mm in the model, the middle of the lower edge of each end face."""

    id: str
    global_id: str
    ends: Array


@dataclass(frozen=True)
class Support:
    """Which column carries an end, by its place among the columns (None: none was found), and how it was found.

    ``outside_mm`` is how far the end lies outside of that column, or of the nearest one; None without any.
    """

    column: int | None
    how: How | None
    outside_mm: float | None


@dataclass(frozen=True, eq=False)
class Floor:
    """What a model holds of columns and beams; ``supports`` of both ends of each beam, ``left_out`` in words."""

    source: str
    sha256: str
    columns: tuple[FloorColumn, ...]
    beams: tuple[FloorBeam, ...]
    supports: tuple[tuple[Support, Support], ...]
    left_out: tuple[tuple[str, str], ...] = ()

    def place_of(self, global_id: str | None, name: str) -> int | None:
        """The column of a report among those of the model: by its GlobalId, or by name where that is not one's own."""
        same = [k for k, column in enumerate(self.columns) if global_id and column.global_id == global_id]
        if len(same) != 1:
            same = [k for k in same or range(len(self.columns)) if name in self.columns[k].names]
        return same[0] if len(same) == 1 else None


def supports_of(beam: FloorBeam, columns: Sequence[FloorColumn], related: Mapping[int, How]) -> tuple[Support, Support]:
    """Which column carries which end of a beam: related ones first, then by where the ends lie.

    Parameters
    ----------
    related
        Columns, by their places, that the model relates to the beam.
    """
    first, second = (_nearest(end, columns, related) for end in beam.ends)
    if first.column is not None and first.column == second.column:
        # One column carries one end: the other one is on its way past it.
        nearer = (first.outside_mm or 0.0) <= (second.outside_mm or 0.0)
        lost = Support(None, None, second.outside_mm if nearer else first.outside_mm)
        return (first, lost) if nearer else (lost, second)
    return first, second


def _nearest(end: Array, columns: Sequence[FloorColumn], related: Mapping[int, How]) -> Support:
    under = [(column.outside_mm(end), k) for k, column in enumerate(columns) if column.is_under(end)]
    for how in (How.CONNECTED, How.ASSEMBLED):
        named = [(mm, k) for mm, k in under if related.get(k) is how and mm <= RELATED_REACH_MM]
        if named:
            mm, place = min(named)
            return Support(place, how, mm)
    if not under:
        return Support(None, None, None)
    mm, place = min(under)
    return Support(place, How.GEOMETRY, mm) if mm <= REACH_MM else Support(None, None, mm)
