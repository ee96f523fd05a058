"""What holds for all formats: errors that help, units, no-returns, precision, camera and picture."""

import contextlib
import hashlib
import os
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from aadm_workbench.errors import CameraError, MissingDependencyError, ScanError
from aadm_workbench.model import Camera, FloatArray
from aadm_workbench.scan.read import read_scan, supported_formats
from aadm_workbench.scan.write import write_pcd, write_ply
from tests.scan.numpy_files import write_npz, write_xyz

from .formats.test_e57 import cartesian, write_e57
from .test_formats_agree import write_las

WRITERS = {
    "ply": write_ply,
    "ascii.ply": lambda path, points: write_ply(path, points, binary=False),
    "pcd": lambda path, points: write_pcd(path, points, "binary"),
    "ascii.pcd": lambda path, points: write_pcd(path, points, "ascii"),
    "packed.pcd": lambda path, points: write_pcd(path, points, "binary_compressed"),
    "xyz": write_xyz,
    "npz": write_npz,
}


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("ending", WRITERS)
def test_what_is_written_reads_back_bit_by_bit(
    tmp_path: Path, cloud: FloatArray, ending: str, dtype: type[np.floating]
) -> None:
    points = cloud.astype(dtype) / dtype(3)
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, points)
    scan = read_scan(path)
    np.testing.assert_array_equal(scan.points.astype(dtype), points)
    assert scan.points.dtype == (np.float64 if ending == "xyz" else dtype)
    assert scan.points.flags.c_contiguous
    assert scan.points.flags.writeable
    assert (scan.dropped, scan.camera, scan.viewpoint, scan.source) == (0, None, None, str(path))
    assert scan.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize("ending", sorted(set(WRITERS) - {"xyz"}))
def test_points_without_return_are_left_out_of_a_cloud_and_counted(
    tmp_path: Path, cloud: FloatArray, ending: str
) -> None:
    points = cloud.copy()
    points[3] = 0.0
    points[10:14, 1] = np.nan
    points[20, 2] = np.inf
    points[21, 0] = -np.inf
    points[22] = [0.0, 0.0, 1.0]
    points[23] = [5.0, -5.0, 0.0]
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, points)
    scan = read_scan(path)
    assert scan.dropped == 7
    np.testing.assert_array_equal(scan.points, np.delete(points, [3, 10, 11, 12, 13, 20, 21], axis=0))


@pytest.mark.parametrize("ending", ["npz", "pcd", "ascii.pcd", "packed.pcd"])
def test_an_organised_cloud_keeps_its_grid_and_its_gaps(tmp_path: Path, grid: FloatArray, ending: str) -> None:
    grid[0, 0] = 0.0
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, grid)
    scan = read_scan(path)
    expected = grid.copy()
    expected[0, 0] = np.nan
    assert scan.organised
    np.testing.assert_array_equal(scan.points, expected)
    assert scan.dropped == 41


@pytest.mark.parametrize("ending", WRITERS)
def test_metres_become_millimetres(tmp_path: Path, cloud: FloatArray, ending: str) -> None:
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, cloud / np.float32(1000))
    scan = read_scan(path, units="m")
    np.testing.assert_allclose(scan.points, cloud, rtol=3e-7)


@pytest.mark.parametrize("ending", ["ply", "pcd", "npz"])
def test_map_coordinates_become_float64(tmp_path: Path, cloud: FloatArray, ending: str) -> None:
    metres = cloud + np.array([512_000.0, 4_096_000.0, 0.0], np.float32)
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, metres)
    scan = read_scan(path, units="m")
    assert scan.points.dtype == np.float64
    np.testing.assert_array_equal(scan.points, metres.astype(np.float64) * 1000)


@pytest.mark.parametrize("ending", ["ply", "npz", "ascii.ply"])
def test_a_cloud_that_fills_the_image_of_its_camera_becomes_organised(
    tmp_path: Path, grid: FloatArray, camera: Camera, ending: str
) -> None:
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, grid.reshape(-1, 3))
    scan = read_scan(path, camera=camera)
    np.testing.assert_array_equal(scan.points, grid)
    assert scan.dropped == 40
    assert scan.camera == camera
    np.testing.assert_array_equal(scan.viewpoint, [0, 0, 0])


