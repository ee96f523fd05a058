"""GigE Vision cameras by their address in the network, ``gige://IP``, with no program of their maker.

Aravis carries packets and registers; what they mean is told by the camera's own description, read by the reference
implementation of GenApi, as behind a GenTL producer.
"""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from aadm_workbench.camera import aravis
from aadm_workbench.camera.aravis import LOST, WHOLE, Connection, RawBuffer, RawPart, TransportError
from aadm_workbench.camera.coordinates import Part
from aadm_workbench.camera.features import Features
from aadm_workbench.camera.frame import Closing, Device, Frame
from aadm_workbench.camera.genicam_frame import FRAME_WITHIN_S, first_line, frame_of, prepare
from aadm_workbench.camera.network import asked_for, ip_of
from aadm_workbench.errors import CameraGoneError, CaptureError, needed
from aadm_workbench.model.reason import said_of

SCHEME = "gige"

_KINDS = (
    (re.compile(r"Coord3D_\w+?32f(_Planar)?"), "<f4"),
    (re.compile(r"Coord3D_[ABC]+16(_Planar)?"), "<u2"),
)
_BYTES = "u1"  # of every other format: pictures of eight bits, and what is not understood


def devices(address: str) -> list[Device]:
    """Return the cameras that answer in the network, or, by ``gige://IP``, the one of that address.

    Raises
    ------
    CameraError
        For an address that is none.
    MissingDependencyError
        Without Aravis.
    """
    ip = ip_of(address, needed=False)
    found = [Device(f"{SCHEME}://{one.address}", one.vendor, one.model, one.serial) for one in aravis.cameras(address)]
    return asked_for(address, ip, found)


def open_camera(address: str) -> GigeCamera:
    """Open the camera at an address; this program controls it until it is closed.

    Raises
    ------
    CameraError
        For an address that is none.
    CameraGoneError
        Where no camera answers, or another program controls it.
    MissingDependencyError
        Without Aravis, or without the packages of the extra ``camera``.
    """
    ip = ip_of(address)
    try:
        return GigeCamera(address, Connection(address, ip))
    except TransportError as error:
        raise CameraGoneError(said_of(address, "camera.not_opened", why=str(error))) from error


class GigeCamera(Closing):
    """A camera that is open. Each frame has a stream of its own, so that none has waited in a buffer."""

    def __init__(
        self,
        address: str,
        transport: Connection,
        now_ns: Callable[[], int] = time.time_ns,
        within_s: float = FRAME_WITHIN_S,
    ) -> None:
        self._transport, self._now_ns, self._within_s = transport, now_ns, within_s
        try:
            self._nodes, self._port = _connected(address, transport)
            self._features = Features(self._nodes)
            said = (("DeviceVendorName",), ("DeviceModelName",), ("DeviceSerialNumber", "DeviceID"))
            self.device = Device(address, *(self._features.text(*names) for names in said))
            prepare(self._features)
            if "SingleFrame" in self._features.choices("AcquisitionMode"):
                self._features.set("AcquisitionMode", "SingleFrame")
        except BaseException:
            self.close()
            raise

    def capture(self) -> Frame:
        """Take one frame now; its time is that of the request, never later than the exposure."""
        try:
            return self._capture()
        except TransportError as error:
            raise self._gone(str(error)) from error
        except CaptureError as error:
            if isinstance(error, CameraGoneError) or self._transport.answers():
                raise
            raise self._gone("no answer") from error

    def close(self) -> None:
        """Let go of the camera; once more does no harm."""
        self._transport.close()

    def _capture(self) -> Frame:
        largest = self._features.number("PayloadSize")
        if not largest:
            raise CaptureError(said_of(self.device.address, "camera.no_size"))
        stream = self._transport.stream(int(largest))
        try:
            asked_s = self._now_ns() / 1e9
            self._features.set("TLParamsLocked", 1)
            self._start()
            buffer = stream.buffer(self._within_s)
        finally:
            self._features.execute("AcquisitionStop")
            self._features.set("TLParamsLocked", 0)
            stream.close()
        if buffer is None:
            raise CaptureError(said_of(self.device.address, "camera.no_frame", within_s=self._within_s))
        return self._frame(buffer, asked_s)

    def _start(self) -> None:
        if not self._features.execute("AcquisitionStart"):
            if not self._transport.answers():
                raise self._gone("no answer")
            raise CaptureError(said_of(self.device.address, "camera.not_started"))

    def _frame(self, buffer: RawBuffer, asked_s: float) -> Frame:
        if buffer.status != WHOLE:
            code = "camera.packets_lost" if buffer.status in LOST else "camera.not_whole"
            raise CaptureError(said_of(self.device.address, code))
        chunks = _attached(self._nodes, buffer.with_chunks)
        try:
            return frame_of(self.device, asked_s, [_part(part) for part in buffer.parts], self._features)
        finally:
            if chunks is not None:
                chunks.detach_buffer()

    def _gone(self, why: str) -> CameraGoneError:
        return CameraGoneError(said_of(self.device.address, "camera.gone", why=why))


def _connected(address: str, transport: Connection) -> tuple[Any, Any]:
    """The features of a camera, and the port through which they are read, which must live as long."""
    with needed("genicam", address):
        from genicam.genapi import AbstractPort, EAccessMode, GenericException, NodeMap

    class Port(AbstractPort):  # type: ignore[misc]
        def is_open(self) -> bool:
            return True

        def get_access_mode(self) -> Any:
            return EAccessMode.RW

        def read(self, register: int, length: int) -> bytes:
            return transport.read(register, length)

        def write(self, register: int, content: bytes) -> None:
            transport.write(register, bytes(content))

    nodes, port = NodeMap(), Port()
    try:
        nodes.load_xml_from_string(transport.xml())
        nodes.connect(port, "Device")
    except GenericException as error:
        raise CameraGoneError(said_of(address, "camera.not_described", why=first_line(error))) from error
    return nodes, port


def _attached(nodes: Any, content: bytes) -> Any:
    """What reads the chunks behind a buffer (GigE Vision 2.0) until it is detached; None where there are none."""
    if not content:
        return None
    from genicam.genapi import ChunkAdapterGEV

    adapter = ChunkAdapterGEV(nodes)
    adapter.attach_buffer(content, len(content))
    return adapter


def _part(part: RawPart) -> Part:
    from harvesters.util.pfnc import symbolics

    name = str(symbolics.get(part.format, ""))
    kind = next((kind for names, kind in _KINDS if names.fullmatch(name)), _BYTES)
    whole = len(part.content) // np.dtype(kind).itemsize * np.dtype(kind).itemsize
    return Part(name, part.width, part.height, np.frombuffer(part.content[:whole], kind))
