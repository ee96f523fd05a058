"""Studies: errors, spreads and biases against numbers worked out by hand, without a rendered scan."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.model import Array, AssemblyPoint, Extraction, Kind, Scan
from aadm_workbench.twin.camera import PRO_M, facing
from aadm_workbench.twin.scene import TrueScan
from aadm_workbench.twin.scenes import LAB
from aadm_workbench.twin.study.errors import Comparison, FeatureError, SpacingError, compared
from aadm_workbench.twin.study.methods import BareTime, Measurement, MethodStudy, seconds_of_bare_calls, thinned_camera
from aadm_workbench.twin.study.plots import write_plots
from aadm_workbench.twin.study.published import TABLES
from aadm_workbench.twin.study.scores import bare_seconds, largest_unflagged_mm, scores, spread_of

UP = np.array([0.0, 0.0, 1.0])
SQUARE = np.array([[-50.0, -50.0], [50.0, -50.0], [50.0, 50.0], [-50.0, 50.0]])


def square_truth(tilt: tuple[float, float] = (0.05, -0.03), *, looking_up: bool = True) -> TrueScan:
    """Four sleeves at the corners of a square of 100 mm, seen from 800 mm away."""
    forward = np.array([0.0, 0.0, 1.0 if looking_up else -1.0])
    T = facing(np.array([10.0, 5.0, 0.0]), forward, np.array([0.0, 1.0, 0.0]), 800.0, tilt, 0.1)
    points = tuple(
        AssemblyPoint(f"S{k}", Kind.SLEEVE, np.array([x, y, 0.0]), UP, 26.0) for k, (x, y) in enumerate(SQUARE, 1)
    )
    return TrueScan(np.zeros((1, 1), np.float32), PRO_M, points, T)


def found_at(truth: TrueScan, offsets: Array, u_mm: float | None = None, more: tuple[Array, ...] = ()) -> Extraction:
    """Points that lie off the true ones by offsets (n, 3) mm, column frame, in reverse order."""
    T = np.linalg.inv(truth.T_column_scan)
    places = [point.centre + offset for point, offset in zip(truth.points, offsets, strict=True)] + list(more)
    covariance = None if u_mm is None else u_mm**2 * np.eye(3)
    points = tuple(
        AssemblyPoint("", Kind.SLEEVE, T[:3, :3] @ place + T[:3, 3], UP, 26.3, covariance) for place in places[::-1]
    )
    return Extraction(Kind.SLEEVE, "made up", points, None, None)


@pytest.mark.parametrize("looking_up", [True, False])
def test_an_error_has_the_length_and_the_directions_it_was_made_with(looking_up: bool) -> None:
    truth = square_truth(looking_up=looking_up)
    eye = truth.T_column_scan[:3, 3]
    outwards = np.array([*(SQUARE[1] - eye[:2]), 0.0])
    offsets = np.zeros((4, 3))
    offsets[1] = 0.3 * outwards / np.linalg.norm(outwards)
    offsets[2] = [0.0, 0.0, 0.7]
    result = compared(found_at(truth, offsets), truth, SQUARE, 13.0)
    first, second, third, _ = result.features
    assert first.distance_mm == pytest.approx(0.0, abs=1e-9)
    assert second.distance_mm == pytest.approx(0.3)
    assert second.radial_mm == pytest.approx(0.3)
    assert (third.distance_mm, third.along_mm) == (pytest.approx(0.0, abs=1e-9), pytest.approx(0.7))
    assert second.diameter_error_mm == pytest.approx(0.3)
    assert second.u_mm is None
    assert result.false == 0


def test_the_scale_error_of_a_camera_is_not_a_methods_but_its_uncertainty_has_to_cover_it() -> None:
    """All lengths 0.1 % too long: no error, but up to 0.07 mm in the plane for u to cover."""
    long = replace(square_truth((0.0, 0.0)), scale=1e-3)
    shift = 1e-3 * long.points_scan() @ long.T_column_scan[:3, :3].T
    bold, careful = (compared(found_at(long, shift, u_mm), long, SQUARE, 13.0) for u_mm in (0.001, 0.05))
    for feature in (*bold.features, *careful.features):
        assert feature.distance_mm == pytest.approx(0.0, abs=1e-9)
        assert feature.along_mm == pytest.approx(0.0, abs=1e-9)
    assert [spacing.error_mm for spacing in bold.spacings] == pytest.approx([0.0] * 4, abs=1e-9)
    assert not any(feature.covered for feature in bold.features)
    assert all(feature.covered for feature in careful.features)


def test_x_and_y_are_right_and_down_in_the_image() -> None:
    truth = square_truth((0.0, 0.0))
    R = truth.T_column_scan[:3, :3]  # columns: the camera's axes in the column frame
    offsets = np.zeros((4, 3))
    offsets[0], offsets[1] = 0.2 * R[:, 0], 0.4 * R[:, 1]
    first, second, *_ = compared(found_at(truth, offsets), truth, SQUARE, 13.0).features
    assert first.error_mm == pytest.approx((0.2, 0.0), abs=1e-9)
    assert second.error_mm == pytest.approx((0.0, 0.4), abs=1e-9)


def test_spacing_is_measured_in_the_plane_between_neighbours_alone() -> None:
    truth = square_truth()
    offsets = np.zeros((4, 3))
    offsets[0] = [-0.5, 0.0, 3.0]
    errors = {s.between: s.error_mm for s in compared(found_at(truth, offsets), truth, SQUARE, 13.0).spacings}
    assert set(errors) == {("S1", "S2"), ("S2", "S3"), ("S3", "S4"), ("S4", "S1")}
    assert errors["S1", "S2"] == pytest.approx(0.5)
    assert errors["S4", "S1"] == pytest.approx(math.hypot(100.0, 0.5) - 100.0)
    assert errors["S2", "S3"] == pytest.approx(0.0, abs=1e-9)


def test_what_is_missing_and_what_is_too_much_is_counted() -> None:
    truth = square_truth()
    offsets = np.zeros((4, 3))
    offsets[3] = [0.0, 40.0, 0.0]
    stray = np.array([0.0, 0.0, 0.0])
    result = compared(found_at(truth, offsets, more=(stray,)), truth, SQUARE, 13.0)
    assert result.features[3] == FeatureError("S4")
    assert result.false == 2
    assert [s.error_mm is None for s in result.spacings] == [False, False, True, True]
    nothing = compared(Extraction(Kind.SLEEVE, "made up", (), None, None), truth, SQUARE, 13.0)
    assert nothing.features == tuple(FeatureError(f"S{k}") for k in (1, 2, 3, 4))


def test_coverage_follows_the_law_of_two_normal_errors() -> None:
    """Of errors drawn with the stated u, 95 % are covered and exp(-9/2) = 1.1 % exceed three u."""
    truth, rng = square_truth(), np.random.default_rng(0)
    features = []
    for _ in range(500):
        result = compared(found_at(truth, rng.normal(0.0, 0.5, (4, 3)), 0.5), truth, SQUARE, 13.0)
        features += result.features
    assert np.mean([feature.covered for feature in features]) == pytest.approx(0.95, abs=0.015)
    beyond = [f.distance_mm > 3.0 * f.u_mm for f in features if f.distance_mm is not None and f.u_mm is not None]
    assert np.mean(beyond) == pytest.approx(0.011, abs=0.008)
    assert np.mean([feature.radial_mm for feature in features]) == pytest.approx(0.0, abs=0.04)


def test_spread_of_known_errors() -> None:
    spread = spread_of([0.3, None, -0.1, 0.2])
    assert spread is not None
    assert (spread.count, spread.largest_mm) == (3, pytest.approx(0.3))
    assert (spread.mean_mm, spread.median_mm, spread.sd_mm) == pytest.approx((0.2, 0.2, 0.1))
    assert spread.rmse_mm == pytest.approx(math.sqrt(0.14 / 3))
    assert spread.interval_mm == pytest.approx((0.2 - 1.96 * 0.1 / math.sqrt(3), 0.2 + 1.96 * 0.1 / math.sqrt(3)))
    assert spread_of([None, None]) is None


def test_unflagged_is_what_its_u_did_not_announce() -> None:
    announced = FeatureError("S1", (2.0, 0.0), u_mm=1.0)
    hidden = FeatureError("S2", (0.5, 0.0), u_mm=0.1)
    without_u = FeatureError("S3", (0.7, 0.0))
    assert largest_unflagged_mm([announced, hidden]) == pytest.approx(0.5)
    assert largest_unflagged_mm([announced, hidden, without_u]) == pytest.approx(0.7)
    assert largest_unflagged_mm([announced, FeatureError("S4")]) is None


def small_study() -> MethodStudy:
    """Two scenes by two methods: refined takes twice the time of fusion, then three times, and misses every bar."""
    measurements = []
    for scene, seconds in ((0, 0.2), (1, 0.3)):
        for kind in Kind:
            for method, time_s in (("refined", seconds), ("fusion", 0.1)):
                lost = method == "refined" and kind is Kind.REBAR
                feature = FeatureError("P1") if lost else FeatureError("P1", (0.1, 0.0), 0.1, 0.0, 0.1, True, -0.2)
                spacing = SpacingError(("P1", "P2"), None if lost else 0.05)
                comparison = Comparison((feature,), (spacing,), int(lost))
                measurements.append(Measurement("lab", scene, method, kind, comparison, time_s, ""))
    bare = tuple(BareTime("lab", scene, Kind.SLEEVE, 0.05) for scene in (0, 1))
    return MethodStudy(0, 2, ("lab",), ("refined", "fusion"), tuple(measurements), bare)


def test_scores_of_a_small_study() -> None:
    rated = {(score.method, score.kind): score for score in scores(small_study())}
    refined = rated["refined", Kind.SLEEVE]
    assert (refined.found, refined.expected, refined.false, refined.coverage) == (2, 2, 0, 1.0)
    assert refined.seconds == pytest.approx(0.25)
    assert refined.times_fusion == pytest.approx(2.5)
    assert refined.times_bare == pytest.approx(5.0)
    assert refined.diameter is not None
    assert refined.diameter.mean_mm == pytest.approx(0.2)
    lost = rated["refined", Kind.REBAR]
    assert (lost.found, lost.false, lost.centre, lost.coverage, lost.unflagged_mm) == (0, 2, None, None, None)
    assert lost.times_bare is None
    assert bare_seconds(small_study(), "lab", Kind.SLEEVE) == pytest.approx(0.05)
    assert bare_seconds(small_study(), "lab", Kind.REBAR) is None


def test_bare_calls_take_time_and_need_points() -> None:
    u, v = np.meshgrid(np.arange(200.0), np.arange(150.0))
    points = np.stack([u, v, np.full(u.shape, 800.0)], -1)
    points[np.hypot(u - 100, v - 75) < 18, 2] = np.nan
    ticks = iter((1.0, 4.0))
    assert seconds_of_bare_calls(Scan(points), Kind.SLEEVE, 36.0, lambda: next(ticks)) == 3.0
    assert seconds_of_bare_calls(Scan(np.full((9, 9, 3), np.nan)), Kind.SLEEVE, 36.0, lambda: 0.0) is None


def test_every_second_pixel_is_seen_by_a_camera_of_half_the_size() -> None:
    half = thinned_camera(PRO_M, 2)
    assert (half.width, half.height) == (960, 600)
    u = np.array([100.0, 959.7418, 1500.0])
    assert (u / 2 - half.cx) / half.fx == pytest.approx((u - PRO_M.cx) / PRO_M.fx)


def test_plots_show_what_was_not_found_as_nothing(tmp_path: Path) -> None:
    paths = write_plots(small_study(), tmp_path)
    assert [path.name for path in paths] == ["lab-scatter.png", "lab-box.png"]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in paths)


def test_without_matplotlib_the_message_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(MissingDependencyError, match=r"pip install 'aadm-workbench\[twin\]'"):
        write_plots(small_study(), tmp_path)


def test_published_tables_are_those_of_the_two_settings() -> None:
    assert set(TABLES) == {"lab", "field"}
    assert LAB.name in TABLES
    for table in TABLES.values():
        assert [row.method for row in table.rows] == ["pointcloud", "image", "fusion"]
    assert TABLES["field"].rows[2].rebar_spacing_mm == (0.83, 0.75)
    assert TABLES["lab"].rows[2].sleeve_s == 1.660
