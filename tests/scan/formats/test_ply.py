"""PLY: both byte orders, text, other properties and elements, hostile headers, and what other programs make of it."""

import struct
from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import ScanError
from aadm_workbench.model import FloatArray
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_ply

POINTS = [(1.5, -2.25, 1000.125), (4.0, 5.5, 900.75), (-7.0, 8.0, 950.0)]
ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}


def read_bytes(tmp_path: Path, content: bytes, units: str = "mm") -> FloatArray:
    path = tmp_path / "scan.ply"
    path.write_bytes(content)
    return read_scan(path, units=units).points


@pytest.mark.parametrize("encoding", ORDERS)
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
@pytest.mark.parametrize(("kind", "code"), [("float", "f"), ("double", "d"), ("float32", "f"), ("float64", "d")])
def test_binary_with_other_properties_in_any_order(
    tmp_path: Path, encoding: str, line_end: str, kind: str, code: str
) -> None:
    header = [
        *("ply", f"format {encoding} 1.0", "comment made by hand", "obj_info num_cols 3", "element vertex 3"),
        *("property uchar red", f"property {kind} z", "property double time", f"property {kind} x"),
        *("property ushort snr", f"property {kind} y", "end_header", ""),
    ]
    rows = [struct.pack(f"{ORDERS[encoding]}B{code}d{code}H{code}", 255, z, 0.5, x, 7, y) for x, y, z in POINTS]
    points = read_bytes(tmp_path, line_end.join(header).encode() + b"".join(rows))
    np.testing.assert_array_equal(points, POINTS)
    assert points.dtype == (np.float32 if code == "f" else np.float64)


@pytest.mark.parametrize("encoding", ORDERS)
def test_mixed_and_integer_coordinates_lose_nothing(tmp_path: Path, encoding: str) -> None:
    header = f"ply\nformat {encoding} 1.0\nelement vertex 1\nproperty int x\nproperty short y\nproperty float z\n"
    row = struct.pack(f"{ORDERS[encoding]}ihf", 16_777_217, -300, 0.5)
    points = read_bytes(tmp_path, f"{header}end_header\n".encode() + row)
    assert points.tolist() == [[16_777_217.0, -300.0, 0.5]]


@pytest.mark.parametrize("encoding", ORDERS)
def test_lists_before_and_behind_the_vertices(tmp_path: Path, encoding: str) -> None:
    order = ORDERS[encoding]
    header = (
        f"ply\nformat {encoding} 1.0\nelement camera 2\nproperty float f\nproperty uchar id\n"
        "element face 3\nproperty list ushort int vertex_indices\nproperty uchar flag\nproperty list char double w\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element edge 1\nproperty list uchar int ends\nend_header\n"
    )
    before = struct.pack(f"{order}fBfB", 1.0, 1, 2.0, 2)
    for length in (3, 0, 5):
        before += struct.pack(f"{order}H{length}iBb1d", length, *range(length), 9, 1, 0.25)
    rows = b"".join(struct.pack(f"{order}3f", *point) for point in POINTS)
    behind = struct.pack(f"{order}B2i", 2, 0, 1)
    content = header.encode() + before + rows
    np.testing.assert_array_equal(read_bytes(tmp_path, content + behind), POINTS)
    np.testing.assert_array_equal(read_bytes(tmp_path, content), POINTS)
    with pytest.raises(ScanError, match="room for 2 points"):
        read_bytes(tmp_path, content[:-1])
    with pytest.raises(ScanError, match="of its element 'face' runs past the end"):
        read_bytes(tmp_path, content[: len(header) + 20])


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_text_with_other_elements_and_line_ends(tmp_path: Path, line_end: str) -> None:
    lines = [
        *("ply", "format ascii 1.0", "element face 2", "property list uchar int vertex_indices"),
        *("element vertex 3", "property double Y", "property uchar red", "property double X", "property double Z"),
        *("element edge 1", "property int a", "end_header", "3 0 1 2", "4 0 1 2 2"),
        *[f"{y!r} 17 {x!r} {z!r}" for x, y, z in POINTS],
        *("5", ""),
    ]
    points = read_bytes(tmp_path, line_end.join(lines).encode())
    np.testing.assert_array_equal(points, POINTS)


def test_text_declared_float_keeps_map_coordinates(tmp_path: Path) -> None:
    header = (
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
    )
    points = read_bytes(tmp_path, f"{header}637012.24 849028.31 431.66\n".encode(), units="m")
    np.testing.assert_allclose(points, [[637_012_240.0, 849_028_310.0, 431_660.0]], rtol=1e-15)


TEXT = "format ascii 1.0\n"
BINARY = "format binary_little_endian 1.0\n"
XYZ = "property float x\nproperty float y\nproperty float z\n"


