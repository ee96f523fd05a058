"""Whether what was measured of a hanging column may be acted upon now: one answer for all who show or send it.

A pure function of the state that ``aadm watch`` writes (docs/hoisting.md) and of the time. The column may be lowered
(``ready``) only when all hold; the first that fails is the reason.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from aadm_workbench.hoisting.moved import moved_in_words, repair_in_words
from aadm_workbench.model import Bend, Reason, Repair

VALID_FOR_S = 15.0
"""How long a frame counts, from its capture: two to four swings of a hanging column; its crane has acted by then."""

_AHEAD_S = 2.0  # how far clocks that are set by the network may run apart
_FEWEST_DECIDE = 3  # two leave a turn open to noise


@dataclass(frozen=True)
class Fitness:
    """``ready``: lower it. ``shows_move``: the way to push may be shown. ``reason``: what keeps it from being ready.

    ``fresh``, ``oriented`` and ``still`` say so of the three by themselves.
    """

    ready: bool
    shows_move: bool
    reason: str
    fresh: bool
    oriented: bool
    still: bool


def fitness_of(state: Mapping[str, Any], now_s: float | None) -> Fitness:
    """The fitness of a state as its file holds it.

    Parameters
    ----------
    now_s
        Seconds since 1970, UTC; None for what was recorded: it is never ready, and may be looked at at any time.
    """
    stale = "" if now_s is None else _not_fresh(state, now_s)
    recorded = Reason("hoisting.recorded") if now_s is None else ""
    unmeasured, open_turn, contradicted = _not_measured(state), _not_oriented(state), _contradicted(state)
    rest: Sequence[Callable[[Mapping[str, Any]], str]] = (
        _bent,
        _not_still,
        _not_seen,
        _tilted,
        _moved_since,
        _not_passed,
    )
    reasons = [stale, unmeasured, open_turn, contradicted, *(check(state) for check in rest), recorded]
    hindered = stale or unmeasured or open_turn or contradicted
    return Fitness(
        ready=not any(reasons),
        shows_move=not hindered and move_of(state) is not None,
        reason=next((reason for reason in reasons if reason), _rests(state)),
        fresh=not (stale or recorded),
        oriented=not (open_turn or unmeasured),
        still=state.get("still") is True,
    )


def move_of(state: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """The correction of a state: from the rest of its swing where it says so, else that of the frame."""
    move = state["move"] if "move" in state else _frame(state).get("correction")
    numbers = [number(move.get(key)) for key in ("dx_mm", "dy_mm", "yaw_deg")] if isinstance(move, Mapping) else [None]
    return move if isinstance(move, Mapping) and None not in numbers else None


def largest_of(state: Mapping[str, Any]) -> float | None:
    """The largest distance of a sleeve from its bar, at the rest of the swing where it is known, mm."""
    at_rest = number(state.get("largest_mm"))
    return number(_frame(state).get("max_mm")) if at_rest is None else at_rest


def seconds_of(stamp: Any) -> float | None:
    """Seconds since 1970 of a time as a state writes it; None where it is none."""
    try:
        when = datetime.fromisoformat(str(stamp))
    except ValueError:
        return None
    return (when if when.tzinfo else when.replace(tzinfo=UTC)).timestamp()


def stamp_of(seconds: float | None) -> str | None:
    """A time as a state writes it, UTC."""
    if seconds is None:
        return None
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def number(value: Any) -> float | None:
    """A finite number of a document; None for anything else."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    return float(value) if is_number else None


def _frame(state: Mapping[str, Any]) -> Mapping[str, Any]:
    frame = state.get("frame")
    return frame if isinstance(frame, Mapping) else {}


def _entries(value: Any) -> list[Mapping[str, Any]]:
    return [entry for entry in value if isinstance(entry, Mapping)] if isinstance(value, list) else []


def _first_reason(state: Mapping[str, Any]) -> str:
    return next((str(reason) for reason in _frame(state).get("reasons") or ()), "")


def _not_fresh(state: Mapping[str, Any], now_s: float) -> str:
    captured = seconds_of(state.get("captured"))
    if captured is None:
        return Reason("hoisting.no_time")
    age_s = now_s - captured
    if age_s < -_AHEAD_S:
        return Reason("hoisting.ahead", ahead_s=-age_s)
    valid_s = number(state.get("valid_for_s"))
    if age_s > (VALID_FOR_S if valid_s is None else valid_s):
        return Reason("hoisting.stale", age_s=age_s)
    return ""


def _not_measured(state: Mapping[str, Any]) -> str:
    frame = _frame(state)
    if frame.get("verdict") in ("pass", "fail", "inconclusive", "not_assessed") and frame.get("max_mm") is not None:
        return ""
    return _first_reason(state) or Reason("hoisting.not_measured")


