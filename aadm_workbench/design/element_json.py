"""Elements as JSON values: how FreeCAD's process hands them over."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from aadm_workbench.design.elements import Element, Solid
from aadm_workbench.design.recognise.bar_courses import Course
from aadm_workbench.design.recognise.paths import Arc, Leg, Straight
from aadm_workbench.design.recognise.tubes import Tube
from aadm_workbench.model import Array, Json

_TEXTS = (
    "GlobalId",
    "Name",
    "said",
    "Tag",
    "ifc_class",
    "kind",
    "ifc_guid",
    "predefined_type",
    "piece_mark",
    "storey",
)


def to_json(elements: Sequence[Element]) -> list[Json]:
    """Elements as plain lists, numbers and texts; numbers keep all their digits."""
    return [
        {
            **{name: getattr(element, name) for name in _TEXTS},
            "wholes": list(element.wholes),
            "T_model_element": element.T_model_element.tolist(),
            "solids": [_solid(solid) for solid in element.solids],
        }
        for element in elements
    ]


def from_json(written: Sequence[Mapping[str, Any]]) -> list[Element]:
    """Elements as they were before :func:`to_json`.

    Raises
    ------
    LookupError, TypeError, ValueError
        Where the values are not such.
    """
    return [
        Element(
            **{name: entry[name] for name in _TEXTS},
            wholes=tuple(entry["wholes"]),
            T_model_element=_array(entry["T_model_element"]),
            solids=tuple(_read_solid(solid) for solid in entry["solids"]),
        )
        for entry in written
    ]


def _solid(solid: Solid) -> Json:
    return {
        "tubes": [[tube.start.tolist(), tube.end.tolist(), tube.outer_mm, list(tube.bore_mm)] for tube in solid.tubes],
        "bars": [
            [[_leg(leg) for leg in bar.legs], bar.diameter_mm, bar.hollow, bar.drawn_length_mm] for bar in solid.bars
        ],
        "edges": [line.tolist() for line in solid.edges],
    }


def _read_solid(written: Mapping[str, Any]) -> Solid:
    return Solid(
        tubes=tuple(
            Tube(_array(start), _array(end), _size(outer_mm), (_size(bore_mm[0]), _size(bore_mm[1])))
            for start, end, outer_mm, bore_mm in written["tubes"]
        ),
        bars=tuple(
            Course(tuple(_read_leg(leg) for leg in legs), float(diameter_mm), bool(hollow), _size(length_mm))
            for legs, diameter_mm, hollow, length_mm in written["bars"]
        ),
        edges=tuple(_array(line) for line in written["edges"]),
    )


def _leg(leg: Leg) -> Json:
    if isinstance(leg, Straight):
        return [leg.start.tolist(), leg.end.tolist()]
    return [leg.centre.tolist(), leg.u.tolist(), leg.v.tolist(), leg.begin, leg.stop]


def _read_leg(written: Sequence[Any]) -> Leg:
    if len(written) == 2:
        return Straight(_array(written[0]), _array(written[1]))
    centre, u, v, begin, stop = written
    return Arc(_array(centre), _array(u), _array(v), float(begin), float(stop))


def _size(written: Any) -> float | None:
    return None if written is None else float(written)


def _array(written: Any) -> Array:
    return np.array(written, dtype=np.float64)
