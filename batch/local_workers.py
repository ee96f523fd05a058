"""The worker processes of this machine: started, replaced when they die, asked how they died."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from time import monotonic
from typing import Any

from aadm_workbench.errors import AadmError

from .worker import last_words, read_log

MOST_FALSE_STARTS = 10
"""So many workers in a row may end by themselves within ``_START_S`` before it is clear that none can be started."""

_START_S = 3.0  # a worker that starts takes one or two
_CLOSE_S = 5.0  # one that does not end by then is killed
_ENVIRONMENT = {
    "DASK_LOGGING__DISTRIBUTED": "error",
    "DASK_LOGGING__TORNADO": "critical",
    "DASK_DISTRIBUTED__ADMIN__LOW_LEVEL_LOG_LENGTH": "20",
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
    "OMP_NUM_THREADS": "1",
}


class LocalWorkers:
    """Some processes of this machine that work for a scheduler.

    Parameters
    ----------
    address
        Of the scheduler.
    processes
        How many.
    folder
        Where they write, each its log among other things.
    memory_bytes
        What one may hold. Each is bound to it by its own system; where that does not help it is ended at a quarter
        more.
    """

    def __init__(self, address: str, processes: int, folder: Path, memory_bytes: int) -> None:
        self._address = address
        self._folder = folder
        self._most_bytes = memory_bytes + memory_bytes // 4
        self._started: dict[int, tuple[subprocess.Popen[bytes], float]] = {}
        self._logs: dict[int, Path] = {}
        self._last_words = ""
        self._ended: dict[int, str] = {}
        self._too_large: set[int] = set()
        self._false_starts = 0
        self._number = 0
        self._processes = processes
        self.tend()

    def tend(self) -> None:
        """Replace what has died, and end what is too large.

        Raises
        ------
        AadmError
            Where workers die as soon as they are started.
        """
        for pid, (process, began) in list(self._started.items()):
            code = process.poll()
            if code is None:
                self._end_if_too_large(pid)
                continue
            del self._started[pid]
            self._ended[pid] = _in_words(code) + self._why(pid)
            is_false_start = monotonic() - began < _START_S and code != -getattr(signal, "SIGKILL", 0)
            self._false_starts = self._false_starts + 1 if is_false_start else 0
            self._last_words = last_words(read_log(str(self._logs[pid]))) or self._last_words
        if self._false_starts > MOST_FALSE_STARTS:
            why = self._last_words or "each ended at once"
            raise AadmError(f"no worker process can be started on this machine: {why}")
        while len(self._started) < self._processes:
            self._start()

    def how_ended(self, address: str, pid: int) -> str | None:
        """How a worker ended, in words; None while it runs."""
        self.tend()
        return self._ended.get(pid)

    def kill(self, address: str, pid: int) -> None:
        """End a worker; another takes its place."""
        if pid in self._started:
            self._started[pid][0].kill()

    def close(self) -> None:
        """End all."""
        for process, _ in self._started.values():
            process.kill()
        for process, _ in self._started.values():
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(_CLOSE_S)
        self._started.clear()

    def _start(self) -> None:
        self._number += 1
        # -P: what lies in the working folder by chance is not to be imported.
        command = [sys.executable, "-P", "-m", f"{__package__}.local_worker"]
        environment = {**os.environ, **_ENVIRONMENT, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
        log_file = self._folder / f"worker-{self._number}.log"
        with log_file.open("wb") as log:
            process = subprocess.Popen(
                [*command, self._address, str(self._folder), str(os.getpid())],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env=environment,
                # Ctrl-C is for the check alone, which ends its workers.
                start_new_session=True,
            )
        self._started[process.pid] = (process, monotonic())
        self._logs[process.pid] = log_file

    def _end_if_too_large(self, pid: int) -> None:
        psutil: Any = import_module("psutil")
        with contextlib.suppress(psutil.Error):
            if psutil.Process(pid).memory_info().rss > self._most_bytes:
                self._too_large.add(pid)
                self.kill(self._address, pid)

    def _why(self, pid: int) -> str:
        return ", because it held more memory than it may (--memory-limit)" if pid in self._too_large else ""


def _in_words(code: int) -> str:
    return signal_words(-code) if code < 0 else f"ended with status {code}"


def signal_words(number: int) -> str:
    """``killed by signal 11 (SIGSEGV)``."""
    try:
        return f"killed by signal {number} ({signal.Signals(number).name})"
    except ValueError:
        return f"killed by signal {number}"
