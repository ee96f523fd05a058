"""PCD: all storages, other fields, the pose of the sensor, hostile headers, and what other programs make of it."""

import struct
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import CameraError, MissingDependencyError, ScanError
from aadm_workbench.model import OPENGL_AXES, Camera, FloatArray
from aadm_workbench.scan.formats import pcd
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_pcd

POINTS = [(1.5, -2.25, 1000.125), (4.0, 5.5, 900.75), (-7.0, 8.0, 950.0)]


def header(storage: str, **entries: str) -> bytes:
    """A PCD header of three float points; an entry of "" is left out."""
    lines = {
        "VERSION": "0.7",
        "FIELDS": "x y z",
        "SIZE": "4 4 4",
        "TYPE": "F F F",
        "COUNT": "1 1 1",
        "WIDTH": "3",
        "HEIGHT": "1",
        "VIEWPOINT": "0 0 0 1 0 0 0",
        "POINTS": "3",
    } | entries
    text = "".join(f"{key} {value}\n" for key, value in lines.items() if value)
    return f"# .PCD v.7 - Point Cloud Data file format\n{text}DATA {storage}\n".encode()


def read_bytes(tmp_path: Path, content: bytes) -> FloatArray:
    path = tmp_path / "scan.pcd"
    path.write_bytes(content)
    return read_scan(path).points


WIDE = {
    "FIELDS": "_ Normal Z label X Y",
    "SIZE": "1 4 8 2 8 8",
    "TYPE": "U F F I F F",
    "COUNT": "3 2 1 1 1 1",
}


def test_binary_with_other_fields_in_any_order_and_capitals(tmp_path: Path) -> None:
    rows = [struct.pack("<3B2fdhdd", 1, 2, 3, 0.5, 0.25, z, -9, x, y) for x, y, z in POINTS]
    points = read_bytes(tmp_path, header("binary", **WIDE) + b"".join(rows))
    np.testing.assert_array_equal(points, POINTS)
    assert points.dtype == np.float64


def test_compressed_with_other_fields(tmp_path: Path) -> None:
    xyz = np.array(POINTS)
    planes = [np.arange(9, dtype="u1"), np.arange(6, dtype="<f4"), xyz[:, 2], np.arange(3, dtype="<i2"), *xyz[:, :2].T]
    body = b"".join(plane.tobytes() for plane in planes)
    packed = pcd.compress(body)
    content = header("binary_compressed", **WIDE) + struct.pack("<II", len(packed), len(body)) + packed
    np.testing.assert_array_equal(read_bytes(tmp_path, content), POINTS)


@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_text_with_other_fields(tmp_path: Path, line_end: str) -> None:
    rows = [f"1 2 3 nan 0.25 {z!r} -9 {x!r} {y!r}\n" for x, y, z in POINTS]
    text = header("ascii", **WIDE).decode() + "".join(rows)
    np.testing.assert_array_equal(read_bytes(tmp_path, text.replace("\n", line_end).encode()), POINTS)


def test_integer_coordinates(tmp_path: Path) -> None:
    rows = struct.pack("<iII", -5, 7, 4_000_000_000) * 3
    points = read_bytes(tmp_path, header("binary", TYPE="I U U") + rows)
    assert points.tolist() == [[-5.0, 7.0, 4_000_000_000.0]] * 3


def test_header_without_what_has_a_default(tmp_path: Path) -> None:
    body = struct.pack("<9f", *np.ravel(POINTS))
    short = header("binary", VERSION=".5", COUNT="", WIDTH="", HEIGHT="", VIEWPOINT="", FIELDS="", COLUMNS="x y z")
    np.testing.assert_array_equal(read_bytes(tmp_path, short + body), POINTS)
    np.testing.assert_array_equal(read_bytes(tmp_path, header("BINARY", POINTS="", TYPE="f f f") + body), POINTS)


def test_viewpoint_moves_the_points_and_places_the_camera(tmp_path: Path) -> None:
    path = tmp_path / "scan.pcd"
    # A quarter turn about z, x to y; the quaternion is not of length one.
    path.write_bytes(header("ascii", VIEWPOINT="0.1 0.2 0.3 2 0 0 2") + b"1 2 3\n0 0 1\n0 0 0\n")
    scan = read_scan(path, units="m")
    np.testing.assert_allclose(scan.points, [[-1900, 1200, 3300], [100, 200, 1300]], atol=1e-3)
    assert scan.viewpoint is not None
    np.testing.assert_allclose(scan.viewpoint, [100, 200, 300])
    assert scan.dropped == 1
    assert scan.points.dtype == np.float32


