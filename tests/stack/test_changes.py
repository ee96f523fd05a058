"""Columns that come to stand elsewhere between two checks: by hand, and none where nothing moved."""

import numpy as np
import pytest

from aadm_workbench.stack.changes import set_changes
from aadm_workbench.stack.measured import MeasuredFloor, measured_floor
from tests.report.typed import typed
from tests.stack.standing import Standing, report_of


def floor(**how: object) -> MeasuredFloor:
    return measured_floor(typed(report_of(Standing("C-1", **how))))  # type: ignore[arg-type]


def test_bars_that_moved_as_a_group_take_the_column_along() -> None:
    """No single bar moved against its group: only the control points tell."""
    (change,) = set_changes(floor(ground=(1.0, 0.0, 0.0)), floor(ground=(4.0, -4.0, 0.0)))
    assert change.moved_mm == pytest.approx(5.0, abs=0.05)
    assert change.u_mm == pytest.approx(np.sqrt(2.0) * 0.3 / 2.0, abs=0.05)
    assert change.from_pose is not None
    assert change.from_pose[:2] == pytest.approx((1.0, 0.0), abs=0.05)


def test_what_the_scans_explain_is_no_change() -> None:
    assert set_changes(floor(), floor(ground=(0.3, 0.1, 0.0))) == ()


def test_known_and_not_known() -> None:
    apart = {"R1": (-3.6, -3.0), "R7": (3.6, 3.0)}
    (change,) = set_changes(floor(), floor(off=apart))
    assert change.to_pose is None
    assert change.moved_mm is None
    assert set_changes(floor(off=apart), floor(off=apart)) == ()


def test_against_the_grid_and_against_bars_are_not_compared() -> None:
    (change,) = set_changes(floor(ground=(5.0, 0.0, 0.0)), floor(ground=(5.0, 0.0, 0.0), control_u_mm=None))
    assert change.moved_mm is None
