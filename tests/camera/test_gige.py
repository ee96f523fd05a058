"""GigE Vision: Aravis' own simulator on loopback, a program of its own, serves frames that this test describes."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.camera.aravis import LOST, RawBuffer, RawPart, TransportError
from aadm_workbench.camera.gige import GigeCamera, devices, open_camera
from aadm_workbench.errors import CameraError, CameraGoneError, CaptureError, MissingDependencyError

from .device import HEAD, node
from .gige_device import ADDRESS, FORMATS, has_aravis, served

needs_aravis = pytest.mark.skipif(not has_aravis(), reason="libaravis-0.8-0 is not installed")
WHOLE = {
    "Scan3dDistanceUnit": "Millimeter",
    "Scan3dOutputMode": "CalibratedABC_Grid",
    "Scan3dCoordinateSystem": "Cartesian",
    "Scan3dCoordinateSystemReference": "Anchor",
    "DeviceVendorName": "Twin",
    "DeviceModelName": "GV3D",
    "DeviceSerialNumber": "T7",
}
DEPTHS = {
    **WHOLE,
    "Scan3dOutputMode": "CalibratedC",
    "Scan3dCoordinateSelector": "CoordinateC",
    "Scan3dCoordinateScale": 0.05,
    "Scan3dCoordinateOffset": 300.0,
    "Scan3dFocalLength": 1000.0,
    "Scan3dPrincipalPointU": 20.0,
    "Scan3dPrincipalPointV": 12.0,
    "PointCloudSurfaceSmoothing": "Weak",
}
POINTS = np.random.default_rng(7).uniform(400.0, 900.0, (30, 40, 3)).astype("<f4")


@needs_aravis
def test_points_come_bit_by_bit_from_a_camera_that_says_who_it_is(tmp_path: Path) -> None:
    with served(tmp_path, POINTS, WHOLE, "Coord3D_ABC32f"):
        assert ADDRESS in [one.address for one in devices("gige://")]
        (found,) = devices(ADDRESS)
        assert (found.vendor, found.serial) == ("Aravis", "TWIN-1")  # as the network says; the description is not read
        with open_camera(ADDRESS) as camera:
            frames = [camera.capture(), camera.capture()]
    for frame in frames:
        assert np.array_equal(frame.points, POINTS)
        assert (frame.device.vendor, frame.device.model, frame.device.serial) == ("Twin", "GV3D", "T7")
        assert frame.settings["PixelFormat"] == "Coord3D_ABC32f"
    assert frames[0].captured_s < frames[1].captured_s


@needs_aravis
def test_depths_come_with_scale_offset_intrinsics_and_what_is_smoothed(tmp_path: Path) -> None:
    steps = np.random.default_rng(8).integers(1, 2**16, (24, 40)).astype("<u2")
    with served(tmp_path, steps, DEPTHS, "Coord3D_C16"), open_camera(ADDRESS) as camera:
        frame = camera.capture()
    assert np.array_equal(frame.depth_mm, (steps * 0.05 + 300.0).astype(np.float32))
    assert (frame.camera.fx, frame.camera.cx, frame.camera.height) == (1000.0, 20.0, 24)
    assert "PointCloudSurfaceSmoothing = Weak" in frame.notes[0]


@needs_aravis
def test_lost_packets_cost_the_frame_and_not_the_camera(tmp_path: Path) -> None:
    with served(tmp_path, POINTS, WHOLE, "Coord3D_ABC32f", "lossy"), open_camera(ADDRESS) as camera:
        for _ in range(2):
            with pytest.raises(CaptureError, match=r"packets of the frame were lost|no frame came") as caught:
                camera.capture()
            assert str(caught.value).startswith(f"{ADDRESS}: ")
            assert not isinstance(caught.value, CameraGoneError)


@needs_aravis
def test_a_camera_that_vanishes_in_mid_frame_is_gone_and_comes_back(tmp_path: Path) -> None:
    large = np.random.default_rng(9).uniform(400.0, 900.0, (300, 400, 3)).astype("<f4")
    with served(tmp_path, large, WHOLE, "Coord3D_ABC32f", "vanishes") as program, open_camera(ADDRESS) as camera:
        camera.capture()
        for _ in range(2):
            with pytest.raises(CameraGoneError, match="went away"):
                camera.capture()
        assert program.wait(60) == 0
    with served(tmp_path, POINTS, WHOLE, "Coord3D_ABC32f"), open_camera(ADDRESS) as camera:
        assert camera.capture().points is not None


@needs_aravis
def test_a_unit_in_which_nothing_is_measured_is_named(tmp_path: Path) -> None:
    wrong = {**WHOLE, "Scan3dDistanceUnit": "Pixel"}
    with (
        served(tmp_path, POINTS, wrong, "Coord3D_ABC32f"),
        open_camera(ADDRESS) as camera,
        pytest.raises(CaptureError, match=r"gige://127\.0\.0\.1: the unit .* is Pixel"),
    ):
        camera.capture()


@needs_aravis
def test_where_no_camera_answers() -> None:
    nobody = "gige://192.0.2.1"  # RFC 5737: an address of documents
    with pytest.raises(CameraGoneError, match=r"gige://192\.0\.2\.1: cannot be opened"):
        open_camera(nobody)
    with pytest.raises(CameraGoneError, match=r"gige://192\.0\.2\.1: no camera answers"):
        devices(nobody)


def test_addresses_that_are_none() -> None:
    for address in ("gige:", "gige://", "gige://camera.site", "gige://300.1.1.1", "gige://::1"):
        with pytest.raises(CameraError, match="write gige://IP"):
            open_camera(address)


def test_a_machine_without_aravis_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    from aadm_workbench.camera import aravis

    monkeypatch.setattr(aravis, "_NAMES", ("libaravis-none.so",))
    monkeypatch.setattr(aravis.ctypes.util, "find_library", lambda _: None)
    aravis.library.cache_clear()
    try:
        with pytest.raises(MissingDependencyError, match=r"libaravis-0\.8-0"):
            open_camera(ADDRESS)
    finally:
        aravis.library.cache_clear()


class Line:
    """Registers and buffers of a camera whose frames carry chunks, as the simulator's do not."""

    def __init__(self, xml: str, *buffers: RawBuffer | None) -> None:
        self._xml, self._buffers, self.closed = xml, list(buffers), 0

    def xml(self) -> str:
        return self._xml

    def write(self, register: int, content: bytes) -> None:
        """Commands."""

    def answers(self) -> bool:
        return True

    def stream(self, largest_bytes: int) -> Line:
        assert largest_bytes == 64
        return self

    def buffer(self, within_s: float) -> RawBuffer | None:
        return self._buffers.pop(0)

    def close(self) -> None:
        self.closed += 1


