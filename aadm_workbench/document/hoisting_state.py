"""What the hoisting window shows: the newest measurement of a folder, and what the crew should do about it.

A measurement is a block of ``hoisting`` in report.json, or a state file with the same keys that a watched folder is
measured into.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from aadm_workbench.errors import ReportError

DEFAULT_LIMIT_MM = 3.0
"""GB/T 51231-2016, 10.4, where the measurement does not carry its own limit."""

SIDES = {"-y": 0.0, "+x": 90.0, "+y": 180.0, "-x": -90.0}
"""Where the reader stands, seen from the column; the turn of what is ahead of them against +y, degrees."""

_STILL_MM = 0.3  # less than a crane can move by: a tenth of the limit
_STILL_DEG = 0.03  # 0.2 mm at the corner of a column of 600 mm


@dataclass(frozen=True)
class Measurement:
    """One frame: the column's id, the block of keys, the file and the time (seconds) it was written."""

    column: str
    frame: Mapping[str, Any]
    file: Path
    written: float
    limit_mm: float


@dataclass(frozen=True)
class Guidance:
    """What to do: push to the right and ahead as the reader stands, mm; turn, degrees, counter-clockwise from above.

    ``light`` is ``go``, ``push`` or ``hold``. None where nothing could be measured.
    """

    right_mm: float | None
    ahead_mm: float | None
    turn_deg: float | None
    largest_mm: float | None
    margin_mm: float | None
    light: str
    reason: str = ""

    @property
    def is_still(self) -> bool:
        """Whether there is nothing left to push or turn."""
        parts = (self.right_mm, self.ahead_mm, self.turn_deg)
        if any(part is None for part in parts):
            return False
        return math.hypot(self.right_mm or 0, self.ahead_mm or 0) < _STILL_MM and abs(self.turn_deg or 0) < _STILL_DEG


def newest_measurement(folder: Path) -> Measurement | None:
    """The newest measurement among the .json files of a folder; None where there is none.

    Raises
    ------
    ReportError
        Where the folder cannot be read.
    """
    try:
        files = sorted(((file.stat().st_mtime, file) for file in folder.glob("*.json")), reverse=True)
    except OSError as error:
        raise ReportError(f"{folder}: cannot be read ({error.strerror}); choose another folder") from error
    for _, file in files:
        try:
            found = read_measurement(file)
        except ReportError:
            # A file that is just being written, or belongs to something else.
            continue
        if found is not None:
            return found
    return None


def read_measurement(file: Path) -> Measurement | None:
    """The last frame that a file holds; None where it holds no hoisting.

    Raises
    ------
    ReportError
        Where it cannot be read or is no JSON.
    """
    try:
        document = json.loads(file.read_text(encoding="utf-8-sig"))
        written = file.stat().st_mtime
    except (OSError, ValueError) as error:
        raise ReportError(f"{file}: is no report and no hoisting state ({error})") from error
    if not isinstance(document, dict):
        return None
    column, frame = _frame_of(document)
    if frame is None:
        return None
    return Measurement(column, frame, file, written, _limit_of(document, frame))


def guidance_of(measurement: Measurement, standing: str) -> Guidance:
    """What to do, for somebody who stands at the side ``standing`` of the column and looks at it.

    Parameters
    ----------
    standing
        One of :data:`SIDES`.
    """
    frame = measurement.frame
    verdict = str(frame.get("verdict") or "not_measured")
    correction = frame.get("correction") or {}
    dx, dy, turn = (_number(correction.get(key)) for key in ("dx_mm", "dy_mm", "yaw_deg"))
    largest_mm = _number(frame.get("max_mm"))
    margin_mm = None if largest_mm is None else measurement.limit_mm - largest_mm
    light = {"pass": "go", "fail": "push"}.get(verdict, "hold")
    reason = "; ".join(str(one) for one in frame.get("reasons") or ())
    if dx is None or dy is None or verdict == "not_measured":
        # Too little was seen to say where to push, whatever single pairs give.
        return Guidance(None, None, turn, largest_mm, margin_mm, "hold", reason)
    angle = math.radians(SIDES[standing])
    right_mm = dx * math.cos(angle) + dy * math.sin(angle)
    ahead_mm = -dx * math.sin(angle) + dy * math.cos(angle)
    return Guidance(right_mm, ahead_mm, turn, largest_mm, margin_mm, light, reason)


def _frame_of(document: Mapping[str, Any]) -> tuple[str, Mapping[str, Any] | None]:
    if "correction" in document or ("pairs" in document and "verdict" in document):
        return str(document.get("column") or document.get("id") or ""), document
    if isinstance(document.get("frame"), dict):  # the state of a folder that is watched
        return str(document.get("column") or ""), document["frame"]
    hoisting = document.get("hoisting")
    frames = hoisting if isinstance(hoisting, list) else [hoisting] if isinstance(hoisting, dict) else []
    if frames and isinstance(frames[-1], dict):
        return str(document.get("column") or document.get("id") or ""), frames[-1]
    columns = document.get("columns")
    for column in columns if isinstance(columns, list) else []:
        if isinstance(column, dict) and column.get("hoisting"):
            return _frame_of({"id": column.get("id"), "hoisting": column["hoisting"]})
    return "", None


def _limit_of(document: Mapping[str, Any], frame: Mapping[str, Any]) -> float:
    written = _number(frame.get("limit_mm")) or _number(document.get("limit_mm"))
    if written is not None:
        return written
    pairs = frame.get("pairs")
    own = [_number(pair.get("limit_mm")) for pair in pairs or () if isinstance(pair, dict)]
    if any(limit is not None for limit in own):
        return min(limit for limit in own if limit is not None)
    profile = document.get("profile")
    rules = profile.get("rules", []) if isinstance(profile, dict) else []
    limits = [_number(rule.get("upper_mm")) for rule in rules if rule.get("limits") == "sleeve_rebar_distance"]
    return min((limit for limit in limits if limit is not None), default=DEFAULT_LIMIT_MM)


def _number(value: Any) -> float | None:
    is_number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    return float(value) if is_number else None
