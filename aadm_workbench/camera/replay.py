"""A camera without hardware, ``replay:FOLDER``: it gives captures that were made before, one after the other.

The folder holds captures, each a folder; or it is one itself; or it holds the frames of a series, files whose names
differ in a number. What is beside a series (intrinsics) belongs to each of its frames.
"""

from __future__ import annotations

import re
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from aadm_workbench.camera.frame import RECORD_NAME, Closing, Device, Frame
from aadm_workbench.camera.record import Record, record_of
from aadm_workbench.errors import CameraError, CaptureError, EndOfFramesError
from aadm_workbench.model.reason import said_of

SCHEME = "replay"
LARGEST_CAPTURE_BYTES = 2**30
"""As of one scan file; a capture takes 10 to 100 MB."""

_POINTS = frozenset({".tif", ".tiff", ".png", ".ply", ".pcd", ".npz", ".e57", ".las", ".laz", ".pts", ".ptx", ".xyz"})
_NUMBER = re.compile(r"\d+")


def devices(address: str) -> list[Device]:
    """Return the one camera that a folder is."""
    return [open_camera(address).device]


def open_camera(address: str, repeat: bool = False) -> ReplayCamera:
    """Open a folder of captures; with ``repeat`` it begins again at its end.

    Raises
    ------
    CameraError
        Where there is no such folder, or no capture in it.
    """
    folder = Path(address.partition(":")[2])
    if not folder.is_dir() or not address.partition(":")[2]:
        raise CameraError(said_of(address, "camera.no_folder"))
    captures = captures_in(folder)
    if not captures:
        raise CameraError(said_of(address, "camera.no_capture"))
    return ReplayCamera(Device(address), captures, repeat)


def captures_in(folder: Path) -> list[list[Path]]:
    """Return the files of each capture of a folder, in the order of the numbers in their names."""
    files = _files(folder)
    frames = list(_series(files)) or ([files] if _scans(files) else [])
    inner = [one for one in sorted(folder.iterdir(), key=_natural) if one.is_dir() and not one.name.startswith(".")]
    return frames or [found for one in inner if _scans(found := _files(one))]


def _files(folder: Path) -> list[Path]:
    return sorted((path for path in folder.iterdir() if path.is_file() and not path.name.startswith(".")), key=_natural)


def _scans(files: Sequence[Path]) -> list[Path]:
    return [path for path in files if path.suffix.lower() in _POINTS]


def _natural(path: Path) -> list[tuple[int, str]]:
    """Key by which frame-9 comes before frame-10."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", path.name)]


def _series(files: Sequence[Path]) -> Iterator[list[Path]]:
    """The frames of a series, each with the files of its number and those without one; nothing where there is none."""
    kinds: dict[tuple[str, str], list[Path]] = defaultdict(list)
    for path in files:
        kinds[_NUMBER.sub("#", path.stem), path.suffix.lower()].append(path)
    if not any(len(paths) > 1 for (_, suffix), paths in kinds.items() if suffix in _POINTS):
        return
    beside = [paths[0] for paths in kinds.values() if len(paths) == 1]
    numbered: dict[tuple[str, ...], list[Path]] = defaultdict(list)
    for path in (path for paths in kinds.values() if len(paths) > 1 for path in paths):
        numbered[tuple(_NUMBER.findall(path.stem))].append(path)
    for _, paths in sorted(numbered.items(), key=lambda item: _natural(item[1][0])):
        if _scans(paths):
            yield [*paths, *beside]


class ReplayCamera(Closing):
    """Captures that are played again; each counts as captured when it is asked for, by the camera that took it."""

    def __init__(
        self,
        device: Device,
        captures: Sequence[Sequence[Path]],
        repeat: bool = False,
        now_ns: Callable[[], int] = time.time_ns,
    ) -> None:
        self.device = device
        self._captures, self._repeat, self._now_ns, self._next = captures, repeat, now_ns, 0

    def capture(self) -> Frame:
        """Give the next capture, byte for byte."""
        if self._next >= len(self._captures):
            if not self._repeat:
                raise EndOfFramesError(said_of(self.device.address, "camera.all_played", count=len(self._captures)))
            self._next = 0
        paths = self._captures[self._next]
        self._next += 1
        files = {path.name: self._content(path) for path in paths if path.name != RECORD_NAME}
        kept = record_of(paths[0].parent) or Record()
        device = replace(self.device, vendor=kept.vendor, model=kept.model, serial=kept.serial)
        return Frame(device, self._now_ns() / 1e9, settings=kept.settings, notes=kept.notes, files=files)

    def close(self) -> None:
        """Nothing is held."""

    def _content(self, path: Path) -> bytes:
        try:
            if path.stat().st_size > LARGEST_CAPTURE_BYTES:
                raise CaptureError(said_of(path, "camera.too_large"))
            return path.read_bytes()
        except OSError as error:
            raise CaptureError(said_of(path, "camera.unread", why=error.strerror)) from error
