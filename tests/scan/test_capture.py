"""The folder of one capture: which file is the scan, whose intrinsics hold, what makes it ambiguous."""

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from aadm_workbench.errors import CameraError, ScanError
from aadm_workbench.model import Array, Camera, FloatArray
from aadm_workbench.scan.read import read_scan
from aadm_workbench.scan.write import write_depth_tiff, write_ply

Intrinsics = Callable[[Camera], tuple[str, str]]


def json_of(camera: Camera) -> tuple[str, str]:
    names = ("fx", "fy", "cx", "cy", "width", "height")
    return "intri.json", json.dumps({"depth": {name: getattr(camera, name) for name in names}})


def matrix_of(camera: Camera) -> tuple[str, str]:
    rows = f"[{camera.fx}, 0, {camera.cx}]\n[0, {camera.fy}, {camera.cy}]\n[0, 0, 1]\n"
    return "CameraIntrinsics.txt", f"Depth Camera Matrix:\n{rows}width: {camera.width}, height: {camera.height}\n"


def old_order_of(camera: Camera) -> tuple[str, str]:
    rows = f"[{camera.fx}, {camera.fy}\n{camera.cx}, {camera.cy}]\n"
    return "intrinsics.txt", f"name: DepthMatrix\n{rows}width: {camera.width}, height: {camera.height}\n"


def yaml_of(camera: Camera) -> tuple[str, str]:
    numbers = f"[{camera.fx}, 0., {camera.cx}, 0.,\n    {camera.fy}, {camera.cy}, 0., 0., 1.]"
    text = (
        f"image_width: {camera.width}\nimage_height: {camera.height}\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
        f"  data: {numbers}\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0., 0., 0., 0., 0.]\n"
    )
    return "calibration.yaml", text


def xml_of(camera: Camera) -> tuple[str, str]:
    numbers = f"{camera.fx} 0. {camera.cx} 0. {camera.fy} {camera.cy} 0. 0. 1."
    text = (
        f'<?xml version="1.0"?><opencv_storage><image_width>{camera.width}</image_width>'
        f'<image_height>{camera.height}</image_height><M type_id="opencv-matrix"><rows>3</rows><cols>3</cols>'
        f"<dt>d</dt><data>{numbers}</data></M></opencv_storage>"
    )
    return "camera.xml", text


@pytest.fixture
def folder(tmp_path: Path, depth_mm: Array) -> Path:
    path = tmp_path / "C-301-foot"
    path.mkdir()
    write_depth_tiff(path / "DepthMap.tiff", depth_mm, 0.02)
    cv2.imwrite(str(path / "2DImage.png"), np.full((48, 64, 3), 77, np.uint8))
    (path / "readme.txt").write_text("taken by Li Wei\n")
    return path


@pytest.mark.parametrize("intrinsics", [json_of, matrix_of, old_order_of, yaml_of, xml_of])
def test_depth_map_with_its_intrinsics_and_its_picture(
    folder: Path, camera: Camera, grid: FloatArray, intrinsics: Intrinsics
) -> None:
    name, text = intrinsics(camera)
    (folder / name).write_text(text)
    scan = read_scan(folder, depth_scale_mm=0.02, source="scans/C-301-foot")
    np.testing.assert_allclose(scan.points, grid, rtol=0, atol=0.02)
    assert (scan.camera, scan.source, scan.dropped) == (camera, "scans/C-301-foot", 40)
    assert scan.image is not None
    assert (scan.image == 77).all()
    assert f"intrinsics from {name}" in scan.notes


def test_the_hash_is_of_all_files_that_count(folder: Path, camera: Camera) -> None:
    name, text = json_of(camera)
    (folder / name).write_text(text)
    hashes = {read_scan(folder, depth_scale_mm=0.02).sha256}
    (folder / "readme.txt").write_text("taken by Wang Fang\n")
    hashes.add(read_scan(folder, depth_scale_mm=0.02).sha256)
    assert len(hashes) == 1
    (folder / name).write_text(text + "\n")
    hashes.add(read_scan(folder, depth_scale_mm=0.02).sha256)
    cv2.imwrite(str(folder / "2DImage.png"), np.zeros((48, 64), np.uint8))
    hashes.add(read_scan(folder, depth_scale_mm=0.02).sha256)
    assert len(hashes) == 3


def test_the_jobs_camera_where_the_folder_has_none(folder: Path, camera: Camera) -> None:
    assert read_scan(folder, camera=camera, depth_scale_mm=0.02).camera == camera


def test_intrinsics_that_contradict_the_job(folder: Path, camera: Camera) -> None:
    name, text = json_of(camera)
    (folder / name).write_text(text)
    close = Camera(camera.fx, camera.fy, camera.cx + 0.5, camera.cy, camera.width, camera.height, 2e-4)
    assert read_scan(folder, camera=close, depth_scale_mm=0.02).camera == close
    other = Camera(camera.fx * 2, camera.fy * 2, camera.cx, camera.cy, camera.width, camera.height)
    with pytest.raises(CameraError, match=r"intri\.json beside the scan holds other intrinsics than \[camera\]"):
        read_scan(folder, camera=other, depth_scale_mm=0.02)


def test_two_files_of_intrinsics(folder: Path, camera: Camera) -> None:
    texture = Camera(camera.fx * 2, camera.fy * 2, camera.cx * 2, camera.cy * 2, camera.width * 2, camera.height * 2)
    (folder / "a.json").write_text(json_of(camera)[1])
    (folder / "b.json").write_text(json_of(texture)[1])
    with pytest.raises(CameraError, match=r"a\.json and b\.json in one folder hold different intrinsics"):
        read_scan(folder, depth_scale_mm=0.02)
    (folder / "a.json").rename(folder / "depth_intrinsics.json")
    assert read_scan(folder, depth_scale_mm=0.02).camera == camera


