"""report.json: everything that a check came to, the same bytes for the same input.

Lengths are rounded to 0.1 µm, which no scan resolves, so that the last bits of the arithmetic do not show. What is not
finite is written as null. ``resources/report.schema.json`` describes the file; ``docs/schema.py`` makes it.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from aadm_workbench.model import ColumnReport, JobReport, Json, Profile
from aadm_workbench.own_files import write_atomically

if TYPE_CHECKING:
    from aadm_workbench.model.across import ShipmentReport

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


def report_schema() -> Json:
    """The JSON Schema (draft 2020-12) of report.json."""
    path = Path(__file__).resolve().parents[1] / "resources" / "report.schema.json"
    schema: Json = json.loads(path.read_text(encoding="utf-8"))
    return schema


def write_report(report: JobReport, path: Path) -> str:
    """Write report.json, whole or not at all; returns the SHA-256 of its bytes.

    Raises
    ------
    AadmError
        Where the file cannot be written.
    """
    found = hashlib.sha256()

    def hashed() -> Iterator[bytes]:
        for part in _encoded_parts(report):
            found.update(part)
            yield part

    write_atomically(path, hashed())
    return found.hexdigest()


def encoded_report(report: JobReport) -> bytes:
    """The bytes of report.json."""
    return b"".join(_encoded_parts(report))


def _encoded_parts(report: JobReport) -> Iterator[bytes]:
    """The bytes of report.json, column by column: a shipment's document need not fit into memory."""
    mark = ' "columns": [],\n'
    before, _, after = _text(_head(report)).partition(mark)
    yield (before + mark[: -len("],\n")]).encode()
    for number, column in enumerate(report.columns):
        # As the only item of its list, so that it is indented as it has to be.
        item = _text({"columns": [_column(column)]})[len('{\n "columns": [') : -len("\n ]\n}\n")]
        yield ("," * bool(number) + item).encode()
    yield (("\n " if report.columns else "") + "],\n" + after).encode()


def encode(document: object) -> bytes:
    """A document as JSON in UTF-8; keys stay in their order.

    Parameters
    ----------
    document
        Mappings, lists, arrays, dataclasses and plain values. Names of keys say the unit, and with it the rounding.
    """
    return _text(_rounded("", plain(document))).encode()


def _text(document: Json) -> str:
    from msgspec.json import format as indented

    # Half a character, which a name may hold, has no bytes.
    content = json.dumps(document, ensure_ascii=False, allow_nan=False).encode(errors="replace")
    text = _STEERING.sub(lambda sign: f"\\u{ord(sign[0]):04x}", indented(content, indent=1).decode())
    return _BROKEN_VECTOR.sub(lambda vector: " ".join(vector[0].split()), text) + "\n"


def _head(report: JobReport) -> Json:
    """A job's report as report.json holds it, with no columns."""
    document = plain(replace(report, columns=()))
    first = {"schema": SCHEMA} | {name: document[name] for name in ("tool", "job", "capture", "model")}
    last = {name: document[name] for name in ("columns", "mould_drift", "grid")}
    return _rounded("", first | {"profile": profile_document(report.profile), "summary": report.summary()} | last)


def shipment_document(report: ShipmentReport) -> Json:
    """The matching of a shipment as match.json holds it."""
    return _rounded("", {"schema": SCHEMA, **plain(report)})


def profile_document(profile: Profile) -> Json:
    """A tolerance profile as report.json holds it."""
    document = plain(profile)
    document["rules"] = document.pop("rules")
    return _rounded("", document)


_JUDGED_TOGETHER = ("offset_mm", "u_mm")
"""What moulds are judged by, of each sleeve; rounded before, their probabilities would be others in the last digits."""


def as_shown(column: dict[str, Any]) -> Json:
    """A column in plain types, its numbers as report.json shows them, but for those that moulds are judged by.

    What is no number stays what it is: only report.json has no word for it.
    """
    shown = _rounded("", column, strange=True)
    document: Any = shown
    exact = column["sleeves"]
    if exact is not None:
        for point, kept in zip(exact["points"], document["sleeves"]["points"], strict=True):
            kept.update({name: point[name] for name in _JUDGED_TOGETHER})
    return shown


_COLUMN_FIRST = ("id", "global_id", "piece_mark", "storey", "grid", "size_mm", "T_model_column")


def _column(column: ColumnReport) -> Json:
    """What names the column comes first, then its verdict, then what led to it; only bars stick out of a floor."""
    document = plain(column)
    sleeves = document["sleeves"]
    if sleeves is not None:
        del sleeves["absolute"]
        for point in sleeves["points"]:
            del point["exposed_length_mm"]
    return _rounded("", {name: document.pop(name) for name in _COLUMN_FIRST} | document)


def plain(value: object) -> Any:
    """A value in the types that JSON knows, its numbers as they are; dataclasses are dictionaries of their fields."""
    from msgspec import to_builtins

    return to_builtins(value, str_keys=True, enc_hook=_known)


def _known(value: object) -> object:
    """What stands for an array, a number of numpy or anything else."""
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else str(value)


def _rounded(name: str, value: Any, *, strange: bool = False) -> Json:
    """A value, its numbers rounded by the names of their keys; ``strange`` keeps what is no number as it is."""
    kind = type(value)
    if kind is float:
        return value if strange and not math.isfinite(value) else _number(name, value)
    if kind is dict:
        return {key: _rounded(key, item, strange=strange) for key, item in value.items()}
    if kind is list or kind is tuple:
        if name.startswith("T_"):
            return _transform(value, strange=strange)
        return [_rounded(name, item, strange=strange) for item in value]
    # A length that happens to be whole is written as every other length.
    if kind is int and name.endswith(("_mm", "_deg")):
        return _number(name, float(value))
    plain_value: Json = value
    return plain_value


def _transform(rows: Sequence[Sequence[float]], *, strange: bool) -> Json:
    """A 4x4 transform: the directions without unit, the shift in mm to the nanometre."""
    decimals = (_DIRECTION_DECIMALS, _DIRECTION_DECIMALS, _DIRECTION_DECIMALS, _SHIFT_DECIMALS)

    def shown(places: int, value: float) -> float | None:
        return value if strange and not math.isfinite(value) else _to(places, float(value))

    return [[shown(places, value) for places, value in zip(decimals, row, strict=True)] for row in rows]


def _number(name: str, value: float) -> float | None:
    """A number by its name: lengths, angles and ratios to a fixed number of decimals, others to nine digits."""
    decimals = _decimals(name)
    return _to(decimals, float(f"{value:.{_OTHER_DIGITS}g}") if decimals is None else value)


@cache
def _decimals(name: str) -> int | None:
    """Decimals of what a key of this name holds; None where its size is not known."""
    if name.endswith("_mm"):
        return _LENGTH_DECIMALS
    if name.endswith("_deg"):
        return _ANGLE_DECIMALS
    if name == "scale":
        return _DIRECTION_DECIMALS
    return _RATIO_DECIMALS if name in _RATIOS else None


def _to(decimals: int | None, value: float) -> float | None:
    """Rounded, without a minus before a zero; None for what is no number."""
    if not math.isfinite(value):
        return None
    return (value if decimals is None else round(value, decimals)) + 0.0
