"""The pinhole camera: points from depths, and intrinsics as files and SDKs write them."""

from pathlib import Path

import numpy as np
import pytest

from aadm_workbench.errors import CameraError, ScanError
from aadm_workbench.model import Camera
from aadm_workbench.scan.camera import depth_to_points, projected, read_camera

PRO_M = Camera(2425.4796, 2425.3285, 959.7418, 632.7028, 1920, 1200)


def test_published_check_point_of_a_real_camera() -> None:
    depth_mm = np.zeros((1200, 1920), np.float32)
    depth_mm[222, 222] = 1230.2920
    points = depth_to_points(depth_mm, PRO_M)
    np.testing.assert_allclose(points[222, 222], [-374.2097, -208.3364, 1230.2920], atol=2e-4)
    assert np.isfinite(points).sum() == 3


def test_points_project_back_on_their_pixels(camera: Camera) -> None:
    depth_mm = np.random.default_rng(2).uniform(500, 2000, (48, 64))
    pixels = projected(depth_to_points(depth_mm, camera).reshape(-1, 3), camera)
    v, u = np.indices((48, 64))
    np.testing.assert_allclose(pixels, np.stack([u.ravel(), v.ravel()], axis=-1), atol=1e-4)


EXPECTED = Camera(2425.48, 2425.33, 959.74, 632.70, 1920, 1200)

ROWS = """Texture Camera Matrix:
    [4850.96, 0, 1919.48]
    [0, 4850.66, 1265.4]
    [0, 0, 1]

Texture Camera Distortion Coefficients:
    k1: 0.1, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0

Depth Camera Matrix:
    [2425.48, 0, 959.74]
    [0, 2425.33, 632.70]
    [0, 0, 1]

Depth Camera Distortion Coefficients:
    k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0

Rotation: From Depth Camera to Texture Camera:
    [1.0, 0.0, 0.0]
    [0.0, 1.0, 0.0]
    [0.0, 0.0, 1.0]

Translation From Depth Camera to Texture Camera:
    X: 0.0mm, Y: 0.0mm, Z: 0.0mm

Texture map size : (width : 3840, height : 2400).
Depth map size   : (width : 1920, height : 1200).
"""

PAIRS = """CameraDistCoeffs: k1: 0.5, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0
DepthDistCoeffs: k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0
name: CameraMatrix
[4850.96, 4850.66
1919.48, 1265.4]
name: DepthMatrix
[2425.48, 2425.33
959.74, 632.70]
width: 1920, height: 1200
"""


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.toml", "fx = 2425.48\nfy = 2425.33\ncx = 959.74\ncy = 632.70\nwidth = 1920\nheight = 1200\n"),
        ("a.toml", "[camera]\nfx=2425.48\nfy=2425.33\ncx=959.74\ncy=632.7\nwidth=1920\nheight=1200\nk1 = 0.0\n"),
        (
            "a.json",
            """{"width": 1920, "height": 1200, "texture": {"fx": 1e3, "fy": 1e3, "cx": 1, "cy": 2, "k1": 0.2},
                "depth": {"FX": 2425.48, "FY": 2425.33, "CX": 959.74, "CY": 632.70}}""",
        ),
        ("a.json", '{"image_width": 1920, "image_height": 1200, "K": [2425.48,0,959.74, 0,2425.33,632.70, 0,0,1]}'),
        (
            "a.json",
            """{"width": 1920, "height": 1200, "camera_matrix": [[2425.48,0,959.74],[0,2425.33,632.70],[0,0,1]],
                "dist_coeffs": [0, 0.0, 0]}""",
        ),
        ("a.json", '{"width":1920,"height":1200,"intrinsic_matrix":[2425.48,0,0, 0,2425.33,0, 959.74,632.70,1]}'),
        ("a.txt", ROWS),
        ("a.txt", PAIRS),
        ("a.txt", "[2425.48, 2425.33; 959.74, 632.70]\nwidth: 1920, height: 1200\n"),
        ("a.txt", "depth: [2425.48 0 959.74; 0 2425.33 632.70; 0 0 1]\r\nwidth = 1920\r\nheight = 1200\r\n"),
        ("a.txt", "2425.48 0 959.74\n0 2425.33 632.70\n0 0 1\nwidth 1920 height 1200\n"),
        (
            "a.yml",
            "CameraMatrix:\n  CX: 959.74\n  CY: 632.70\n  FX: 2425.48\n  FY: 2425.33\nwidth: 1920\nheight: 1200\n",
        ),
    ],
)
def test_all_ways_of_writing_the_same_camera(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    assert read_camera(tmp_path / name) == EXPECTED


def test_scale_error_of_a_job(tmp_path: Path) -> None:
    keys = "fx = 2000\nfy = 2000\ncx = 960\ncy = 600\nwidth = 1920\nheight = 1200\nscale_error = 2e-4\n"
    (tmp_path / "camera.toml").write_text(keys)
    assert read_camera(tmp_path / "camera.toml") == Camera(2000, 2000, 960, 600, 1920, 1200, 2e-4)


KEYS = {"fx": "2000", "fy": "2000", "cx": "960", "cy": "600", "width": "1920", "height": "1200"}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"fx": ""}, "holds no fx, fy, cx and cy"),
        ({"fx": "'2000'"}, "has fx = '2000', which is no number"),
        ({"fx": "-2000"}, "focal lengths fx = -2000.0"),
        ({"fy": "nan"}, "focal lengths"),
        ({"fy": "inf"}, "focal lengths"),
        ({"width": ""}, "does not say how large the depth map is"),
        ({"width": "1920.5"}, "has width = 1920.5; it must be a whole number"),
        ({"height": "-1"}, "has height = -1"),
        ({"width": "640", "height": "480"}, r"centre \(cx, cy\) = \(960.0, 600.0\) outside of its 640 x 480 pixels"),
        ({"k1": "-0.27"}, r"distortion coefficients \[-0.27\]"),
        ({"fx": "2000 ="}, "is no valid TOML"),
    ],
)
def test_what_cannot_be_a_camera(tmp_path: Path, changes: dict[str, str], message: str) -> None:
    lines = [f"{key} = {value}" for key, value in (KEYS | changes).items() if value]
    (tmp_path / "camera.toml").write_text("\n".join(lines))
    with pytest.raises(CameraError, match=rf"camera\.toml: .*{message}"):
        read_camera(tmp_path / "camera.toml")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (ROWS.replace("Depth", "Other"), "describes cameras that differ, and none is called depth"),
        (PAIRS.replace("width: 1920, height: 1200", ""), "does not say how large"),
        (ROWS.replace("k1: 0.0", "k1: -0.3"), "distortion coefficients"),
        ("hello", "holds no fx"),
        ("[1, 0, 0]\n[0, 1, 0]\n[0, 0, 1]\n", "holds no fx"),
    ],
)
def test_text_that_describes_no_one_camera(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "camera.txt").write_text(text)
    with pytest.raises(CameraError, match=message):
        read_camera(tmp_path / "camera.txt")


