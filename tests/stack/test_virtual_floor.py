"""Columns placed with known errors, measured with noise: where they come to stand is predicted within its regions.

The truth is made with other formulas: Kabsch by scipy, exact rotations, and the errors that were drawn.
"""

from collections.abc import Iterator

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.model import StackSettings
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import measured_floor
from aadm_workbench.stack.result import StackedColumn
from aadm_workbench.stack.tower import Tower
from tests.report.typed import typed
from tests.stack.standing import Standing, report_of

SETTINGS = StackSettings(plumb_u_mm=0.6, fit_u_mm=0.4, bars_u_mm=0.4, level_u_mm=1.0, height_mm=3600.0)
TOWER = Tower(SETTINGS, Limits(load_profile("cn-gbt51231-2016"), "guarded"), {})
NUMBER = 16  # benchmarks/towers.py has hundreds
POINT_MM, CONTROL_MM, BUILT_MM = 0.08, 0.4, 0.3


def column(number: int, rng: np.random.Generator) -> Standing:
    return Standing(
        f"C-{number}",
        ground=(*rng.normal(0.0, 3.0, 2), rng.normal(0.0, 0.08)),
        sleeves=rng.normal(0.0, BUILT_MM, (12, 2)),
        bars=rng.normal(0.0, BUILT_MM, (12, 2)),
        noise=np.vstack([rng.normal(0.0, POINT_MM, (24, 2)), rng.normal(0.0, CONTROL_MM, (4, 2))]),
        u_mm=POINT_MM,
        control_u_mm=CONTROL_MM,
    )


def let_down(standing: Standing, found: StackedColumn, rng: np.random.Generator) -> tuple[np.ndarray, float]:
    """The top (2,) mm and the turn (radians) of a column that was set by the pairs of its trial, not quite there."""
    pairs = {pair.sleeve: pair for pair in found.measured.pairs}
    design = [(p["label"], p["design_mm"]) for p in REPORT[standing.name]["sleeves"]["points"]]
    order = [int(np.argmin(np.hypot(*(standing.true_sleeves() - xy[:2]).T))) for _, xy in design]
    sleeves = standing.true_sleeves()[order]
    bars = standing.true_bars()[order]
    told = np.array([pairs[label].offset for label, _ in design])
    goal = bars - told
    flat = [np.column_stack([xy, np.zeros(12)]) for xy in (goal - goal.mean(axis=0), sleeves - sleeves.mean(axis=0))]
    turn, _ = Rotation.align_vectors(*flat)
    shift = goal.mean(axis=0) - turn.apply([*sleeves.mean(axis=0), 0.0])[:2]
    yaw = rng.normal(0.0, SETTINGS.fit_u_mm / (found.measured.radius_mm or 1.0))
    lean = rng.normal(0.0, SETTINGS.plumb_at(3600.0), 2)
    body = turn * Rotation.from_euler("z", yaw)
    top = body.apply([0.0, 0.0, SETTINGS.height_mm or 0.0])[:2] + shift + rng.normal(0.0, SETTINGS.fit_u_mm, 2) + lean
    return top, float(body.as_rotvec()[2])


REPORT: dict[str, dict] = {}


@pytest.fixture(scope="module")
def misses() -> Iterator[np.ndarray]:
    """Squared distances (n, 2), in units of their covariance, of tops and of turns."""
    rng = np.random.default_rng(27)
    standing = [column(number, rng) for number in range(NUMBER)]
    report = report_of(*standing)
    REPORT.update({one["id"]: one for one in report["columns"]})
    found = TOWER.stacked(list(measured_floor(typed(report)).columns))
    rows = []
    for one, stacked in zip(standing, found, strict=True):
        assert stacked.placed is not None
        top, turn = let_down(one, stacked, rng)
        offset, covariance = stacked.placed.at(np.array([0.0, 0.0, SETTINGS.height_mm]))
        miss = top - offset[:2]
        rows.append(
            (
                miss @ np.linalg.inv(covariance[:2, :2]) @ miss,
                (turn - stacked.placed.values[5]) ** 2 / stacked.placed.covariance[5, 5],
            )
        )
    yield np.array(rows)
    REPORT.clear()


def test_tops_lie_in_their_regions(misses: np.ndarray) -> None:
    assert np.mean(misses[:, 0] <= chi2.ppf(0.95, 2)) >= 0.85
    assert 0.2 <= np.mean(misses[:, 0] <= chi2.ppf(0.5, 2)) <= 0.8
    assert 0.5 <= misses[:, 0].mean() / 2.0 <= 1.5


def test_turns_lie_in_their_intervals(misses: np.ndarray) -> None:
    assert 0.85 <= np.mean(misses[:, 1] <= chi2.ppf(0.95, 1)) <= 1.0
    assert misses[:, 1].mean() <= 1.6
