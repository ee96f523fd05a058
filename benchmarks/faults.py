"""What goes wrong around a check that is in itself sound: the disk is full, the scheduler dies, a mount is empty.

Each fault meets a check that goes on where the last one ended, and has to end it with one sentence and its exit code;
what was kept is kept.
"""

from __future__ import annotations

import contextlib
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from batch.switches import BAD_USAGE, INTERNAL

_COLUMNS_MORE = 1  # are checked before the disk is full, and before the scheduler dies: each fault needs one to meet
_ROOM_FOR = 1.5  # columns: room for those, and not for a further one
_POLL_S = 0.01
_START_S, _END_S = 120.0, 300.0  # until a scheduler is there, and until a check has noticed; a crowded machine has time


@dataclass
class Faults:
    """What each fault came to: whether the check ended as promised, and what it said; ``untried`` with the reason."""

    said: dict[str, tuple[bool, str]] = field(default_factory=dict)
    untried: dict[str, str] = field(default_factory=dict)

    @property
    def all_said(self) -> bool:
        """Whether each fault that was tried ended the check with its sentence."""
        return all(promised for promised, _ in self.said.values())

    def note(self, name: str, code: int, text: str, sentence: str) -> None:
        """Note how a check ended, and whether it said so; before the first column it may end as with bad usage."""
        promised = code in (BAD_USAGE, INTERNAL) and sentence in text and "Traceback" not in text
        self.said[name] = promised, f"exit code {code}: {' | '.join(text.strip().splitlines()[-3:])}"

    def lines(self) -> Iterator[str]:
        """A line for each fault."""
        for name, (promised, text) in self.said.items():
            yield f"{name}: {'ended with its sentence' if promised else f'NOT as promised: {text}'}"
        yield from (f"{name}: not tried ({why})" for name, why in self.untried.items())


def meet_faults(command: list[str], job: Path, kept: Callable[[], int]) -> Faults:
    """Let a check meet each fault in turn; ``kept`` counts the columns that have a result."""
    faults = Faults()
    journal = job.parent / "job-report" / "journal.jsonl"
    written = journal.stat().st_size
    most_bytes = written + int(_ROOM_FOR * _COLUMNS_MORE * written / kept())
    full = _ended(command, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, most_bytes)))
    faults.note("full disk", *full, "the results so far cannot be kept")
    with _cluster(job.parent, []) as (address, scheduler):
        before = kept()
        process = _started([*command, "--scheduler", address])
        until = time.monotonic() + _END_S
        while process.poll() is None and kept() < before + _COLUMNS_MORE and time.monotonic() < until:
            time.sleep(_POLL_S)
        scheduler.kill()
        faults.note("dead scheduler", *_outcome(process), "the scheduler of Dask is gone")
    hidden = _over(job.parent)
    if hidden is None:
        faults.untried["empty mount"] = "needs the right to mount, and unshare"
    else:
        with _cluster(job.parent, hidden) as (address, _):
            faults.note("empty mount", *_ended([*command, "--scheduler", address]), "it does not see")
    return faults


def _started(command: list[str], **options: object) -> subprocess.Popen[str]:
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **options)  # type: ignore[call-overload,no-any-return]


def _ended(command: list[str], **options: object) -> tuple[int, str]:
    return _outcome(_started(command, **options))


def _outcome(process: subprocess.Popen[str]) -> tuple[int, str]:
    try:
        _, said = process.communicate(timeout=_END_S)
    except subprocess.TimeoutExpired:
        process.kill()
        return process.wait(), f"it did not end within {_END_S:.0f} s"
    return process.returncode, said


def _over(folder: Path) -> list[str] | None:
    """What starts a program that sees an empty folder in place of one; None where the system does not allow it."""
    words = ["unshare", "--mount", "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', str(folder)]
    tried = shutil.which("unshare") and subprocess.run([*words, "true"], check=False, capture_output=True)
    return words if tried and tried.returncode == 0 else None


def address_in(file: Path, seconds: float) -> str:
    """The address that a scheduler writes into a file once it is there; the file may be there before its content."""
    until = time.monotonic() + seconds
    while True:
        with contextlib.suppress(OSError, ValueError):
            return str(json.loads(file.read_text("utf-8"))["address"])
        if time.monotonic() > until:
            raise TimeoutError(f"no scheduler within {seconds:.0f} s")
        time.sleep(_POLL_S)


@contextlib.contextmanager
def _cluster(folder: Path, before_worker: list[str]) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """The address of a scheduler of Dask with one worker, and its process; ``before_worker`` starts the worker."""
    scratch = folder.parent / "cluster"
    scratch.mkdir(exist_ok=True)
    said = scratch / "scheduler.json"
    said.unlink(missing_ok=True)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[1])}
    started: list[subprocess.Popen[bytes]] = []

    def start(*words: str) -> None:
        nowhere = subprocess.DEVNULL
        started.append(
            subprocess.Popen(
                words, cwd=scratch, env=environment, stdout=nowhere, stderr=nowhere, start_new_session=True
            )
        )

    dask = [sys.executable, "-m", "dask"]
    try:
        start(*dask, "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(said))
        address = address_in(said, _START_S)
        start(*before_worker, *dask, "worker", address, "--nthreads", "1", "--no-dashboard")
        yield address, started[0]
    finally:
        for process in started:
            # A nanny and its worker, at once: an orderly end takes seconds.
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
