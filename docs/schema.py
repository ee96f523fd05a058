"""Writes the JSON Schema of report.json from the dataclasses that it is read by: python docs/schema.py.

Keys that a reader may do without are not required, and keys that it does not know are allowed: a report of another
version of schema 1 is one, too.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import msgspec

from aadm_workbench.model import SUMMED, JobReport
from aadm_workbench.model.reports import LONGEST_ID
from aadm_workbench.report.json import SCHEMA
from aadm_workbench.report.read import NAMED

FILE = Path(__file__).resolve().parents[1] / "aadm_workbench" / "resources" / "report.schema.json"
_DESCRIPTION = (
    "What a check of precast columns came to. Lengths in mm, angles in degrees, transforms row-major, "
    "T_to_from @ from = to. u_mm is per axis, k = 1."
)
_ROW = {"type": "array", "minItems": 4, "maxItems": 4, "items": {"type": "number"}}
_TRANSFORM = {"type": "array", "minItems": 4, "maxItems": 4, "items": _ROW}


def schema() -> dict[str, Any]:
    """The schema, draft 2020-12."""
    found = msgspec.json.schema(JobReport, schema_hook=lambda kind: _TRANSFORM)
    report = found["$defs"].pop("JobReport")
    counted = {"type": "integer", "minimum": 0}
    report["properties"] |= {
        "schema": {"const": SCHEMA},
        "summary": {"type": "object", "additionalProperties": counted, "required": [*SUMMED]},
    }
    report["required"] += ["schema"]
    report["properties"]["columns"]["minItems"] = 1
    found["$defs"]["ColumnReport"]["properties"]["id"] |= {"minLength": 1, "maxLength": LONGEST_ID}
    found["$defs"]["ColumnReport"]["properties"]["verdict"] = {"enum": [*SUMMED]}
    for part, names in NAMED.items():
        entry = report["properties"][part]
        entry.get("anyOf", [entry])[0]["required"] = list(names)
    title = f"report.json of the AADM workbench, schema {SCHEMA}"
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return head | report | {"title": title, "description": _DESCRIPTION, "$defs": found["$defs"]}


def text() -> str:
    """The schema as its file holds it."""
    return json.dumps(schema(), ensure_ascii=False, indent=1) + "\n"


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
