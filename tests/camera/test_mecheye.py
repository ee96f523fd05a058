"""Mech-Eye: the process that holds the maker's library, with the library's own containers and no camera."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.camera import mecheye
from aadm_workbench.camera.mecheye import PYTHON, devices, open_camera
from aadm_workbench.errors import CameraError, CameraGoneError, CaptureError, MissingDependencyError

needs_library = pytest.mark.skipif(importlib.util.find_spec("mecheye") is None, reason="mecheyeapi is not installed")
IP = "192.168.23.4"
ADDRESS = f"mecheye://{IP}"
DEPTH = np.random.default_rng(3).uniform(500.0, 900.0, (24, 40)).astype(np.float32)
SAID: dict[str, Any] = {
    "ip": IP,
    "matrix": [1000.0, 1001.0, 20.0, 12.0],
    "distortion": [0.0] * 5,
    "settings": {"PointCloudSurfaceSmoothing": "Weak", "EnableGapFilling": False, "Scan3DGain": 1.5, "Count": 2},
    "faults": [],
}


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Set what the camera of the double holds."""
    program = tmp_path / "python"
    double = Path(__file__).with_name("mecheye_double.py")
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{double}" "$@"\n', encoding="utf-8")
    program.chmod(0o700)
    monkeypatch.setenv(PYTHON, str(program))
    monkeypatch.setenv("AADM_TEST_MECHEYE", str(tmp_path))

    def hold(depth: np.ndarray = DEPTH, **changes: Any) -> None:
        np.save(tmp_path / "depth.npy", depth)
        (tmp_path / "said.json").write_text(json.dumps({**SAID, **changes}), encoding="utf-8")

    return hold


@needs_library
def test_depths_come_bit_by_bit_with_intrinsics_and_settings(library: Any, capfd: Any) -> None:
    holes = DEPTH.copy()
    holes[3, 5], holes[4, 6] = 0.0, np.nan
    library(holes)
    (found,) = devices("mecheye://")
    assert (found.address, found.model, found.serial) == (ADDRESS, "Mech-Eye PRO M", "M-0042")
    with open_camera(ADDRESS) as camera:
        frame = camera.capture()
    assert capfd.readouterr() == ("", ""), "what the library writes to the screen goes nowhere"
    expected = np.where(holes > 0, holes, np.float32(np.nan))
    assert np.array_equal(frame.depth_mm, expected, equal_nan=True)
    intrinsics = frame.camera
    assert (intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy) == (1000.0, 1001.0, 20.0, 12.0)
    assert (intrinsics.width, intrinsics.height) == (40, 24)
    assert frame.settings == SAID["settings"]
    assert [note for note in frame.notes if "PointCloudSurfaceSmoothing = Weak" in note]
    assert len(frame.notes) == 1


@needs_library
def test_a_lens_that_is_not_straightened_is_refused(library: Any) -> None:
    library(distortion=[-0.1, 0.0, 0.0, 0.0, 0.0])
    with open_camera(ADDRESS) as camera, pytest.raises(CaptureError, match=r"mecheye://.*: the lens .* -0\.1"):
        camera.capture()


@needs_library
def test_faults_are_named_and_those_that_end_the_camera_are_told_apart(library: Any) -> None:
    library(faults=["NO_DATA_ERROR", "", "DEVICE_OFFLINE", "dies"])
    with open_camera(ADDRESS) as camera:
        with pytest.raises(CaptureError, match="the library says NO_DATA_ERROR") as caught:
            camera.capture()
        assert not isinstance(caught.value, CameraGoneError)
        assert camera.capture().depth_mm is not None
        with pytest.raises(CameraGoneError, match="DEVICE_OFFLINE"):
            camera.capture()
        for _ in range(2):
            with pytest.raises(CameraGoneError, match="ended in the middle"):
                camera.capture()
    with pytest.raises(CameraGoneError, match="no camera has this address"):
        open_camera("mecheye://192.168.23.5")
    with pytest.raises(CameraGoneError, match="no camera answers"):
        devices("mecheye://192.168.23.5")


@needs_library
def test_a_library_that_hangs_is_ended(library: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    library(faults=["hangs"])
    with open_camera(ADDRESS) as camera:
        monkeypatch.setattr(camera._program, "_within_s", 0.2)
        with pytest.raises(CameraGoneError, match=r"said nothing for 0\.2 s"):
            camera.capture()


@needs_library
def test_the_makers_own_camera_says_no_and_fills_no_disk() -> None:
    """The library as it is, asked for a camera that is not there; its files under /var/log stay empty."""
    before = written_logs()
    with pytest.raises(CameraGoneError, match=r"mecheye://127\.0\.0\.1: the camera's maker says: "):
        open_camera("mecheye://127.0.0.1")
    assert written_logs() == before


def written_logs() -> dict[Path, int]:
    sizes = {path: path.stat().st_size for path in Path("/var/log/mmind").rglob("*") if path.is_file()}
    return {path: size for path, size in sizes.items() if size}


def test_where_the_library_is_not_installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bare = tmp_path / "python"
    bare.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S "$@"\n', encoding="utf-8")  # no site-packages
    bare.chmod(0o700)
    for python in (str(bare), str(tmp_path / "none")):
        monkeypatch.setenv(PYTHON, python)
        with pytest.raises(MissingDependencyError, match=f"mecheyeapi.*{PYTHON}"):
            open_camera(ADDRESS)


def test_addresses_that_are_none() -> None:
    for address in ("mecheye:", "mecheye://camera.site", "mecheye://300.1.1.1"):
        with pytest.raises(CameraError, match="write mecheye://IP"):
            open_camera(address)


def test_the_program_needs_nothing_of_this_product() -> None:
    source = Path(mecheye.mecheye_program.__file__).read_text(encoding="utf-8")
    assert "aadm_workbench" not in source
    done = subprocess.run(
        [sys.executable, "-I", "-c", "import ast,sys;ast.parse(sys.stdin.read(),feature_version=(3,10))"],
        input=source,
        text=True,
        check=False,
    )
    assert done.returncode == 0, "it runs in Python 3.10"
