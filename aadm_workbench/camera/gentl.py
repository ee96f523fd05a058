"""Cameras behind a GenTL producer, ``gentl:FILE.cti[#SERIAL]``: what most vendors of machine vision ship."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from aadm_workbench.camera.coordinates import BEST_FORMATS, BEST_MODE, Part, measured
from aadm_workbench.camera.features import Features, coding_of
from aadm_workbench.camera.frame import Closing, Device, Frame
from aadm_workbench.camera.pinhole import camera_of
from aadm_workbench.camera.settings import warnings_of
from aadm_workbench.errors import CameraError, CameraGoneError, CaptureError, MissingDependencyError

SCHEME = "gentl"
FRAME_WITHIN_S = 15.0
"""Cameras of this kind project, decode and send in half a second to five; then something is wrong."""

_LUMA = (0.299, 0.587, 0.114)  # of R, G, B: ITU-R BT.601
_CHANNELS = {"RGB8": (0, 1, 2, 3), "BGR8": (2, 1, 0, 3), "RGBa8": (0, 1, 2, 4), "BGRa8": (2, 1, 0, 4)}
"""Place of R, G and B among the values of a pixel, and how many these are."""


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
        self._prepare()

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
            raise CameraGoneError(f"{self.device.address}: the camera went away ({_first_line(error)})") from error

    def close(self) -> None:
        """Let go of the camera; once more does no harm."""
        self._acquirer.destroy()
        self._let_go()

    def _note_loss(self) -> None:
        self._lost = True

    def _why_none(self) -> str:
        if self._lost:
            return (
                f"{self.device.address}: packets of the frame were lost, so it is not used; look at the cable, the "
                "switch and the size of packets"
            )
        return f"{self.device.address}: no frame came within {self._within_s:g} s; is it waiting for a trigger?"

    def _prepare(self) -> None:
        """Ask for all coordinates, in the camera's own system, and for what each frame says of them."""
        features = self._features
        features.set("ChunkModeActive", True)
        for chunk in features.choices("ChunkSelector"):
            if chunk.startswith("Scan3d") and features.set("ChunkSelector", chunk):
                features.set("ChunkEnable", True)
        if features.set("ComponentSelector", "Range"):
            features.set("ComponentEnable", True)
        if BEST_MODE in features.choices("Scan3dOutputMode"):
            features.set("Scan3dOutputMode", BEST_MODE)
        offered = features.choices("PixelFormat")
        best = next((name for name in BEST_FORMATS if name in offered), None)
        if best is not None:
            features.set("PixelFormat", best)

    def _frame(self, buffer: Any, captured_s: float) -> Frame:
        try:
            parts = [_part(component) for component in buffer.payload.components]
            width, height = next(((p.width, p.height) for p in parts if p.format.startswith("Coord3D")), (0, 0))
            coding = coding_of(self._features, width, height)
            found = measured(parts, coding)
        except (CaptureError, ValueError) as error:
            raise CaptureError(f"{self.device.address}: {error}") from error
        settings = self._features.settings()
        camera = found.camera if found.points is None else camera_of(found.points)
        return Frame(
            self.device,
            captured_s,
            found.points,
            found.depth_mm,
            camera,
            _grey(parts, width, height),
            settings,
            warnings_of(settings),
        )


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
        raise CameraError(f"{address}: names no producer; write gentl:FILE.cti, or gentl:FILE.cti#SERIAL")
    return Path(file), serial


def _harvester(file: Path) -> Any:
    _check_producer(file)
    try:
        from genicam.gentl import GenericException
        from harvesters.core import Harvester
    except ImportError as error:
        raise MissingDependencyError("harvesters", f"{SCHEME}:{file}") from error
    harvester = Harvester()
    try:
        harvester.add_file(str(file.resolve()))
        harvester.update()
    except GenericException as error:
        harvester.reset()
        raise CameraError(f"{file}: the GenTL producer does not start ({_first_line(error)})") from error
    return harvester


def _check_producer(file: Path) -> None:
    """Say why a file is no producer: harvesters takes anything, and then sees no camera."""
    if not file.is_file():
        raise CameraError(f"{file}: there is no such file; name the .cti file that came with the camera's program")
    try:
        library = ctypes.CDLL(str(file.resolve()))
    except OSError as error:
        raise CameraError(f"{file}: cannot be loaded ({error}); take the .cti file for this system") from error
    if not hasattr(library, "GCInitLib"):
        raise CameraError(f"{file}: is a library, but no GenTL producer")


def _device(file: Path, found: Any) -> Device:
    said = found.property_dict
    vendor, model, serial = (str(said.get(key) or "") for key in ("vendor", "model", "serial_number"))
    return Device(f"{SCHEME}:{file}#{serial}" if serial else f"{SCHEME}:{file}", vendor, model, serial)


def _chosen(file: Path, serial: str, found: Sequence[Device]) -> int:
    """Place of the camera that is meant among those that a producer sees."""
    if not found:
        raise CameraGoneError(f"{SCHEME}:{file}: the producer sees no camera; is it on, and in this network?")
    serials = [device.serial for device in found]
    if serial in serials:
        return serials.index(serial)
    listed = ", ".join(f"{SCHEME}:{file}#{one}" for one in serials)
    if serial:
        raise CameraGoneError(f"{SCHEME}:{file}#{serial}: no such camera; there are {listed}")
    if len(found) > 1:
        raise CameraError(f"{SCHEME}:{file}: several cameras are there; name one of {listed}")
    return 0


def _acquirer(harvester: Any, index: int, device: Device) -> Any:
    from genicam.gentl import GenericException

    try:
        return harvester.create(index)
    except (GenericException, ValueError) as error:
        raise CameraGoneError(
            f"{device.address}: cannot be opened ({_first_line(error)}); does another program have it?"
        ) from error


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]


def _part(component: Any) -> Part:
    """Return a part of a buffer with values of its own: those of the buffer are gone with it."""
    return Part(component.data_format, component.width, component.height, np.array(component.data))


def _grey(parts: Sequence[Part], width: int, height: int) -> npt.NDArray[np.uint8] | None:
    """Return the picture of the same view, pixel for pixel; None where there is none."""
    for part in parts:
        if (part.width, part.height) != (width, height):
            continue
        if part.format == "Mono8" and part.values.size == width * height:
            return part.values.reshape(height, width).astype(np.uint8)
        channels = _CHANNELS.get(part.format)
        if channels is not None and part.values.size == width * height * channels[-1]:
            colours = part.values.reshape(height, width, channels[-1])[..., channels[:3]]
            grey: npt.NDArray[np.uint8] = np.rint(colours @ np.array(_LUMA)).astype(np.uint8)
            return grey
    return None
