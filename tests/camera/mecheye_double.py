"""The maker's library with its camera replaced: all containers and error codes are its own, the network is not asked.

Run as a Python: ``mecheye_double.py [-I] PROGRAM``. What the camera holds stands in the folder AADM_TEST_MECHEYE:
``depth.npy``, and ``said.json`` with matrix, distortion, settings and what goes wrong at each capture.
"""

import ctypes
import json
import os
import runpy
import sys
import time
from pathlib import Path

import numpy as np
from mecheye import area_scan_3d_camera as library
from mecheye.shared import ErrorStatus

FOLDER = Path(os.environ["AADM_TEST_MECHEYE"])
SAID = json.loads((FOLDER / "said.json").read_text())


def status(name: str = "SUCCESS", description: str = "") -> ErrorStatus:
    return ErrorStatus(getattr(ErrorStatus, f"MMIND_STATUS_{name}"), description)


class UserSet:
    def get_available_parameter_names(self):
        return status(), list(SAID["settings"])

    def _read(self, name, kind):
        value = SAID["settings"][name]
        if type(value) is kind:
            return status(), value
        return status("PARAMETER_ERROR", "of another type"), None

    def get_enum_value_string(self, name):
        return self._read(name, str)

    def get_bool_value(self, name):
        return self._read(name, bool)

    def get_int_value(self, name):
        return self._read(name, int)

    def get_float_value(self, name):
        return self._read(name, float)


class Frame3D:
    """Holds the library's own depth map, as its own frame does."""

    def get_depth_map(self):
        return self.depth


class Camera:
    @staticmethod
    def discover_cameras(_within_ms):
        found = library.CameraInfo()
        Camera().get_camera_info(found)
        return [found]

    def connect(self, ip, _within_ms):
        print("chatter on the standard output")
        print("chatter on the standard error", file=sys.stderr)
        return status() if ip == SAID["ip"] else status("INVALID_DEVICE", "no camera has this address")

    def get_camera_info(self, info):
        info.model, info.serial_number, info.ip_address = "Mech-Eye PRO M", "M-0042", SAID["ip"]
        return status()

    def current_user_set(self):
        return UserSet()

    def get_camera_intrinsics(self, found):
        for name, value in zip(("fx", "fy", "cx", "cy"), SAID["matrix"], strict=True):
            setattr(found.depth.camera_matrix, name, value)
        for name, value in zip(("k1", "k2", "p1", "p2", "k3"), SAID["distortion"], strict=True):
            setattr(found.depth.camera_distortion, name, value)
        return status()

    def capture_3d(self, frame, _within_ms):
        fault = SAID["faults"].pop(0) if SAID["faults"] else ""
        if fault == "dies":
            os._exit(1)
        if fault == "hangs":
            time.sleep(600)
        if fault:
            return status(fault, f"the library says {fault}")
        values = np.load(FOLDER / "depth.npy").astype(np.float32)
        frame.depth = library.DepthMap()
        frame.depth.resize(values.shape[1], values.shape[0])
        start = int(library._area_scan_3d_camera.DepthMap_data(frame.depth).this)
        ctypes.memmove(start, values.tobytes(), values.nbytes)
        return status()


library.Camera, library.Frame3D = Camera, Frame3D
runpy.run_path(sys.argv[-1], run_name="__main__")