def chunked(scale: float, steps: np.ndarray) -> RawBuffer:
    """A buffer as GigE Vision 2.0 lays out chunks: content, its number and its length, big-endian, from the end."""
    image, said = steps.tobytes(), struct.pack("<d", scale)
    content = image + struct.pack(">II", 1, len(image)) + said + struct.pack(">II", 0xBEEF, len(said))
    return RawBuffer(0, (RawPart(FORMATS["Coord3D_C16"], steps.shape[1], steps.shape[0], image),), content)


def with_chunks(**features: Any) -> str:
    shown = {**DEPTHS, "PayloadSize": 64, **features}
    chunk = (
        '<FloatReg Name="ChunkScan3dCoordinateScale"><Address>0</Address><Length>8</Length><AccessMode>RO</AccessMode>'
        "<pPort>Chunk</pPort><Cachable>NoCache</Cachable><Endianess>LittleEndian</Endianess></FloatReg>"
        '<Port Name="Chunk"><ChunkID>BEEF</ChunkID></Port>'
        '<IntReg Name="Go"><Address>4</Address><Length>4</Length><AccessMode>WO</AccessMode><pPort>Device</pPort>'
        "<Sign>Unsigned</Sign><Endianess>BigEndian</Endianess></IntReg>"
        '<Command Name="AcquisitionStart"><pValue>Go</pValue><CommandValue>1</CommandValue></Command>'
    )
    top = "".join(f"<pFeature>{name}</pFeature>" for name in (*shown, "ChunkScan3dCoordinateScale"))
    nodes = "".join(node(name, value, ()) for name, value in shown.items())
    return f'{HEAD}<Category Name="Root">{top}</Category>{nodes}{chunk}<Port Name="Device"/></RegisterDescription>'


def test_each_frame_is_scaled_by_its_own_chunks() -> None:
    steps = np.full((24, 40), 1000, "<u2")
    xml = with_chunks(ChunkScan3dCoordinateSelector="CoordinateC")
    camera = GigeCamera(ADDRESS, Line(xml, chunked(0.1, steps), chunked(0.2, steps)))
    assert camera.capture().depth_mm[0, 0] == np.float32(100.0)
    assert camera.capture().depth_mm[0, 0] == np.float32(200.0)


def test_buffers_that_are_not_whole_and_none_at_all() -> None:
    lost, wrong_size = RawBuffer(min(LOST)), RawBuffer(5)
    camera = GigeCamera(ADDRESS, Line(with_chunks(), lost, wrong_size, None))
    for said in ("packets of the frame were lost", "not the one that the camera said", "no frame came within 15 s"):
        with pytest.raises(CaptureError, match=said):
            camera.capture()


def test_a_camera_that_cannot_be_described_is_let_go() -> None:
    line = Line("no description")
    with pytest.raises(CameraGoneError, match="does not describe its features"):
        GigeCamera(ADDRESS, line)
    assert line.closed == 1


def test_what_the_network_says_is_an_error_of_its_own() -> None:
    class Silent(Line):
        def stream(self, largest_bytes: int) -> Line:
            raise TransportError("timeout")

    with pytest.raises(CameraGoneError, match=r"went away \(timeout\)"):
        GigeCamera(ADDRESS, Silent(with_chunks())).capture()
