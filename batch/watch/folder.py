"""New frames in a folder, each once it is written whole."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from aadm_workbench.camera.frame import RECORD_NAME
from aadm_workbench.camera.record import record_of
from aadm_workbench.scan.read import supported_formats

from ..job.table import NEAR

_STEADY_LOOKS = 2  # in a row with the same size: a file that grows changes between them
_PATIENCE_LOOKS = 8  # a second or so, until a file of full size also has its content


@dataclass
class _Growth:
    """A file that is not done: what it was when last looked at, in how many looks, and when it was first seen, ns."""

    size: int
    stamp_ns: int
    looks: int
    first_seen_ns: int | None


@dataclass
class FolderWatch:
    """Tells which files of a folder are new and have stopped growing.

    A capture is a folder with a ``capture.json`` in it. A camera that stands at another corner writes into a subfolder
    with that corner's name (``-x-y``). What counts is which file was there, by name, size and time of change, never
    whether a time lies before another: clocks are set back. What is known of files that are gone is forgotten.
    """

    folder: Path
    now_ns: Callable[[], int] = time.time_ns
    names_done: dict[str, tuple[int, int]] = field(default_factory=dict)
    _growing: dict[str, _Growth] = field(default_factory=dict)
    _has_looked: bool = False

    def skip_present(self) -> None:
        """Count all that is there already as done."""
        self._has_looked = True
        self.names_done = self._present()

    def wait_for(self, path: Path) -> None:
        """Look at a file again once it has changed: it was whole in size and not in content."""
        self._growing.setdefault(self.name_of(path), _Growth(0, 0, 0, None)).looks = -_PATIENCE_LOOKS

    def ready(self) -> list[Path]:
        """Files that are new, or written anew, and have not grown since the last looks; oldest first."""
        present, now_ns = self._present(), self.now_ns()
        self.names_done = {name: known for name, known in self.names_done.items() if name in present}
        self._growing = {name: growth for name, growth in self._growing.items() if name in present}
        found: list[tuple[int, str]] = []
        for name, (size, stamp_ns) in present.items():
            if self.names_done.get(name) == (size, stamp_ns) or size == 0:
                continue
            # what was there before anybody looked, and says it comes from the future, has no time
            known = self._has_looked or stamp_ns <= now_ns
            growth = self._growing.setdefault(name, _Growth(-1, -1, 0, now_ns if known else None))
            if (size, stamp_ns) == (growth.size, growth.stamp_ns):
                growth.looks += 1
            else:
                growth.size, growth.stamp_ns, growth.looks = size, stamp_ns, 1
            # a capture is put in its place when it is whole
            if growth.looks >= _STEADY_LOOKS or (self.folder / name).is_dir():
                found.append((stamp_ns, name))
        self._has_looked = True
        return [self.folder / name for _, name in sorted(found)]

    def captured_s(self, path: Path) -> float | None:
        """When a file that is ready was written, seconds since 1970; not after it was first seen. None: not known."""
        growth = self._growing.get(self.name_of(path))
        if growth is None or growth.first_seen_ns is None:
            return None
        record = record_of(path) if path.is_dir() else None
        recorded_s = [] if record is None or record.captured_s is None else [record.captured_s]
        return min(growth.stamp_ns / 1e9, growth.first_seen_ns / 1e9, *recorded_s)

    def done(self, path: Path) -> None:
        """Count a file as done, as it was when it was ready."""
        growth = self._growing.pop(self.name_of(path), _Growth(0, 0, 0, None))
        self.names_done[self.name_of(path)] = (growth.size, growth.stamp_ns)

    def name_of(self, path: Path) -> str:
        """What a frame is called: its name, with the corner's subfolder before it."""
        return path.relative_to(self.folder).as_posix()

    def _present(self) -> dict[str, tuple[int, int]]:
        """Size and time of change (ns) of every file that can be a frame."""
        present: dict[str, tuple[int, int]] = {}
        for path in self._frames():
            try:
                whole = (path / RECORD_NAME if path.is_dir() else path).stat()
            except OSError:  # gone between listing and looking
                continue
            present[self.name_of(path)] = (whole.st_size, whole.st_mtime_ns)
        return present

    def _frames(self) -> Iterator[Path]:
        formats = supported_formats()
        for path in self.folder.iterdir():
            inner = _listed(path) if path.name in NEAR else [path]
            yield from (one for one in inner if not one.name.startswith(".") and _is_frame(one, formats))


def _is_frame(path: Path, formats: tuple[str, ...]) -> bool:
    """Whether something in the folder is a scan, or a capture that ``aadm capture`` or ``aadm watch`` wrote."""
    return path.suffix.lower() in formats or (path / RECORD_NAME).is_file()


def _listed(folder: Path) -> list[Path]:
    try:
        return list(folder.iterdir())
    except OSError:  # no folder, or gone between listing and looking
        return []


def corner_of(path: Path) -> tuple[int, int] | None:
    """The corner that a frame's subfolder names; None for a frame in the folder itself."""
    return NEAR.get(path.parent.name)
