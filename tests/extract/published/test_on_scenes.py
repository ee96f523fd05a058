"""The three methods of the literature on scans whose truth is known."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aadm_workbench.extract.method import extract
from aadm_workbench.extract.published import fusion
from aadm_workbench.model import Array, Extraction, Kind, Scan
from aadm_workbench.twin.scene import TrueScan

DIAMETER_MM = {Kind.SLEEVE: 26.0, Kind.REBAR: 18.0}
# Mean error in the plane, mm. Hough circles err by a good pixel (0.66 mm here), geometric fits by a fraction of one.
LIMIT_MM = {"fusion": 1.1, "pointcloud": 0.35, "image": 1.1}
# Along the axis: one plane through all tops misses tops that differ by 3 mm either way; the others look at each top.
ALONG_LIMIT_MM = {
    ("fusion", Kind.SLEEVE): 0.2,
    ("fusion", Kind.REBAR): 3.0,
    ("pointcloud", Kind.SLEEVE): 0.2,
    ("pointcloud", Kind.REBAR): 0.2,
    ("image", Kind.SLEEVE): 0.2,
    ("image", Kind.REBAR): 0.2,
}
METHODS = tuple(LIMIT_MM)
KINDS = tuple(DIAMETER_MM)
Scenes = dict[Kind, TrueScan]
Compare = Callable[[Extraction, Array, Array], Any]


def extracted(scan: Scan, kind: Kind, method: str, seed: int = 1) -> Extraction:
    return extract(scan, kind, DIAMETER_MM[kind], method, np.random.default_rng(seed))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", METHODS)
def test_twelve_of_twelve_within_the_method_s_accuracy(scenes: Scenes, score: Compare, method: str, kind: Kind) -> None:
    scene = scenes[kind]
    found = extracted(scene.scan(), kind, method)
    got = score(found, scene.points_scan(), scene.axes_scan())
    assert (got.found, got.false) == (12, 0)
    assert got.mean_mm < LIMIT_MM[method]
    assert got.along_mm < ALONG_LIMIT_MM[method, kind]
    assert got.lean_deg < 3.0
    assert found.method == method
    assert found.kind is kind
    assert found.reason == ""
    assert all(point.covariance is None and point.kind is kind for point in found.points)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", METHODS)
def test_plane_faces_the_camera_and_vertical_points_up_the_column(scenes: Scenes, method: str, kind: Kind) -> None:
    scene = scenes[kind]
    found = extracted(scene.scan(), kind, method)
    assert found.plane is not None
    assert found.vertical is not None
    assert -found.plane.offset > 0  # the camera is at the origin
    assert found.vertical @ scene.axes_scan().mean(axis=0) > 0.999
    assert np.allclose(found.vertical, -found.plane.normal if kind is Kind.SLEEVE else found.plane.normal)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", ["fusion", "pointcloud"])
def test_cloud_of_unknown_viewpoint_seen_from_above(scenes: Scenes, score: Compare, method: str, kind: Kind) -> None:
    over = np.array([1.0, -1.0, -1.0])
    scene = scenes[kind]
    points = scene.scan().points.reshape(-1, 3) * over.astype(np.float32)
    cloud = Scan(points[np.isfinite(points[:, 2])])
    got = score(extracted(cloud, kind, method), scene.points_scan() * over, scene.axes_scan() * over)
    assert (got.found, got.false) == (12, 0)
    assert got.mean_mm < LIMIT_MM[method]
    assert got.lean_deg < 3.0  # and not 177: up is up


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", ["fusion", "pointcloud"])
def test_same_seed_gives_the_same_bytes(scenes: Scenes, method: str, kind: Kind) -> None:
    scan = scenes[kind].scan()
    first, second = (extracted(scan, kind, method, seed=7) for _ in range(2))
    assert [p.centre.tobytes() for p in first.points] == [p.centre.tobytes() for p in second.points]
    assert [p.axis.tobytes() for p in first.points] == [p.axis.tobytes() for p in second.points]


@pytest.mark.parametrize("kind", KINDS)
def test_fusion_takes_given_thresholds(scenes: Scenes, kind: Kind) -> None:
    recipe = fusion.extract_sleeves if kind is Kind.SLEEVE else fusion.extract_rebars
    scan = scenes[kind].scan()
    rng = np.random.default_rng(1)
    given = recipe(scan, DIAMETER_MM[kind], rng, z_range_mm=(780.0, 825.0))
    assert given.quality["z_range_mm"] == (780.0, 825.0)
    assert len(given.points) == 12
    beside = recipe(scan, DIAMETER_MM[kind], rng, z_range_mm=(100.0, 200.0))
    assert beside.points == ()
    assert "pass-through" in beside.reason


def flat_wall(camera_scan: Scan) -> Scan:
    points = camera_scan.points.copy()
    rows, columns = np.indices(points.shape[:2])
    camera = camera_scan.camera
    assert camera is not None
    points[..., 2] = 800.0
    points[..., 0] = (columns - camera.cx) * 800.0 / camera.fx
    points[..., 1] = (rows - camera.cy) * 800.0 / camera.fy
    return Scan(points, camera=camera, viewpoint=np.zeros(3))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", METHODS)
def test_blank_wall_gives_a_reason(scenes: Scenes, method: str, kind: Kind) -> None:
    found = extracted(flat_wall(scenes[kind].scan()), kind, method)
    assert found.points == ()
    assert found.reason


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", METHODS)
def test_scan_without_a_return_gives_a_reason(scenes: Scenes, method: str, kind: Kind) -> None:
    scan = scenes[kind].scan()
    found = extracted(Scan(np.full_like(scan.points, np.nan), camera=scan.camera), kind, method)
    assert found.points == ()
    assert found.reason
    cloud = extracted(Scan(np.empty((0, 3), np.float32)), kind, method)
    assert cloud.points == ()
    assert cloud.reason
