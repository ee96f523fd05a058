"""Storey upon storey: closed forms, and a crowd of towers built of exact motions."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.model import StackSettings, Verdict
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import MeasuredColumn, measured_floor
from aadm_workbench.stack.result import StackedColumn
from aadm_workbench.stack.tower import Tower
from tests.report.typed import typed
from tests.stack.standing import Standing, near, report_of, shifted

LIMITS = Limits(load_profile("cn-gbt51231-2016"), "guarded")
HEIGHT_MM = 3600.0
SETTINGS = StackSettings(plumb_u_mm=1.5, fit_u_mm=0.8, bars_u_mm=0.6, level_u_mm=1.0, height_mm=HEIGHT_MM)


@pytest.fixture(scope="module")
def ground_floor() -> MeasuredColumn:
    return measured_floor(typed(report_of(Standing("C-1", u_mm=1e-6, control_u_mm=1e-3)))).columns[0]


def storeys(first: MeasuredColumn, number: int, turned_deg: float = 0.0) -> list[MeasuredColumn]:
    """A tower of one column drawn again and again, of which the lowest alone is tied to the grid."""
    found = []
    for level in range(number):
        T = np.eye(4)
        T[:3, :3] = Rotation.from_euler("z", turned_deg * level, degrees=True).as_matrix()
        T[2, 3] = HEIGHT_MM * level
        ground = first.ground if level == 0 else None
        found.append(replace(first, id=f"C-{level + 1}", T_model_column=T, ground=ground))
    return found


def stacked(columns: list[MeasuredColumn], settings: StackSettings = SETTINGS) -> tuple[StackedColumn, ...]:
    return Tower(settings, LIMITS, {}).stacked(columns)


@pytest.mark.parametrize("turned_deg", [0.0, 90.0])
@pytest.mark.parametrize("number", [1, 2, 5, 10])
def test_braced_towers_wander(ground_floor: MeasuredColumn, number: int, turned_deg: float) -> None:
    """σ² = n·(fit² + plumb²) + (n − 1)·bars², for each storey sets out from where the last one ended."""
    top = stacked(storeys(ground_floor, number, turned_deg))[-1].top
    assert top is not None
    assert top.u_mm**2 == pytest.approx(number * (0.8**2 + 1.5**2) + (number - 1) * 0.6**2, rel=1e-4)


@pytest.mark.parametrize("number", [1, 3, 10])
def test_towers_without_braces_lean_as_one(ground_floor: MeasuredColumn, number: int) -> None:
    """σ² = plumb²·Σ m² + n·fit² + (n − 1)·bars²: what the lowest leans counts at every storey above."""
    top = stacked(storeys(ground_floor, number), replace(SETTINGS, braced=False))[-1].top
    squares = number * (number + 1) * (2 * number + 1) / 6
    assert top is not None
    assert top.u_mm**2 == pytest.approx(1.5**2 * squares + number * 0.8**2 + (number - 1) * 0.6**2, rel=1e-4)


@pytest.mark.parametrize("braced", [True, False])
def test_a_crowd_of_towers_scatters_as_it_is_told(ground_floor: MeasuredColumn, braced: bool) -> None:
    """Rigid motions of SE(3), composed storey by storey; the top of the sixth, its height and its turn."""
    number, crowd, rng = 6, 4000, np.random.default_rng(8)
    radius_mm = ground_floor.radius_mm
    assert radius_mm is not None
    turns, places = Rotation.identity(crowd), np.zeros((crowd, 3))
    for level in range(number):
        if level and braced:
            # Plumbed: what is left of the turn is the one about the vertical.
            turns = Rotation.from_rotvec(np.outer(turns.as_euler("zyx")[:, 0], [0.0, 0.0, 1.0]))
        drawn = rng.normal(size=(crowd, 9)) * [0.8, 0.8, 1.0, *(1.5 / HEIGHT_MM,) * 2, 0.8 / radius_mm, 0.6, 0.6, 0.0]
        bars = drawn[:, 6:9] * (level > 0)
        places = places + turns.apply(drawn[:, :3] + bars)
        yaw = drawn[:, 5] + (level > 0) * rng.normal(size=crowd) * 0.6 / radius_mm
        turns = turns * Rotation.from_rotvec(np.column_stack([drawn[:, 3], drawn[:, 4], yaw]))
        places = places + turns.apply([0.0, 0.0, HEIGHT_MM])
    last = stacked(storeys(ground_floor, number), replace(SETTINGS, braced=braced))[-1]
    assert last.top is not None
    assert last.placed is not None
    scatter = np.sqrt(np.mean((places - [0.0, 0.0, number * HEIGHT_MM]) ** 2, axis=0))
    assert near(scatter[:2], [last.top.u_mm] * 2, 0.06 * last.top.u_mm)
    assert scatter[2] == pytest.approx(np.sqrt(last.placed.covariance[2, 2]), rel=0.06)
    yaw = turns.as_euler("zyx")[:, 0]
    assert np.std(yaw) == pytest.approx(np.sqrt(last.placed.covariance[5, 5]), rel=0.06)


def test_control_points_begin_anew(ground_floor: MeasuredColumn) -> None:
    columns = storeys(ground_floor, 3)
    columns[2] = replace(columns[2], ground=ground_floor.ground)
    found = stacked(columns)
    assert [one.basis for one in found] == ["control_points", "storey_below", "control_points"]
    assert [one.below for one in found] == [None, "C-1", None]
    assert found[2].top is not None
    assert found[0].top is not None
    assert found[2].top.u_mm == pytest.approx(found[0].top.u_mm)


def test_where_it_stands_is_ground_and_trial_together() -> None:
    """Bars 4 mm off and turned by 0.1°; sleeves that make the column stand 0.7, −0.4 mm beside its bars."""
    report = report_of(Standing("C-1", (7000.0, 0.0, 0.0), 90.0, (4.0, 1.0, 0.1), sleeves=shifted(0.7, -0.4, 0.05)))
    (column,) = stacked(list(measured_floor(typed(report)).columns))
    # The check shows sleeves by their own fit: that the group sits off in its column, no scan of a foot tells.
    assert column.placed is not None
    assert near(column.placed.values[:3], [4.0, 1.0, 0.0], 0.01)
    assert column.placed.values[5] == pytest.approx(np.radians(0.1), abs=1e-5)


def test_one_bar_that_is_off_takes_the_column_along() -> None:
    """By hand: one bar 3 mm off in x of twelve; least squares goes 0.25 mm with it, the trial's pose further."""
    report = report_of(Standing("C-1", off={"R1": (3.0, 0.0)}, control_u_mm=1e-3, u_mm=1e-3))
    (column,) = stacked(list(measured_floor(typed(report)).columns))
    assert column.placed is not None
    assert 0.3 < column.placed.values[0] < 2.0
    assert abs(column.placed.values[1]) < 0.6


