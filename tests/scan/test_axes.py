"""Axes of clouds: a camera's, or OpenGL's; found out from the side on which points lie, declared, or unknown."""

from pathlib import Path

import laspy
import numpy as np
import pye57
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import AXES_UNKNOWN, CAMERA_AXES, OPENGL_AXES, Camera, FloatArray
from aadm_workbench.scan.read import read_scan


def flat_of(grid: FloatArray) -> FloatArray:
    flat = grid.reshape(-1, 3)
    return flat[np.isfinite(flat).all(axis=1)]


def in_opengl(points: FloatArray) -> FloatArray:
    """The same points as a program for OpenGL writes them, by its rule: y and z change their signs."""
    return np.stack([points[..., 0], -points[..., 1], -points[..., 2]], axis=-1)


def written(folder: Path, name: str, points: FloatArray) -> Path:
    """A cloud (n, 3) mm in one format, by a library or by hand."""
    path, kind = folder / name, name.partition(".")[2]
    rows = "".join(f"{x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in points.tolist())
    count = len(points)
    if kind == "las":
        cloud = laspy.LasData(laspy.LasHeader(point_format=0, version="1.2"))
        cloud.header.scales = [1e-5] * 3
        cloud.x, cloud.y, cloud.z = points.T.astype(np.float64)
        cloud.write(path)
    elif kind == "e57":
        x, y, z = (points.T / 1000.0).astype(np.float64)
        with pye57.E57(str(path), mode="w") as image:
            image.write_scan_raw({"cartesianX": x, "cartesianY": y, "cartesianZ": z})
    elif kind == "npz":
        np.savez(path, points=points)
    elif kind == "ply":
        header = f"ply\nformat ascii 1.0\nelement vertex {count}\n" + "".join(f"property float {a}\n" for a in "xyz")
        path.write_text(f"{header}end_header\n{rows}")
    elif kind == "pcd":
        header = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        path.write_text(f"{header}WIDTH {count}\nHEIGHT 1\nPOINTS {count}\nDATA ascii\n{rows}")
    elif kind == "ptx":
        identity = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
        path.write_text(f"{count}\n1\n{identity}{rows}")
    else:
        path.write_text(rows)
    return path


@pytest.mark.parametrize("kind", ["ply", "pcd", "xyz", "csv", "pts", "ptx", "npz", "las", "e57"])
def test_clouds_before_and_behind_the_plane_of_the_camera(tmp_path: Path, grid: FloatArray, kind: str) -> None:
    points = flat_of(grid)
    ahead = read_scan(written(tmp_path, f"a.{kind}", points))
    behind = read_scan(written(tmp_path, f"b.{kind}", in_opengl(points)))
    assert (ahead.axes, behind.axes) == (CAMERA_AXES, OPENGL_AXES)
    assert behind.points.shape == ahead.points.shape
    np.testing.assert_allclose(behind.points, ahead.points, atol=1e-3)
    flat = flat_of(behind.points)
    np.testing.assert_allclose(flat @ behind.R_file_scan.T, in_opengl(points), atol=1e-3)
    said = [
        any("OpenGL's axes" in note and "+y of the file" in note for note in scan.notes) for scan in (ahead, behind)
    ]
    assert said == [False, True]


def test_declared_axes_go_before_those_that_were_found(tmp_path: Path, grid: FloatArray) -> None:
    path = written(tmp_path, "a.ply", in_opengl(flat_of(grid)))
    declared = read_scan(path, axes="camera")
    assert (declared.axes, declared.notes) == (CAMERA_AXES, ())
    assert (flat_of(declared.points)[:, 2] < 0).all()
    opengl = read_scan(path, axes="opengl")
    assert (opengl.axes, opengl.notes) == (OPENGL_AXES, ())
    np.testing.assert_array_equal(opengl.points, read_scan(path).points)
    with pytest.raises(ScanError, match=r'b\.ply: its points lie at z > 0.*write axes = "camera"'):
        read_scan(written(tmp_path, "b.ply", flat_of(grid)), axes="opengl")
    with pytest.raises(ScanError, match="must be one of 'camera', 'opengl'"):
        read_scan(path, axes="up")


def test_organised_clouds_with_and_without_a_camera(tmp_path: Path, grid: FloatArray, camera: Camera) -> None:
    np.savez(tmp_path / "a.npz", points=in_opengl(grid))
    for scan in (read_scan(tmp_path / "a.npz"), read_scan(tmp_path / "a.npz", camera=camera)):
        assert scan.axes == OPENGL_AXES
        np.testing.assert_array_equal(scan.points, grid)


def test_clouds_in_frames_that_are_no_cameras(tmp_path: Path, grid: FloatArray) -> None:
    about_zero = flat_of(grid) - [0.0, 0.0, 900.0]
    on_a_map = np.add(in_opengl(flat_of(grid)), [512_000_000.0, 3_400_000_000.0, 0.0])
    for number, points in enumerate((about_zero, on_a_map)):
        scan = read_scan(written(tmp_path, f"{number}.xyz", points))
        assert (scan.axes, scan.notes) == (AXES_UNKNOWN, ())


def test_a_station_of_the_building_is_none_of_the_two(tmp_path: Path, grid: FloatArray) -> None:
    path = written(tmp_path, "a.ptx", in_opengl(flat_of(grid)))
    path.write_text(path.read_text().replace("0 0 1 0\n0 0 0 1\n", "0 0 1 0\n5 6 1700 1\n", 1))
    assert read_scan(path).axes == AXES_UNKNOWN


def test_depth_maps_have_the_axes_of_their_camera(tmp_path: Path, depth_mm: FloatArray, camera: Camera) -> None:
    np.savez(tmp_path / "a.npz", depth=depth_mm)
    assert read_scan(tmp_path / "a.npz", camera=camera, axes="opengl").axes == CAMERA_AXES