@pytest.mark.parametrize(
    ("header", "body", "message"),
    [
        (f"{TEXT}element vertex 3\n{XYZ}", b"1 2 3\n4 5 6\n", "announces 3 points of at least 6 bytes"),
        (f"{TEXT}element vertex 3\n{XYZ}", b"1 2 3\n4 5 6.000000\n\n", "after 2 of them the file ends"),
        (
            f"{TEXT}element vertex 2\n{XYZ}",
            b"1 2 3.00\n4 5\n",
            "line 9 should begin with 3 numbers, but reads '4 5'",
        ),
        (f"{TEXT}element vertex 2\n{XYZ}", b"1 2 3\n4 x 5\n", "line 9 should begin .* reads '4 x 5'"),
        (f"{TEXT}element vertex 1000000000000\n{XYZ}", b"1 2 3\n", "announces 1000000000000 points"),
        (
            f"{BINARY}element vertex 1000000000000\n{XYZ}",
            bytes(24),
            "of at least 12 bytes from byte 127 on, but the file has 151 bytes, room for 2 points",
        ),
        (f"{BINARY}element vertex 0\n{XYZ}", b"", "announces 0 points"),
        (
            f"{BINARY}element vertex -5\n{XYZ}",
            b"",
            "line 3 .* makes no sense: 'element vertex -5'",
        ),
        (f"{BINARY}element vertex {'9' * 5000}\n{XYZ}", b"", "line 3 .* makes no sense"),
        (f"format binary_middle_endian 1.0\nelement vertex 1\n{XYZ}", b"", "line 2 .* makes no sense"),
        (f"element vertex 1\n{XYZ}", bytes(12), "has no format line"),
        (f"{TEXT}property float x\n", b"", "line 3 .* makes no sense: 'property float x'"),
        (f"{TEXT}element vertex 1\nproperty float128 x\n", b"", "line 4 .* makes no sense"),
        (f"{TEXT}element vertex 1\nproperty list float int x\n", b"", "line 4 .* makes no sense"),
        (f"{TEXT}element vertex 1\nproperty list uchar float x\n", b"0\n", "have a list property"),
        (f"{TEXT}element vertex 1\nproperty float x\nproperty float nx\n", b"1 2\n", "no property y, z"),
        (f"{TEXT}element face 1\nproperty int a\n", b"1\n", 'no element "vertex"'),
        (f"{TEXT}element face 7\nelement vertex 1\n{XYZ}", b"1\n", "ends within its element 'face'"),
        (
            f"{BINARY}element face 999999999999\nproperty list int int i\nelement vertex 1\n{XYZ}",
            b"\xff" * 40,
            "999999999999 rows of its element .face. stand before its points",
        ),
        (
            f"format binary_big_endian 1.0\nelement face 99999999999999\nelement vertex 1\n{XYZ}",
            b"",
            "room for 0 points",
        ),
    ],
)
def test_hostile_headers_are_refused_before_anything_is_allocated(
    tmp_path: Path, header: str, body: bytes, message: str
) -> None:
    with pytest.raises(ScanError, match=message):
        read_bytes(tmp_path, f"ply\n{header}end_header\n".encode() + body)


def test_header_without_end(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match="has no end_header"):
        read_bytes(tmp_path, b"ply\n" + b"comment x\n" * 200_000)
    with pytest.raises(ScanError, match='does not begin with "ply"'):
        read_bytes(tmp_path, b"plyers\nend_header\n")


@pytest.mark.parametrize("binary", [True, False])
def test_open3d_and_trimesh_read_what_was_written(tmp_path: Path, cloud: FloatArray, binary: bool) -> None:
    open3d = pytest.importorskip("open3d")
    trimesh = pytest.importorskip("trimesh")
    path = tmp_path / "scan.ply"
    write_ply(path, cloud, binary=binary)
    for points in (open3d.io.read_point_cloud(str(path)).points, trimesh.load(path).vertices):
        np.testing.assert_array_equal(np.asarray(points).astype(np.float32), cloud)


@pytest.mark.parametrize("as_text", [True, False])
def test_what_open3d_wrote_is_read(tmp_path: Path, cloud: FloatArray, as_text: bool) -> None:
    open3d = pytest.importorskip("open3d")
    written = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(cloud.astype(np.float64)))
    written.colors = open3d.utility.Vector3dVector(np.full(cloud.shape, 0.5))
    path = tmp_path / "scan.ply"
    open3d.io.write_point_cloud(str(path), written, write_ascii=as_text)
    scan = read_scan(path)
    assert scan.points.dtype == np.float64
    # As text it writes six digits.
    np.testing.assert_allclose(scan.points, cloud, rtol=5e-6 if as_text else 0)


def test_a_mesh_in_inches_of_another_program(reference_clouds: Path) -> None:
    scan = read_scan(reference_clouds / "mikedh_featuretype.ply")
    assert scan.points.shape == (5096, 3)
    np.testing.assert_allclose(np.ptp(scan.points, axis=0), [5.0, 2.5, 1.375], rtol=1e-6)


@pytest.mark.parametrize("first", ["ply ", "ply\t", "\ufeffply", "\ufeffply  "])
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_first_lines_as_careless_programs_write_them(tmp_path: Path, first: str, line_end: str) -> None:
    lines = [first, "format ascii 1.0 ", "element vertex 3", *(f"property float {axis} " for axis in "xyz")]
    rows = [f"{x} {y} {z}" for x, y, z in POINTS]
    content = line_end.join([*lines, "end_header", *rows, ""]).encode()
    np.testing.assert_array_equal(read_bytes(tmp_path, content), POINTS)
    binary = content[: content.index(b"end_header")].replace(b"ascii", b"binary_little_endian")
    body = b"".join(struct.pack("<3f", *point) for point in POINTS)
    np.testing.assert_array_equal(read_bytes(tmp_path, binary + b"end_header" + line_end.encode() + body), POINTS)


@pytest.mark.parametrize("first", ["ply2", "plyx y", "pl y", "PLy\0"])
def test_first_lines_of_something_else(tmp_path: Path, first: str) -> None:
    with pytest.raises(ScanError, match='does not begin with "ply"'):
        read_bytes(tmp_path, f"{first}\nformat ascii 1.0\n".encode())
