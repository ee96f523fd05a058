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
    recorded = "recorded, not live" if now_s is None else ""
    unmeasured, open_turn, contradicted = _not_measured(state), _not_oriented(state), _contradicted(state)
    rest: Sequence[Callable[[Mapping[str, Any]], str]] = (
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
        return "when the frame was captured is not known: take a new one"
    age_s = now_s - captured
    if age_s < -_AHEAD_S:
        return f"the frame's time lies {-age_s:.0f} s ahead: set the clocks alike"
    valid_s = number(state.get("valid_for_s"))
    if age_s > (VALID_FOR_S if valid_s is None else valid_s):
        return f"captured {age_s:.0f} s ago: take a new frame"
    return ""


def _not_measured(state: Mapping[str, Any]) -> str:
    frame = _frame(state)
    if frame.get("verdict") in ("pass", "fail", "inconclusive", "not_assessed") and frame.get("max_mm") is not None:
        return ""
    return _first_reason(state) or "not measured"


def _not_oriented(state: Mapping[str, Any]) -> str:
    if _frame(state).get("orientation") in ("declared", "resolved"):
        return ""
    return "it is open which sleeve is which: say near, the corner of the bars nearest to the camera"


def _contradicted(state: Mapping[str, Any]) -> str:
    return next((str(one.get("text")) for one in _entries(_frame(state).get("findings")) if one.get("holds_back")), "")


def _not_still(state: Mapping[str, Any]) -> str:
    if state.get("still") is True:
        return ""
    swing, largest_mm, limit_mm = state.get("swing"), largest_of(state), number(state.get("limit_mm"))
    if not isinstance(swing, Mapping):
        if state.get("moving"):
            return "moving: wait for three frames that tell where it comes to rest"
        return "seen in fewer than three frames: whether it moves is not known"
    if limit_mm is None:
        return "no limit is given"
    if largest_mm is not None and largest_mm > limit_mm:
        return f"largest distance {largest_mm:.1f} mm, limit {limit_mm:g} mm"
    amplitude_mm = number(swing.get("amplitude_mm"))
    if amplitude_mm is None or largest_mm is None or move_of(state) is None:
        return "moving: wait for three frames that tell where it comes to rest"
    return (
        f"swings by {amplitude_mm:.1f} mm, {largest_mm:.1f} mm off at rest, limit {limit_mm:g} mm: let it come to rest"
    )


def _not_seen(state: Mapping[str, Any]) -> str:
    frame = _frame(state)
    correction = frame.get("correction")
    over = correction.get("over") if isinstance(correction, Mapping) else None
    pairs = {str(pair.get("sleeve")): pair for pair in _entries(frame.get("pairs"))}
    resting = set(frame.get("rests_on_scans") or ())
    seen = [name for name in over or () if pairs.get(str(name), {}).get("seen") is True]
    if len(seen) < _FEWEST_DECIDE:
        return f"only {len(seen)} pairs are seen: three decide where the column goes"
    for name in over or ():
        pair = pairs.get(str(name), {})
        hidden = {pair.get(key) for key in ("sleeve", "rebar") if pair.get(f"{key}_seen") is not True}
        if pair.get("seen") is not True and not hidden <= resting:
            return f"{name} decides where the column goes, and is not seen"
    return ""


def _tilted(state: Mapping[str, Any]) -> str:
    """A column that hangs askew comes down beside where its foot's normal points, by height times tilt."""
    frame, limit_mm, largest_mm = _frame(state), number(state.get("limit_mm")), largest_of(state)
    tilt, height_mm = number(frame.get("column_tilt_deg")), number(frame.get("height_mm"))
    if tilt is None or height_mm is None:
        return "the tilt of the column is not known"
    aside_mm = height_mm * math.tan(math.radians(tilt))
    if limit_mm is None or largest_mm is None or aside_mm + largest_mm <= limit_mm:
        return ""
    return f"tilted by {tilt:.2f}°: on its way down that moves the foot by {aside_mm:.1f} mm"


def _moved_since(state: Mapping[str, Any]) -> str:
    moved = _entries(_frame(state).get("moved_since"))
    if not moved:
        return ""
    said = ", ".join(f"{one.get('label')} moved {number(one.get('moved_mm')) or 0.0:.1f} mm" for one in moved)
    hidden = [str(pair.get("rebar")) for pair in _entries(_frame(state).get("pairs")) if not pair.get("rebar_seen")]
    look = f"; look at {', '.join(hidden)}, which the frame does not show" if hidden else ""
    return f"{said} since the scan from before hoisting{look}"


def _not_passed(state: Mapping[str, Any]) -> str:
    verdict = _frame(state).get("verdict")
    if verdict == "pass":
        return ""
    return _first_reason(state) or ("no limit is given" if verdict == "not_assessed" else "the frame does not pass")


def _rests(state: Mapping[str, Any]) -> str:
    resting = [str(label) for label in _frame(state).get("rests_on_scans") or ()]
    return f"{', '.join(resting)} not seen: where it was measured before hoisting" if resting else ""
