"""PTX: several scans and their poses, grids column by column, no-returns, headers that lie."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, FloatArray
from aadm_workbench.scan.read import read_scan
from aadm_workbench.twin.camera import turned_about

IDENTITY = np.eye(4)


def block(points: FloatArray, T_scan_file: Array = IDENTITY, *, more: str = " 0.5 10 20 30", end: str = "\n") -> str:
    """One scan (h, w, 3) as text, points without return as zeros."""
    height, width = points.shape[:2]
    lines = [str(width), str(height), " ".join(f"{value:.17g}" for value in T_scan_file[:3, 3])]
    lines += [" ".join(f"{value:.17g}" for value in axis) for axis in T_scan_file[:3, :3].T]
    lines += [" ".join(f"{value:.17g}" for value in row) for row in T_scan_file.T]
    by_column = np.nan_to_num(points.astype(np.float64).transpose(1, 0, 2).reshape(-1, 3))
    lines += [" ".join(f"{value:.17g}" for value in point) + more for point in by_column]
    return end.join(lines) + end


def pose(shift: list[float]) -> Array:
    T_scan_file = np.eye(4)
    T_scan_file[:3, :3] = turned_about(np.array([0.6, 0.0, 0.8]), 0.7)
    T_scan_file[:3, 3] = shift
    return T_scan_file


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("more", ["", " 0.5", " 0.5 10 20 30"])
def test_one_scan_is_a_grid_with_its_pose(tmp_path: Path, grid: FloatArray, end: str, more: str) -> None:
    T_scan_file = pose([100.0, -200.0, 3000.0])
    (tmp_path / "scan.ptx").write_bytes(block(grid, T_scan_file, more=more, end=end).encode())
    scan = read_scan(tmp_path / "scan.ptx")
    assert scan.points.shape == grid.shape
    assert scan.dropped == 40
    expected = grid.astype(np.float64) @ T_scan_file[:3, :3].T + T_scan_file[:3, 3]
    np.testing.assert_allclose(scan.points, expected, atol=1e-9)
    np.testing.assert_allclose(scan.viewpoint, [100.0, -200.0, 3000.0])
    assert (scan.image is None) == (more == "")


def test_intensities_become_the_grey_picture(tmp_path: Path, grid: FloatArray) -> None:
    rows = block(grid).splitlines()
    intensity = np.linspace(0.0, 1.0, 48 * 64).reshape(48, 64)
    by_column = intensity.T.ravel()
    rows[10:] = [f"{row.rsplit(' ', 4)[0]} {value:.6f}" for row, value in zip(rows[10:], by_column, strict=True)]
    (tmp_path / "scan.ptx").write_text("\n".join(rows))
    scan = read_scan(tmp_path / "scan.ptx")
    assert scan.image is not None
    np.testing.assert_allclose(scan.image, intensity * 255.0, atol=0.501)


def test_several_scans_are_joined_and_their_no_returns_counted(tmp_path: Path, grid: FloatArray) -> None:
    far = pose([637_012_000.0, 849_028_000.0, 431_000.0])
    near = pose([637_012_500.0, 849_028_000.0, 431_000.0])
    (tmp_path / "scan.ptx").write_text(block(grid, far) + block(grid, near))
    scan = read_scan(tmp_path / "scan.ptx")
    seen = grid[np.isfinite(grid[..., 2])].astype(np.float64)
    expected = [seen @ one[:3, :3].T + one[:3, 3] for one in (far, near)]
    assert scan.dropped == 80
    assert scan.points.dtype == np.float64
    assert scan.viewpoint is None
    by_x = [np.sort(points[:, 0]) for points in (scan.points, np.concatenate(expected))]
    np.testing.assert_allclose(by_x[0], by_x[1], rtol=0, atol=1e-6)
    assert any("2 scans" in note for note in scan.notes)


def test_scans_from_one_station_keep_its_viewpoint(tmp_path: Path, grid: FloatArray) -> None:
    T_scan_file = pose([1.0, 2.0, 3.0])
    (tmp_path / "scan.ptx").write_text(block(grid[:, :30], T_scan_file) + block(grid[:, 30:], T_scan_file))
    scan = read_scan(tmp_path / "scan.ptx")
    np.testing.assert_allclose(scan.viewpoint, [1.0, 2.0, 3.0])
    assert scan.points.shape == (48 * 64 - 40, 3)


def test_an_empty_scan_among_others_is_passed_over(tmp_path: Path, grid: FloatArray) -> None:
    (tmp_path / "scan.ptx").write_text(block(grid[:, :0]) + block(grid))
    assert read_scan(tmp_path / "scan.ptx").points.shape == grid.shape


GOOD = (
    "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n5 6 7 1\n1 1 9 0.1\n1 2 9 0.1\n2 1 9 0.1\n2 2 9 0.1\n"
)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("2\n2\n0 0 0", "1000000\n1000000\n0 0 0", "announces 1000000000000 points .* room for"),
        ("2\n2\n0 0 0", "2\n3\n0 0 0", "announces 6 points.*after 4 of them the file ends"),
        ("2\n2\n0 0 0", "-2\n2\n0 0 0", "they must be whole"),
        ("2\n2\n0 0 0", "2.5\n2\n0 0 0", "they must be whole"),
        ("2\n2\n0 0 0", "2\nnan\n0 0 0", "line 2 should be line 2 of 10 of a PTX header, 1 number"),
        ("0 0 1 0\n", "0 0 1\n", "line 9 should be line 9 of 10 of a PTX header, 4 numbers, but reads '0 0 1'"),
        ("5 6 7 1", "5 6 7 2", "the transform before byte"),
        ("0 0 1 0\n5", "0 0 0 0\n5", "the transform before byte"),
        ("1 2 9 0.1", "1 2 x 0.1", "line 12 should begin with 4 numbers, but reads '1 2 x 0.1'"),
        ("2 2 9 0.1\n", "2 2 9 0.1\n7 7 7\n", "line 15 should be line 1 of 10 of a PTX header"),
        ("2\n2\n0 0 0", "0\n0\n0 0 0", "line 11 should be line 1 of 10"),
    ],
)
def test_what_is_no_ptx(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert GOOD.count(old) == 1
    (tmp_path / "scan.ptx").write_text(GOOD.replace(old, new))
    with pytest.raises(ScanError, match=rf"scan\.ptx: .*{message}"):
        read_scan(tmp_path / "scan.ptx")


def test_a_station_that_a_job_gives_the_camera_of_is_the_camera(tmp_path: Path) -> None:
    (tmp_path / "scan.ptx").write_text(GOOD)
    assert read_scan(tmp_path / "scan.ptx").points.tolist() == [[[6, 7, 16], [7, 7, 16]], [[6, 8, 16], [7, 8, 16]]]


def test_two_scans_of_another_program(reference_clouds: Path) -> None:
    scan = read_scan(reference_clouds / "PDAL_multiple-and-transform.ptx", units="m")
    first_mm = np.array([637012.24, 849028.31, 431.66]) * 1000.0
    np.testing.assert_allclose(scan.points[[0, 4]], [first_mm, first_mm], rtol=0, atol=1e-6)
    np.testing.assert_allclose(scan.points[:4], scan.points[4:], rtol=0, atol=1e-6)
    assert scan.points.shape == (8, 3)
