"""What a link may show of a state, and what it may not."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aadm_workbench.report.hoisting_fitness import seconds_of
from batch.link.snapshot import Quality, read_snapshot, snapshot_of
from tests.report.test_hoisting_fitness import AGAINST, GOOD, NOON, state

from .links import write_state

SAID = {"schema": 2, "column": "C-301", "sequence": 7}


def test_a_good_state_shows_its_numbers() -> None:
    shown = snapshot_of({**SAID, **GOOD}, NOON + 3.0)
    assert (shown.ready, shown.quality, shown.sequence, shown.column) == (True, Quality.GOOD, 7, "C-301")
    move = GOOD.get("move") or GOOD["frame"]["correction"]
    assert (shown.dx_mm, shown.dy_mm, shown.yaw_deg) == (move["dx_mm"], move["dy_mm"], move["yaw_deg"])
    assert shown.captured_s == seconds_of(GOOD["captured"])


@pytest.mark.parametrize(("changes", "reason", "shows_move"), AGAINST)
def test_what_may_not_be_acted_upon_has_no_numbers(changes: dict[str, Any], reason: str, shows_move: bool) -> None:
    shown = snapshot_of({**SAID, **state(**changes)}, NOON + 3.0)
    assert not shown.ready
    assert reason in shown.reason
    numbers = [shown.dx_mm, shown.dy_mm, shown.yaw_deg, shown.left_mm, shown.u_mm]
    if not shows_move:
        assert numbers == [None] * 5
        assert shown.quality in (Quality.NO_DATA, Quality.TIMEOUT)
    else:
        assert None not in numbers[:3]


@pytest.mark.parametrize(
    ("changes", "after_s", "quality"),
    [
        ({}, 15.5, Quality.TIMEOUT),
        ({}, 14.5, Quality.GOOD),
        ({}, -30.0, Quality.NO_DATA),
        ({"captured": None}, 1.0, Quality.NO_DATA),
        ({"frame__verdict": "inconclusive"}, 1.0, Quality.UNCERTAIN),
        ({"frame__verdict": "not_assessed"}, 1.0, Quality.UNCERTAIN),
        ({"frame__verdict": "error"}, 1.0, Quality.NO_DATA),
        ({"frame__verdict": "inconclusive"}, 60.0, Quality.TIMEOUT),
    ],
)
def test_quality(changes: dict[str, Any], after_s: float, quality: Quality) -> None:
    assert snapshot_of({**SAID, **state(**changes)}, NOON + after_s).quality is quality


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (None, "is not there"),
        (b"", "cannot be read"),
        (b'{"schema": 2, "rea', "cannot be read"),
        (b"[1, 2]", "is no state"),
        (b"{}", "schema None"),
        (b'{"schema": 1, "ready": true}', "schema 1"),
        (b'{"schema": 2, "ready": true}', "not known"),
        (b"[" * 100_000, "cannot be read"),
        (b" " * (2**22 + 1), "too large"),
    ],
)
def test_a_file_that_is_no_state_shows_nothing(tmp_path: Path, content: bytes | None, reason: str) -> None:
    path = tmp_path / "aadm-state.json"
    if content is not None:
        path.write_bytes(content)
    shown = read_snapshot(path, NOON)
    assert (shown.ready, shown.quality, shown.dx_mm) == (False, Quality.NO_DATA, None)
    assert reason in shown.reason


def test_a_state_that_was_written_is_read(tmp_path: Path) -> None:
    write_state(tmp_path / "s.json", NOON)
    assert read_snapshot(tmp_path / "s.json", NOON + 1.0).ready
