"""Intrinsics as programs write them, each with a straight lens (read) and with a bent one (refused), in every spelling.

``{a}`` and ``{b}`` stand where the program puts its first two coefficients.
"""

import json
from pathlib import Path

import pytest

from aadm_workbench.errors import CameraError
from aadm_workbench.model import Camera
from aadm_workbench.scan.camera import read_camera

EXPECTED = Camera(2425.48, 2425.33, 959.74, 632.70, 1920, 1200)

NAMES = "width: 1920\nheight: 1200\nfx: 2425.48\nfy: 2425.33\ncx: 959.74\ncy: 632.70\n"
K = "[2425.48, 0.0, 959.74, 0.0, 2425.33, 632.70, 0.0, 0.0, 1.0]"
ROS_ECHO = f"""header:
  seq: 7
  stamp:
    secs: 1467
    nsecs: 32000
  frame_id: "camera_depth_optical_frame"
height: 1200
width: 1920
distortion_model: "plumb_bob"
D: [{{a}}, {{b}}, 0.0, 0.0, 0.0]
K: {K}
R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
P: [2425.48, 0.0, 959.74, 0.0, 0.0, 2425.33, 632.70, 0.0, 0.0, 0.0, 1.0, 0.0]
binning_x: 0
roi:
  x_offset: 0
  height: 0
  width: 0
  do_rectify: False
"""
ROS2_ECHO = """height: 1200
width: 1920
distortion_model: plumb_bob
d:
- {a}
- {b}
- 0.0
- 0.0
- 0.0
k:
- 2425.48
- 0.0
- 959.74
- 0.0
- 2425.33
- 632.70
- 0.0
- 0.0
- 1.0
"""
ROS_INI = """# Camera intrinsics

[image]

width
1920

height
1200

[narrow_stereo]

camera matrix
2425.48 0.000000 959.74
0.000000 2425.33 632.70
0.000000 0.000000 1.000000

distortion
{a} {b} 0.000000 0.000000 0.000000

rectification
1.000000 0.000000 0.000000
0.000000 1.000000 0.000000
0.000000 0.000000 1.000000
"""
OPENCV = """%YAML:1.0
---
calibration_time: "Mon Nov  2 12:00:00 2026"
image_width: 1920
image_height: 1200
flags: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 2.4254800000000000e+03, 0., 9.5974000000000001e+02, 0.,
       2.4253299999999999e+03, 6.3270000000000005e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ {a}, {b},
       0., 0., 0. ]
avg_reprojection_error: 3.4e-01
"""
MATLAB = """  cameraIntrinsics with properties:

             FocalLength: [2425.48 2425.33]
          PrincipalPoint: [959.74 632.70]
               ImageSize: [1200 1920]
        RadialDistortion: [{a} {b}]
    TangentialDistortion: [0 0]
                    Skew: 0
"""
ZIVID = """__version__:
  serializer: 1
  data: 12
CameraIntrinsics:
  CameraMatrix:
    CX: 959.74
    CY: 632.70
    FX: 2425.48
    FY: 2425.33
  Distortion:
    K1: {a}
    K2: {b}
    K3: 0
    P1: 0
    P2: 0
"""
KINECT = """===== Device 0: 000123 =====
resolution width: 1920
resolution height: 1200
principal point x: 959.74
principal point y: 632.70
focal length x: 2425.48
focal length y: 2425.33
radial distortion coefficients:
k1: {a}
k2: {b}
k3: 0.000000
center of distortion in Z=1 plane, x: 0.000000
center of distortion in Z=1 plane, y: 0.000000
tangential distortion coefficient x: 0.000000
tangential distortion coefficient y: 0.000000
metric radius: 0.000000
"""
ENUMERATED = """ Intrinsic of "Depth" / 1920x1200 / {{Z16}}
  Width:      \t1920
  Height:     \t1200
  PPX:        \t959.74
  PPY:        \t632.70
  Fx:         \t2425.48
  Fy:         \t2425.33
  Distortion: \tBrown Conrady
  Coeffs:     \t{a}  \t{b}  \t0  \t0  \t0
  FOV (deg):  \t43.2 x 27.8
"""
TEXTS = {
    "names.txt": NAMES + "coeffs: [{a}, {b}, 0, 0, 0]\n",
    "matlab_like.txt": NAMES + "RadialDistortion: [{a}, {b}]\n",
    "prose.txt": NAMES + "lens distortion coefficients: {a} {b} 0 0 0\n",
    "dist.txt": NAMES + "dist = {a}, {b}, 0, 0\n",
    "kc.m": NAMES + "kc = [ {a} ; {b} ; 0 ; 0 ; 0 ];\n",
    "indexed.txt": NAMES + "k[1] = {a}\nk[2] = {b}\n",
    "underscored.ini": "[depth]\n" + NAMES.replace(": ", " = ") + "k_1 = {a}\nk_2 = {b}\n",
    "capital.yaml": NAMES + "lensDistortion:\n  K1: {a}\n  K2: {b}\n",
    "list.yaml": NAMES + "distortion_coefficients:\n- {a}\n- {b}\n- 0.0\n",
    "flow.yaml": NAMES + "distortion: {{k1: {a}, k2: {b}, p1: 0, p2: 0}}\n",
    "chinese.txt": NAMES + "畸变系数: {a} {b} 0 0 0\n",
    "table.csv": "fx,fy,cx,cy,k1,k2,width,height\n2425.48,2425.33,959.74,632.70,{a},{b},1920,1200\n",
    "columns.csv": "Fx,2425.48\nFy,2425.33\nPPx,959.74\nPPy,632.70\nDistorsion,Brown Conrady\nCoeffs,{a}\nk2,{b}\n"
    "Resolution x,1920\nResolution y,1200\n",
    "ros.yaml": ROS_ECHO,
    "ros2.yaml": ROS2_ECHO,
    "ros.ini": ROS_INI,
    "opencv.yml": OPENCV,
    "matlab.txt": MATLAB,
    "zivid.yml": "width: 1920\nheight: 1200\n" + ZIVID,
    "kinect.txt": KINECT,
    "enumerated.txt": ENUMERATED,
    "printed.txt": "[ 1920x1200  p[959.74 632.7]  f[2425.48 2425.33]  Inverse Brown Conrady [{a} {b} 0 0 0] ]\n",
    "attributes.txt": "width: 1920, height: 1200, ppx: 959.74, ppy: 632.7, fx: 2425.48, fy: 2425.33, "
    "model: Brown Conrady, coeffs: [{a}, {b}, 0, 0, 0]\n",
    "brackets.txt": "[2425.48, 2425.33; 959.74, 632.70]\nDepthDistCoeffs: k1: {a}, k2: {b}\nsize: 1920 x 1200\n",
}
CORE = {"fx": 2425.48, "fy": 2425.33, "cx": 959.74, "cy": 632.70}
SIZE = {"width": 1920, "height": 1200}
MATRIX = [[2425.48, 0, 959.74], [0, 2425.33, 632.70], [0, 0, 1]]