@pytest.mark.parametrize("turn_deg", [90.0, 180.0, -90.0])
def test_a_column_set_turned_by_its_symmetry(ground_floor: MeasuredColumn, turn_deg: float) -> None:
    """Its displacement is the small rest, and the play is told in the frame of its design."""
    turn = Rotation.from_euler("z", turn_deg, degrees=True).as_matrix()
    T = np.eye(4)
    T[:3, :3] = turn
    T[:2, 3] = (0.5, -0.25)
    assert ground_floor.ground is not None
    ground = replace(ground_floor.ground, planar=np.array([1.5, 1.0, 0.0]))
    (column,) = stacked([replace(ground_floor, T_bars_sleeves=T, turn_deg=abs(turn_deg), ground=ground)])
    assert column.placed is not None
    assert near(column.placed.values, [2.0, 0.75, 0.0, 0.0, 0.0, 0.0], 1e-6)
    assert column.advice is not None
    assert near(column.advice.from_trial, [-2.0, -0.75, 0.0], 1e-6)
    assert near(column.advice.set_pose, [-1.5, -1.0, 0.0], 1e-6)


def test_without_control_points_nothing_is_said_of_the_grid() -> None:
    report = report_of(Standing("C-1", ground=(6.0, 0.0, 0.0), control_u_mm=None))
    (column,) = stacked(list(measured_floor(typed(report)).columns))
    assert column.basis == "bars"
    assert column.top is not None
    assert column.top.judged.verdict is Verdict.NOT_MEASURED
    assert column.top.judged.limit is None
    assert column.advice is None
    assert near(column.top.offset_mm, [0.0, 0.0], 0.01)
    assert any("own bars alone" in reason.en for reason in column.reasons)


def test_a_column_that_does_not_go_on_stands_nowhere() -> None:
    apart = {"R1": (-3.6, -3.0), "R7": (3.6, 3.0)}
    columns = list(
        measured_floor(typed(report_of(Standing("C-1", off=apart), Standing("C-2", off={"S7": None})))).columns
    )
    fails, unseen = stacked(columns)
    assert fails.measured.goes_on is Verdict.FAIL
    assert unseen.measured.goes_on is Verdict.NOT_MEASURED
    assert fails.placed is unseen.placed is None
    assert "does not go on" in fails.reasons[0].en
    assert "not measured" in unseen.reasons[0].en


def test_without_a_height_the_foot_alone_is_told() -> None:
    columns = list(measured_floor(typed(report_of(Standing("C-1")))).columns)
    (column,) = stacked(columns, replace(SETTINGS, height_mm=None))
    assert column.placed is not None
    assert column.top is None
    assert any("height" in reason.en for reason in column.reasons)


@pytest.mark.parametrize(("height_mm", "plumb_mm"), [(3600.0, 2.5), (6000.0, 2.5), (6001.0, 5.0), (9000.0, 5.0)])
def test_what_nobody_says_of_plumb_is_half_of_the_limit_of_that_height(
    ground_floor: MeasuredColumn, height_mm: float, plumb_mm: float
) -> None:
    """5 mm up to 6 m, 10 mm above; what a job says holds for every height."""
    known = StackSettings(fit_u_mm=0.8, height_mm=height_mm)
    for settings, expected in ((known, plumb_mm), (replace(known, plumb_u_mm=1.25), 1.25)):
        (column,) = stacked([ground_floor], settings)
        assert column.top is not None
        assert column.top.u_mm**2 == pytest.approx(expected**2 + 0.8**2, rel=1e-4)


def test_another_storey_is_no_storey_of_this_tower(ground_floor: MeasuredColumn) -> None:
    first, second = storeys(ground_floor, 2)
    assert second.T_model_column is not None
    beside = second.T_model_column.copy()
    beside[0, 3] = 2000.0
    found = stacked([first, replace(second, T_model_column=beside)])
    assert found[1].basis == "bars"
    assert found[1].below is None
