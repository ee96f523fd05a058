"""Depth maps: step and unit, what is no return, cameras that do not belong, pictures that are no depth map."""

import contextlib
import struct
from pathlib import Path

import cv2
import numpy as np
import pytest

from aadm_workbench.errors import CameraError, ScanError
from aadm_workbench.model import Array, Camera
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_depth_tiff


def exact_points(depth_mm: Array, camera: Camera) -> Array:
    v, u = np.indices(depth_mm.shape)
    x = (u - camera.cx) * depth_mm / camera.fx
    return np.stack([x, (v - camera.cy) * depth_mm / camera.fy, depth_mm], axis=-1)


def test_steps_of_a_tiff_are_exact(tmp_path: Path, camera: Camera, depth_mm: Array) -> None:
    write_depth_tiff(tmp_path / "scan.tiff", depth_mm, 0.02)
    scan = read_scan(tmp_path / "scan.tiff", camera=camera, depth_scale_mm=0.02)
    stepped = np.rint(depth_mm / 0.02) * 0.02
    np.testing.assert_allclose(scan.points, exact_points(stepped, camera), rtol=3e-7)
    assert np.nanmax(np.abs(scan.points[..., 2] - depth_mm)) < 0.0101
    assert scan.points.dtype == np.float32
    assert scan.dropped == 40
    assert scan.camera == camera
    np.testing.assert_array_equal(scan.viewpoint, [0, 0, 0])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(("units", "scale"), [("mm", 1.0), ("m", 1000.0)])
def test_floating_maps_are_in_the_declared_unit(
    tmp_path: Path, camera: Camera, depth_mm: Array, dtype: type[np.floating], units: str, scale: float
) -> None:
    depth_mm[0, :5] = [0.0, -1.0, np.inf, -np.inf, np.nan]
    cv2.imwrite(str(tmp_path / "scan.tif"), (depth_mm / scale).astype(dtype))
    scan = read_scan(tmp_path / "scan.tif", units=units, camera=camera)
    expected = exact_points(depth_mm, camera)
    expected[0, :5] = np.nan
    np.testing.assert_allclose(scan.points, expected, rtol=3e-7)
    assert scan.dropped == 45


def test_png_in_steps(tmp_path: Path, camera: Camera) -> None:
    steps = np.arange(48 * 64, dtype=np.uint16).reshape(48, 64) * 21
    cv2.imwrite(str(tmp_path / "scan.png"), steps)
    scan = read_scan(tmp_path / "scan.png", camera=camera, depth_scale_mm=0.05)
    expected = np.where(steps > 0, steps * 0.05, np.nan)
    np.testing.assert_allclose(scan.points[..., 2], expected, rtol=3e-7)


def test_what_the_camera_must_say(tmp_path: Path, camera: Camera, depth_mm: Array) -> None:
    path = tmp_path / "scan.tiff"
    write_depth_tiff(path, depth_mm, 0.02)
    with pytest.raises(CameraError, match=r"scan\.tiff: a depth map needs its intrinsics; add \[camera\] with fx"):
        read_scan(path)
    with pytest.raises(CameraError, match="an integer depth map needs its step; add depth_scale_mm"):
        read_scan(path, camera=camera)
    turned = Camera(camera.fx, camera.fy, camera.cx, camera.cy, camera.height, camera.width)
    with pytest.raises(CameraError, match=r"the depth map is 64 x 48 pixels, \[camera\] says 48 x 64"):
        read_scan(path, camera=turned, depth_scale_mm=0.02)


@pytest.mark.parametrize(
    ("pixels", "message"),
    [
        (np.full((48, 64, 3), 900, np.uint16), "has 3 channels: it is a picture"),
        (np.full((48, 64), 90, np.uint8), "has 8 bits a pixel: it is a picture"),
        (np.full((48, 64), 900, np.int16), "has pixels of type int16"),
        (np.full((48, 64), 900, np.int32), "has pixels of type int32"),
    ],
)
def test_pictures_that_are_no_depth_map(tmp_path: Path, camera: Camera, pixels: np.ndarray, message: str) -> None:
    cv2.imwrite(str(tmp_path / "scan.tiff"), pixels)
    with pytest.raises(ScanError, match=message):
        read_scan(tmp_path / "scan.tiff", camera=camera, depth_scale_mm=0.02)


