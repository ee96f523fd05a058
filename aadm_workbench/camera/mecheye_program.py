"""The process that holds a Mech-Eye camera: the maker's library (mecheyeapi, BSD-3) and nothing of this product.

It runs by itself, in whatever Python has the library (it is made for 3.10 and 3.11 alone). Requests are lines of JSON
on its standard input: ``{"ask": "devices"}``, ``{"ask": "open", "ip": …}``, ``{"ask": "capture", "within_ms": …}``.
Each answer is a line of JSON on what was its standard output, and after it the bytes of the depth map, where it says
how many. The library writes to the screen and into /var/log: the one goes nowhere, the other has room for nothing.
"""

from __future__ import annotations

import json
import os
import sys
from typing import IO, Any

_CONNECT_WITHIN_MS = 5000  # a camera in the same network answers in a tenth of it
_DISCOVER_WITHIN_MS = 3000  # cameras answer a broadcast within one second
_GONE = ("MMIND_STATUS_INVALID_DEVICE", "MMIND_STATUS_DEVICE_OFFLINE", "MMIND_STATUS_MESSAGE_CHANNEL_ERROR")
_READERS = ("get_enum_value_string", "get_bool_value", "get_int_value", "get_float_value")


def main() -> None:
    """Answer requests until there are no more."""
    answers = os.fdopen(os.dup(1), "wb")
    _keep_quiet()
    try:
        from mecheye import area_scan_3d_camera as library
    except (ImportError, OSError) as error:
        _send(answers, {"missing": str(error)})
        return
    holder = _Holder(library)
    for line in sys.stdin.buffer:
        request = json.loads(line)
        try:
            answer, content = getattr(holder, request.pop("ask"))(**request)
        except _SaidNoError as error:
            answer, content = {"fault": str(error), "gone": error.gone}, b""
        _send(answers, answer, content)


class _SaidNoError(Exception):
    """The library answered with an error."""

    def __init__(self, status: Any) -> None:
        super().__init__(status.error_description)
        self.gone = status.error_code in {getattr(type(status), name) for name in _GONE}


class _Holder:
    """One camera, once it is opened."""

    def __init__(self, library: Any) -> None:
        self._library, self._camera = library, library.Camera()

    def devices(self) -> tuple[dict[str, object], bytes]:
        """The cameras that answer a broadcast."""
        found = self._library.Camera.discover_cameras(_DISCOVER_WITHIN_MS)
        return {"devices": [_info(one) for one in found]}, b""

    def open(self, ip: str) -> tuple[dict[str, object], bytes]:
        """Connect, and say what was connected to."""
        _check(self._camera.connect(ip, _CONNECT_WITHIN_MS))
        info = self._library.CameraInfo()
        _check(self._camera.get_camera_info(info))
        return _info(info), b""

    def capture(self, within_ms: int) -> tuple[dict[str, object], bytes]:
        """A depth map, its intrinsics, and the settings in force."""
        frame, intrinsics = self._library.Frame3D(), self._library.CameraIntrinsics()
        _check(self._camera.capture_3d(frame, within_ms))
        _check(self._camera.get_camera_intrinsics(intrinsics))
        depth = frame.get_depth_map()
        matrix, lens = intrinsics.depth.camera_matrix, intrinsics.depth.camera_distortion
        content = b"" if depth.is_empty() else depth.data().astype("<f4").tobytes()
        return {
            "width": depth.width(),
            "height": depth.height(),
            "matrix": [matrix.fx, matrix.fy, matrix.cx, matrix.cy],
            "distortion": [lens.k1, lens.k2, lens.p1, lens.p2, lens.k3],
            "settings": _settings(self._camera.current_user_set()),
            "bytes": len(content),
        }, content


def _info(info: Any) -> dict[str, object]:
    return {"ip": info.ip_address, "model": info.model, "serial": info.serial_number}


def _settings(user_set: Any) -> dict[str, object]:
    """What is set, by the maker's names; what has no single value (regions, sequences) is left out."""
    status, names = user_set.get_available_parameter_names()
    _check(status)
    found = {}
    for name in names:
        for reader in _READERS:
            status, value = getattr(user_set, reader)(name)
            if status.is_ok():
                found[name] = value
                break
    return found


def _check(status: Any) -> None:
    if not status.is_ok():
        raise _SaidNoError(status)


def _send(answers: IO[bytes], answer: dict[str, object], content: bytes = b"") -> None:
    answers.write(json.dumps(answer).encode() + b"\n" + content)
    answers.flush()


def _keep_quiet() -> None:
    """What the library writes to the screen goes nowhere, and its files stay empty."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    try:
        import resource
        import signal
    except ImportError:  # Windows has neither, and the library writes elsewhere there
        return
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


if __name__ == "__main__":
    main()
