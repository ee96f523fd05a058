"""Columns that swing on a crane, set by their corrections; and the pendulum that they hang on."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from aadm_workbench.twin.pendulum import HangingColumn
from aadm_workbench.twin.study.loops import drawn_column
from batch.main import main
from batch.study_loops import act_on_frame


def test_a_pendulum_follows_its_equation_of_motion() -> None:
    periods_s, damping, crane = np.array([4.0, 4.0, 3.0]), np.array([0.2, 0.2, 0.3]), np.array([6.0, -2.0, 0.01])
    pace = 2.0 * np.pi / periods_s

    def slope(time_s: float, state: np.ndarray) -> np.ndarray:
        rest = np.minimum(time_s, 3.0) * crane
        return np.concatenate([state[3:], -2.0 * damping * pace * state[3:] - pace**2 * (state[:3] - rest)])

    begin = np.array([5.0, -1.0, 0.02, 3.0, 4.0, -0.01])
    stepped = solve_ivp(slope, (0.0, 7.0), begin, rtol=1e-9, atol=1e-9, max_step=0.02).y[:3, -1]
    column = HangingColumn(begin[:3], begin[3:], np.zeros(3), periods_s, damping)
    column.advance(3.0, crane)
    assert column.places(np.array([4.0]))[0] == pytest.approx(stepped, abs=1e-3)
    column.advance(4.0)
    assert column.place == pytest.approx(stepped, abs=1e-3)


@pytest.mark.parametrize("machine", [[], ["--arm"]])
def test_columns_end_ready_and_stay_within_their_limit(machine: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["study", "loop", "--loops", "8", "--seed", "40", "--json", *machine]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["loops"] == 8
    assert found["ready"] >= 7
    assert found["beyond_after_ready"] == 0
    assert all(3 <= end["frames"] <= 8 for end in found["ends"])
    assert all(end["beyond_mm"] < 3.0 for end in found["ends"] if end["ready"])


def test_a_free_swing_is_never_lowered_however_well_its_middle_fits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nine millimetres to either side of the best place: frames pass on the way, and none is to be acted upon."""
    for seed in range(4):
        column, looks = drawn_column(seed), ()
        monkeypatch.setattr(column, "move", lambda *_: None)
        pace = 2.0 * np.pi / column.hanging.periods_s
        speed = np.array([9.0, 0.0, 0.0]) * pace
        column.hanging = HangingColumn(np.zeros(3), speed, np.zeros(3), column.hanging.periods_s, np.zeros(3))
        for number in range(1, 16):
            looks = act_on_frame(column, looks, number)
            assert not column.landed
