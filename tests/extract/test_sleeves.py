"""Sleeves: found, measured and refused, against the exact truth of the virtual camera."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aadm_workbench.extract.missing import explain_missing
from aadm_workbench.extract.sleeves import extract_sleeves
from aadm_workbench.model import Scan
from aadm_workbench.twin.parts import Foot
from tests.scenes import SETTINGS, as_cloud, in_plane_errors, lab_foot, lab_scan, sleeve_scan


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


@pytest.mark.parametrize(("setting", "mean_mm", "largest_mm"), [("lab", 0.12, 0.3), ("field", 0.2, 0.45)])
def test_all_twelve_are_found_where_they_are(setting: str, mean_mm: float, largest_mm: float) -> None:
    truth = sleeve_scan(setting)
    found = extract_sleeves(truth.scan(), SETTINGS[setting].sleeve_diameter, rng())
    errors = np.hypot(*in_plane_errors(found, truth).T)
    assert len(found.points) == 12
    assert errors.mean() < mean_mm
    assert errors.max() < largest_mm
    diameters = np.array([point.diameter_mm for point in found.points])
    assert np.abs(diameters.mean() - SETTINGS[setting].sleeve_diameter) < 0.5


def test_uncertainty_covers_the_error() -> None:
    truth = sleeve_scan("field")
    found = extract_sleeves(truth.scan(), 36.0, rng())
    for point in found.points:
        error = point.centre - truth.points_scan()[np.linalg.norm(truth.points_scan() - point.centre, axis=1).argmin()]
        assert point.covariance is not None
        assert np.all(np.linalg.eigvalsh(point.covariance) > 0)
        across = error - found.vertical * (error @ found.vertical)
        assert np.linalg.norm(across) < 6 * np.sqrt(np.trace(point.covariance) / 3)


def test_vertical_points_into_the_column() -> None:
    truth = sleeve_scan("lab")
    found = extract_sleeves(truth.scan(), 26.0, rng())
    up = truth.T_column_scan[:3, :3].T @ np.array([0.0, 0.0, 1.0])
    assert found.vertical @ up > np.cos(np.radians(0.1))


@pytest.mark.parametrize("viewpoint", [True, False])
def test_a_shuffled_cloud_in_any_pose_gives_the_same_centres(viewpoint: bool) -> None:
    truth = sleeve_scan("lab")
    cloud, rotation, shift = as_cloud(truth.scan(), 11, viewpoint=viewpoint)
    found = extract_sleeves(cloud, 26.0, rng())
    assert len(found.points) == 12
    back = [replace(point, centre=rotation.T @ (point.centre - shift)) for point in found.points]
    errors = np.hypot(*in_plane_errors(replace(found, points=tuple(back)), truth).T)
    assert errors.mean() < 0.15
    up = truth.T_column_scan[:3, :3].T @ np.array([0.0, 0.0, 1.0])
    assert (rotation.T @ found.vertical) @ up > 0.999


def test_a_sleeve_far_off_its_place_is_reported_there() -> None:
    foot = lab_foot()
    moved = replace(foot.sleeves[4], x=foot.sleeves[4].x - 12.0, y=foot.sleeves[4].y + 9.0)
    truth = lab_scan(Foot(foot.size, (*foot.sleeves[:4], moved, *foot.sleeves[5:])))
    found = extract_sleeves(truth.scan(), 26.0, rng())
    assert len(found.points) == 12
    assert np.hypot(*in_plane_errors(found, truth)[4]) < 0.3


def test_a_plugged_sleeve_is_not_invented() -> None:
    foot = lab_foot()
    plugged = replace(foot.sleeves[6], plugged_at=0.0)
    truth = lab_scan(Foot(foot.size, (*foot.sleeves[:6], plugged, *foot.sleeves[7:])))
    place = truth.points_scan()[6:7]
    found = extract_sleeves(truth.scan(), 26.0, rng(), places=place)
    assert len(found.points) == 11
    assert min(np.linalg.norm(point.centre - place[0]) for point in found.points) > 30.0
    assert explain_missing(truth.scan(), found, place, 26.0, rng()) == ("no opening: the mouth is plugged or covered",)


def test_a_place_outside_the_foot_is_said_to_be_out_of_view() -> None:
    truth = sleeve_scan("lab")
    found = extract_sleeves(truth.scan(), 26.0, rng())
    beyond = truth.points_scan()[:1] + 400.0 * (truth.points_scan()[:1] - truth.points_scan().mean(axis=0)) / 127.0
    assert "outside" in explain_missing(truth.scan(), found, beyond, 26.0, rng())[0]


@pytest.mark.parametrize("shape", [(0, 3), (3, 3), (5000, 3), (40, 50, 3)])
def test_what_holds_no_foot_gives_a_reason(shape: tuple[int, ...]) -> None:
    empty = Scan(np.full(shape, np.nan, np.float32) if len(shape) == 3 else np.zeros(shape))
    found = extract_sleeves(empty, 26.0, rng())
    assert found.points == ()
    assert found.reason


def test_a_wall_of_random_points_gives_no_sleeve() -> None:
    noise = np.random.default_rng(1).uniform(-300.0, 300.0, (50_000, 3))
    assert extract_sleeves(Scan(noise), 26.0, rng()).points == ()


def test_the_wrong_diameter_finds_nothing() -> None:
    assert extract_sleeves(sleeve_scan("lab").scan(), 40.0, rng()).points == ()


def test_twice_the_same_scan_gives_the_same_numbers() -> None:
    scan = sleeve_scan("lab").scan()
    first, second = extract_sleeves(scan, 26.0, rng()), extract_sleeves(scan, 26.0, rng())
    assert all(np.array_equal(a.centre, b.centre) for a, b in zip(first.points, second.points, strict=True))
