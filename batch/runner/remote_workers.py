"""Workers that others have started: their nannies replace them, and say how they died."""

from __future__ import annotations

import contextlib
import os
import re
import signal
from asyncio import CancelledError
from collections.abc import Iterator
from typing import Any

from .local_workers import signal_words

GONE: tuple[type[BaseException], ...] = (OSError, TimeoutError, RuntimeError, ValueError, CancelledError)
"""What Dask raises where a worker or the scheduler is no longer there."""


class RemoteWorkers:
    """The workers of a scheduler, by a client of Dask."""

    def __init__(self, client: Any) -> None:
        self._client = client

    def how_ended(self, address: str, pid: int) -> str | None:
        """How a worker ended, as a nanny on its machine says; None where none has said it (yet)."""
        return next((words for line in self._nannies_say(address) if (words := exit_in_words(line, pid))), None)

    def kill(self, address: str, pid: int) -> None:
        """End a worker; its nanny starts another."""
        with contextlib.suppress(*GONE, KeyError):
            self._client.run(_kill, pid, workers=[address], nanny=True)

    def _nannies_say(self, address: str) -> Iterator[str]:
        host = address.rpartition(":")[0]
        with contextlib.suppress(*GONE):
            there = self._client.scheduler_info(n_workers=-1)["workers"]
            near = [other for other in there if other.rpartition(":")[0] == host]
            logs = self._client.get_worker_logs(workers=near, nanny=True) if near else {}
            for messages in logs.values():
                yield from (str(message[-1]) for message in messages)


def exit_in_words(message: str, pid: int) -> str | None:
    """How a process ended, from what its nanny says of it; None where the message is about something else."""
    found = re.search(rf"\bprocess {pid} (?:was killed by signal (\d+)|exited with status (-?\d+))", message)
    if found is None:
        return None
    return signal_words(int(found[1])) if found[1] else f"ended with status {found[2]}"


def _kill(pid: int) -> None:
    """End a process of this machine, from its nanny."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, getattr(signal, "SIGKILL", signal.SIGTERM))
