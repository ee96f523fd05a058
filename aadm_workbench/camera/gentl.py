"""Cameras behind a GenTL producer, ``gentl:FILE.cti[#SERIAL]``: what most vendors of machine vision ship."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.camera.coordinates import Part
from aadm_workbench.camera.features import Features
from aadm_workbench.camera.frame import Closing, Device, Frame
from aadm_workbench.camera.genicam_frame import FRAME_WITHIN_S, first_line, frame_of, prepare
from aadm_workbench.errors import CameraError, CameraGoneError, CaptureError, needed
from aadm_workbench.model.reason import said_of

SCHEME = "gentl"


def devices(address: str) -> list[Device]:
    """Return the cameras that a producer sees.

    Raises
    ------
    CameraError
        For a file that is no GenTL producer.
    MissingDependencyError
        Without the packages of the extra ``camera``.
    """
    file, _ = _split(address)
    harvester = _harvester(file)
    try:
        return [_device(file, found) for found in harvester.device_info_list]
    finally:
        harvester.reset()


def open_camera(address: str) -> GentlCamera:
    """Open a camera: the one with the serial number that is named, else the only one there is.

    Raises
    ------
    CameraError
        For a file that is no GenTL producer, or where it is open which camera is meant.
    CameraGoneError
        Where the camera is not there, or belongs to another program now.
    """
    file, serial = _split(address)
    harvester = _harvester(file)
    try:
        index = _chosen(file, serial, [_device(file, found) for found in harvester.device_info_list])
        device = _device(file, harvester.device_info_list[index])
        return GentlCamera(device, _acquirer(harvester, index, device), harvester.reset)
    except BaseException:
        harvester.reset()
        raise


class GentlCamera(Closing):
    """A camera that is open. Each frame is asked for by itself, so that none has waited in a buffer."""

    def __init__(
        self,
        device: Device,
        acquirer: Any,
        let_go: Callable[[], None],
        now_ns: Callable[[], int] = time.time_ns,
        within_s: float = FRAME_WITHIN_S,
    ) -> None:
        self.device = device
        self._acquirer, self._let_go, self._now_ns, self._within_s = acquirer, let_go, now_ns, within_s
        self._features = Features(acquirer.remote_device.node_map)
        self._lost = False
        acquirer.add_callback(acquirer.Events.INCOMPLETE_BUFFER, _Lost(self._note_loss))
        prepare(self._features)

    def capture(self) -> Frame:
        """Take one frame now; its time is that of the request, never later than the exposure."""
        from genicam.gentl import GenericException

        self._lost, asked_s = False, self._now_ns() / 1e9
        try:
            self._acquirer.start()
            try:
                buffer = self._acquirer.try_fetch(timeout=self._within_s)
                if buffer is None:
                    raise CaptureError(self._why_none())
                with buffer:
                    return self._frame(buffer, asked_s)
            finally:
                self._acquirer.stop()
        except GenericException as error:
            raise CameraGoneError(said_of(self.device.address, "camera.gone", why=first_line(error))) from error

    def close(self) -> None:
        """Let go of the camera; once more does no harm."""
        self._acquirer.destroy()
        self._let_go()

    def _note_loss(self) -> None:
        self._lost = True

    def _why_none(self) -> str:
        if self._lost:
            return said_of(self.device.address, "camera.packets_lost")
        return said_of(self.device.address, "camera.no_frame", within_s=self._within_s)

    def _frame(self, buffer: Any, captured_s: float) -> Frame:
        try:
            parts = [_part(component) for component in buffer.payload.components]
        except ValueError as error:
            raise CaptureError(said_of(self.device.address, "camera.not_whole")) from error
        return frame_of(self.device, captured_s, parts, self._features)


class _Lost:
    """What harvesters calls where a frame came with gaps."""

    def __init__(self, note: Callable[[], None]) -> None:
        self._note = note

    def emit(self, context: Any = None) -> None:
        self._note()


def _split(address: str) -> tuple[Path, str]:
    """File and serial number of ``gentl:FILE.cti#SERIAL``; the number is empty where none is given."""
    file, _, serial = address.partition(":")[2].partition("#")
    if not file:
        raise CameraError(said_of(address, "camera.no_producer_named"))
    return Path(file), serial


def _harvester(file: Path) -> Any:
    _check_producer(file)
    with needed("harvesters", f"{SCHEME}:{file}"):
        from genicam.gentl import GenericException
        from harvesters.core import Harvester
    harvester = Harvester()
    try:
        harvester.add_file(str(file.resolve()))
        harvester.update()
    except GenericException as error:
        harvester.reset()
        raise CameraError(said_of(file, "camera.producer_unstarted", why=first_line(error))) from error
    return harvester


def _check_producer(file: Path) -> None:
    """Say why a file is no producer: harvesters takes anything, and then sees no camera."""
    if not file.is_file():
        raise CameraError(said_of(file, "camera.no_producer_file"))
    try:
        library = ctypes.CDLL(str(file.resolve()))
    except OSError as error:
        raise CameraError(said_of(file, "camera.library_not_loaded", why=str(error))) from error
    if not hasattr(library, "GCInitLib"):
        raise CameraError(said_of(file, "camera.no_producer"))


def _device(file: Path, found: Any) -> Device:
    said = found.property_dict
    vendor, model, serial = (str(said.get(key) or "") for key in ("vendor", "model", "serial_number"))
    return Device(f"{SCHEME}:{file}#{serial}" if serial else f"{SCHEME}:{file}", vendor, model, serial)


def _chosen(file: Path, serial: str, found: Sequence[Device]) -> int:
    """Place of the camera that is meant among those that a producer sees."""
    if not found:
        raise CameraGoneError(said_of(f"{SCHEME}:{file}", "camera.none_seen"))
    serials = [device.serial for device in found]
    if serial in serials:
        return serials.index(serial)
    listed = [f"{SCHEME}:{file}#{one}" for one in serials]
    if serial:
        raise CameraGoneError(said_of(f"{SCHEME}:{file}#{serial}", "camera.not_there_among", listed=listed))
    if len(found) > 1:
        raise CameraError(said_of(f"{SCHEME}:{file}", "camera.several", listed=listed))
    return 0


def _acquirer(harvester: Any, index: int, device: Device) -> Any:
    from genicam.gentl import GenericException

    try:
        return harvester.create(index)
    except (GenericException, ValueError) as error:
        raise CameraGoneError(said_of(device.address, "camera.busy", why=first_line(error))) from error


def _part(component: Any) -> Part:
    """Return a part of a buffer with values of its own: those of the buffer are gone with it."""
    return Part(component.data_format, component.width, component.height, np.array(component.data))