def test_viewpoint_in_the_map_keeps_float64(tmp_path: Path) -> None:
    path = tmp_path / "scan.pcd"
    path.write_bytes(header("ascii", VIEWPOINT="637012.24 849028.31 431.66 1 0 0 0") + b"1 2 3\n0 0 1\n4 5 6\n")
    points = read_scan(path, units="m").points
    np.testing.assert_allclose(points[0], [637_013_240.0, 849_030_310.0, 434_660.0], rtol=1e-14)


def test_viewpoint_of_a_grid_is_believed_and_that_of_a_heap_only_where_it_says_something(
    tmp_path: Path, grid: FloatArray
) -> None:
    write_pcd(tmp_path / "grid.pcd", grid)
    np.testing.assert_array_equal(read_scan(tmp_path / "grid.pcd").viewpoint, [0, 0, 0])
    write_pcd(tmp_path / "heap.pcd", grid.reshape(-1, 3))
    assert read_scan(tmp_path / "heap.pcd").viewpoint is None


def test_with_a_camera_the_scan_frame_is_the_camera_frame(tmp_path: Path, grid: FloatArray, camera: Camera) -> None:
    write_pcd(tmp_path / "scan.pcd", grid, "binary")
    content = (tmp_path / "scan.pcd").read_bytes()
    (tmp_path / "scan.pcd").write_bytes(content.replace(b"0 0 0 1 0 0 0", b"5 6 7 0 1 0 0"))
    scan = read_scan(tmp_path / "scan.pcd", camera=camera)
    np.testing.assert_array_equal(scan.points, grid)
    np.testing.assert_array_equal(scan.viewpoint, [0, 0, 0])


FLOATS = struct.pack("<9f", *np.ravel(POINTS))


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"WIDTH": "1000000000000", "POINTS": "1000000000000"}, "announces 1000000000000 points .* room for 3 points"),
        ({"WIDTH": "0", "POINTS": "0"}, "announces 0 points"),
        ({"WIDTH": "-3"}, "says WIDTH -3; it should list whole numbers from 0 on"),
        ({"WIDTH": "9" * 30}, "says WIDTH 9999"),
        ({"POINTS": "4"}, "POINTS 4, but WIDTH 3 x HEIGHT 1"),
        ({"HEIGHT": "2"}, "POINTS 3, but WIDTH 3 x HEIGHT 2"),
        ({"SIZE": "4 4"}, "FIELDS, SIZE, TYPE and COUNT of its PCD header differ in length"),
        ({"SIZE": "4 4 0"}, "says SIZE 4 4 0"),
        ({"SIZE": "4 4 3"}, "values of unknown type .F3."),
        ({"TYPE": "F F X"}, "values of unknown type .X4."),
        ({"SIZE": ""}, "has no SIZE"),
        ({"COUNT": "1 1 2"}, "no single value z"),
        ({"COUNT": "1 1 999999999999"}, "no single value z"),
        ({"FIELDS": "a b c"}, "no single value x, y, z .fields: a, b, c."),
        ({"FIELDS": ""}, "differ in length"),
        ({"VIEWPOINT": "0 0 0 0 0 0 0"}, "says VIEWPOINT 0 0 0 0 0 0 0; it should be a translation and a quaternion"),
        ({"VIEWPOINT": "0 0 0 1 0 0"}, "says VIEWPOINT"),
        ({"VIEWPOINT": "0 0 nan 1 0 0 0"}, "says VIEWPOINT"),
        ({"VIEWPOINT": "a b c 1 0 0 0"}, "says VIEWPOINT"),
    ],
)
def test_hostile_headers_are_refused_before_anything_is_allocated(
    tmp_path: Path, entries: dict[str, str], message: str
) -> None:
    with pytest.raises(ScanError, match=message):
        read_bytes(tmp_path, header("binary", **entries) + FLOATS)


