"""New frames in a folder, each once it is written whole."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from aadm_workbench.scan.read import supported_formats

_STEADY_LOOKS = 2  # in a row with the same size: a file that grows changes between them
_MOST_KNOWN = 2_000  # frames of some hours; names of older ones are forgotten
_PATIENCE_LOOKS = 8  # a second or so, until a file of full size also has its content


@dataclass
class FolderWatch:
    """Tells which files of a folder are new and have stopped growing.

    What it knows of files that are gone is forgotten, and of a folder that only ever grows the newest are kept, so that
    a day of frames costs no more memory than an hour.
    """

    folder: Path
    names_done: dict[str, int] = field(default_factory=dict)
    _forgotten_ns: int = -1
    _sizes: dict[str, tuple[int, int, int]] = field(default_factory=dict)

    def skip_present(self) -> None:
        """Count all that is there already as done."""
        self._forgotten_ns = max((stamp for _, stamp in self._present().values()), default=-1)

    def wait_for(self, path: Path) -> None:
        """Look at a file again once it has changed: it was whole in size and not in content."""
        size, stamp, _ = self._sizes.get(path.name, (0, 0, 0))
        self._sizes[path.name] = (size, stamp, -_PATIENCE_LOOKS)

    def ready(self) -> list[Path]:
        """Files that are new, or written anew, and have not grown since the last looks; oldest first."""
        present = self._present()
        self.names_done = {name: stamp for name, stamp in self.names_done.items() if name in present}
        for name in list(self._sizes):
            if name not in present:
                del self._sizes[name]
        found: list[tuple[int, str]] = []
        for name, (size, stamp) in present.items():
            if self.names_done.get(name) == stamp or stamp <= self._forgotten_ns or size == 0:
                continue
            last_size, last_stamp, looks = self._sizes.get(name, (-1, -1, 0))
            looks = looks + 1 if (size, stamp) == (last_size, last_stamp) else 1
            self._sizes[name] = (size, stamp, looks)
            if looks >= _STEADY_LOOKS:
                found.append((stamp, name))
        return [self.folder / name for _, name in sorted(found)]

    def done(self, path: Path) -> None:
        """Count a file as done, as it is now."""
        _, stamp, _ = self._sizes.pop(path.name, (0, 0, 0))
        self.names_done[path.name] = stamp
        while len(self.names_done) > _MOST_KNOWN:
            oldest = min(self.names_done, key=lambda name: self.names_done[name])
            self._forgotten_ns = max(self._forgotten_ns, self.names_done.pop(oldest))

    def _present(self) -> dict[str, tuple[int, int]]:
        """Size and time of change (ns) of every file that can be a frame."""
        formats = supported_formats()
        present: dict[str, tuple[int, int]] = {}
        for path in self.folder.iterdir():
            if path.suffix.lower() in formats and not path.name.startswith("."):
                try:
                    status = path.stat()
                except OSError:  # gone between listing and looking
                    continue
                present[path.name] = (status.st_size, status.st_mtime_ns)
        return present
