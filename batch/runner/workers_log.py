"""DIR/workers.log: what workers and Dask have to say, wherever they run, one line each with its time."""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

from aadm_workbench.own_files import open_to_write

NAME = "workers.log"
_APPEND = os.O_WRONLY | os.O_APPEND


class WorkersLog:
    """A log that lines are added to; that it cannot be written is never the reason why a check fails."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        self._lock = threading.Lock()

    def write(self, line: str) -> None:
        """Add a line."""
        # What a scan's name or a native library says is not to steer the terminal that shows the log.
        line = "".join(sign if sign.isprintable() else "\N{REPLACEMENT CHARACTER}" for sign in line)
        now = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        said = f"{now} {line}\n".encode(errors="replace")
        with self._lock, suppress(OSError), open(open_to_write(self._path, _APPEND), "ab") as stream:  # noqa: PTH123
            stream.write(said)
