"""Mech-Eye cameras by their maker's own library, ``mecheye://IP``, which a process of its own holds.

The library is made for Python 3.10 and 3.11, ends the process that it fails in, and writes to the screen and into
/var/log. So it runs beside this product (:mod:`aadm_workbench.camera.mecheye_program`), in the Python that
``AADM_MECHEYE_PYTHON`` names, else in this one. Its cameras speak GigE Vision too: ``gige://`` needs none of this.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from aadm_workbench.camera import mecheye_program
from aadm_workbench.camera.coordinates import Coding, Part, measured
from aadm_workbench.camera.frame import Closing, Device, Frame
from aadm_workbench.camera.genicam_frame import FRAME_WITHIN_S
from aadm_workbench.camera.network import asked_for, ip_of
from aadm_workbench.camera.settings import warnings_of
from aadm_workbench.errors import CameraGoneError, CaptureError, MissingDependencyError, package_called
from aadm_workbench.model import Camera, Reason
from aadm_workbench.model.reason import reason_of, said_of

SCHEME = "mecheye"
PYTHON = "AADM_MECHEYE_PYTHON"
"""Variable that names the Python in which the maker's library is installed."""

_VENDOR = "Mech-Mind"
_PACKAGE = "mecheyeapi"
_LONGER_S = 15.0  # the library keeps its own time, 5 s to connect; what takes so much longer is stuck


def devices(address: str) -> list[Device]:
    """Return the cameras that answer in the network, or, by ``mecheye://IP``, the one of that address.

    Raises
    ------
    CameraError
        For an address that is none.
    MissingDependencyError
        Without the maker's library.
    """
    ip = ip_of(address, needed=False)
    with _Program(address) as program:
        listed, _ = program.asked("devices")
    found = [Device(f"{SCHEME}://{one['ip']}", _VENDOR, one["model"], one["serial"]) for one in listed["devices"]]
    return asked_for(address, ip, found)


def open_camera(address: str) -> MechEyeCamera:
    """Open the camera at an address.

    Raises
    ------
    CameraError
        For an address that is none.
    CameraGoneError
        Where no camera answers, or its maker's library says no.
    MissingDependencyError
        Without the maker's library.
    """
    ip = ip_of(address)
    program = _Program(address)
    try:
        said, _ = program.asked("open", ip=ip)
    except BaseException:
        program.close()
        raise
    return MechEyeCamera(Device(address, _VENDOR, said["model"], said["serial"]), program)


class MechEyeCamera(Closing):
    """A camera that is open: depths, in mm, with the intrinsics that the camera says."""

    def __init__(self, device: Device, program: _Program, now_ns: Callable[[], int] = time.time_ns) -> None:
        self.device, self._program, self._now_ns = device, program, now_ns

    def capture(self) -> Frame:
        """Take one frame now; its time is that of the request, never later than the exposure."""
        asked_s = self._now_ns() / 1e9
        said, content = self._program.asked("capture", within_ms=round(FRAME_WITHIN_S * 1000))
        fx, fy, cx, cy = said["matrix"]
        width, height, settings = said["width"], said["height"], said["settings"]
        depth = Part("Coord3D_C32f", width, height, np.frombuffer(content, "<f4"))
        coding = Coding(
            mode="CalibratedC", camera=Camera(fx, fy, cx, cy, width, height), distortion=tuple(said["distortion"])
        )
        try:
            found = measured([depth], coding)
        except CaptureError as error:
            raise CaptureError(Reason("said.of_file", file=self.device.address, why=reason_of(error))) from error
        notes = warnings_of(settings)
        return Frame(self.device, asked_s, depth_mm=found.depth_mm, camera=found.camera, settings=settings, notes=notes)

    def close(self) -> None:
        """Let go of the camera; once more does no harm."""
        self._program.close()


class _Program(Closing):
    """The process with the maker's library: one question, one answer; one that hangs is ended."""

    def __init__(self, address: str, within_s: float = FRAME_WITHIN_S + _LONGER_S) -> None:
        self._address, self._within_s = address, within_s
        command = [os.environ.get(PYTHON) or sys.executable, "-I", str(Path(mecheye_program.__file__).resolve())]
        try:
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
            )
        except OSError as error:
            raise _not_installed(address) from error

    def asked(self, ask: str, **values: object) -> tuple[dict[str, Any], bytes]:
        """Return the answer to a request, and the bytes that come with it.

        Raises
        ------
        CaptureError
            Where the library says no to this frame.
        CameraGoneError
            Where the camera went away, the library's process ended, or it hangs.
        """
        late = threading.Timer(self._within_s, self._process.kill)
        late.start()
        try:
            answer, content = self._exchanged({"ask": ask, **values})
        finally:
            late.cancel()
        if "missing" in answer:
            raise _not_installed(self._address)
        if "fault" in answer:
            kind = CaptureError if ask == "capture" and not answer["gone"] else CameraGoneError
            raise kind(said_of(self._address, "camera.vendor_fault", why=answer["fault"]))
        return answer, content

    def close(self) -> None:
        """End the process; once more does no harm."""
        self._process.kill()
        self._process.communicate()

    def _exchanged(self, request: dict[str, object]) -> tuple[dict[str, Any], bytes]:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None
        try:
            stdin.write(json.dumps(request).encode() + b"\n")
            stdin.flush()
            answer: dict[str, Any] = json.loads(stdout.readline())
            content = stdout.read(answer.get("bytes", 0))
        except (OSError, ValueError) as error:
            raise CameraGoneError(said_of(self._address, "camera.vendor_ended", within_s=self._within_s)) from error
        if len(content) != answer.get("bytes", 0):
            raise CameraGoneError(said_of(self._address, "camera.vendor_ended", within_s=self._within_s))
        return answer, content


def _not_installed(address: str) -> MissingDependencyError:
    install = f"{package_called(_PACKAGE).install}, into Python 3.10 or 3.11, which {PYTHON} may name"
    return MissingDependencyError(_PACKAGE, address, install)