def test_a_cloud_in_the_view_of_its_camera_stays_without_order(
    tmp_path: Path, grid: FloatArray, camera: Camera
) -> None:
    shuffled = np.random.default_rng(1).permutation(grid.reshape(-1, 3))
    write_ply(tmp_path / "scan.ply", shuffled)
    scan = read_scan(tmp_path / "scan.ply", camera=camera)
    assert scan.points.shape == (48 * 64 - 40, 3)
    np.testing.assert_array_equal(scan.viewpoint, [0, 0, 0])


def test_a_cloud_that_its_camera_cannot_have_seen_is_refused(tmp_path: Path, cloud: FloatArray, camera: Camera) -> None:
    write_ply(tmp_path / "scan.ply", cloud)
    with pytest.raises(CameraError, match=r"scan\.ply: only \d+% of its points lie in the view of \[camera\]"):
        read_scan(tmp_path / "scan.ply", camera=camera)


def test_intrinsics_of_another_camera_are_refused(tmp_path: Path, grid: FloatArray, camera: Camera) -> None:
    write_npz(tmp_path / "scan.npz", grid)
    other = Camera(camera.fx, camera.fy, camera.cx + 3.0, camera.cy, camera.width, camera.height)
    with pytest.raises(CameraError, match=r"3\.0 pixels beside the rays"):
        read_scan(tmp_path / "scan.npz", camera=other)
    smaller = Camera(camera.fx, camera.fy, camera.cx, camera.cy, 60, 40)
    with pytest.raises(CameraError, match=r"64 x 48 pixels, \[camera\] says 60 x 40"):
        read_scan(tmp_path / "scan.npz", camera=smaller)


def test_half_a_pixel_of_convention_is_no_other_camera(tmp_path: Path, grid: FloatArray, camera: Camera) -> None:
    write_npz(tmp_path / "scan.npz", grid)
    shifted = Camera(camera.fx, camera.fy, camera.cx + 0.5, camera.cy + 0.5, camera.width, camera.height)
    assert read_scan(tmp_path / "scan.npz", camera=shifted).organised


def test_a_scan_without_any_return_is_refused(tmp_path: Path) -> None:
    write_ply(tmp_path / "scan.ply", np.zeros((50, 3)))
    with pytest.raises(ScanError, match=r"scan\.ply: none of its 50 points is a measurement"):
        read_scan(tmp_path / "scan.ply")


def test_extension_in_capitals_and_name_of_the_job(tmp_path: Path, cloud: FloatArray) -> None:
    write_ply(tmp_path / "SCAN.PLY", cloud)
    assert read_scan(tmp_path / "SCAN.PLY", source="scans/a.ply").source == "scans/a.ply"


def test_unknown_extension_names_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(
        ScanError, match=r"scan\.docx: files of type \.docx are not read; export one of .*\.ply .*\.pcd"
    ):
        read_scan(tmp_path / "scan.docx")
    with pytest.raises(ScanError, match=r"files of type \(none\)"):
        read_scan(tmp_path / "scan")
    assert {".tif", ".tiff", ".png", ".ply", ".pcd", ".xyz", ".txt", ".csv", ".npz"} <= set(supported_formats())
    assert {".pts", ".ptx", ".las", ".laz", ".e57"} <= set(supported_formats())


@pytest.mark.parametrize("ending", supported_formats())
def test_no_file_a_folder_an_empty_file(tmp_path: Path, camera: Camera, ending: str) -> None:
    with pytest.raises(ScanError, match="there is no such file"):
        read_scan(tmp_path / f"absent{ending}", camera=camera)
    (tmp_path / f"folder{ending}").mkdir()
    with pytest.raises(ScanError, match="is a folder"):
        read_scan(tmp_path / f"folder{ending}", camera=camera)
    (tmp_path / f"empty{ending}").touch()
    with pytest.raises(ScanError, match=r"is empty \(0 bytes\)"):
        read_scan(tmp_path / f"empty{ending}", camera=camera)


@pytest.mark.parametrize("ending", supported_formats())
@pytest.mark.parametrize("content", [b"\0", b"hello\n", b"\x89PNG\r\n\x1a\n", b"II*\0\x08\0\0\0", b"PK\3\4", b"ply\n"])
def test_garbage_is_a_scan_error_that_names_the_file(
    tmp_path: Path, camera: Camera, ending: str, content: bytes
) -> None:
    path = tmp_path / f"scan{ending}"
    path.write_bytes(content)
    with pytest.raises(ScanError, match="scan"):
        read_scan(path, camera=camera, depth_scale_mm=0.1)


