"""What runs in a worker process: one column at a time, within its limits, its log in a file that outlives it."""

from __future__ import annotations

import contextlib
import faulthandler
import os
import re
import socket
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import IO, Any

from aadm_workbench.model import Reason

from ..job.inputs import ShippedFile, content_hash, difference, program_versions, unpack
from ..switches import is_in_one_thread
from .engine import Death

LOOK_S, LOOK_SOON_S = 0.5, 0.1
"""So often is looked which workers there are; more often while some are starting."""

GRACE_S = 30.0
"""So long after its time limit is a worker ended from outside, which could not end itself."""

Ship = Callable[[Any], tuple[ShippedFile, ...]]
Say = Callable[[str], None]

_LOG_BYTES = 16_384
"""So much of what a column writes is kept."""

_LAST_LINES = 4  # the first ones of a fault, or the last ones of anything else, say what happened
TOO_LONG = "Timeout ("
"""What :mod:`faulthandler` writes first where the time limit is up."""


@dataclass(frozen=True)
class Terms:
    """What the client asks of each worker.

    Parameters
    ----------
    folder
        Of the job; a worker that does not see it needs its inputs shipped.
    job_file, job_sha256
        The job file, and the hash of its bytes: a folder may be there and empty, where a disk is not mounted, or be
        another machine's own.
    memory_bytes
        Limit of what a worker may hold; None for no limit.
    seconds
        Limit for one column; None for no limit.
    log_folder
        Where workers write, if they see it (else a temporary folder of theirs).
    """

    folder: Path
    log_folder: Path
    memory_bytes: int | None = None
    seconds: float | None = None
    job_file: Path | None = None
    job_sha256: str = ""

    def are_seen(self) -> bool:
        """Whether this process sees the job's folder, with the same job file in it."""
        is_there = self.folder.is_dir()
        return is_there and (self.job_file is None or content_hash(self.job_file) == self.job_sha256)

    def is_over(self, worked_s: float) -> bool:
        """Whether a column that was worked on for so long is over its time."""
        return self.seconds is not None and worked_s > self.seconds


@dataclass(frozen=True)
class Introduction:
    """What a worker says of itself before it is given work."""

    pid: int
    host: str
    log: str
    versions: dict[str, str]
    sees_job: bool
    one_thread: bool


@dataclass(frozen=True, eq=False)
class Done:
    """The outcome of a task, and what was written while it was worked on."""

    outcome: Any
    written: str


_log: IO[bytes] | None = None
_log_path = ""


def introduce(terms: Terms) -> Introduction:
    """Make this process ready to check columns: log, memory limit, heavy packages."""
    global _log, _log_path
    if _log is None or not Path(_log_path).exists():
        folder = terms.log_folder if terms.log_folder.is_dir() else Path(tempfile.gettempdir())
        # A name that nobody can know before, and a file that nobody else can open: the folder may be a shared one.
        descriptor, path = tempfile.mkstemp(".log", f"column-{socket.gethostname()}-{os.getpid()}-", folder)
        _log, _log_path = open(descriptor, "wb+", buffering=0), path  # noqa: PTH123, SIM115
        _write_into(_log)
        faulthandler.enable(_log)
    _limit_memory(terms.memory_bytes)
    import_module("aadm_workbench.inspection.column")
    return Introduction(
        pid=os.getpid(),
        host=socket.gethostname(),
        log=_log_path,
        versions=program_versions(),
        sees_job=terms.are_seen(),
        one_thread=is_in_one_thread(),
    )


def death_of(written: str, how: Callable[[], str], terms: Terms, *, is_overdue: bool) -> Death:
    """What a worker died of, by what it wrote last; ``how`` its process ended is asked where that says nothing."""
    if TOO_LONG in written or is_overdue:
        return Death(Reason("run.too_long", seconds=terms.seconds), is_final=True)
    return Death(how(), last_words(written))


