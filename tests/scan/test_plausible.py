"""Scans that cannot be what they are declared to be."""

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Scan
from aadm_workbench.scan.plausible import FEWEST_POINTS, check_plausible


def frame(extent_mm: float, count: int = 4000) -> Scan:
    points = np.random.default_rng(4).uniform(-0.5, 0.5, (count, 3)) * extent_mm * [1.0, 0.6, 0.1]
    points[:, 2] += 2.0 * extent_mm
    return Scan(points, source="foot.ply")


@pytest.mark.parametrize("extent_mm", [30.0, 480.0, 1500.0, 40_000.0])
def test_a_scan_about_as_large_as_its_pattern_passes(extent_mm: float) -> None:
    check_plausible(frame(extent_mm), 480.0)


def test_metres_declared_as_millimetres() -> None:
    with pytest.raises(ScanError, match=r'foot\.ply: its points span 1\.\d+ x .* mm, but .* 480 mm; .* units = "m"'):
        check_plausible(frame(1.5), 480.0)


def test_millimetres_declared_as_metres() -> None:
    with pytest.raises(ScanError, match='it looks like mm declared as metres: write units = "mm" in the job'):
        check_plausible(frame(1_500_000.0), 480.0)


def test_inches_are_named_where_they_fit_as_well() -> None:
    with pytest.raises(ScanError, match="metres or inches declared as mm"):
        check_plausible(frame(20.0), 480.0)


@pytest.mark.parametrize("extent_mm", [1e-5, 1e10])
def test_what_no_unit_explains(extent_mm: float) -> None:
    with pytest.raises(ScanError, match="no unit explains that"):
        check_plausible(frame(extent_mm), 480.0)


def test_a_few_points_far_away_do_not_hide_the_unit() -> None:
    scan = frame(1.5)
    scan.points[::200] = 900.0
    with pytest.raises(ScanError, match='units = "m"'):
        check_plausible(scan, 480.0)


def test_too_few_points_gaps_not_counted() -> None:
    check_plausible(frame(500.0, FEWEST_POINTS), 480.0)
    with pytest.raises(ScanError, match=f"has {FEWEST_POINTS - 1} points, {FEWEST_POINTS} are the least"):
        check_plausible(frame(500.0, FEWEST_POINTS - 1), 480.0)
    grid = np.full((40, 50, 3), np.nan)
    grid[0, :10] = 5.0
    with pytest.raises(ScanError, match="has 10 points"):
        check_plausible(Scan(grid), 480.0)


def test_nothing_is_rescaled() -> None:
    scan = frame(1500.0)
    before = scan.points.copy()
    check_plausible(scan, 480.0)
    np.testing.assert_array_equal(scan.points, before)


def test_a_file_and_a_job_that_differ_on_the_unit() -> None:
    """The file says metres, the job mm; which of them fits the pattern is taken, and said."""
    by_file = replace(frame(600.0), declared_scale=1e-3, viewpoint=np.ones(3))
    assert check_plausible(by_file, 480.0) is by_file
    by_job = replace(frame(600_000.0), declared_scale=1e-3, viewpoint=np.full(3, 5000.0), notes=("first",))
    taken = check_plausible(by_job, 480.0)
    np.testing.assert_allclose(taken.points, by_job.points / 1000.0)
    np.testing.assert_allclose(taken.viewpoint, np.full(3, 5.0))
    assert taken.notes[0] == "first"
    assert "the unit that the job declares was taken" in taken.notes[1]


def test_a_file_and_a_job_that_are_both_wrong_on_the_unit() -> None:
    with pytest.raises(ScanError, match="no unit explains that"):
        check_plausible(replace(frame(6e12), declared_scale=1e-3), 480.0)


@pytest.mark.parametrize("organised", [False, True])
def test_strays_are_left_out_counted_and_noted(organised: bool) -> None:
    scan = frame(480.0)
    points = scan.points.reshape(50, 80, 3).copy() if organised else scan.points.copy()
    points.reshape(-1, 3)[[5, 77]] = [[1e9, 0.0, 0.0], [0.0, 0.0, -49_000.0]]
    points.reshape(-1, 3)[100] = [47_000.0, 0.0, 900.0]
    checked = check_plausible(replace(scan, points=points, dropped=3), 480.0)
    assert checked.dropped == 5
    assert checked.points.shape == (points.shape if organised else (3998, 3))
    assert np.nanmax(checked.points) == 47_000.0
    assert checked.notes == ("2 points more than 48 m away from the others were left out",)
    assert np.nanmax(points) == 1e9, "the scan itself was changed"
