"""Whether a hanging column may be lowered now: every single thing that speaks against it does, and is the reason."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from aadm_workbench.report.hoisting_fitness import fitness_of, seconds_of, stamp_of
from aadm_workbench.report.words.reasons import in_both_languages

NOON = 1_796_040_000.0  # 2026-11-30T12:00:00Z by `date -u -d`
PAIRS = [
    {"sleeve": f"S{k}", "rebar": f"R{k}", "seen": k < 5, "sleeve_seen": True, "rebar_seen": k < 5} for k in range(1, 7)
]
GOOD: dict[str, Any] = {
    "schema": 2,
    "captured": "2026-11-30T12:00:00.000Z",
    "valid_for_s": 15.0,
    "limit_mm": 3.0,
    "still": True,
    "moving": False,
    "swing": {"amplitude_mm": 0.2, "period_s": None},
    "largest_mm": 1.0,
    "move": {"dx_mm": 0.4, "dy_mm": -0.2, "yaw_deg": 0.01},
    "frame": {
        "verdict": "pass",
        "max_mm": 1.1,
        "orientation": "declared",
        "height_mm": 90.0,
        "column_tilt_deg": 0.1,
        "pairs": PAIRS,
        "correction": {"dx_mm": 0.5, "dy_mm": -0.3, "yaw_deg": 0.01, "over": ["S1", "S2", "S3", "S4"]},
        "moved_since": [],
        "rests_on_scans": ["R5", "R6"],
    },
}


def state(**changes: Any) -> dict[str, Any]:
    """The good state with changes; a key with two underscores is one of the frame."""
    changed = copy.deepcopy(GOOD)
    for key, value in changes.items():
        (changed["frame"] if key.startswith("frame__") else changed)[key.removeprefix("frame__")] = value
    return changed


def test_times_are_written_in_utc() -> None:
    assert seconds_of("2026-11-30T12:00:00Z") == NOON
    assert seconds_of("2026-11-30T20:00:00+08:00") == NOON
    assert stamp_of(NOON + 0.25) == "2026-11-30T12:00:00.250Z"
    assert seconds_of(None) is None
    assert seconds_of("yesterday") is None


def test_a_good_state_is_ready_and_names_what_rests_on_older_scans() -> None:
    fit = fitness_of(GOOD, NOON + 3.0)
    assert (fit.ready, fit.shows_move, fit.fresh, fit.oriented, fit.still) == (True,) * 5
    assert fit.reason.startswith("R5, R6 not seen")


BENT = [{"label": "R2", "dx_mm": -6.0, "dy_mm": 4.5}]
NAMED = [{"label": "R2", "dx_mm": -6.0, "dy_mm": 0.0, "towards": [{"mm": 6.0, "first": "R10", "last": "R1"}]}]
HALF = [{"label": "R2", "dx_mm": -6.0, "dy_mm": 4.5, "towards": [{"mm": 6.0, "first": "R10"}]}]
AGAINST: list[tuple[dict[str, Any], str, bool]] = [
    ({"captured": None}, "when the frame was captured is not known", False),
    ({"captured": "2026-11-30T11:59:40Z"}, "captured 23 s ago", False),
    ({"captured": "2026-11-30T12:05:03Z"}, "the frame's time lies 300 s ahead", False),
    ({"valid_for_s": 2.0}, "captured 3 s ago", False),
    ({"frame__verdict": "not_measured", "frame__reasons": ["no bar is seen"]}, "no bar is seen", False),
    ({"frame__verdict": "error", "frame__reasons": ["no picture"], "frame__max_mm": None}, "no picture", False),
    ({"frame__orientation": "ambiguous"}, "it is open which sleeve is which", False),
    ({"frame__orientation": ""}, "it is open which sleeve is which", False),
    ({"frame__findings": [{"holds_back": True, "text": "they contradict each other"}]}, "they contradict", False),
    (
        {"still": False, "frame__correction": {**GOOD["frame"]["correction"], "repairs": BENT}},
        "no move brings R2 in",
        True,
    ),
    (
        {"frame__correction": {**GOOD["frame"]["correction"], "repairs": NAMED}},
        "no move brings R2 in with the others: bend it by 6.0 mm towards the side of R10 to R1",
        True,
    ),
    (
        {"frame__correction": {**GOOD["frame"]["correction"], "repairs": HALF}},
        "no move brings R2 in with the others: bend it by -6.0, +4.5 mm (x, y",
        True,
    ),
    ({"still": False, "swing": None}, "seen in fewer than three frames", True),
    ({"still": False, "swing": None, "moving": True, "move": None}, "moving: wait", False),
    ({"still": False, "swing": {"amplitude_mm": 9.0}}, "swings by 9.0 mm, 1.0 mm off at rest", True),
    ({"still": False, "largest_mm": 8.0}, "largest distance 8.0 mm, limit 3 mm", True),
    ({"still": None}, "swings by", True),
    ({"frame__correction": {**GOOD["frame"]["correction"], "over": ["S1", "S2", "S5"]}}, "only 2 pairs", True),
    ({"frame__rests_on_scans": [], "frame__correction": {"over": ["S1", "S2", "S3", "S6"]}}, "S6 decides", True),
    ({"frame__column_tilt_deg": 1.4}, "tilted by 1.40°: on its way down that moves the foot by 2.2 mm", True),
    ({"frame__column_tilt_deg": None}, "the tilt of the column is not known", True),
    ({"frame__moved_since": [{"label": "R1", "moved_mm": 6.03, "u_mm": 0.1}]}, "R1 moved 6.0 mm", True),
    ({"frame__verdict": "inconclusive", "frame__reasons": ["S2-R2: too close"]}, "S2-R2: too close", True),
    ({"frame__verdict": "not_assessed"}, "no limit is given", True),
]


@pytest.mark.parametrize(("changes", "reason", "shows"), AGAINST, ids=[reason for _, reason, _ in AGAINST])
def test_what_speaks_against_it_is_the_reason(changes: dict[str, Any], reason: str, shows: bool) -> None:
    fit = fitness_of(state(**changes), NOON + 3.0)
    assert not fit.ready
    assert fit.reason.startswith(reason)
    assert fit.shows_move is shows
    spoken = in_both_languages(fit.reason)
    given = {"no bar is seen", "no picture", "they contradict each other", "S2-R2: too close"}
    assert fit.reason in given or spoken.zh != spoken.en
    assert fit.reason in given or not any(word in spoken.zh for word in ("frame", "column", "moved", "look at"))


def test_the_first_that_fails_is_shown() -> None:
    both = state(frame__orientation="ambiguous", frame__column_tilt_deg=5.0, captured="2026-11-30T11:00:00Z")
    assert fitness_of(both, NOON).reason == "captured 3600 s ago: take a new frame"


def test_a_record_may_be_looked_at_and_is_never_ready() -> None:
    fit = fitness_of(GOOD, None)
    assert (fit.ready, fit.shows_move, fit.reason) == (False, True, "recorded, not live")


@pytest.mark.parametrize("broken", [{}, {"frame": None}, {"frame": []}, {"frame": {"pairs": "x", "max_mm": "y"}}])
def test_what_is_no_state_is_not_fit(broken: dict[str, Any]) -> None:
    fit = fitness_of(broken, NOON)
    assert not fit.ready
    assert not fit.shows_move


def test_age_alone_turns_a_ready_state_unfit() -> None:
    ready = [fitness_of(GOOD, NOON + age).ready for age in (0.0, 14.9, 15.1, 3600.0, -1.0, -60.0)]
    assert ready == [True, True, False, False, True, False]