@pytest.mark.parametrize("ending", ["tiff", "png"])
def test_every_cut_of_a_picture_is_noticed(tmp_path: Path, camera: Camera, depth_mm: Array, ending: str) -> None:
    path = tmp_path / f"scan.{ending}"
    cv2.imwrite(str(path), np.nan_to_num(depth_mm / 0.02).astype(np.uint16))
    content = path.read_bytes()
    for length in [*range(1, 60, 3), *range(60, len(content) - 12, 211), len(content) - 13]:
        path.write_bytes(content[:length])
        with pytest.raises(ScanError, match="scan"):
            read_scan(path, camera=camera, depth_scale_mm=0.02)


def test_a_picture_of_another_size_is_refused_before_it_is_unpacked(tmp_path: Path, camera: Camera) -> None:
    huge = struct.pack(">4sIIBBBBB", b"IHDR", 1_000_000, 1_000_000, 16, 0, 0, 0, 0)
    (tmp_path / "scan.png").write_bytes(b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + huge + bytes(4))
    with pytest.raises(CameraError, match="1000000 x 1000000 pixels"):
        read_scan(tmp_path / "scan.png", camera=camera, depth_scale_mm=0.02)


@pytest.mark.parametrize(("order", "mark"), [("<", b"II"), (">", b"MM")])
@pytest.mark.parametrize("is_big", [False, True])
def test_sizes_of_all_kinds_of_tiff(tmp_path: Path, camera: Camera, order: str, mark: bytes, is_big: bool) -> None:
    entries = [(256, 3, 70_000 % 65_536), (257, 4, 70_000)]
    if is_big:
        head = mark + struct.pack(f"{order}HHHQQ", 43, 8, 0, 16, len(entries))
        rows = [struct.pack(f"{order}HHQ", tag, kind, 1) for tag, kind, _ in entries]
        values = [struct.pack(f"{order}{'HxxxxxxI'[:7] if kind == 3 else 'I4x'}", value) for _, kind, value in entries]
    else:
        head = mark + struct.pack(f"{order}HIH", 42, 8, len(entries))
        rows = [struct.pack(f"{order}HHI", tag, kind, 1) for tag, kind, _ in entries]
        values = [struct.pack(f"{order}{'Hxx' if kind == 3 else 'I'}", value) for _, kind, value in entries]
    content = head + b"".join(row + value for row, value in zip(rows, values, strict=True))
    (tmp_path / "scan.tif").write_bytes(content)
    with pytest.raises(CameraError, match="4464 x 70000 pixels"):
        read_scan(tmp_path / "scan.tif", camera=camera)


def test_depths_that_do_not_fit_name_a_step_that_does(tmp_path: Path) -> None:
    depth_mm = np.full((8, 8), 1535.0)
    with pytest.raises(ScanError, match=r"take a depth_scale_mm of 0\.0235 or more"):
        write_depth_tiff(tmp_path / "scan.tiff", depth_mm, 0.02)
    assert not list(tmp_path.iterdir())
    write_depth_tiff(tmp_path / "scan.tiff", depth_mm, 0.0235)


def test_the_map_is_packed_to_less_than_half(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    flat = 900.0 + rng.normal(0.0, 0.1, (300, 400))
    slanted = flat + np.add.outer(0.4 * np.arange(300), 0.6 * np.arange(400))
    for name, depth_mm in (("flat", flat), ("slanted", slanted)):
        write_depth_tiff(tmp_path / f"{name}.tiff", depth_mm, 0.02)
        assert (tmp_path / f"{name}.tiff").stat().st_size < 0.5 * 2 * depth_mm.size


@pytest.mark.parametrize("ending", ["tiff", "png"])
def test_damaged_pictures_never_escape_as_another_error(
    tmp_path: Path, camera: Camera, depth_mm: Array, ending: str
) -> None:
    path = tmp_path / f"scan.{ending}"
    cv2.imwrite(str(path), np.nan_to_num(depth_mm / 0.02).astype(np.uint16))
    content = path.read_bytes()
    rng = np.random.default_rng(8)
    for _ in range(150):
        damaged = bytearray(content)
        for position in rng.integers(-200, 200, 3):
            damaged[position] = rng.integers(0, 256)
        path.write_bytes(bytes(damaged))
        with contextlib.suppress(ScanError, CameraError):
            assert read_scan(path, camera=camera, depth_scale_mm=0.02).points.shape == (48, 64, 3)
