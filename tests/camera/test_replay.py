"""Folders of captures as people keep them, played in the order of their numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

from aadm_workbench.camera.open import devices, open_camera
from aadm_workbench.camera.replay import open_camera as open_replay
from aadm_workbench.errors import CameraError, CaptureError, EndOfFramesError


def written(folder: Path, *names: str) -> None:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(name.encode())


def played(folder: Path) -> list[set[str]]:
    frames = []
    with open_camera(f"replay:{folder}") as camera:
        while True:
            try:
                frames.append({*camera.capture().files})
            except EndOfFramesError:
                return frames


def test_a_folder_of_capture_folders(tmp_path: Path) -> None:
    for number in (1, 2, 10):
        written(tmp_path, f"cap-{number}/depth-{number}.tiff", f"cap-{number}/camera.json")
    written(tmp_path, "notes.txt", ".hidden/depth.tiff", "empty/readme.md")
    assert played(tmp_path) == [{f"depth-{n}.tiff", "camera.json"} for n in (1, 2, 10)]


def test_one_capture_is_one_frame(tmp_path: Path) -> None:
    written(tmp_path, "depth.tiff", "texture.png", "cloud.ply", "intrinsics.yaml")
    assert played(tmp_path) == [{"depth.tiff", "texture.png", "cloud.ply", "intrinsics.yaml"}]


def test_a_series_shares_what_is_beside_it(tmp_path: Path) -> None:
    names = [f"frame{n}{suffix}" for n in (9, 10) for suffix in (".tiff", ".png")]
    written(tmp_path, *names, "camera.toml", ".frame11.tiff.part")
    assert played(tmp_path) == [
        {"frame9.tiff", "frame9.png", "camera.toml"},
        {"frame10.tiff", "frame10.png", "camera.toml"},
    ]


def test_a_capture_keeps_its_record_but_for_the_time(tmp_path: Path) -> None:
    written(tmp_path, "one/depth.tiff")
    (tmp_path / "one" / "capture.json").write_text(
        '{"captured": "2020-01-01T00:00:00Z", "serial": "X7", "settings": {"Gain": 2.0}, "notes": ["smoothing is on"]}'
    )
    frame = open_replay(f"replay:{tmp_path}").capture()
    assert (frame.device.serial, frame.settings, frame.notes) == ("X7", {"Gain": 2.0}, ("smoothing is on",))
    assert frame.captured_s > 1_700_000_000
    assert {*frame.files} == {"depth.tiff"}


def test_a_capture_that_is_gone_costs_itself_alone(tmp_path: Path) -> None:
    written(tmp_path, "a/depth.tiff", "b/depth.tiff")
    camera = open_replay(f"replay:{tmp_path}")
    (tmp_path / "a" / "depth.tiff").unlink()
    with pytest.raises(CaptureError, match=r"a/depth.tiff: cannot be read") as caught:
        camera.capture()
    assert not isinstance(caught.value, EndOfFramesError)
    assert camera.capture().files == {"depth.tiff": b"b/depth.tiff"}


def test_it_can_begin_again(tmp_path: Path) -> None:
    written(tmp_path, "a/depth.tiff")
    camera = open_replay(f"replay:{tmp_path}", repeat=True)
    assert [len(camera.capture().files) for _ in range(3)] == [1, 1, 1]


@pytest.mark.parametrize("address", ["replay:", "replay:no-such-folder", "usb:1", "viky.cti", ""])
def test_addresses_that_name_no_camera(address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(CameraError, match=r"^(replay|usb|viky|:)"):
        open_camera(address)
    with pytest.raises(CameraError):
        devices(address)


def test_a_folder_without_captures_says_so(tmp_path: Path) -> None:
    written(tmp_path, "readme.md")
    with pytest.raises(CameraError, match="holds no capture"):
        open_camera(f"replay:{tmp_path}")
