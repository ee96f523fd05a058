"""Which pool a job gets: this process for a few columns, processes of this machine for more, a scheduler on request."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .engine import Here, Pool

if TYPE_CHECKING:
    from .cluster import Certificates

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
) -> Iterator[Pool]:
    """The pool for a job of some columns, closed with the context.

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
        yield Here()
        return
    from .worker import Terms

    seconds = options.seconds or SECONDS_PER_COLUMN
    chosen_ship = ship if options.ship_inputs else None
    if options.scheduler is None:
        from .local_pool import local_pool
        from .machine import cores, memory_per_worker

        processes = min(options.processes or cores(), columns)
        memory_bytes = options.memory_bytes or memory_per_worker(processes)
        terms = Terms(folder, log_folder, memory_bytes, seconds)
        with local_pool(processes, terms, memory_bytes, log_folder, ship=chosen_ship, log=log) as here:
            yield here
        return
    from .cluster import remote_cluster
    from .dask_pool import DaskPool

    terms = Terms(folder, log_folder, options.memory_bytes, seconds)
    with remote_cluster(options.scheduler, log, options.certificates) as cluster:
        there = DaskPool(cluster, terms, ship=chosen_ship, say=say, log=log)
        with contextlib.closing(there):
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