def test_the_step_of_a_depth_map_beside_it(folder: Path, camera: Camera, grid: FloatArray) -> None:
    name, text = json_of(camera)
    (folder / name).write_text(text.replace('"fx"', '"depth_scale_mm": 0.02, "fx"'))
    np.testing.assert_allclose(read_scan(folder).points, grid, rtol=0, atol=0.02)


def test_a_picture_of_another_size_is_left_out(folder: Path, camera: Camera) -> None:
    cv2.imwrite(str(folder / "2DImage.png"), np.zeros((96, 128), np.uint8))
    scan = read_scan(folder, camera=camera, depth_scale_mm=0.02)
    assert scan.image is None
    assert any("2DImage.png is left out" in note for note in scan.notes)


def test_the_cloud_where_there_is_no_depth_map_or_nothing_to_read_it_with(folder: Path, grid: FloatArray) -> None:
    write_ply(folder / "PointCloud.ply", grid)
    write_ply(folder / "TexturedPointCloud.ply", grid)
    (folder / "TexturedPointCloud.ply").unlink()
    scan = read_scan(folder)
    assert scan.dropped == 40
    assert any("PointCloud.ply was taken: DepthMap.tiff has no intrinsics" in note for note in scan.notes)
    (folder / "DepthMap.tiff").unlink()
    assert read_scan(folder).points.shape == (48 * 64 - 40, 3)


def test_the_plain_cloud_goes_before_the_textured_one(tmp_path: Path, grid: FloatArray) -> None:
    write_ply(tmp_path / "PointCloud.ply", grid)
    write_ply(tmp_path / "TexturedPointCloud.ply", grid[:, :40])
    assert len(read_scan(tmp_path).points) == 48 * 64 - 40


def test_folders_that_are_no_capture(folder: Path, camera: Camera, grid: FloatArray) -> None:
    (folder / "empty").mkdir()
    with pytest.raises(ScanError, match="C-301-foot: is a folder without a scan in it"):
        read_scan(folder / "empty", source="C-301-foot")
    (folder / "DepthMap_2.tiff").write_bytes((folder / "DepthMap.tiff").read_bytes())
    with pytest.raises(ScanError, match=r"holds several scans \(DepthMap\.tiff, DepthMap_2\.tiff\)"):
        read_scan(folder, camera=camera)
    for number in range(1001):
        (folder / f"{number}.bin").touch()
    with pytest.raises(ScanError, match="holds more than 1000 files"):
        read_scan(folder, camera=camera)


def test_a_depth_map_without_intrinsics_says_so(folder: Path) -> None:
    with pytest.raises(CameraError, match=r"C-301-foot/DepthMap\.tiff: a depth map needs its intrinsics"):
        read_scan(folder, depth_scale_mm=0.02)


@pytest.mark.parametrize(
    "text", ["{fx} 0 {cx}\n0 {fy} {cy}\n0 0 1\n", "fx: {fx}\nfy: {fy}\ncx: {cx}\ncy: {cy}\n", "{fx} {fy} {cx} {cy}\n"]
)
def test_intrinsics_without_a_size_are_of_the_size_of_the_depth_map(folder: Path, camera: Camera, text: str) -> None:
    numbers = {name: getattr(camera, name) for name in ("fx", "fy", "cx", "cy")}
    (folder / "K.txt").write_text(text.format(**numbers))
    assert read_scan(folder, depth_scale_mm=0.02).camera == camera


def test_a_coloured_view_of_the_depth_map_is_no_second_one(folder: Path, camera: Camera) -> None:
    cv2.imwrite(str(folder / "depth_color.png"), np.zeros((48, 64, 3), np.uint8))
    cv2.imwrite(str(folder / "depth_preview.png"), np.zeros((48, 64, 3), np.uint8))
    assert read_scan(folder, camera=camera, depth_scale_mm=0.02).organised


CAMERA_INFO = (
    "height: 48\nwidth: 64\nD: [-0.08, 0.12, 0.0, 0.0, 0.0]\nK: [80.0, 0.0, 30.5, 0.0, 81.0, 25.25, 0.0, 0.0, 1.0]\n"
)


def test_a_bent_lens_beside_a_depth_map_is_an_error_whatever_the_job_declares(
    folder: Path, camera: Camera, grid: FloatArray
) -> None:
    (folder / "camera_info.yaml").write_text(CAMERA_INFO)
    for declared in (None, camera):
        with pytest.raises(CameraError, match=r"camera_info\.yaml: has distortion coefficients \[-0\.08"):
            read_scan(folder, camera=declared, depth_scale_mm=0.02)
    write_ply(folder / "PointCloud.ply", grid)
    scan = read_scan(folder)
    assert len(scan.points) == 48 * 64 - 40 or scan.organised
    assert any("PointCloud.ply was taken" in note and "distortion" in note for note in scan.notes)


def test_a_bent_lens_of_the_texture_camera_does_not_matter(folder: Path, camera: Camera) -> None:
    (folder / "color_info.yaml").write_text(CAMERA_INFO)
    name, text = json_of(camera)
    (folder / name).write_text(text)
    assert read_scan(folder, depth_scale_mm=0.02).camera == camera


def test_why_intrinsics_beside_a_depth_map_were_not_understood_is_said(folder: Path) -> None:
    (folder / "intrinsics.txt").write_text("fx = 80, fy = 81, cx = 30.5")
    with pytest.raises(CameraError, match=r"needs its intrinsics.*intrinsics\.txt was not understood.*no fx, fy, cx"):
        read_scan(folder, depth_scale_mm=0.02)
