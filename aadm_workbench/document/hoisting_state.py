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
from aadm_workbench.report.hoisting_fitness import fitness_of, largest_of, move_of, number, seconds_of

DEFAULT_LIMIT_MM = 3.0
"""GB/T 51231-2016, 10.4, where the measurement does not carry its own limit."""

SIDES = {"-y": 0.0, "+x": 90.0, "+y": 180.0, "-x": -90.0}
"""Where the reader stands, seen from the column; the turn of what is ahead of them against +y, degrees."""

BESIDE_CAMERA = ""
"""Where the reader stands who looks as the camera does: what crews know without a drawing."""

_LOOKED_AT = 20  # of the files of a folder that many people write into, several times a second
_STILL_MM = 0.3  # less than a crane can move by: a tenth of the limit
_STILL_DEG = 0.03  # 0.2 mm at the corner of a column of 600 mm
_FULL_ARROW_MM = 20.0
"""A push that long fills the picture; half of the arrow stands for a quarter of it: 1 mm must be seen from 3 m away."""


@dataclass(frozen=True)
class Measurement:
    """One frame: the column's id, the state that holds it (``aadm-state.json``), its file, and the limit."""

    column: str
    state: Mapping[str, Any]
    file: Path
    limit_mm: float

    @property
    def frame(self) -> Mapping[str, Any]:
        """The frame as report.json holds it."""
        frame: Mapping[str, Any] = self.state["frame"]
        return frame

    @property
    def captured_s(self) -> float | None:
        """When the frame was taken, seconds since 1970; None where that is not known."""
        return seconds_of(self.state.get("captured"))


@dataclass(frozen=True)
class Guidance:
    """What to do: push to the right and ahead as the reader stands, mm; turn, degrees, counter-clockwise from above.

    ``light`` is ``go``, ``push`` or ``hold``. None where nothing may be shown. ``reason`` says what keeps the column
    from being lowered.
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

    @property
    def arrow_share(self) -> float:
        """Length of the arrow, of the longest that is drawn: it grows with the root of the amount."""
        amount_mm = math.hypot(self.right_mm or 0.0, self.ahead_mm or 0.0)
        return min(1.0, math.sqrt(amount_mm / _FULL_ARROW_MM))

    @property
    def margin_light(self) -> str:
        """In which light the margin stands: green only where the column may be lowered."""
        if self.margin_mm is not None and self.margin_mm < 0.0:
            return "push"
        return "go" if self.light == "go" else "hold"


def newest_measurement(folder: Path, now_s: float | None = None) -> Measurement | None:
    """The newest measurement among the .json files of a folder; None where there is none.

    With a time ``now_s``, seconds since 1970, one that is fresh goes before those that are not, whatever the times of
    their files: clocks are set back.

    Raises
    ------
    ReportError
        Where the folder cannot be read.
    """
    try:
        files = sorted(((file.stat().st_mtime, file) for file in folder.glob("*.json")), reverse=True)
    except OSError as error:
        raise ReportError.about(folder, "document.folder", why=error.strerror) from error
    newest: Measurement | None = None
    for _, file in files[:_LOOKED_AT]:
        try:
            found = read_measurement(file)
        except ReportError:
            # A file that is just being written, or belongs to something else.
            continue
        if found is not None and (now_s is None or fitness_of(found.state, now_s).fresh):
            return found
        newest = newest or found
    return newest


def read_measurement(file: Path) -> Measurement | None:
    """The last frame that a file holds; None where it holds no hoisting.

    Raises
    ------
    ReportError
        Where it cannot be read or is no JSON.
    """
    try:
        document = json.loads(file.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError) as error:
        raise ReportError.about(file, "document.no_state", why=error) from error
    if not isinstance(document, dict):
        return None
    column, frame = _frame_of(document)
    if frame is None:
        return None
    limit_mm = _limit_of(document, frame)
    state = document if document.get("frame") is frame else {"frame": frame}
    return Measurement(column, {**state, "limit_mm": limit_mm}, file, limit_mm)


def guidance_of(measurement: Measurement, standing: str, now_s: float | None = None) -> Guidance:
    """What to do, for somebody who stands at the side ``standing`` of the column and looks at it.

    Parameters
    ----------
    standing
        One of :data:`SIDES`, or :data:`BESIDE_CAMERA`: then nothing is shown of which nobody knows where the camera is.
    now_s
        Seconds since 1970; None for what is looked at as a record: it never says ``go``.
    """
    state = measurement.state
    fitness, largest_mm = fitness_of(state, now_s), largest_of(state)
    margin_mm = None if largest_mm is None else measurement.limit_mm - largest_mm
    move = move_of(state)
    if move is None or not fitness.shows_move or measurement.frame.get("verdict") == "not_measured":
        return Guidance(None, None, None, largest_mm, margin_mm, "hold", fitness.reason)
    dx, dy, turn = (number(move.get(key)) or 0.0 for key in ("dx_mm", "dy_mm", "yaw_deg"))
    right_mm, ahead_mm = _as_seen(move, dx, dy, standing)
    if right_mm is None or ahead_mm is None:
        return Guidance(None, None, None, largest_mm, margin_mm, "hold", fitness.reason)
    is_beyond = measurement.frame.get("verdict") == "fail" or (margin_mm is not None and margin_mm < 0.0)
    light = "go" if fitness.ready else "push" if is_beyond else "hold"
    return Guidance(right_mm, ahead_mm, turn, largest_mm, margin_mm, light, fitness.reason)


def _as_seen(move: Mapping[str, Any], dx: float, dy: float, standing: str) -> tuple[float | None, float | None]:
    """A move to the right and ahead, mm, of somebody who stands there; None where that is not told."""
    if standing == BESIDE_CAMERA:
        camera = move.get("camera")  # of a frame in report.json; a state file tells it beside the move
        told = camera if isinstance(camera, Mapping) else move
        return number(told.get("right_mm")), number(told.get("away_mm"))
    angle = math.radians(SIDES[standing])
    return dx * math.cos(angle) + dy * math.sin(angle), -dx * math.sin(angle) + dy * math.cos(angle)


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
    written = number(frame.get("limit_mm")) or number(document.get("limit_mm"))
    if written is not None:
        return written
    pairs = frame.get("pairs")
    own = [number(pair.get("limit_mm")) for pair in pairs or () if isinstance(pair, dict)]
    if any(limit is not None for limit in own):
        return min(limit for limit in own if limit is not None)
    profile = document.get("profile")
    rules = profile.get("rules", []) if isinstance(profile, dict) else []
    limits = [number(rule.get("upper_mm")) for rule in rules if rule.get("limits") == "sleeve_rebar_distance"]
    return min((limit for limit in limits if limit is not None), default=DEFAULT_LIMIT_MM)
