"""What the hoisting window is told."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.document.hoisting_state import (
    BESIDE_CAMERA,
    SIDES,
    Guidance,
    guidance_of,
    newest_measurement,
    read_measurement,
)
from aadm_workbench.errors import ReportError

FRAME = {
    "source": "frame.tiff",
    "verdict": "fail",
    "orientation": "declared",
    "max_mm": 5.0,
    "correction": {"dx_mm": 4.0, "dy_mm": 3.0, "yaw_deg": -0.5},
    "pairs": [],
}

NOON = 1_796_040_000.0
READY: dict[str, Any] = {
    "schema": 2,
    "column": "C-1",
    "captured": "2026-11-30T12:00:00Z",
    "valid_for_s": 15.0,
    "limit_mm": 3.0,
    "still": True,
    "moving": False,
    "swing": {"amplitude_mm": 0.1, "period_s": None},
    "largest_mm": 1.0,
    "move": {"dx_mm": 0.4, "dy_mm": -0.2, "yaw_deg": 0.01},
    "frame": {
        "source": "frame.tiff",
        "verdict": "pass",
        "max_mm": 1.1,
        "orientation": "declared",
        "height_mm": 90.0,
        "column_tilt_deg": 0.1,
        "pairs": [{"sleeve": f"S{k}", "rebar": f"R{k}", "seen": True, "rebar_seen": True} for k in range(1, 5)],
        "correction": {"dx_mm": 0.1, "dy_mm": 0.0, "yaw_deg": 0.0, "over": ["S1", "S2", "S3", "S4"]},
    },
}


def write(folder: Path, name: str, content: object, age_s: float = 0.0) -> Path:
    path = folder / name
    path.write_text(json.dumps(content), encoding="utf-8")
    os.utime(path, (1_000_000 - age_s, 1_000_000 - age_s))
    return path


@pytest.mark.parametrize(
    ("standing", "right_mm", "ahead_mm"),
    [("-y", 4.0, 3.0), ("+x", 3.0, -4.0), ("+y", -4.0, -3.0), ("-x", -3.0, 4.0)],
)
def test_directions_are_the_readers(tmp_path: Path, standing: str, right_mm: float, ahead_mm: float) -> None:
    # Who stands at +x looks towards -x: +y is to the right, -x is ahead.
    found = read_measurement(write(tmp_path, "state.json", FRAME))
    assert found is not None
    guidance = guidance_of(found, standing)
    assert guidance.right_mm == pytest.approx(right_mm)
    assert guidance.ahead_mm == pytest.approx(ahead_mm)
    assert guidance.turn_deg == -0.5
    assert len(SIDES) == 4


def test_who_stands_beside_the_camera_is_told_what_it_sees(tmp_path: Path) -> None:
    frame = FRAME | {
        "correction": FRAME["correction"] | {"camera": {"right_mm": -1.5, "away_mm": 4.8, "yaw_deg": -0.5}}
    }
    states = {
        "frame.json": (frame, (-1.5, 4.8)),
        "state.json": (READY | {"move": READY["move"] | {"right_mm": 0.1, "away_mm": 0.4}}, (0.1, 0.4)),
        "old.json": (FRAME, (None, None)),  # nothing is shown of which nobody knows from where it is seen
    }
    for name, (content, expected) in states.items():
        found = read_measurement(write(tmp_path, name, content))
        assert found is not None
        guidance = guidance_of(found, BESIDE_CAMERA)
        assert (guidance.right_mm, guidance.ahead_mm) == expected
        assert guidance.light == ("hold" if expected[0] is None else guidance_of(found, "-y").light)


@pytest.mark.parametrize(
    ("verdict", "largest_mm", "light"),
    [
        ("pass", 1.0, "go"),
        ("fail", 5.0, "push"),
        ("inconclusive", 2.9, "hold"),
        ("not_measured", 1.0, "hold"),
        ("nonsense", 1.0, "hold"),
    ],
)
def test_only_a_pass_that_is_fit_is_green(tmp_path: Path, verdict: str, largest_mm: float, light: str) -> None:
    state = READY | {"frame": READY["frame"] | {"verdict": verdict}, "largest_mm": largest_mm}
    found = read_measurement(write(tmp_path, "aadm-state.json", state))
    assert found is not None
    assert guidance_of(found, "-y", NOON + 1.0).light == light
    for unfit in (NOON + 60.0, NOON - 60.0, None):  # old, from the future, recorded
        assert guidance_of(found, "-y", unfit).light != "go"
        assert guidance_of(found, "-y", unfit).margin_light != "go"


def test_an_old_frame_shows_no_arrow(tmp_path: Path) -> None:
    found = read_measurement(write(tmp_path, "aadm-state.json", READY))
    assert found is not None
    assert guidance_of(found, "-y", NOON).right_mm == 0.4
    old = guidance_of(found, "-y", NOON + 16.0)
    assert (old.right_mm, old.ahead_mm, old.light) == (None, None, "hold")
    assert old.reason == "captured 16 s ago: take a new frame"


def test_the_arrow_is_that_of_the_rest_of_the_swing(tmp_path: Path) -> None:
    swinging = READY | {"still": False, "swing": {"amplitude_mm": 9.0, "period_s": 4.5}}
    found = read_measurement(write(tmp_path, "aadm-state.json", swinging))
    assert found is not None
    guidance = guidance_of(found, "-y", NOON)
    assert (guidance.right_mm, guidance.light) == (0.4, "hold")  # its frame by itself passes, and says 0.1
    unknown = swinging | {"swing": None, "moving": True, "move": None}
    found = read_measurement(write(tmp_path, "aadm-state.json", unknown))
    assert found is not None
    assert guidance_of(found, "-y", NOON).right_mm is None


def test_an_ambiguous_frame_shows_no_arrow(tmp_path: Path) -> None:
    for record in (FRAME | {"orientation": "ambiguous"}, {key: FRAME[key] for key in FRAME if key != "orientation"}):
        found = read_measurement(write(tmp_path, "state.json", record))
        assert found is not None
        guidance = guidance_of(found, "-y")
        assert (guidance.right_mm, guidance.turn_deg, guidance.light) == (None, None, "hold")


def test_the_arrow_grows_with_the_amount() -> None:
    shares = [Guidance(mm, 0.0, 0.0, mm, None, "push").arrow_share for mm in (0.2, 1.0, 5.0, 20.0, 90.0)]
    assert shares == sorted(shares)
    assert shares[0] < 0.11
    assert shares[1] > 0.2  # 1 mm is seen from afar
    assert shares[2] == pytest.approx(0.5)
    assert shares[3:] == [1.0, 1.0]


@pytest.mark.parametrize("correction", [None, {}, {"dx_mm": None, "dy_mm": 1.0}, {"dx_mm": float("nan"), "dy_mm": 1.0}])
def test_without_a_correction_there_is_no_arrow_and_no_green(tmp_path: Path, correction: object) -> None:
    found = read_measurement(write(tmp_path, "state.json", FRAME | {"verdict": "pass", "correction": correction}))
    assert found is not None
    guidance = guidance_of(found, "-y")
    assert guidance.right_mm is None
    assert guidance.light == "hold"


def test_margin_is_what_is_left_of_the_limit(tmp_path: Path) -> None:
    found = read_measurement(write(tmp_path, "state.json", FRAME | {"max_mm": 2.0}))
    assert found is not None
    assert guidance_of(found, "-y").margin_mm == pytest.approx(1.0)
    stricter = read_measurement(write(tmp_path, "state.json", FRAME | {"max_mm": 2.0, "limit_mm": 2.5}))
    assert stricter is not None
    assert guidance_of(stricter, "-y").margin_mm == pytest.approx(0.5)


def test_the_newest_frame_counts_and_half_a_file_does_not(tmp_path: Path) -> None:
    assert newest_measurement(tmp_path) is None
    write(tmp_path, "1.json", FRAME | {"max_mm": 9.0}, age_s=20.0)
    write(tmp_path, "2.json", FRAME | {"max_mm": 7.0}, age_s=10.0)
    (tmp_path / "3.json").write_text('{"verdict": "pa', encoding="utf-8")
    write(tmp_path, "4.json", {"settings": 1})
    found = newest_measurement(tmp_path)
    assert found is not None
    assert found.frame["max_mm"] == 7.0


def test_a_fresh_state_goes_before_a_file_from_the_future(tmp_path: Path) -> None:
    write(tmp_path, "aadm-state.json", READY, age_s=500.0)
    write(tmp_path, "old.json", FRAME, age_s=-9000.0)
    found = newest_measurement(tmp_path, NOON + 2.0)
    assert found is not None
    assert found.column == "C-1"
    gone_stale = newest_measurement(tmp_path, NOON + 99.0)
    assert gone_stale is not None
    assert gone_stale.file.name == "old.json"


def test_last_frame_of_a_report_is_shown(tmp_path: Path) -> None:
    report = {
        "schema": 1,
        "columns": [{"id": "C-1", "hoisting": []}, {"id": "C-2", "hoisting": [FRAME, FRAME | {"max_mm": 1.0}]}],
        "profile": {"rules": [{"limits": "sleeve_rebar_distance", "upper_mm": 4.0}]},
    }
    found = read_measurement(write(tmp_path, "report.json", report))
    assert found is not None
    assert (found.column, found.frame["max_mm"], found.limit_mm) == ("C-2", 1.0, 4.0)


def test_a_file_that_cannot_be_read_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ReportError, match=r"nowhere\.json"):
        read_measurement(tmp_path / "nowhere.json")


def test_the_limit_is_that_of_the_strictest_pair(tmp_path: Path) -> None:
    pairs = [{"sleeve": "S1", "limit_mm": 3.0}, {"sleeve": "S2", "limit_mm": 2.5}, {"sleeve": "S3"}]
    frame = FRAME | {"max_mm": 2.0, "pairs": pairs}
    found = read_measurement(write(tmp_path, "aadm-state.json", {"column": "C-1", "frame": frame}))
    assert found is not None
    assert guidance_of(found, "-y").margin_mm == pytest.approx(0.5)


def test_what_was_not_measured_shows_no_way_to_push(tmp_path: Path) -> None:
    frame = FRAME | {"verdict": "not_measured", "reasons": ["half of the column is out of the picture"]}
    found = read_measurement(write(tmp_path, "state.json", {"column": "C-1", "frame": frame}))
    assert found is not None
    guidance = guidance_of(found, "-y")
    assert (guidance.right_mm, guidance.ahead_mm, guidance.light) == (None, None, "hold")
    assert "out of the picture" in guidance.reason