def test_camera_file_that_is_absent_or_broken(tmp_path: Path) -> None:
    with pytest.raises(ScanError, match="there is no such file"):
        read_camera(tmp_path / "absent.toml")
    (tmp_path / "camera.json").write_text('{"fx": ')
    with pytest.raises(CameraError, match="is no valid JSON"):
        read_camera(tmp_path / "camera.json")
    (tmp_path / "list.json").write_text("[1, 2]")
    with pytest.raises(CameraError, match="holds no fx"):
        read_camera(tmp_path / "list.json")


OPENCV_YAML = """%YAML:1.0
---
image_width: 1920
image_height: 1200
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 2425.48, 0., 959.74, 0.,
       2425.33, 632.70, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ 0., 0., 0., 0., 0. ]
"""
XML = """<?xml version="1.0"?>
<opencv_storage><image_width>1920</image_width><image_height>1200</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt>
<data>2425.48 0. 959.74 0. 2425.33 632.70 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>5</rows><cols>1</cols><dt>d</dt><data>0. 0. 0. 0. 0.</data>
</distortion_coefficients></opencv_storage>
"""
ROS = """height: 1200
width: 1920
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.0, 0.0, 0.0, 0.0, 0.0]
camera_matrix:
  rows: 3
  cols: 3
  data: [2425.48, 0.0, 959.74, 0.0, 2425.33, 632.70, 0.0, 0.0, 1.0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
"""


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.yml", OPENCV_YAML),
        ("a.yaml", ROS),
        ("a.xml", XML),
        (
            "a.xml",
            '<camera width="1920" height="1200"><depth fx="2425.48" fy="2425.33" cx="959.74" cy="632.7"/></camera>',
        ),
        (
            "a.json",
            '{"width":1920,"height":1200,"fx":2425.48,"fy":2425.33,"ppx":959.74,"ppy":632.7,"coeffs":[0,0,0,0,0]}',
        ),
        ("a.txt", "2425.48 2425.33 959.74 632.70\nsize = [1920, 1200]\n"),
        ("a.txt", "2425.48 959.74 2425.33 632.70\nresolution: 1920 x 1200\n"),
    ],
)
def test_the_same_camera_in_other_programs_files(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    assert read_camera(tmp_path / name) == EXPECTED


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.yml", OPENCV_YAML.replace("data: [ 0., 0.,", "data: [ -0.2, 0.,")),
        ("a.yaml", ROS.replace("data: [0.0, 0.0, 0.0, 0.0, 0.0]", "data: [0.0, 0.0, 0.0, 0.01, 0.0]")),
        ("a.xml", XML.replace("<data>0. 0.", "<data>0. 0.1")),
        ("a.json", '{"width":1920,"height":1200,"fx":2425,"fy":2425,"ppx":959,"ppy":632,"coeffs":[0,0.1,0,0,0]}'),
    ],
)
def test_a_lens_that_was_not_straightened_is_noticed_wherever_it_is_written(
    tmp_path: Path, name: str, text: str
) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(CameraError, match="distortion coefficients"):
        read_camera(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.xml", '<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>', "declares its own XML document type"),
        ("a.xml", "<a>" * 5000 + "</a>" * 5000, "nested more than 50 deep"),
        ("a.xml", "<a><b></a>", "is no valid XML"),
        ("a.json", "[" * 100_000, "nested deeper"),
        ("a.toml", "a = " + "[" * 100_000, "nested deeper"),
        ("a.toml", "fx = 1" + "0" * 5000, "is no valid TOML"),
        (
            "a.json",
            '{"fx": 1' + "0" * 400 + ', "fy": 2000, "cx": 1, "cy": 2, "width": 3, "height": 4}',
            "focal lengths",
        ),
        ("a.json", '{"fx":20,"fy":20,"cx":9,"cy":9,"width":1000000,"height":1000000}', "more than any camera"),
        ("a.txt", "1 " * 600_000, "which is no file of intrinsics"),
    ],
)
def test_files_of_intrinsics_that_mean_harm(tmp_path: Path, name: str, text: str, message: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(CameraError, match=message):
        read_camera(tmp_path / name)