@pytest.mark.parametrize("ending", sorted(set(WRITERS) - {"xyz", "npz"}))
def test_every_cut_of_a_file_is_noticed(tmp_path: Path, cloud: FloatArray, ending: str) -> None:
    whole = tmp_path / f"whole.{ending}"
    WRITERS[ending](whole, cloud[:40])
    content = whole.read_bytes()
    path = tmp_path / f"cut.{ending}"
    # The last number of a text and the line end behind it may be shortened without a trace.
    margin = 12 if ending.startswith("ascii") else 1
    for length in [*range(1, 260, 7), *range(260, len(content) - margin, 41), len(content) - margin]:
        path.write_bytes(content[:length])
        with pytest.raises(ScanError, match=r"cut\."):
            read_scan(path)


@pytest.mark.parametrize("ending", WRITERS)
def test_damaged_bytes_never_escape_as_another_error(tmp_path: Path, cloud: FloatArray, ending: str) -> None:
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, cloud[:40])
    content = path.read_bytes()
    rng = np.random.default_rng(3)
    for _ in range(150):
        damaged = bytearray(content)
        for position in rng.integers(0, min(len(content), 400), 3):
            damaged[position] = rng.integers(0, 256)
        path.write_bytes(bytes(damaged))
        with contextlib.suppress(ScanError):
            assert np.isfinite(read_scan(path).points).all()


def test_unknown_unit_and_impossible_step(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match="the unit of scans is 'inch'; it must be one of 'mm', 'm'"):
        read_scan(tmp_path / "scan.ply", units="inch")
    for step in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(CameraError, match="depth_scale_mm"):
            read_scan(tmp_path / "scan.tiff", depth_scale_mm=step)


def test_file_that_is_no_scan_by_its_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("aadm_workbench.scan.file.LARGEST_FILE_BYTES", 100)
    (tmp_path / "scan.xyz").write_text("1 2 3\n" * 20)
    with pytest.raises(ScanError, match="has 120 bytes, more than"):
        read_scan(tmp_path / "scan.xyz")


def test_grey_picture_of_the_same_view(tmp_path: Path, grid: FloatArray, camera: Camera) -> None:
    write_npz(tmp_path / "scan.npz", grid)
    grey = np.arange(48 * 64, dtype=np.uint16).astype(np.uint8).reshape(48, 64)
    cv2.imwrite(str(tmp_path / "view.png"), grey)
    cv2.imwrite(str(tmp_path / "half.png"), grey[::2, ::2])
    scan = read_scan(tmp_path / "scan.npz", camera=camera, image=tmp_path / "view.png")
    np.testing.assert_array_equal(scan.image, grey)
    with pytest.raises(ScanError, match=r"half\.png: is 32 x 24 pixels, its scan 64 x 48"):
        read_scan(tmp_path / "scan.npz", image=tmp_path / "half.png")
    with pytest.raises(ScanError, match=r"absent\.png: there is no such file"):
        read_scan(tmp_path / "scan.npz", image=tmp_path / "absent.png")


@pytest.mark.parametrize(
    ("module", "name", "package"), [("lazrs", "scan.laz", "lazrs"), ("pye57.libe57", "scan.e57", "pye57")]
)
def test_what_a_format_needs_is_named_where_it_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cloud: FloatArray, module: str, name: str, package: str
) -> None:
    path = tmp_path / name
    if path.suffix == ".e57":
        write_e57(path, cartesian(cloud))
    else:
        write_las(path, cloud.astype(np.float64))
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingDependencyError, match=rf"package {package}, .* pip install 'aadm-workbench\[formats\]'"):
        read_scan(path)


@pytest.mark.parametrize("ending", supported_formats())
def test_a_pipe_is_not_waited_for(tmp_path: Path, ending: str) -> None:
    os.mkfifo(tmp_path / f"scan{ending}")
    with pytest.raises(ScanError, match="is a device or a pipe"):
        read_scan(tmp_path / f"scan{ending}")


def test_a_name_that_no_disk_takes(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match=r"\.ply: cannot be read \(File name too long\)"):
        read_scan(tmp_path / f"{'n' * 300}.ply")


@pytest.mark.parametrize("ending", ["ply", "npz", "pcd", "packed.pcd"])
def test_points_out_of_this_world_are_no_measurement(tmp_path: Path, cloud: FloatArray, ending: str) -> None:
    points = cloud.astype(np.float64)
    points[3], points[7, 1] = 1e300, -2e12
    path = tmp_path / f"scan.{ending}"
    WRITERS[ending](path, points)
    scan = read_scan(path)
    assert scan.dropped == 2
    np.testing.assert_array_equal(scan.points, np.delete(points, [3, 7], axis=0))
