"""Which pool a job gets: this process for a few columns, processes of this machine for more, a scheduler on request."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from .engine import Here, Pool

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
        Where several processes, a limit or a scheduler are asked for without Dask.
    JobError
        Where no scheduler answers.
    """
    if options.scheduler is None and _is_for_here(options, columns, say):
        yield Here()
        return
    from .cluster import load_distributed, local_cluster, memory_per_worker, remote_cluster
    from .dask_pool import DaskPool
    from .worker import Terms

    load_distributed()
    processes = min(_processes(options), columns)
    memory_bytes = options.memory_bytes
    if options.scheduler is None and memory_bytes is None:
        memory_bytes = memory_per_worker(processes)
    terms = Terms(folder, log_folder, memory_bytes, options.seconds or SECONDS_PER_COLUMN)
    with contextlib.ExitStack() as stack:
        if options.scheduler is not None:
            cluster = stack.enter_context(remote_cluster(options.scheduler, log))
        else:
            assert memory_bytes is not None
            cluster = stack.enter_context(local_cluster(processes, memory_bytes, log, log_folder))
        pool = DaskPool(cluster, terms, ship=ship if options.ship_inputs else None, say=say, log=log)
        stack.callback(pool.close)
        yield pool


def _is_for_here(options: PoolOptions, columns: int, say: Callable[[str], None]) -> bool:
    if columns == 0:
        return True
    if options.is_limited or ((options.processes or 1) > 1 and columns > 1):
        return False
    if columns <= MOST_COLUMNS_HERE and not options.apart:
        return True
    if find_spec("distributed") is None:
        from aadm_workbench.errors import install_of

        if options.processes is None and columns > MOST_COLUMNS_HERE:
            say(f"one column at a time, all in one process: {install_of('batch')} to use every core")
        return True
    return False


def _processes(options: PoolOptions) -> int:
    from .cluster import cores

    return options.processes or cores()
