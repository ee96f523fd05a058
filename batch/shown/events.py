"""What happens in a check as JSON lines, for programs that follow it.

Each line is an object with ``event``: ``started``, ``column``, ``lost``, ``message``, ``interrupted`` or ``finished``.
"""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from aadm_workbench.errors import JobError

STDOUT = "-"


class Events:
    """A stream of events, into a file or, for ``-``, to stdout; None is for nobody.

    Raises
    ------
    JobError
        Where the file cannot be opened.
    """

    def __init__(self, target: str | None) -> None:
        self._stream: IO[str] | None = None
        self._is_own = target not in (None, STDOUT)
        if target == STDOUT:
            self._stream = sys.stdout
        elif target is not None:
            try:
                self._stream = Path(target).open("a", encoding="utf-8", errors="replace", buffering=1)  # noqa: SIM115
            except OSError as error:
                raise JobError(f"{target}: events cannot be written there ({error.strerror})") from error

    def send(self, event: str, **what: Any) -> None:
        """Write one event; a reader that has gone away is no reason to stop."""
        if self._stream is None:
            return
        try:
            self._stream.write(json.dumps({"event": event, **what}, ensure_ascii=False, default=str) + "\n")
            self._stream.flush()
        except (OSError, ValueError):
            self._stream = None

    def close(self) -> None:
        """Let go of the file."""
        if self._is_own and self._stream is not None:
            with suppress(OSError):
                self._stream.close()
        self._stream = None
