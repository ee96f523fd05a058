"""report.json: everything that a check came to, the same bytes for the same input.

Lengths are rounded to 0.1 µm, which no scan resolves, so that the last bits of the arithmetic do not show. What is not
finite is written as null. ``resources/report.schema.json`` describes the file.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from aadm_workbench.atomic import write_atomically
from aadm_workbench.model import ColumnReport, GroupReport, JobReport, Kind, Profile, ShipmentReport

SCHEMA = 1
"""Of report.json: keys are added under the same number, and never change their meaning."""
_LENGTH_DECIMALS = 4  # 0.1 µm
_ANGLE_DECIMALS = 6  # of degrees: 0.01 µm over 600 mm
_RATIO_DECIMALS = 6  # a millionth
_DIRECTION_DECIMALS = 9  # of units: 0.01 µm over 10 m
_SHIFT_DECIMALS = 6  # a nanometre: transforms are multiplied
_OTHER_DIGITS = 9  # significant ones, of what has no kind
_RATIOS = {
    "probability",
    "margin",
    "smallest_margin",
    "sum_of_margins",
    "as_listed_margin",
    "p_value",
    "cp",
    "cp_interval",
    "cpk",
    "cpk_interval",
}

# Vectors go on one line, so that people can read the file; a text holds no line break, so none is touched.
_NUMBER = r"\n\s+(?:[-+.\deE]+|null)"
_BROKEN_VECTOR = re.compile(rf"(?<=\[){_NUMBER}(?:,{_NUMBER})*\n\s+(?=\])")

# Names come from the files of others, and JSON is shown in terminals: these signs steer one, or turn a line around.
_STEERING = re.compile("[\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")

Json: TypeAlias = "dict[str, Json] | list[Json] | str | int | float | bool | None"


def report_schema() -> dict[str, Any]:
    """The JSON Schema (draft 2020-12) of report.json."""
    path = Path(__file__).resolve().parents[1] / "resources" / "report.schema.json"
    schema: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return schema


def write_report(report: JobReport, path: Path) -> None:
    """Write report.json, whole or not at all.

    Raises
    ------
    AadmError
        Where the file cannot be written.
    """
    write_atomically(path, _encoded_parts(report))


def _encoded_parts(report: JobReport) -> Iterator[bytes]:
    """The bytes of report.json, column by column: a shipment's document need not fit into memory."""
    mark = ' "columns": [],\n'
    before, _, after = _text(report_document(replace(report, columns=()), report.summary())).partition(mark)
    yield _bytes(before + mark[: -len("],\n")])
    for number, column in enumerate(report.columns):
        # As the only item of its list, so that it is indented as it has to be.
        item = _text({"columns": [_column(column)]})[len('{\n "columns": [') : -len("\n ]\n}\n")]
        yield _bytes("," * bool(number) + item)
    yield _bytes(("\n " if report.columns else "") + "],\n" + after)


def encode(document: Any) -> bytes:
    """A document as JSON in UTF-8; keys stay in their order.

    Parameters
    ----------
    document
        Mappings, lists, arrays, dataclasses and plain values. Names of keys say the unit, and with it the rounding.
    """
    return _bytes(_text(_plain("", document)))


def _text(document: Json) -> str:
    text = json.dumps(document, ensure_ascii=False, indent=1, allow_nan=False)
    text = _STEERING.sub(lambda sign: f"\\u{ord(sign[0]):04x}", text)
    return _BROKEN_VECTOR.sub(lambda vector: " ".join(vector[0].split()), text) + "\n"


def _bytes(text: str) -> bytes:
    return text.encode(errors="replace")


def report_document(report: JobReport, summary: dict[str, int] | None = None) -> dict[str, Json]:
    """A job's report as report.json holds it; ``summary`` instead of that of its columns."""
    return {
        "schema": SCHEMA,
        "tool": _plain("", report.tool),
        "job": _plain("", report.job),
        "capture": _plain("", report.capture),
        "model": _plain("", report.model),
        "profile": profile_document(report.profile),
        "summary": _plain("", summary or report.summary()),
        "columns": [_column(column) for column in report.columns],
        "mould_drift": _plain("", report.mould_drift),
    }


