"""The play: as far to the grid as limits let it, never a hair further; against a search that knows no convexity."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.assembly.pose.play import nearest_to, play_limits, within
from aadm_workbench.assembly.tolerances import load_profile
from aadm_workbench.assembly.trial.aim import with_aim
from aadm_workbench.model import StackSettings
from aadm_workbench.stack.limits import Limits
from aadm_workbench.stack.measured import MeasuredColumn, measured_floor
from aadm_workbench.stack.tower import Tower
from tests.report.checked_floor import CENTRES
from tests.report.typed import typed
from tests.stack.standing import Standing, report_of

TOWER = Tower(StackSettings(height_mm=3000.0), Limits(load_profile("cn-gbt51231-2016"), "guarded"), {})
LEVER_MM = 285.0


@pytest.fixture(scope="module", params=[1, 2, 3])
def column(request: pytest.FixtureRequest) -> MeasuredColumn:
    """A column whose sleeves and bars are all a little off, and two of its bars a lot."""
    rng = np.random.default_rng(request.param)
    standing = Standing(
        "C-1",
        ground=(5.0, -2.0, 0.2),
        sleeves=rng.normal(0.0, 0.3, (12, 2)),
        bars=rng.normal(0.0, 0.4, (12, 2)),
        off={"R2": (1.2, 0.5)},
        u_mm=0.05,
    )
    return measured_floor(typed(report_of(standing))).columns[0]


def distances(column: MeasuredColumn, planar: np.ndarray) -> np.ndarray:
    """Of bars from sleeves after the column was displaced, by matrices of scipy."""
    places = np.array([pair.place for pair in column.pairs])
    bars = places + np.array([pair.offset for pair in column.pairs])
    turned = Rotation.from_euler("z", planar[2]).apply(np.column_stack([places, np.zeros(len(places))]))[:, :2]
    return np.linalg.norm(bars - turned - planar[:2], axis=1)


@pytest.mark.parametrize("wanted", [(-5.0, 2.0, -0.003), (0.4, 0.1, 0.0), (0.0, 9.0, 0.0), (0.0, 0.0, 0.05)])
def test_the_nearest_permitted_pose(column: MeasuredColumn, wanted: tuple[float, float, float]) -> None:
    limits = play_limits(column.gaps)
    assert limits is not None
    aim, scale = np.array(wanted), np.array([1.0, 1.0, LEVER_MM])
    found = nearest_to(limits, aim, LEVER_MM)
    assert distances(column, found).max() <= 3.0
    assert limits.keeps(found)
    # No step of a crowd about it, nor of one about everything, is permitted and nearer.
    rng, best = np.random.default_rng(1), np.linalg.norm((found - aim) * scale)
    for width in (0.01, 0.1, 1.0, 3.0):
        tried = found + rng.normal(size=(400, 3)) * width / scale
        nearer = tried[np.linalg.norm((tried - aim) * scale, axis=1) < best - 0.01]
        assert not any(limits.keeps(one) for one in nearer)


def test_the_play_is_smaller_by_what_is_not_known(column: MeasuredColumn) -> None:
    """Twelve gaps that together may fail in 5 %: each keeps 2.64 standard uncertainties away from its limit."""
    limits = play_limits(column.gaps)
    assert limits is not None
    gap = column.pairs[0].gaps[0]
    sigmas = (gap.radius_mm - limits.radii[0]) / gap.u_mm
    assert 2.3 < sigmas < 3.3


def test_a_gap_beyond_its_smaller_radius_does_not_grow() -> None:
    standing = Standing("C-1", off={"R1": (1.94, 0.0), "R7": (-1.94, 0.0)}, u_mm=0.1)
    column = measured_floor(typed(report_of(standing))).columns[0]
    tight = replace(
        column, pairs=tuple(replace(p, gaps=tuple(replace(g, u_mm=0.5) for g in p.gaps)) for p in column.pairs)
    )
    limits = play_limits(tight.gaps)
    assert limits is not None
    before = distances(tight, np.zeros(3))
    after = distances(tight, nearest_to(limits, np.array([0.0, 5.0, 0.0]), LEVER_MM))
    beyond = before > limits.radii[: len(before)].min() + 1e-6
    assert after.max() <= 3.0
    assert np.all(after[beyond] <= before[beyond] + 1e-6)


def test_a_trial_that_breaks_a_limit_has_no_play() -> None:
    column = measured_floor(typed(report_of(Standing("C-1", off={"R1": (-3.6, -3.0), "R7": (3.6, 3.0)})))).columns[0]
    assert play_limits(column.gaps) is None


def test_what_was_asked_for_is_cut_at_the_limit(column: MeasuredColumn) -> None:
    limits = play_limits(column.gaps)
    assert limits is not None
    asked = np.array([8.0, 3.0, 0.001])
    kept = within(limits, asked)
    assert kept == pytest.approx(asked * kept[0] / asked[0])
    assert limits.keeps(kept)
    assert not limits.keeps(1.001 * kept)
    assert np.array_equal(within(limits, 0.01 * asked), 0.01 * asked)


def test_the_tower_is_led_back_to_the_grid(column: MeasuredColumn) -> None:
    (stacked,) = TOWER.stacked([column])
    assert stacked.top is not None
    assert stacked.advice is not None
    assert stacked.advice.top is not None
    before, after = (np.hypot(*top.offset_mm) for top in (stacked.top, stacked.advice.top))
    assert after < before - 1.0
    moved = np.array([*stacked.advice.from_trial[:2], np.radians(stacked.advice.from_trial[2])])
    assert distances(column, moved).max() <= 3.0


def test_small_bars_have_room_over_the_ribs_alone() -> None:
    """A bar of 22 mm over its ribs has 7 mm of room in 36 mm; with 33 mm it has 1.5, and the play is that."""
    column = measured_floor(typed(report_of(Standing("C-1", ground=(6.0, 0.0, 0.0), u_mm=0.01)))).columns[0]
    pairs = []
    for pair in column.pairs:
        narrow = replace(pair.gaps[0], radius_mm=1.5, vector=pair.offset)
        pairs.append(replace(pair, gaps=(pair.gaps[0], narrow)))
    (stacked,) = TOWER.stacked([replace(column, pairs=tuple(pairs))])
    assert stacked.advice is not None
    assert -1.5 <= stacked.advice.from_trial[0] < -1.35


def test_what_is_done_is_not_advised_again() -> None:
    """The pose as the page prints it, put into the job: two decimals of it may lie a hair beyond where a limit cuts."""
    report = typed(report_of(Standing("C-1", ground=(5.0, -2.0, 0.2), off={"R2": (1.2, 0.5)})))
    (before,) = TOWER.stacked(measured_floor(report).columns)
    assert before.advice is not None
    dx, dy, yaw_deg = before.advice.set_pose
    for asked, cut in (((round(dx, 2), round(dy, 2), round(yaw_deg, 3)), False), ((2.0 * dx, 2.0 * dy, yaw_deg), True)):
        told = replace(report, columns=(with_aim(report.columns[0], asked),))
        (after,) = TOWER.stacked(measured_floor(told).columns)
        said = " ".join(reason.en for reason in after.reasons)
        assert after.origin == "told"
        assert ("breaks a limit" in said) is cut
        if not cut:
            assert after.advice is None
            assert "leads there already" in said
            assert after.top is not None
            assert before.advice.top is not None
            assert after.top.offset_mm == pytest.approx(before.advice.top.offset_mm, abs=0.02)


def test_nothing_to_gain_is_said(column: MeasuredColumn) -> None:
    assert column.ground is not None
    assert column.T_bars_sleeves is not None
    T = column.T_bars_sleeves
    back = np.linalg.inv(T)
    planar = np.array([back[0, 3], back[1, 3], np.arctan2(back[1, 0], back[0, 0])])
    (stacked,) = TOWER.stacked([replace(column, ground=replace(column.ground, planar=planar))])
    assert stacked.advice is None
    assert "set it as the trial has it" in stacked.reasons[-1].en


def test_the_ring_of_the_tests_is_the_ring_of_the_check() -> None:
    assert np.sqrt((CENTRES**2).sum(axis=1).mean()) == pytest.approx(LEVER_MM, abs=0.5)
