"""Which pool a job gets: this process for a few columns, processes of this machine for more, a scheduler on request."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from aadm_workbench.errors import AadmError
from aadm_workbench.own_files import open_to_write, remove

if TYPE_CHECKING:
    from aadm_workbench.inspection.job import Job

    from ..job.inputs import ShippedFile
    from .cluster import Certificates
    from .engine import Pool

SCRATCH_NAME, LOG_NAME = ".aadm-workers", "workers.log"
_APPEND = os.O_WRONLY | os.O_APPEND

MOST_COLUMNS_HERE = 8
"""Up to so many columns are done in this process before a second one has started and loaded its packages."""

SECONDS_PER_COLUMN = 900.0
"""Time limit where none is given: a column takes a second, one of a hundred million points a minute or two."""


@dataclass(frozen=True)
class PoolOptions:
    """Where columns are checked.

    Parameters
    ----------
    processes
        How many on this machine; None for as many as it has cores, where there are columns enough.
    scheduler
        Address of a scheduler of Dask, whose workers are used instead.
    certificates
        With which it is spoken to, where it asks for them.
    ship_inputs
        Whether files travel to the workers by content.
    memory_bytes
        Limit of each worker; None for an even share of the machine.
    seconds
        Limit of each column; None for ``SECONDS_PER_COLUMN``.
    job_file, job_sha256
        The job's file and its hash, by which a worker shows that it sees the same files; None where it need not.
    apart
        Whether not to check in this process, where that can be avoided: a column may be what ended the one before.
    """

    processes: int | None = None
    scheduler: str | None = None
    ship_inputs: bool = False
    memory_bytes: int | None = None
    seconds: float | None = None
    apart: bool = False
    certificates: Certificates | None = None
    job_file: Path | None = None
    job_sha256: str = ""

    def of_job(self, job: Job) -> PoolOptions:
        """The same for the columns of a job."""
        path = job.folder.absolute() / Path(job.source).name
        return replace(self, job_file=path, job_sha256=job.sha256)

    @property
    def is_limited(self) -> bool:
        """Whether a limit was asked for, which only another process can be held to."""
        return self.memory_bytes is not None or self.seconds is not None


@contextmanager
def open_pool(
    options: PoolOptions,
    columns: int,
    folder: Path,
    *,
    ship: Callable[[Any], Any],
    say: Callable[[str], None],
    log: Callable[[str], None],
    log_folder: Path,
) -> Iterator[Pool | None]:
    """The pool for a job of some columns, closed with the context; None for this process itself.

    Parameters
    ----------
    folder
        Of the job.
    ship
        Gives the files of a task by content.
    say, log
        Are told what a person should know, and everything else.
    log_folder
        Where workers of this machine write.

    Raises
    ------
    MissingDependencyError
        Where several processes or a limit are asked for without psutil, or a scheduler without Dask.
    JobError
        Where no scheduler answers.
    """
    if options.scheduler is None and _is_for_here(options, columns, say):
        yield None
        return
    from .worker import Terms

    seconds = options.seconds or SECONDS_PER_COLUMN
    chosen_ship = ship if options.ship_inputs else None
    if options.scheduler is None:
        from .local_pool import local_pool
        from .machine import cores, memory_per_worker

        processes = min(options.processes or cores(), columns)
        memory_bytes = options.memory_bytes or memory_per_worker(processes)
        terms = Terms(folder, log_folder, memory_bytes, seconds, options.job_file, options.job_sha256)
        with local_pool(processes, terms, memory_bytes, log_folder, ship=chosen_ship, log=log) as here:
            yield here
        return
    from .cluster import remote_cluster
    from .dask_pool import DaskPool

    terms = Terms(folder, log_folder, options.memory_bytes, seconds, options.job_file, options.job_sha256)
    with remote_cluster(options.scheduler, log, options.certificates) as cluster:
        there = DaskPool(cluster, terms, ship=chosen_ship, say=say, log=log)
        with closing(there):
            yield there


def _is_for_here(options: PoolOptions, columns: int, say: Callable[[str], None]) -> bool:
    if columns == 0:
        return True
    if options.is_limited or ((options.processes or 1) > 1 and columns > 1):
        return False
    if columns <= MOST_COLUMNS_HERE and not options.apart:
        return True
    if find_spec("psutil") is None:
        from aadm_workbench.errors import install_of

        if options.processes is None and columns > MOST_COLUMNS_HERE:
            say(f"one column at a time, all in one process: {install_of('batch')} to use every core")
        return True
    return False


@contextmanager
def opened_pool(
    options: PoolOptions,
    columns: int,
    job: Job,
    folder: Path | None,
    ship: Callable[[Any], tuple[ShippedFile, ...]],
    say: Callable[[str], None],
) -> Iterator[Pool | None]:
    """As :func:`open_pool`, for columns of a job; what workers write goes into a folder, or is forgotten with them."""
    with ExitStack() as stack:
        scratch = _scratch(stack, folder)
        log = (lambda line: None) if folder is None else WorkersLog(folder).write
        options, job_folder = options.of_job(job), job.folder.absolute()
        yield stack.enter_context(
            open_pool(options, columns, job_folder, ship=ship, say=say, log=log, log_folder=scratch)
        )


def _scratch(stack: ExitStack, folder: Path | None) -> Path:
    """A folder for what workers write while they work, gone afterwards; that of a killed run is removed first."""
    if folder is None:
        return Path(stack.enter_context(TemporaryDirectory(prefix="aadm-workers-", ignore_cleanup_errors=True)))
    scratch = folder / SCRATCH_NAME
    stack.callback(remove, scratch)
    remove(scratch)
    try:
        # Nobody else may write into it, whoever may write beside it.
        scratch.mkdir(mode=0o700)
    except OSError as error:
        reason = f"cannot be made ({error.strerror}); remove what is there, or name another folder with --out"
        raise AadmError.because("run.worker_folder", folder=scratch, why=reason) from error
    return scratch


class WorkersLog:
    """``DIR/workers.log``: what workers and Dask have to say, a line each with its time.

    That it cannot be written is never the reason why a check fails.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / LOG_NAME
        self._lock = threading.Lock()

    def write(self, line: str) -> None:
        """Add a line."""
        # What a scan's name or a native library says is not to steer the terminal that shows the log.
        line = "".join(sign if sign.isprintable() else "\N{REPLACEMENT CHARACTER}" for sign in line)
        now = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        said = f"{now} {line}\n".encode(errors="replace")
        with self._lock, suppress(OSError), open(open_to_write(self._path, _APPEND), "ab") as stream:  # noqa: PTH123
            stream.write(said)