def shipment_document(report: ShipmentReport) -> dict[str, Json]:
    """The matching of a shipment as match.json holds it."""
    return {"schema": SCHEMA, **_fields(report)}


def profile_document(profile: Profile) -> Json:
    """A tolerance profile as report.json holds it."""
    in_report = {"upper": "upper_mm", "lower": "lower_mm"}
    rules = [{in_report.get(key, key): value for key, value in _fields(rule).items()} for rule in profile.rules]
    limit_mm = _plain("_mm", profile.adjustment_limit_mm)
    return {"name": profile.name, "title": profile.title, "adjustment_limit_mm": limit_mm, "rules": [*rules]}


_COLUMN_FIRST = ("id", "global_id", "piece_mark", "storey", "grid", "size_mm", "T_model_column")


def _column(column: ColumnReport) -> Json:
    """What names the column comes first, then its verdict, then what led to it."""
    document = _fields(column) | {
        "sleeves": _group(column.sleeves),
        "rebars": _group(column.rebars),
    }
    return {key: document[key] for key in (*_COLUMN_FIRST, *(key for key in document if key not in _COLUMN_FIRST))}


def _group(group: GroupReport | None) -> Json:
    """Sleeves or rebars; only bars stick out of a floor, and stand in a building."""
    if group is None:
        return None
    document = _fields(group)
    del document["kind"]
    if group.kind is Kind.SLEEVE:
        del document["absolute"]
        points = (_fields(point) for point in group.points)
        document["points"] = [
            {key: value for key, value in point.items() if key != "exposed_length_mm"} for point in points
        ]
    return document


def _fields(value: Any) -> dict[str, Json]:
    """A dataclass, field by field; the field's name says its unit."""
    return {item.name: _plain(item.name, getattr(value, item.name)) for item in fields(value)}


def _plain(name: str, value: Any) -> Json:
    """A value of a field in the types that JSON knows."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if is_dataclass(value):
        return _fields(value)
    if isinstance(value, Mapping):
        return {str(key): _plain(str(key), item) for key, item in value.items()}
    if name.startswith("T_") and value is not None:
        return _transform(value)
    if isinstance(value, list | tuple):
        return [_plain(name, item) for item in value]
    # A length that happens to be whole is written as every other length.
    if isinstance(value, float) or (type(value) is int and name.endswith(("_mm", "_deg"))):
        return _rounded(name, float(value))
    return value if value is None or isinstance(value, bool | int) else str(value)


def _transform(rows: Sequence[Sequence[float]]) -> Json:
    """A 4x4 transform: the directions without unit, the shift in mm to the nanometre."""
    decimals = (_DIRECTION_DECIMALS, _DIRECTION_DECIMALS, _DIRECTION_DECIMALS, _SHIFT_DECIMALS)
    return [[_to(places, float(value)) for places, value in zip(decimals, row, strict=True)] for row in rows]


def _rounded(name: str, value: float) -> float | None:
    """A number by its name: lengths, angles and ratios to a fixed number of decimals, others to nine digits."""
    if name.endswith("_mm"):
        return _to(_LENGTH_DECIMALS, value)
    if name.endswith("_deg"):
        return _to(_ANGLE_DECIMALS, value)
    if name == "scale":
        return _to(_DIRECTION_DECIMALS, value)
    if name in _RATIOS:
        return _to(_RATIO_DECIMALS, value)
    return _to(None, float(f"{value:.{_OTHER_DIGITS}g}"))


def _to(decimals: int | None, value: float) -> float | None:
    """Rounded, without a minus before a zero; None for what is no number."""
    if not math.isfinite(value):
        return None
    return (value if decimals is None else round(value, decimals)) + 0.0
