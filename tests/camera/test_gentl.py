"""GenTL: the simulator that the GenICam committee ships, and a device of this test's own for what must go wrong."""

from __future__ import annotations

import ctypes.util
from pathlib import Path

import genicam
import numpy as np
import pytest
from genicam.gentl import IoException

from aadm_workbench.camera.frame import Device, Frame
from aadm_workbench.camera.gentl import GentlCamera, devices, open_camera
from aadm_workbench.errors import CameraError, CameraGoneError, CaptureError
from tests.hoisting_scenes import usual

from .device import Acquirer, Buffer, component, lost, node_map, silent

VIKY = Path(genicam.__file__).parent / "viky.cti"
SCAN3D = {
    "PixelFormat": "Mono8",
    "Scan3dDistanceUnit": "Millimeter",
    "Scan3dOutputMode": "UncalibratedC",
    "Scan3dCoordinateSystem": "Cartesian",
    "Scan3dCoordinateSystemReference": "Anchor",
    "Scan3dCoordinateSelector": "CoordinateA",
    "Scan3dCoordinateScale": 1.0,
    "Scan3dCoordinateOffset": 0.0,
    "ComponentSelector": "Intensity",
    "ComponentEnable": False,
}
CHOICES = {
    "PixelFormat": ("Coord3D_C16", "Coord3D_ABC32f", "Coord3D_ABC32f_Planar"),
    "Scan3dOutputMode": ("CalibratedC", "CalibratedABC_Grid"),
    "Scan3dCoordinateSelector": ("CoordinateB", "CoordinateC"),
    "ComponentSelector": ("Range",),
}


def opened(features: dict, *frames, choices: dict | None = None) -> tuple[GentlCamera, Acquirer]:
    acquirer = Acquirer(node_map(features, CHOICES if choices is None else choices), frames)
    return GentlCamera(
        Device("gentl:test.cti#7"), acquirer, lambda: None, now_ns=lambda: 1_700_000_000_250_000_000
    ), acquirer


def twin(_: Acquirer) -> Buffer:
    points = usual().frame.scan().points
    height, width = points.shape[:2]
    return Buffer([component("Coord3D_ABC32f", width, height, points.astype("<f4"))])


def depths(_: Acquirer) -> Buffer:
    return Buffer([component("Coord3D_C16", 4, 2, np.full(8, 10_000, np.uint16))])


def test_viky_shows_its_three_cameras_and_gives_frames_one_after_the_other() -> None:
    found = devices(f"gentl:{VIKY}")
    assert [device.serial for device in found] == ["0", "1", "2"]
    with open_camera(f"gentl:{VIKY}#1") as camera:
        frames = [camera.capture() for _ in range(3)]
    for frame in frames:
        assert (frame.points.shape, frame.points.dtype) == ((400, 400, 3), np.float32)
        assert frame.grey.shape == (400, 400)
        assert frame.settings["Scan3dDistanceUnit"] == "Millimeter"
        assert frame.camera is None  # its rays are parallel
    # its pixels are its millimetres: x to the right, y down
    assert frames[0].points[17, 230, :2].tolist() == [230.0, 17.0]
    times = [frame.captured_s for frame in frames]
    assert times == sorted(times)


def test_a_camera_that_another_one_has_and_one_that_is_not_there() -> None:
    with open_camera(f"gentl:{VIKY}#2"), pytest.raises(CameraGoneError):
        open_camera(f"gentl:{VIKY}#2")
    with open_camera(f"gentl:{VIKY}#2") as camera:  # given back
        assert camera.capture().points is not None
    with pytest.raises(CameraGoneError, match=r"no such camera; there are gentl:.*#0, gentl:.*#1"):
        open_camera(f"gentl:{VIKY}#77")
    with pytest.raises(CameraError, match="several cameras"):
        open_camera(f"gentl:{VIKY}")


def test_files_that_are_no_producer_say_why(tmp_path: Path) -> None:
    text = tmp_path / "text.cti"
    text.write_text("no library")
    library = Path(ctypes.util.find_library("m") or "libm.so.6")
    with pytest.raises(CameraError, match="cannot be loaded"):
        devices(f"gentl:{text}")
    with pytest.raises(CameraError, match="no such file"):
        devices(f"gentl:{tmp_path}/none.cti")
    with pytest.raises(CameraError, match="names no producer"):
        devices("gentl:")
    real = next(path for folder in ("/lib", "/usr/lib") for path in Path(folder).rglob(library.name) if path.is_file())
    with pytest.raises(CameraError, match="no GenTL producer"):
        devices(f"gentl:{real}")


