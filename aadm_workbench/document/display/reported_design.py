"""What a report says of a column's design, for columns that no model is at hand for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from aadm_workbench.model import AssemblyPoint, ColumnDesign, Kind

FROM_REPORT = "a report"
"""Why a point is there that was taken from report.json: its place is the design's, its diameter was measured."""
_UNKNOWN_DIAMETER_MM = {Kind.SLEEVE: 40.0, Kind.REBAR: 20.0}
"""Drawn for a report whose points were all not measured; it is never measured against."""


def design_of_report(column: Mapping[str, Any]) -> ColumnDesign:
    """What a column of report.json says of its design: its points as designed; diameters are the measured ones."""
    placed, size_mm = column.get("T_model_column"), column.get("size_mm")
    return ColumnDesign(
        id=str(column["id"]),
        sleeves=_reported_points(Kind.SLEEVE, column),
        rebars=_reported_points(Kind.REBAR, column),
        size_mm=None if size_mm is None else (float(size_mm[0]), float(size_mm[1])),
        global_id=column.get("global_id"),
        piece_mark=column.get("piece_mark"),
        storey=column.get("storey"),
        grid=column.get("grid"),
        names=(str(column["id"]),),
        T_model_column=None if placed is None else np.array(placed, dtype=np.float64),
    )


def _reported_points(kind: Kind, column: Mapping[str, Any]) -> tuple[AssemblyPoint, ...]:
    points: Sequence[Mapping[str, Any]] = (column.get(kind.plural) or {}).get("points", ())
    measured = [point["diameter_mm"] for point in points if point.get("diameter_mm") is not None]
    diameter_mm = float(np.median(measured)) if measured else _UNKNOWN_DIAMETER_MM[kind]
    return tuple(
        AssemblyPoint(
            label=point["label"],
            kind=kind,
            centre=np.array(point["design_mm"], dtype=np.float64),
            axis=np.array([0.0, 0.0, 1.0]),
            diameter_mm=diameter_mm,
            global_id=point.get("global_id"),
            why=FROM_REPORT,
        )
        for point in points
    )