def _not_oriented(state: Mapping[str, Any]) -> str:
    if _frame(state).get("orientation") in ("declared", "resolved"):
        return ""
    return Reason("hoisting.which_sleeve")


def _contradicted(state: Mapping[str, Any]) -> str:
    return next((str(one.get("text")) for one in _entries(_frame(state).get("findings")) if one.get("holds_back")), "")


def _bent(state: Mapping[str, Any]) -> str:
    """A bar that no move brings to its sleeve together with the others, whatever the column does."""
    correction = _frame(state).get("correction")
    repairs = _entries(correction.get("repairs") if isinstance(correction, Mapping) else None)
    for one in repairs:
        dx_mm, dy_mm = number(one.get("dx_mm")), number(one.get("dy_mm"))
        if dx_mm is not None and dy_mm is not None:
            return repair_in_words(Repair(str(one.get("label")), dx_mm, dy_mm, _towards(one)))
    return ""


def _towards(repair: Mapping[str, Any]) -> tuple[Bend, ...]:
    """The parts of a bend; none where one of them is not whole."""
    parts = [(number(part.get("mm")), part.get("first"), part.get("last")) for part in _entries(repair.get("towards"))]
    told = [Bend(mm, str(first), str(last)) for mm, first, last in parts if mm is not None and first and last]
    return tuple(told) if len(told) == len(parts) else ()


def _not_still(state: Mapping[str, Any]) -> str:
    if state.get("still") is True:
        return ""
    swing, largest_mm, limit_mm = state.get("swing"), largest_of(state), number(state.get("limit_mm"))
    if not isinstance(swing, Mapping):
        if state.get("moving"):
            return Reason("hoisting.moving")
        return Reason("hoisting.few_frames")
    if limit_mm is None:
        return Reason("hoisting.no_limit")
    if largest_mm is not None and largest_mm > limit_mm:
        return Reason("hoisting.largest", largest_mm=largest_mm, limit_mm=limit_mm)
    amplitude_mm = number(swing.get("amplitude_mm"))
    if amplitude_mm is None or largest_mm is None or move_of(state) is None:
        return Reason("hoisting.moving")
    return Reason("hoisting.swings", amplitude_mm=amplitude_mm, largest_mm=largest_mm, limit_mm=limit_mm)


def _not_seen(state: Mapping[str, Any]) -> str:
    frame = _frame(state)
    correction = frame.get("correction")
    over = correction.get("over") if isinstance(correction, Mapping) else None
    pairs = {str(pair.get("sleeve")): pair for pair in _entries(frame.get("pairs"))}
    resting = set(frame.get("rests_on_scans") or ())
    seen = [name for name in over or () if pairs.get(str(name), {}).get("seen") is True]
    if len(seen) < _FEWEST_DECIDE:
        return Reason("hoisting.few_pairs", count=len(seen))
    for name in over or ():
        pair = pairs.get(str(name), {})
        hidden = {pair.get(key) for key in ("sleeve", "rebar") if pair.get(f"{key}_seen") is not True}
        if pair.get("seen") is not True and not hidden <= resting:
            return Reason("hoisting.decides", label=str(name))
    return ""


def _tilted(state: Mapping[str, Any]) -> str:
    """A column that hangs askew comes down beside where its foot's normal points, by height times tilt."""
    frame, limit_mm, largest_mm = _frame(state), number(state.get("limit_mm")), largest_of(state)
    tilt, height_mm = number(frame.get("column_tilt_deg")), number(frame.get("height_mm"))
    if tilt is None or height_mm is None:
        return Reason("hoisting.no_tilt")
    aside_mm = height_mm * math.tan(math.radians(tilt))
    if limit_mm is None or largest_mm is None or aside_mm + largest_mm <= limit_mm:
        return ""
    return Reason("hoisting.tilted", tilt_deg=tilt, aside_mm=aside_mm)


def _moved_since(state: Mapping[str, Any]) -> str:
    moved = _entries(_frame(state).get("moved_since"))
    if not moved:
        return ""
    said = [(str(one.get("label")), number(one.get("moved_mm")) or 0.0) for one in moved]
    hidden = [str(pair.get("rebar")) for pair in _entries(_frame(state).get("pairs")) if not pair.get("rebar_seen")]
    return moved_in_words(said, hidden)


def _not_passed(state: Mapping[str, Any]) -> str:
    verdict = _frame(state).get("verdict")
    if verdict == "pass":
        return ""
    return _first_reason(state) or Reason(
        "hoisting.no_limit" if verdict == "not_assessed" else "hoisting.frame_no_pass"
    )


def _rests(state: Mapping[str, Any]) -> str:
    resting = [str(label) for label in _frame(state).get("rests_on_scans") or ()]
    return Reason("hoisting.not_seen", labels=resting) if resting else ""
