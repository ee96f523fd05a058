"""NumPy archives: both arrays, all number types, and archives that must not be unpacked."""

import io
import struct
import zipfile
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

from aadm_workbench.errors import CameraError, ScanError
from aadm_workbench.model import Array, Camera, FloatArray
from aadm_workbench.scan.read import read_scan


@pytest.mark.parametrize("dtype", ["<f2", ">f4", "<f8", ">f8", "<i2", ">i4", "u1", "<u8"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_number_types_and_memory_orders(tmp_path: Path, dtype: str, order: Literal["C", "F"]) -> None:
    points = np.arange(1, 121).reshape(40, 3).astype(np.dtype(dtype), order=order)
    np.savez(tmp_path / "scan.npz", points=points, other=np.zeros(3))
    scan = read_scan(tmp_path / "scan.npz")
    np.testing.assert_array_equal(scan.points, np.arange(1, 121).reshape(40, 3))
    assert scan.points.dtype in (np.float32, np.float64)
    assert scan.points.flags.c_contiguous


def test_depth_goes_with_the_camera(tmp_path: Path, camera: Camera, depth_mm: Array, grid: FloatArray) -> None:
    path = tmp_path / "scan.npz"
    np.savez_compressed(path, depth=depth_mm / 1000)
    scan = read_scan(path, camera=camera, units="m")
    np.testing.assert_allclose(scan.points, grid, rtol=2e-7)
    assert scan.dropped == 40
    np.savez_compressed(path, depth=np.nan_to_num(depth_mm / 0.5).round().astype(np.uint16))
    scan = read_scan(path, camera=camera, depth_scale_mm=0.5)
    np.testing.assert_allclose(scan.points[..., 2], depth_mm, atol=0.2501)
    with pytest.raises(CameraError, match=r"add \[camera\] with fx, fy, cx, cy, width = 64 and height = 48"):
        read_scan(path)


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"cloud": np.ones((5, 3))}, r'has no array "points" or "depth" \(only cloud.npy\)'),
        ({"points": np.ones((5, 4))}, r"shape \(5, 4\), but must be numbers of shape \(n, 3\) or \(h, w, 3\)"),
        ({"points": np.ones(3)}, r"shape \(3,\)"),
        ({"points": np.ones((2, 2, 2, 3))}, "but must be"),
        ({"points": np.ones((5, 3), complex)}, "is complex128"),
        ({"points": np.array([["a", "b", "c"]])}, "is <U1"),
        ({"points": np.array([[None, 1, 2]], dtype=object)}, "is object"),
        ({"points": np.ones((0, 3))}, "has 0 of 0 bytes"),
        ({"depth": np.ones((4, 5, 3))}, r"must be numbers of shape \(h, w\)"),
    ],
)
def test_arrays_that_are_no_points(tmp_path: Path, arrays: dict[str, Any], message: str) -> None:
    np.savez(tmp_path / "scan.npz", **arrays)
    with pytest.raises(ScanError, match=message):
        read_scan(tmp_path / "scan.npz")


def npy_header(shape: str) -> bytes:
    text = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}}}".ljust(117) + "\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text.encode()


@pytest.mark.parametrize(
    ("member", "message"),
    [
        (npy_header("(1000000000000, 3)"), "is larger than any scan"),
        (npy_header("(30000000, 3)") + bytes(30), "has 30 of 360000000 bytes"),
        (npy_header("(-5, 3)"), "points"),
        (npy_header("(5, 'x')"), "has no header that can be read"),
        (npy_header("(5, 3").replace(b"}", b" "), "has no header that can be read"),
        (b"\x93NUMPY\7\0" + bytes(200), "has no header that can be read"),
        (b"", "has no header that can be read"),
    ],
)
def test_hostile_members(tmp_path: Path, member: bytes, message: str) -> None:
    with zipfile.ZipFile(tmp_path / "scan.npz", "w") as archive:
        archive.writestr("points.npy", member)
    with pytest.raises(ScanError, match=message):
        read_scan(tmp_path / "scan.npz")


def test_a_bomb_is_unpacked_no_further_than_its_header_says(tmp_path: Path) -> None:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("points.npy", npy_header("(4, 3)") + b"\x3f" * 50_000_000)
    (tmp_path / "scan.npz").write_bytes(stream.getvalue())
    assert len(read_scan(tmp_path / "scan.npz").points) == 4


def test_every_cut_of_an_archive_is_noticed(tmp_path: Path, cloud: FloatArray) -> None:
    np.savez_compressed(tmp_path / "whole.npz", points=cloud)
    content = (tmp_path / "whole.npz").read_bytes()
    for length in range(1, len(content), 97):
        (tmp_path / "cut.npz").write_bytes(content[:length])
        with pytest.raises(ScanError, match=r"cut\.npz: is damaged"):
            read_scan(tmp_path / "cut.npz")
    damaged = bytearray(content)
    damaged[len(content) // 2] ^= 0xFF
    (tmp_path / "cut.npz").write_bytes(bytes(damaged))
    with pytest.raises(ScanError, match="is damaged"):
        read_scan(tmp_path / "cut.npz")
