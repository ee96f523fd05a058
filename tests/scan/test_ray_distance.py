"""Distances along the rays that were saved as depths: noticed on every face, and on nothing that is sound or curved."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, Camera, FloatArray, Scan
from aadm_workbench.scan.plausible import check_plausible
from aadm_workbench.scan.read import read_scan
from tests.scenes import bar_scan, sleeve_scan

LENS = Camera(2400.0, 2400.0, 960.0, 600.0, 1920, 1200)
FRINGE = Path(__file__).resolve().parents[1] / "fringe_scans"
EXTENT_MM = 300.0


def with_distances(points: FloatArray) -> FloatArray:
    """What is computed from a picture of distances that is taken for one of depths: each ray with its length for z."""
    distance = np.sqrt((points.astype(np.float64) ** 2).sum(axis=-1))
    ray = points / points[..., 2:]
    return (ray * distance[..., None]).astype(points.dtype)


def sound_scans() -> dict[str, FloatArray]:
    scans = {
        f"{name} {setting}": truth(setting).scan().points for name, truth in TRUTHS.items() for setting in SETTINGS
    }
    for name in ("a-field1", "b-lab1"):
        given = dict(tomllib.loads((FRINGE / name / "job.toml").read_text())["camera"])
        step_mm = given.pop("depth_scale_mm")
        for part in ("foot", "bars"):
            path = FRINGE / name / f"{part}.tiff"
            scans[f"{name} {part}"] = read_scan(path, camera=Camera(**given), depth_scale_mm=step_mm).points
    return scans


TRUTHS = {"foot": sleeve_scan, "bars": bar_scan}
SETTINGS = ("lab", "field")


def test_feet_and_floors_of_three_cameras() -> None:
    for name, points in sound_scans().items():
        seen = Scan(points, name, viewpoint=np.zeros(3))
        assert check_plausible(seen, EXTENT_MM).source == name
        with pytest.raises(ScanError, match=rf"{name}: its depths look like distances from the camera.*export depths"):
            check_plausible(replace(seen, points=with_distances(points)), EXTENT_MM)


def test_clouds_of_a_camera_at_their_origin_too_and_of_no_others() -> None:
    points = sleeve_scan("lab").scan().points.reshape(-1, 3)
    cloud = Scan(with_distances(points[np.isfinite(points[:, 2])]), "cloud", viewpoint=np.zeros(3))
    with pytest.raises(ScanError, match="its depths look like distances"):
        check_plausible(cloud, EXTENT_MM)
    check_plausible(replace(cloud, viewpoint=None), EXTENT_MM)
    check_plausible(replace(cloud, viewpoint=np.array([0.0, 0.0, -500.0])), EXTENT_MM)


def surface(*, hollow_mm: float = 0.0, tilt: float = 0.0, noise_mm: float = 0.1) -> Array:
    """(h, w, 3) mm: a face 300 mm about the axis, hollow by so much at its corners, seen from 800 mm."""
    across = np.linspace(-150.0, 150.0, 160)
    x, y = np.meshgrid(across, across)
    z = 800.0 + tilt * x + hollow_mm * (x**2 + y**2) / (2.0 * 150.0**2)
    z = z + np.random.default_rng(4).normal(0.0, noise_mm, z.shape)
    return np.stack([x, y, z], axis=-1)


@pytest.mark.parametrize("hollow_mm", [-60.0, -29.0, -14.0, -5.0, -2.0, 0.0, 2.0, 5.0, 10.0, 19.0, 40.0, 60.0])
@pytest.mark.parametrize("tilt", [0.0, 0.1])
def test_faces_that_are_really_curved(hollow_mm: float, tilt: float) -> None:
    """A distance saved as depth would be 28 mm at these corners."""
    points = surface(hollow_mm=hollow_mm, tilt=tilt)
    check_plausible(Scan(points, "face", viewpoint=np.zeros(3)), EXTENT_MM)


@pytest.mark.parametrize("k1", [-0.3, -0.1, 0.1, 0.3])
@pytest.mark.parametrize("tilt", [0.0, 0.1, 0.25])
def test_faces_seen_through_a_lens_that_was_not_straightened(k1: float, tilt: float) -> None:
    points = surface(tilt=tilt)
    x, y, z = np.moveaxis(points, -1, 0)
    radius2 = (x / z) ** 2 + (y / z) ** 2
    bent = np.stack([x * (1.0 + k1 * radius2), y * (1.0 + k1 * radius2), z], axis=-1)
    check_plausible(Scan(bent, "face", viewpoint=np.zeros(3)), EXTENT_MM)


@pytest.mark.parametrize("tilt", [0.0, 0.1, 0.25])
@pytest.mark.parametrize("noise_mm", [0.0, 0.3])
def test_distances_of_faces_aslant_and_in_noise(tilt: float, noise_mm: float) -> None:
    points = with_distances(surface(tilt=tilt, noise_mm=noise_mm))
    with pytest.raises(ScanError, match="its depths look like distances"):
        check_plausible(Scan(points, "face", viewpoint=np.zeros(3)), EXTENT_MM)


def test_a_picture_without_a_face_proves_nothing() -> None:
    rng = np.random.default_rng(2)
    points = rng.uniform([-150.0, -150.0, 700.0], [150.0, 150.0, 900.0], (5000, 3))
    for scan in (points, with_distances(points)):
        check_plausible(Scan(scan, "dust", viewpoint=np.zeros(3)), EXTENT_MM)
