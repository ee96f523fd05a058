"""The published route to as-designed points beside the exact one, for people and for programs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from rich.table import Table

    from aadm_workbench.design.published import PublishedPoint
    from aadm_workbench.model import Array, ColumnDesign

    from .told import Words


def published_tables(columns: Sequence[ColumnDesign], words: Words) -> Iterator[Table | str]:
    """One table for each column, in the model's frame, with the distance in the plane from the exact centres."""
    from rich.text import Text

    from aadm_workbench.inspection.as_designed import published_route

    numbers = ("x", "y", "z", "edge_points", "difference")
    for column in columns:
        points = published_route(column)
        table = words.table("ui.point", *numbers, numbers=numbers)
        for point in points:
            centre = _in_model(point, column)
            difference_mm = point.difference_mm
            found = ["", "", ""] if centre is None else [f"{value:.2f}" for value in centre]
            away = words("no_points") if difference_mm is None else f"{difference_mm:.3f}"
            table.add_row(*(Text(text) for text in (point.label, *found, str(point.edge_points), away)))
        yield words("published", column=column.id)
        yield table
        yield words("differences", said=_summary(points, words))
        yield ""


@dataclass(frozen=True, eq=False)
class PublishedEntry:
    """A point as ``--json`` tells it, in the frame of the model."""

    label: str
    centre_mm: Array | None
    edge_points: int
    difference_mm: float | None


@dataclass(frozen=True, eq=False)
class PublishedColumn:
    """The points of a column."""

    id: str
    points: list[PublishedEntry]


def published_entries(columns: Sequence[ColumnDesign]) -> list[PublishedColumn]:
    """The same for ``--json``."""
    from aadm_workbench.inspection.as_designed import published_route

    found = []
    for column in columns:
        points = [
            PublishedEntry(point.label, _in_model(point, column), point.edge_points, point.difference_mm)
            for point in published_route(column)
        ]
        found.append(PublishedColumn(column.id, points))
    return found


def _in_model(point: PublishedPoint, column: ColumnDesign) -> Array | None:
    T = column.T_model_column
    if point.centre is None or T is None:
        return point.centre
    return T[:3, :3] @ point.centre + T[:3, 3]


def _summary(points: Sequence[PublishedPoint], words: Words) -> str:
    away_mm = [point.difference_mm for point in points if point.difference_mm is not None]
    if not away_mm:
        return words("no_points")
    return words("on_average", mean=float(np.mean(away_mm)), most=max(away_mm), number=len(away_mm))