def tables(a: float, b: float) -> dict[str, object]:
    """The same as tables: whatever is bent is bent by ``a`` and ``b``."""
    return {
        "radial": {**CORE, **SIZE, "radial_distortion": [a, b], "tangential_distortion": [0, 0]},
        "camel": {**CORE, **SIZE, "lensDistortion": {"k1": a, "k2": b}},
        "depth": {**CORE, **SIZE, "depth_distortion": [a, b, 0, 0, 0]},
        "sibling": {**SIZE, "intrinsics": CORE, "distortion": {"k1": a, "k2": b, "p1": 0}},
        "far": {"size": SIZE, "a": {"b": {**SIZE, "K": MATRIX}}, "c": [{"d": {"dist_coeffs": [a, b, 0, 0]}}]},
        "text": {**CORE, **SIZE, "distortion": f"[{a}, {b}, 0, 0, 0]"},
        "model": {**CORE, **SIZE, "distortion": {"model": 1, "coefficients": [a, b, 0, 0, 0]}},
        "named": {**CORE, **SIZE, "parameters": [{"name": "k1", "value": a}, {"name": "k2", "value": b}]},
        "shape": {**SIZE, "camera_matrix": MATRIX, "D": {"rows": 1, "cols": 5, "data": [a, b, 0, 0, 0]}},
        "list": [{"name": "depth", **CORE, **SIZE, "D": [a, b, 0, 0, 0]}],
        "open3d": {**SIZE, "intrinsic_matrix": [2425.48, 0, 0, 0, 2425.33, 0, 959.74, 632.7, 1], "d": [a, b, 0, 0]},
        "matlab": {
            "FocalLength": [2425.48, 2425.33],
            "PrincipalPoint": [959.74, 632.70],
            "ImageSize": [1200, 1920],
            "RadialDistortion": [a, b],
        },
    }


@pytest.mark.parametrize("name", TEXTS)
def test_printed_cameras_are_read_where_straight_and_refused_where_bent(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_text(TEXTS[name].format(a="0.0", b="0"))
    assert read_camera(path) == EXPECTED
    for a, b in (("-0.08", "0.12"), ("-8.0e-02", "0"), ("0", "1.2E-01")):
        path.write_text(TEXTS[name].format(a=a, b=b))
        with pytest.raises(CameraError, match="distortion coefficients"):
            read_camera(path)


@pytest.mark.parametrize("name", tables(0, 0))
def test_tables_are_read_where_straight_and_refused_where_bent(tmp_path: Path, name: str) -> None:
    path = tmp_path / "camera.json"
    path.write_text(json.dumps(tables(0, 0.0)[name]))
    assert read_camera(path) == EXPECTED
    for a, b in ((-0.08, 0.12), (0, 0.12)):
        path.write_text(json.dumps(tables(a, b)[name]))
        with pytest.raises(CameraError, match="distortion coefficients"):
            read_camera(path)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.txt", NAMES + "distance: 800.5\nundistorted: 1\ndistortion_model: 4\ndistortion corrected: 1\n"),
        ("a.txt", NAMES + "Distortion: Brown Conrady\nFOV: 43.2 x 27.8\n"),
        ("a.json", json.dumps({"depth": {**CORE, **SIZE}, "rgb": {**CORE, "fx": 1800.5, "k1": 0.3}})),
        ("a.json", json.dumps({**CORE, **SIZE, "distance_mm": 800, "distortion": {"removed": 1, "model": 5}})),
    ],
)
def test_what_is_said_of_a_distortion_and_is_none(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    assert read_camera(tmp_path / name) == EXPECTED


@pytest.mark.parametrize(
    ("name", "text"),
    [
        (
            "a.toml",
            "[camera]\nfx=2425.48\nfy=2425.33\ncx=959.74\ncy=632.7\nwidth=1920\nheight=1200\n[lens]\ndist=[0.1]\n",
        ),
        (
            "a.xml",
            """<a width="1920" height="1200"><depth fx="2425.48" fy="2425.33" cx="959.74" cy="632.7"/>
            <Distortion><coefficient name="k1">-0.08</coefficient></Distortion></a>""",
        ),
        ("a.xml", '<a width="1920" height="1200" fx="2425" fy="2425" cx="959" cy="632"><k1>0.1</k1></a>'),
    ],
)
def test_other_places_of_coefficients(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(CameraError, match="distortion coefficients"):
        read_camera(tmp_path / name)
