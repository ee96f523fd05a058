"""A column's design as text: JSON, lengths in mm, every digit. Documents keep it, and processes hand it over."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.design.model_design import ModelDesign
from aadm_workbench.errors import DesignError
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Json, Kind, Reason
from aadm_workbench.model.reason import said_of

_ORIGIN = ("source", "sha256", "schema", "project")
_PLAIN = ("id", "global_id", "piece_mark", "storey", "grid", "rebar_outer_diameter_mm", "embedded_length_mm")


def write_design(design: ColumnDesign) -> str:
    """The text of a design, in the column frame; :func:`read_design` gives back the same."""
    written: dict[str, Any] = {key: getattr(design, key) for key in _PLAIN}
    written |= {
        "size_mm": design.size_mm,
        "section_middle_mm": design.section_middle_mm,
        "exposed_length_mm": design.exposed_length_mm,
        "shared_ids": design.shared_ids,
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
        # Documents of earlier versions hold neither of the last three.
        exposed_mm = written.get("exposed_length_mm")
        return ColumnDesign(
            **{key: written[key] for key in _PLAIN},
            size_mm=_two(written["size_mm"]),
            section_middle_mm=_two(written.get("section_middle_mm")),
            exposed_length_mm=None if exposed_mm is None else float(exposed_mm),
            shared_ids=tuple(written.get("shared_ids", ())),
            names=tuple(written["names"]),
            warnings=tuple(written["warnings"]),
            T_model_column=None if placed is None else np.array(placed, dtype=np.float64),
            sleeves=tuple(_point(Kind.SLEEVE, entry) for entry in written["sleeves"]),
            rebars=tuple(_point(Kind.REBAR, entry) for entry in written["rebars"]),
        )
    except (ValueError, KeyError, TypeError, IndexError) as error:
        raise DesignError(Reason("design.none_held", label=label)) from error


def _two(lengths_mm: Any) -> tuple[float, float] | None:
    return None if lengths_mm is None else (float(lengths_mm[0]), float(lengths_mm[1]))


def write_model(origin: Mapping[str, Any], columns: Mapping[str, ColumnDesign]) -> str:
    """The text of a file that a job may name as its model: columns whose design is already known.

    Parameters
    ----------
    origin
        ``source``, ``sha256``, ``schema`` and ``project`` of the model that they were taken from, as far as known.
    columns
        By the ids that the job calls them by.
    """
    entries = [
        json.loads(write_design(replace(design, id=name, names=tuple(dict.fromkeys((name, *design.names))))))
        for name, design in columns.items()
    ]
    return json.dumps({"taken_from": dict(origin), "columns": entries}, ensure_ascii=False)


def read_designs(path: Path) -> ModelDesign:
    """The model that :func:`write_model` has written; it is reported under the name and hash of its origin.

    Raises
    ------
    DesignError
        Where the file cannot be read, or is none.
    """
    try:
        written = json.loads(path.read_text(encoding="utf-8"))
        origin, entries = written["taken_from"], written["columns"]
        source, sha256, schema, project = (str(origin.get(key) or "") for key in _ORIGIN)
        columns = tuple(read_design(json.dumps(entry), str(path)) for entry in entries)
    except OSError as error:
        raise DesignError(said_of(path, "design.unread", why=error.strerror)) from error
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        raise DesignError(said_of(path, "design.not_handed", why=error)) from error
    return ModelDesign(source or str(path), sha256, schema, columns, project=project)


def _point_entry(point: AssemblyPoint) -> dict[str, Json]:
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
