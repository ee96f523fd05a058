"""A simulated storey: its control points, seen in the scan, give where its bars were put."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from aadm_workbench.stack.measured import rigid_motion
from aadm_workbench.twin.tower import HEIGHT_MM, make_tower
from batch.job.file import read_job


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("tower")
    assert [line.split(":")[0] for line in make_tower(folder, seed=3, columns=1)] == ["T-1"]
    return folder


def test_control_points_tell_where_the_bars_stand(folder: Path) -> None:
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))["columns"]["T-1"]
    (column,) = read_job(folder / "job.toml").columns
    T = np.array(truth["rebars"]["T_column_scan"])
    seen = np.array([point.scan_mm for point in column.control_points]) @ T[:3, :3].T + T[:3, 3]
    ground = truth["ground"]
    turn = Rotation.from_euler("z", ground["yaw_deg"], degrees=True)
    placed = turn.apply(seen)[:, :2] + [ground["dx_mm"], ground["dy_mm"]]
    known = np.array([point.known_mm for point in column.control_points])[:, :2]
    assert 0.05 < np.abs(known - placed).max() < 4.0 * 0.4


def test_the_job_says_how_columns_are_set(folder: Path) -> None:
    job = read_job(folder / "job.toml")
    assert job.stack.height_mm == HEIGHT_MM
    assert job.stack.plumb_u_mm == 1.5
    assert {path.name for path in (folder / "scans").iterdir()} == {"T-1-foot.tiff", "T-1-bars.tiff"}


def test_the_motion_of_points_in_the_plan() -> None:
    """Against Kabsch of scipy."""
    rng = np.random.default_rng(2)
    source = rng.normal(0.0, 200.0, (9, 2))
    target = source @ np.array([[0.8, 0.6], [-0.6, 0.8]]) + [3.0, -7.0] + rng.normal(0.0, 0.5, (9, 2))
    weights = rng.uniform(0.5, 2.0, 9)
    found = rigid_motion(source, target, weights)
    middles = [np.average(points, axis=0, weights=weights) for points in (source, target)]
    flat = [np.column_stack([p - m, np.zeros(9)]) for p, m in zip((target, source), reversed(middles), strict=True)]
    turn, _ = Rotation.align_vectors(*flat, weights=weights)
    assert found[2] == pytest.approx(turn.as_rotvec()[2], abs=1e-9)
    assert found[:2] == pytest.approx(middles[1] - turn.apply([*middles[0], 0.0])[:2], abs=1e-7)