def objection(known: Introduction, terms: Terms, *, ships: bool) -> str:
    """Why a worker may get no work, and what to do about it; empty where it may."""
    different = difference(program_versions(), known.versions)
    if different:
        return Reason("run.other_versions", different=different)
    if not known.one_thread:
        return Reason("run.several_threads")
    if not known.sees_job and not ships:
        if terms.job_file is None:
            return Reason("run.folder_unseen", folder=str(terms.folder))
        return Reason("run.job_unseen", file=str(terms.job_file))
    return ""


def run_task(
    work: Callable[[Any], Any], task: Any, seconds: float | None, shipped: tuple[ShippedFile, ...] | None = None
) -> Done:
    """Work on one task, within its time; files that came with it are unpacked for as long as that takes."""
    if _log is not None:
        os.ftruncate(_log.fileno(), 0)
        os.lseek(_log.fileno(), 0, os.SEEK_SET)
        if seconds is not None:
            faulthandler.dump_traceback_later(seconds, exit=True, file=_log)
    try:
        if shipped is None:
            outcome = work(task)
        else:
            with tempfile.TemporaryDirectory(prefix="aadm-inputs-") as folder:
                outcome = work(task.at(unpack(shipped, Path(folder))))
    finally:
        faulthandler.cancel_dump_traceback_later()
        _flush()
    return Done(outcome, "" if _log is None else read_log(_log_path))


def read_log(path: str) -> str:
    """The end of a worker's log; empty where there is none."""
    with contextlib.suppress(OSError), Path(path).open("rb") as stream:
        stream.seek(0, os.SEEK_END)
        stream.seek(max(0, stream.tell() - _LOG_BYTES))
        return stream.read().decode(errors="replace").replace("\x00", "")
    return ""


def remove_log(path: str) -> None:
    """Remove the log of a worker that is no more."""
    with contextlib.suppress(OSError):
        Path(path).unlink()


def last_words(written: str) -> str:
    """The last lines of a log on one line, without the folders of the machine that wrote them, and its addresses."""
    lines = [line.strip() for line in written.splitlines() if line.strip()]
    # A fault is told first, then where it happened, innermost first: the first lines say most.
    chosen = lines[:_LAST_LINES] if lines and _tells_fault(lines[0]) else lines[-_LAST_LINES:]
    text = " | ".join(chosen)
    text = re.sub(r"(?:[A-Za-z]:)?[\\/](?:[^\\/\s\"':|]+[\\/])+", "", text)
    return re.sub(r"0x[0-9a-f]+", "0x…", text)[:500]


def _tells_fault(line: str) -> bool:
    return line.startswith(("Fatal Python error", TOO_LONG))


def _write_into(log: IO[bytes]) -> None:
    """Everything that this process says from now on, native libraries included, goes into its log."""
    _flush()
    for descriptor in (1, 2):
        os.dup2(log.fileno(), descriptor)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):
            stream.flush()


def _limit_memory(limit_bytes: int | None) -> None:
    """Bound what this process may still allocate: beyond it numpy raises MemoryError, and only its column is lost.

    What is counted are private pages that can be written, so what the packages themselves take is allowed on top.
    """
    if limit_bytes is None:
        return
    with contextlib.suppress(ImportError, OSError, ValueError, AttributeError):
        resource: Any = import_module("resource")
        _, hard = resource.getrlimit(resource.RLIMIT_DATA)
        soft = limit_bytes + _data_bytes()
        resource.setrlimit(resource.RLIMIT_DATA, (soft if hard < 0 else min(soft, hard), hard))


def _data_bytes() -> int:
    """What this process has reserved beyond what it holds: stacks of threads, mostly."""
    sizes = {}
    for line in Path("/proc/self/status").read_text().splitlines():
        name, _, value = line.partition(":")
        if name in {"VmData", "VmRSS"}:
            sizes[name] = int(value.split()[0]) * 1024
    return max(0, sizes.get("VmData", 0) - sizes.get("VmRSS", 0))
