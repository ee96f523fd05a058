"""What a link shows at one moment: the numbers of the state file, as far as they may be acted upon now."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

from aadm_workbench.report.hoisting_fitness import Fitness, fitness_of, move_of, number, seconds_of

LARGEST_STATE_BYTES = 2**22
"""A state takes ten thousand bytes; forty pairs of sleeves and bars four times as many."""

WITHDRAWN = "new values follow"
_SCHEMA = 2  # the first that says ready, reason and captured


class Quality(StrEnum):
    """How far numbers may be believed; with the last two there are none."""

    GOOD = "good"
    UNCERTAIN = "uncertain"
    NO_DATA = "no_data"
    TIMEOUT = "timeout"


@dataclass(frozen=True)
class Snapshot:
    """What is shown; lengths in mm, angles in degrees, signs and frame as of ``correction`` (docs/hoisting.md).

    Numbers are None where there is none to act upon; ``left_mm`` is the largest distance that the move leaves.
    ``captured_s`` and ``now_s``, when this holds, are in seconds since 1970. ``document`` is the state as its file
    holds it, None without one.
    """

    ready: bool
    reason: str
    quality: Quality
    fresh: bool = False
    still: bool = False
    oriented: bool = False
    column: str = ""
    sequence: int = 0
    dx_mm: float | None = None
    dy_mm: float | None = None
    yaw_deg: float | None = None
    left_mm: float | None = None
    u_mm: float | None = None
    limit_mm: float | None = None
    captured_s: float | None = None
    now_s: float = 0.0
    document: Mapping[str, Any] | None = None

    def withdrawn(self) -> Snapshot:
        """The same, not ready: what is shown while values change."""
        return replace(self, ready=False, reason=WITHDRAWN)


def read_snapshot(path: Path, now_s: float) -> Snapshot:
    """Read a state file as it is to be shown at a time; what cannot be read shows nothing, and says why."""
    try:
        if path.stat().st_size > LARGEST_STATE_BYTES:
            return _nothing(f"{path.name} is no state: it is too large")
        document = json.loads(path.read_bytes())
    except FileNotFoundError:
        return _nothing(f"{path.name} is not there: is aadm watch running?")
    except (OSError, ValueError, RecursionError) as error:
        return _nothing(f"{path.name} cannot be read ({error})")
    if not isinstance(document, Mapping):
        return _nothing(f"{path.name} is no state")
    return snapshot_of(document, now_s)


def snapshot_of(state: Mapping[str, Any], now_s: float) -> Snapshot:
    """A state as it is to be shown at ``now_s``, seconds since 1970: its age counts from the capture."""
    if state.get("schema") != _SCHEMA:
        return _nothing(f"the state has schema {state.get('schema')!r}, not {_SCHEMA}: renew aadm watch")
    fitness = fitness_of(state, now_s)
    sequence, frame = number(state.get("sequence")), state.get("frame")
    shown = Snapshot(
        fitness.ready,
        fitness.reason,
        _quality(state, fitness, now_s),
        fitness.fresh,
        fitness.still,
        fitness.oriented,
        str(state.get("column") or ""),
        0 if sequence is None else int(sequence),
        limit_mm=number(state.get("limit_mm")),
        captured_s=seconds_of(state.get("captured")),
        now_s=now_s,
        document=state,
    )
    move = move_of(state)
    if move is None or shown.quality in (Quality.NO_DATA, Quality.TIMEOUT):
        return shown
    correction = frame.get("correction") if isinstance(frame, Mapping) else None
    return replace(
        shown,
        dx_mm=number(move.get("dx_mm")),
        dy_mm=number(move.get("dy_mm")),
        yaw_deg=number(move.get("yaw_deg")),
        u_mm=number(move.get("u_mm")),
        left_mm=number(correction.get("left_mm")) if isinstance(correction, Mapping) else None,
    )


def _quality(state: Mapping[str, Any], fitness: Fitness, now_s: float) -> Quality:
    if not fitness.shows_move:
        captured_s = seconds_of(state.get("captured"))
        is_old = not fitness.fresh and captured_s is not None and captured_s < now_s
        return Quality.TIMEOUT if is_old else Quality.NO_DATA
    frame = state.get("frame")
    certain = isinstance(frame, Mapping) and frame.get("verdict") in ("pass", "fail")
    return Quality.GOOD if certain else Quality.UNCERTAIN


def _nothing(reason: str) -> Snapshot:
    return Snapshot(False, reason, Quality.NO_DATA)
