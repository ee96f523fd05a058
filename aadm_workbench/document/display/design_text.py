"""A column's design as the text that its document object keeps: JSON, lengths in mm, every digit."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from aadm_workbench.errors import DesignError
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Kind

_PLAIN = ("id", "global_id", "piece_mark", "storey", "grid", "rebar_outer_diameter_mm", "embedded_length_mm")
FROM_REPORT = "a report"
"""Why a point is there that was taken from report.json: its place is the design's, its diameter was measured."""
_UNKNOWN_DIAMETER_MM = {Kind.SLEEVE: 40.0, Kind.REBAR: 20.0}
"""Drawn for a report whose points were all not measured; it is never measured against."""


def write_design(design: ColumnDesign) -> str:
    """The text of a design, in the column frame; :func:`read_design` gives back the same."""
    written: dict[str, Any] = {key: getattr(design, key) for key in _PLAIN}
    written |= {
        "size_mm": design.size_mm,
        "names": design.names,
        "warnings": design.warnings,
        "T_model_column": None if design.T_model_column is None else np.asarray(design.T_model_column).tolist(),
        "sleeves": [_point_entry(point) for point in design.sleeves],
        "rebars": [_point_entry(point) for point in design.rebars],
    }
    return json.dumps(written, ensure_ascii=False)


def read_design(text: str, label: str) -> ColumnDesign:
    """The design that a document object keeps.

    Raises
    ------
    DesignError
        Where the object ``label`` holds none.
    """
    try:
        written = json.loads(text)
        placed = written["T_model_column"]
        size_mm = written["size_mm"]
        return ColumnDesign(
            **{key: written[key] for key in _PLAIN},
            size_mm=None if size_mm is None else (float(size_mm[0]), float(size_mm[1])),
            names=tuple(written["names"]),
            warnings=tuple(written["warnings"]),
            T_model_column=None if placed is None else np.array(placed, dtype=np.float64),
            sleeves=tuple(_point(Kind.SLEEVE, entry) for entry in written["sleeves"]),
            rebars=tuple(_point(Kind.REBAR, entry) for entry in written["rebars"]),
        )
    except (ValueError, KeyError, TypeError, IndexError) as error:
        raise DesignError(f"{label} holds no design: sample the design of its column again") from error


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


def _point_entry(point: AssemblyPoint) -> dict[str, Any]:
    return {
        "label": point.label,
        "centre_mm": np.asarray(point.centre, dtype=np.float64).tolist(),
        "axis": np.asarray(point.axis, dtype=np.float64).tolist(),
        "diameter_mm": float(point.diameter_mm),
        "global_id": point.global_id,
        "why": point.why,
        "length_mm": None if point.length_mm is None else float(point.length_mm),
        "object_name": point.object_name,
        "outer_diameter_mm": None if point.outer_diameter_mm is None else float(point.outer_diameter_mm),
    }


def _point(kind: Kind, entry: Mapping[str, Any]) -> AssemblyPoint:
    return AssemblyPoint(
        label=entry["label"],
        kind=kind,
        centre=np.array(entry["centre_mm"], dtype=np.float64),
        axis=np.array(entry["axis"], dtype=np.float64),
        diameter_mm=entry["diameter_mm"],
        global_id=entry["global_id"],
        why=entry["why"],
        length_mm=entry["length_mm"],
        object_name=entry.get("object_name"),
        outer_diameter_mm=entry.get("outer_diameter_mm"),
    )
