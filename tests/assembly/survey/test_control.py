"""Control points: an exact pose, what two of them can do, uncertainties that come true, and points that cannot be."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aadm_workbench.assembly.pose.eopa import NoFit
from aadm_workbench.assembly.survey.control import ControlPose, fit_control_points, shown_up_deg
from aadm_workbench.model import Array, ControlPoint

CORNERS = np.array([[-800.0, -700.0, -20.0], [900.0, -600.0, 5.0], [700.0, 850.0, 0.0], [-750.0, 800.0, 12.0]])


def pose_of_scan(build: Any, seed: int) -> Array:
    """T_column_scan (4, 4), anything."""
    rng = np.random.default_rng(seed)
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = build.rotation(rng), rng.uniform(-3000.0, 3000.0, 3)
    return T


def control(T_column_scan: Array, known: Array, noise: Array | None = None, **more: Any) -> list[ControlPoint]:
    scan = (known - T_column_scan[:3, 3]) @ T_column_scan[:3, :3] + (0.0 if noise is None else noise)
    return [
        ControlPoint(f"G{number}", tuple(place), tuple(seen), False, **more)
        for number, (place, seen) in enumerate(zip(known.tolist(), scan.tolist(), strict=True), 1)
    ]


def fitted(found: ControlPose | NoFit) -> ControlPose:
    assert isinstance(found, ControlPose), found
    return found


def refused(found: ControlPose | NoFit) -> str:
    assert isinstance(found, NoFit)
    return found.reason


@pytest.mark.parametrize("count", [3, 4])
def test_points_that_span_a_plane_need_no_vertical(count: int, build: Any) -> None:
    T = pose_of_scan(build, count)
    pose = fitted(fit_control_points(control(T, CORNERS[:count]), None, None))
    np.testing.assert_allclose(pose.T_column_scan, T, atol=1e-8)
    assert pose.vertical_from == "control points"
    assert pose.rms_mm < 1e-9


def test_two_points_need_the_vertical(build: Any) -> None:
    T = pose_of_scan(build, 9)
    points = control(T, CORNERS[:2])
    pose = fitted(fit_control_points(points, None, T[2, :3]))
    np.testing.assert_allclose(pose.T_column_scan, T, atol=1e-8)
    assert pose.vertical_from == "scan"
    assert "does not show the vertical" in refused(fit_control_points(points, None, None))
    on_one_line = control(T, np.array([[-500.0, 0.0, 0.0], [0.0, 0.0, 0.0], [900.0, 0.0, 0.0]]))
    assert fitted(fit_control_points(on_one_line, None, T[2, :3])).vertical_from == "scan"
    above = control(T, np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 400.0]]))
    assert "do not show how the scan is turned" in refused(fit_control_points(above, None, T[2, :3]))


def test_points_of_the_model_with_map_coordinates(build: Any) -> None:
    T = pose_of_scan(build, 2)
    T_model_column = np.eye(4)
    T_model_column[:3, :3] = build.rotation(np.random.default_rng(8))
    T_model_column[:3, 3] = [4.3e8, 5.1e9, 7200.0]
    points = [
        replace(point, known_mm=tuple((T_model_column[:3, :3] @ point.known_mm + T_model_column[:3, 3]).tolist()))
        for point in control(T, CORNERS)
    ]
    points = [replace(point, in_model=True) for point in points]
    pose = fitted(fit_control_points(points, T_model_column, None))
    np.testing.assert_allclose(pose.T_column_scan, T, atol=1e-4)
    assert "no place in a model" in refused(fit_control_points(points, None, None))


@pytest.mark.parametrize("stated", [0.4, None])
@pytest.mark.parametrize("count", [2, 4])
def test_the_uncertainty_is_the_scatter_of_what_comes_out(stated: float | None, count: int, build: Any) -> None:
    """Each control point errs by 0.4 mm per axis: the place of a bar scatters as much as its covariance says."""
    rng = np.random.default_rng(3)
    T, u_mm = pose_of_scan(build, 5), 0.4
    bar = np.array([240.0, -240.0, 160.0])
    seen = (bar - T[:3, 3]) @ T[:3, :3]
    places, variances = [], []
    for _ in range(400):
        points = control(T, CORNERS[:count], rng.normal(0.0, u_mm, (count, 3)), u_mm=stated)
        pose = fitted(fit_control_points(points, None, T[2, :3] if count == 2 else None))
        places.append((pose.T_column_scan[:3, :3] @ seen + pose.T_column_scan[:3, 3])[:2])
        variances.append(np.trace(pose.covariance_at(bar)))
    ratio = np.sqrt(np.trace(np.cov(np.array(places).T)) / np.mean(variances))
    # Never too small; with two points the 0.1° that the vertical may be off is in it, which is not simulated here.
    assert 0.6 < ratio < 1.1
    if stated is not None and count == 4:
        assert ratio == pytest.approx(0.9, abs=0.15)


def test_residuals_larger_than_stated_raise_the_uncertainty(build: Any) -> None:
    T = pose_of_scan(build, 6)
    noise = np.random.default_rng(1).normal(0.0, 2.0, CORNERS.shape)
    pose = fitted(fit_control_points(control(T, CORNERS, noise, u_mm=0.1), None, None))
    assert pose.u_mm.min() > 0.5


def test_points_that_contradict_each_other(build: Any) -> None:
    T = pose_of_scan(build, 7)
    points = control(T, CORNERS)
    swapped = [points[0], replace(points[2], name="G2"), replace(points[1], name="G3"), points[3]]
    swapped = [replace(a, known_mm=b.known_mm) for a, b in zip(swapped, points, strict=True)]
    assert "contradict each other" in refused(fit_control_points(swapped, None, None))
    metres = [replace(point, scan_mm=tuple(value / 1000.0 for value in point.scan_mm)) for point in points]
    assert "1e+03 times as far apart as in the scan" in refused(fit_control_points(metres, None, None))
    far = [replace(points[0], scan_mm=tuple(value + 30.0 for value in points[0].scan_mm)), *points[1:]]
    assert "G1 is" in refused(fit_control_points(far, None, None))
    # Three points fit upside down as well as upright: only the vertical tells.
    mirrored = np.array([[0.0, 500.0, 0.0], [-433.0, -250.0, 0.0], [433.0, -250.0, 0.0]])
    three = control(T, mirrored)
    wrong = [three[0], replace(three[1], scan_mm=three[2].scan_mm), replace(three[2], scan_mm=three[1].scan_mm)]
    assert "lean 180°" in refused(fit_control_points(wrong, None, T[2, :3]))


def test_the_direction_at_the_top_of_the_image(build: Any) -> None:
    T = np.eye(4)
    T[:3, :3] = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    pose = fitted(fit_control_points(control(T, CORNERS), None, None))
    assert abs(shown_up_deg(pose, np.array([0.0, -1.0, 0.0])) or 0.0) == pytest.approx(180.0)
    assert shown_up_deg(pose, np.array([1.0, 0.0, 0.0])) == pytest.approx(90.0)
    assert shown_up_deg(pose, np.array([0.0, 0.0, 1.0])) is None