def test_all_coordinates_are_asked_for_before_depth_alone() -> None:
    _, acquirer = opened(SCAN3D)
    nodes = acquirer.remote_device.node_map
    assert (nodes.PixelFormat.value, nodes.Scan3dOutputMode.value) == ("Coord3D_ABC32f", "CalibratedABC_Grid")
    assert (nodes.ComponentSelector.value, nodes.ComponentEnable.value) == ("Range", True)
    _, acquirer = opened(SCAN3D, choices={**CHOICES, "PixelFormat": ("Coord3D_C16",)})
    assert acquirer.remote_device.node_map.PixelFormat.value == "Coord3D_C16"


def test_a_twin_frame_comes_bit_by_bit_with_its_camera() -> None:
    camera, acquirer = opened({**SCAN3D, "PointCloudSurfaceSmoothing": "Strong"}, twin)
    frame = camera.capture()
    scan = usual().frame.scan()
    assert np.array_equal(frame.points, scan.points, equal_nan=True)
    assert frame.camera is not None
    for name in ("fx", "fy", "cx", "cy"):
        assert getattr(frame.camera, name) == pytest.approx(getattr(scan.camera, name), abs=0.01)
    assert frame.captured_s == pytest.approx(1_700_000_000.25, abs=1e-3)
    assert len(frame.notes) == 1
    assert "PointCloudSurfaceSmoothing = Strong" in frame.notes[0]
    assert not acquirer.running


def test_the_chunks_of_a_frame_go_before_the_features_of_the_device() -> None:
    chunks = {f"Chunk{name}": value for name, value in SCAN3D.items() if name.startswith("Scan3dCoordinate")}
    features = {
        **SCAN3D,
        **chunks,
        "Scan3dOutputMode": "CalibratedC",
        "ChunkScan3dCoordinateScale": 0.05,
        "ChunkScan3dCoordinateOffset": 300.0,
        "Scan3dCoordinateScale": 9.0,
        "ChunkScan3dFocalLength": 1000.0,
        "ChunkScan3dPrincipalPointU": 1.5,
        "ChunkScan3dPrincipalPointV": 1.0,
    }
    choices = {**CHOICES, "ChunkScan3dCoordinateSelector": ("CoordinateB", "CoordinateC"), "Scan3dOutputMode": ()}
    camera, _ = opened(features, depths, choices=choices)
    frame = camera.capture()
    assert frame.depth_mm.tolist() == [[800.0] * 4] * 2
    assert (frame.camera.fx, frame.camera.cx, frame.camera.cy) == (1000.0, 1.5, 1.0)


def test_lenses_that_are_not_straightened_are_refused_and_straightened_ones_are_not() -> None:
    flat = {**SCAN3D, "Scan3dOutputMode": "CalibratedC", "LensDistortionK1": -0.12}
    only = {**CHOICES, "Scan3dOutputMode": ()}
    camera, _ = opened(flat, depths, choices=only)
    with pytest.raises(CaptureError, match="not straightened"):
        camera.capture()
    camera, _ = opened({**flat, "DistortionCorrectionEnable": True}, depths, choices=only)
    assert isinstance(camera.capture(), Frame)


def gone(_: Acquirer) -> Buffer:
    raise IoException("the device was pulled out")


def half(_: Acquirer) -> Buffer:
    return Buffer([component("Coord3D_ABC32f", 4, 2, np.zeros(13, "<f4"))])


def test_a_frame_that_is_lost_is_named_and_the_next_one_goes_on() -> None:
    camera, acquirer = opened(SCAN3D, lost, silent, half, twin)
    for said in ("packets of the frame were lost", "no frame came within 15 s", "not whole"):
        with pytest.raises(CaptureError, match=said) as caught:
            camera.capture()
        assert str(caught.value).startswith("gentl:test.cti#7: ")
        assert not isinstance(caught.value, CameraGoneError)
        assert not acquirer.running
    assert camera.capture().points is not None


def test_a_camera_that_goes_away_in_mid_frame_has_to_be_opened_again() -> None:
    camera, acquirer = opened(SCAN3D, gone)
    with pytest.raises(CameraGoneError, match=r"went away .*pulled out"):
        camera.capture()
    camera.close()
    assert acquirer.destroyed


def test_a_device_that_measures_in_pixels_is_refused() -> None:
    camera, _ = opened({**SCAN3D, "Scan3dDistanceUnit": "Pixel"}, twin)
    with pytest.raises(CaptureError, match=r"gentl:test.cti#7: the unit .* is Pixel"):
        camera.capture()
