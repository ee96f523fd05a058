"""Connecting rebars: found and measured against the exact truth of the virtual camera."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.extract.missing import explain_missing
from aadm_workbench.extract.rebars import extract_rebars
from aadm_workbench.model import Scan
from aadm_workbench.twin.parts import BarGroup
from aadm_workbench.twin.scene import truth_of
from tests.scenes import SETTINGS, as_cloud, bar_scan, in_plane_errors, lab_bars, lab_scan


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


@pytest.mark.parametrize(("setting", "mean_mm", "largest_mm"), [("lab", 0.15, 0.35), ("field", 0.18, 0.45)])
def test_all_twelve_are_found_where_they_are(setting: str, mean_mm: float, largest_mm: float) -> None:
    truth = bar_scan(setting)
    found = extract_rebars(truth.scan(), SETTINGS[setting].bar_diameter, rng())
    errors = np.hypot(*in_plane_errors(found, truth).T)
    assert len(found.points) == 12
    assert errors.mean() < mean_mm
    assert errors.max() < largest_mm
    diameters = np.array([point.diameter_mm for point in found.points])
    assert np.abs(diameters.mean() - SETTINGS[setting].bar_core) < 0.5


def test_the_floor_gives_the_vertical_and_the_exposed_lengths() -> None:
    truth = bar_scan("field")
    found = extract_rebars(truth.scan(), 20.0, rng())
    assert found.vertical_from == "floor"
    true = truth.points_scan()
    for point, length in zip(found.points, found.exposed_length_mm, strict=True):
        nearest = int(np.linalg.norm(true - point.centre, axis=1).argmin())
        assert length == pytest.approx(truth.points[nearest].centre[2] + SETTINGS["field"].exposed, abs=0.5)


def test_without_a_floor_the_bars_are_still_found() -> None:
    truth = bar_scan("lab")
    points = truth.scan().points.copy()
    column = points @ truth.T_column_scan[:3, :3].T + truth.T_column_scan[:3, 3]
    points[column[..., 2] < -60.0] = np.nan
    found = extract_rebars(replace(truth.scan(), points=points), 18.0, rng())
    assert len(found.points) == 12
    assert found.vertical_from == "bar axes"
    assert np.hypot(*in_plane_errors(found, truth).T).mean() < 0.4


def test_a_shuffled_cloud_in_any_pose_gives_the_same_centres() -> None:
    truth = bar_scan("lab")
    cloud, rotation, shift = as_cloud(truth.scan(), 12, viewpoint=True)
    found = extract_rebars(cloud, 18.0, rng())
    assert len(found.points) == 12
    back = [replace(point, centre=rotation.T @ (point.centre - shift)) for point in found.points]
    assert np.hypot(*in_plane_errors(replace(found, points=tuple(back)), truth).T).mean() < 0.2


def test_a_missing_bar_is_not_invented() -> None:
    bars = lab_bars()
    without = lab_scan(BarGroup((*bars.bars[:3], *bars.bars[4:]), bars.floor))
    place = replace(without, points=truth_of(bars)).points_scan()[3:4]
    found = extract_rebars(without.scan(), 18.0, rng(), places=place)
    assert len(found.points) == 11
    assert "no bar stands there" in explain_missing(without.scan(), found, place, 18.0, rng())[0]


@pytest.mark.parametrize("shape", [(0, 3), (4, 3), (5000, 3)])
def test_what_holds_no_bar_gives_a_reason(shape: tuple[int, int]) -> None:
    found = extract_rebars(Scan(np.zeros(shape)), 18.0, rng())
    assert found.points == ()
    assert found.reason


@pytest.mark.parametrize("points", [120_000, 400_000])
def test_a_bare_plate_given_as_a_cloud_has_no_bars(points: int) -> None:
    rng = np.random.default_rng(2)
    plate = np.column_stack([rng.uniform(-300.0, 300.0, (points, 2)), rng.normal(800.0, 0.05, points)])
    found = extract_rebars(Scan(plate), 20.0, np.random.default_rng(0))
    assert found.points == ()
    assert "20 mm" in found.reason