def test_unknown_storage_and_no_header(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match="says DATA zipped; known are ascii, binary, binary_compressed"):
        read_bytes(tmp_path, header("zipped") + FLOATS)
    with pytest.raises(ScanError, match="has no PCD header ending in a DATA line"):
        read_bytes(tmp_path, b"\n" * 2_000_000)


def test_hostile_compressed_bodies(tmp_path: Path) -> None:
    head = header("binary_compressed")
    packed = pcd.compress(FLOATS)

    def refused(content: bytes, message: str) -> None:
        with pytest.raises(ScanError, match=message):
            read_bytes(tmp_path, content)

    refused(head + b"\1\0\0", "before its compressed points")
    refused(head + struct.pack("<II", len(packed) + 1, 36) + packed, "it is cut off")
    refused(head + struct.pack("<II", len(packed), 35) + packed, "its header is wrong")
    refused(head + struct.pack("<II", len(packed), 36) + b"\xff" * len(packed), "do not unpack to 3 points")
    refused(head + struct.pack("<II", 5, 36) + pcd.compress(b"1234"), "do not unpack to 3 points")
    many = header("binary_compressed", WIDTH="300000000", POINTS="300000000")
    refused(many + struct.pack("<II", len(packed), 3_600_000_000) + packed, "300000000 points of 12 bytes, but")


def test_compressed_without_the_library_names_the_command_that_installs_it(
    tmp_path: Path, cloud: FloatArray, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_pcd(tmp_path / "scan.pcd", cloud)

    def not_installed(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr(pcd, "import_module", not_installed)
    with pytest.raises(MissingDependencyError, match=r"python-neo-lzf.*pip install 'aadm-workbench\[formats\]'"):
        read_scan(tmp_path / "scan.pcd")


@pytest.mark.parametrize("mode", ["ascii", "binary", "binary_compressed"])
def test_open3d_reads_what_was_written(tmp_path: Path, cloud: FloatArray, mode: str) -> None:
    open3d = pytest.importorskip("open3d")
    path = tmp_path / "scan.pcd"
    write_pcd(path, cloud, mode)
    points = np.asarray(open3d.io.read_point_cloud(str(path)).points)
    np.testing.assert_array_equal(points.astype(np.float32), cloud)


@pytest.mark.parametrize("options", [{"write_ascii": True}, {}, {"compressed": True}])
def test_what_open3d_wrote_is_read(tmp_path: Path, cloud: FloatArray, options: dict[str, bool]) -> None:
    open3d = pytest.importorskip("open3d")
    written = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud.astype(np.float64)))
    written.colors = open3d.utility.Vector3dVector(np.full(cloud.shape, 0.5))
    path = tmp_path / "scan.pcd"
    open3d.io.write_point_cloud(str(path), written, **options)
    np.testing.assert_allclose(read_scan(path).points, cloud, rtol=1e-6, atol=1e-4)


def test_kinect_frame_of_another_program(reference_clouds: Path) -> None:
    path = reference_clouds / "PointCloudLibrary_capture0001.pcd"
    scan = read_scan(path, units="m")
    assert scan.points.shape == (480, 640, 3)
    assert scan.dropped == 307_200 - 249_647
    assert np.isfinite(scan.points).all(axis=-1).sum() == 249_647
    np.testing.assert_array_equal(scan.viewpoint, [0, 0, 0])
    # The file is turned by 180 degrees about x: what lies before the camera has a negative z there, as OpenGL has it.
    assert scan.axes == OPENGL_AXES
    assert np.nanmin(scan.points[..., 2]) > 0

    kinect = Camera(525.0, 525.0, 319.5, 239.5, 640, 480)
    seen = read_scan(path, units="m", camera=kinect)
    np.testing.assert_allclose(seen.points, scan.points, atol=1e-3)
    with pytest.raises(CameraError, match="pixels beside the rays"):
        read_scan(path, units="m", camera=Camera(575.0, 575.0, 319.5, 239.5, 640, 480))


def test_range_scan_of_another_program(reference_clouds: Path) -> None:
    open3d = pytest.importorskip("open3d")
    path = reference_clouds / "PointCloudLibrary_region_growing_tutorial.pcd"
    scan = read_scan(path)
    assert scan.points.shape == (108_104, 3)
    assert scan.points.dtype == np.float32
    np.testing.assert_array_equal(scan.points, np.asarray(open3d.io.read_point_cloud(str(path)).points))
