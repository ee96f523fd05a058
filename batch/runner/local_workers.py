"""The worker processes of this machine: started, replaced when they die, asked how they died."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Reason
from aadm_workbench.own_files import create

from .machine import load_psutil
from .worker import last_words, read_log

MOST_FALSE_STARTS = 10
"""So many workers in a row may end by themselves within ``_START_S`` before it is clear that none can be started."""

_START_S = 3.0  # a worker that starts takes one or two
_CLOSE_S = 5.0  # one that does not end by then is killed
_ENVIRONMENT = {"OMP_NUM_THREADS": "1"}


@dataclass(frozen=True, eq=False)
class LocalProcess:
    """A worker process: its number among those of this check, and the file into which it writes until it works."""

    number: int
    process: subprocess.Popen[bytes]
    log: Path
    began: float


class LocalWorkers:
    """Some processes of this machine that wait for questions at the other end of a pipe.

    Parameters
    ----------
    processes
        How many.
    folder
        Where they write, each its log among other things.
    memory_bytes
        What one may hold. Each is bound to it by its own system; where that does not help it is ended at a quarter
        more.
    """

    def __init__(self, processes: int, folder: Path, memory_bytes: int) -> None:
        self.running: dict[int, LocalProcess] = {}
        self._folder = folder
        self._most_bytes = memory_bytes + memory_bytes // 4
        self._psutil = load_psutil()
        self._ended: dict[int, str] = {}
        self._too_large: set[int] = set()
        self._false_starts = 0
        self._last_words = ""
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
        for number, worker in list(self.running.items()):
            code = worker.process.poll()
            if code is None:
                self._end_if_too_large(worker)
                continue
            del self.running[number]
            self._ended[number] = self._in_words(number, code)
            is_false_start = monotonic() - worker.began < _START_S and code != -getattr(signal, "SIGKILL", 0)
            self._false_starts = self._false_starts + 1 if is_false_start else 0
            self._last_words = last_words(read_log(str(worker.log))) or self._last_words
        if self._false_starts > MOST_FALSE_STARTS:
            why = self._last_words or Reason("run.ended_at_once")
            raise AadmError.because("run.no_process", why=why)
        while len(self.running) < self._processes:
            self._start()

    def how_ended(self, number: int) -> str | None:
        """How a worker ended, in words; None while it runs."""
        self.tend()
        return self._ended.get(number)

    def kill(self, number: int) -> None:
        """End a worker; another takes its place."""
        if number in self.running:
            self.running[number].process.kill()

    def close(self) -> None:
        """End all."""
        for worker in self.running.values():
            worker.process.kill()
        for worker in self.running.values():
            with suppress(subprocess.TimeoutExpired):
                worker.process.wait(_CLOSE_S)
        self.running.clear()

    def _start(self) -> None:
        self._number += 1
        # -P: what lies in the working folder by chance is not to be imported.
        command = [sys.executable, "-P", "-m", f"{__package__}.local_worker", str(os.getpid())]
        environment = {**os.environ, **_ENVIRONMENT, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
        log_file = self._folder / f"worker-{self._number}.log"
        with open(create(log_file), "wb") as log:  # noqa: PTH123 - of a descriptor
            process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                env=environment,
                # Ctrl-C is for the check alone, which ends its workers.
                start_new_session=True,
            )
        self.running[self._number] = LocalProcess(self._number, process, log_file, monotonic())

    def _end_if_too_large(self, worker: LocalProcess) -> None:
        with suppress(self._psutil.Error):
            if self._psutil.Process(worker.process.pid).memory_info().rss > self._most_bytes:
                self._too_large.add(worker.number)
                worker.process.kill()

    def _in_words(self, number: int, code: int) -> Reason:
        how = exit_words(code)
        return Reason("run.too_large", how=how) if number in self._too_large else how


def exit_words(code: int) -> Reason:
    """``ended with status 3``; of a negative number, as Python has it, what signal killed it."""
    return signal_words(-code) if code < 0 else Reason("run.ended", code=code)


def signal_words(number: int) -> Reason:
    """``killed by signal 11 (SIGSEGV)``."""
    try:
        return Reason("run.killed", signal=f"{number} ({signal.Signals(number).name})")
    except ValueError:
        return Reason("run.killed", signal=str(number))
