"""What the samples' reports said when it was last looked at: ``python -m tests.frozen`` writes it anew.

A change of the code that is not meant to change a number must not change one; one that is meant to shows its numbers in
``tests/frozen_samples.json``, where they are to be looked at.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

KEPT = Path(__file__).with_name("frozen_samples.json")


def frozen(document: dict[str, Any]) -> dict[str, Any]:
    """Of each column of a report what people act on."""
    return {column["id"]: _column(column) for column in document["columns"]}


def _column(column: dict[str, Any]) -> dict[str, Any]:
    trial = column["trial_assembly"]
    return {
        "verdict": column["verdict"],
        "goes_on": column["goes_on"],
        "reasons": [re.sub(r"[\d.]*\d", "#", reason) for reason in column["reasons"]],
        "findings": [finding["code"] for finding in column["findings"]],
        "centres_mm": {kind: _centres(column[kind]) for kind in ("sleeves", "rebars")},
        "probability": None if trial is None else trial["probability"],
        "in_the_way": None if trial is None else trial["in_the_way"],
        "repair": column["repair"],
    }


def _centres(group: dict[str, Any] | None) -> dict[str, list[float] | None]:
    if group is None:
        return {}
    return {
        point["label"]: None if point["scan_mm"] is None else [*point["scan_mm"], point["u_mm"]]
        for point in group["points"]
    }


def main() -> None:
    """Check both samples and keep what they say."""
    from tests.test_samples import report

    said = {sample: frozen(report(sample)) for sample in ("floor", "lab")}
    rounded = json.loads(json.dumps(said), parse_float=lambda text: round(float(text), 4))
    KEPT.write_text(json.dumps(rounded, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
