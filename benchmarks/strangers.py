"""What strangers do to a check while it runs: links and pipes in its folder, another user at its ports and pipes."""

from __future__ import annotations

import os
import subprocess
import sys
import uuid
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import psutil

NOBODY = 65534

_REPLACED = ("report.json", "timing.json", "workers.log", "report.bcf", ".aadm-workers")
"""Files and folders of a check in whose place a stranger puts something; not its journal, from which it is resumed."""

_REACH = """
import os, socket, sys
os.setgroups([]); os.setgid({nobody}); os.setuid({nobody})
folder, *pids = sys.argv[1:]
for pid in pids:
    for path in (f"/proc/{{pid}}/fd/0", f"/proc/{{pid}}/fd/1", f"/proc/{{pid}}/mem", f"/proc/{{pid}}/environ"):
        try:
            os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK)); print("opened", path)
        except OSError:
            pass
for name in ("journal.jsonl", "stranger"):
    try:
        os.close(os.open(os.path.join(folder, name), os.O_WRONLY | os.O_CREAT)); print("wrote", name)
    except OSError:
        pass
"""


@dataclass
class Strangers:
    """Plants things in the folder of a check, and keeps count.

    Parameters
    ----------
    folder
        Of the reports.
    precious
        A folder with what links lead to; whatever changes in it is lost to a stranger.
    """

    folder: Path
    precious: Path
    links: int = 0
    pipes: int = 0
    users: int = 0
    doors: set[str] = field(default_factory=set)
    reached: list[str] = field(default_factory=list)
    _before: dict[str, bytes] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.precious.mkdir()
        for name in _REPLACED:
            (self.precious / name).write_bytes(uuid.uuid4().bytes)
        self._before = self._now()

    @property
    def harm(self) -> list[str]:
        """What went wrong, in words."""
        changed = [name for name in {**self._before, **self._now()} if self._now().get(name) != self._before.get(name)]
        return [*(f"written through a link: {name}" for name in changed), *sorted(self.doors), *self.reached]

    def plant(self, rng: np.random.Generator) -> None:
        """Put a link or a pipe in the place of something, or a half-written file beside it."""
        name = _REPLACED[int(rng.integers(len(_REPLACED)))]
        place, kind = self.folder / name, int(rng.integers(4))
        with suppress(OSError):
            self.folder.mkdir(exist_ok=True)
            place.unlink(missing_ok=True)
            if kind == 0:
                place.symlink_to(self.precious / name)
            elif kind == 1:
                place.hardlink_to(self.precious / name)
            elif kind == 2:
                os.mkfifo(place)
            else:
                (self.folder / f".{name}.{uuid.uuid4().hex}.part").symlink_to(self.precious / name)
            self.pipes += kind == 2
            self.links += kind != 2

    def come_near(self, pid: int) -> None:
        """Look for ports of a check and its workers, and, as root, reach for its pipes and files as another user."""
        family = []
        with suppress(psutil.Error):
            family = [psutil.Process(pid), *psutil.Process(pid).children(recursive=True)]
        for process in family:
            with suppress(psutil.Error):
                ports = [one for one in process.net_connections() if one.status == psutil.CONN_LISTEN]
                self.doors |= {f"listens on port {one.laddr.port}" for one in ports}
        if hasattr(os, "geteuid") and os.geteuid() == 0:
            words = [str(self.folder), *(str(process.pid) for process in family)]
            command = [sys.executable, "-c", _REACH.format(nobody=NOBODY), *words]
            found = subprocess.run(command, cwd="/", capture_output=True, text=True, check=False)
            self.reached += found.stdout.splitlines()
            self.users += 1

    def _now(self) -> dict[str, bytes]:
        return {entry.name: entry.read_bytes() for entry in self.precious.iterdir()}
