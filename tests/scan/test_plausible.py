"""Scans that cannot be what they are declared to be."""

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
