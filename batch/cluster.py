"""Processes that check columns, by Dask: on this machine, or wherever a scheduler has its workers."""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol

from aadm_workbench.errors import JobError, MissingDependencyError

from .local_workers import LocalWorkers
from .remote_workers import RemoteWorkers

_CONNECT_S = 10.0  # a scheduler that is there answers at once: a slow network has seconds
_LOGGERS = ("distributed", "distributed.client", "tornado", "tornado.application")

_SETTINGS: dict[str, Any] = {
    # A column whose worker dies is tried again by the engine, which blames that column alone.
    "distributed.scheduler.allowed-failures": 0,
    "distributed.scheduler.worker-saturation": 1.0,
    "distributed.scheduler.work-stealing": False,
    "distributed.admin.tick.limit": "10s",
    # Nobody is to look into it from outside.
    "distributed.scheduler.http.routes": [],
    # Dask remembers what it did, for its developers: a kilobyte or more for each column, for a thousand of them.
    "distributed.admin.low-level-log-length": 20,
    "distributed.diagnostics.computations.max-history": 1,
}


@dataclass(frozen=True)
class Cluster:
    """A synchronous client of Dask, and who looks after its workers."""

    client: Any
    keeper: Keeper


class Keeper(Protocol):
    """Looks after workers."""

    def tend(self) -> None:
        """Replace those that died, where that is its task."""

    def how_ended(self, address: str, pid: int) -> str | None:
        """How a worker ended, in words; None where that is not known (yet)."""

    def kill(self, address: str, pid: int) -> None:
        """End a worker that does not end itself."""


def load_distributed() -> Any:
    """Dask's ``distributed``.

    Raises
    ------
    MissingDependencyError
        Where it is not installed.
    """
    try:
        return import_module("distributed")
    except ImportError as error:
        raise MissingDependencyError("distributed", "Checking columns in several processes") from error


def cores() -> int:
    """How many processes this one may keep busy: its share of the machine, as a container or a queue gives it."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def memory_per_worker(processes: int) -> int:
    """An even share of the memory that this machine or its container has, bytes."""
    limit: int = import_module("distributed.system").MEMORY_LIMIT
    return limit // (processes + 1)


@contextmanager
def local_cluster(processes: int, memory_bytes: int, log: Callable[[str], None], folder: Path) -> Iterator[Cluster]:
    """Some processes of this machine; they end with it.

    Parameters
    ----------
    memory_bytes
        What each may hold.
    log
        Is given each line that Dask has to say.
    folder
        Where processes write what they need.
    """
    distributed = load_distributed()
    dask = import_module("dask")
    with ExitStack() as stack:
        stack.enter_context(_messages_to(log))
        stack.enter_context(dask.config.set(_SETTINGS))
        # The scheduler alone: the nanny of a worker of its own is lost when that worker dies while it starts.
        cluster = stack.enter_context(
            distributed.LocalCluster(
                n_workers=0,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                silence_logs=False,
                local_directory=str(folder),
            )
        )
        client = stack.enter_context(distributed.Client(cluster, set_as_default=False))
        workers = LocalWorkers(cluster.scheduler_address, processes, folder, memory_bytes)
        stack.callback(workers.close)
        yield Cluster(client, workers)


@contextmanager
def remote_cluster(address: str, log: Callable[[str], None]) -> Iterator[Cluster]:
    """The workers of a scheduler.

    Raises
    ------
    JobError
        Where no scheduler answers, or one of another version of Dask.
    """
    distributed = load_distributed()
    dask = import_module("dask")
    with _messages_to(log), dask.config.set({"distributed.comm.retry.count": 2}):
        try:
            client = distributed.Client(address, timeout=_CONNECT_S, set_as_default=False)
        except (OSError, TimeoutError, ValueError, TypeError, ImportError, AttributeError, RuntimeError) as error:
            reason = str(error).splitlines()[0] if str(error) else type(error).__name__
            message = (
                f"no scheduler of Dask answers at {address} ({reason}); start one with: dask scheduler "
                f"(this is distributed {distributed.__version__}; all of a cluster must have the same)"
            )
            raise JobError(message) from error
        try:
            yield Cluster(client, RemoteWorkers(client))
        finally:
            with contextlib.suppress(OSError, TimeoutError):
                client.close(timeout=5)


class _Lines(logging.Handler):
    def __init__(self, log: Callable[[str], None]) -> None:
        super().__init__()
        self._log = log

    def emit(self, record: logging.LogRecord) -> None:
        """Hand over one message, on one line."""
        with contextlib.suppress(OSError, ValueError, TypeError):
            self._log(" ".join(f"{record.name}: {record.getMessage()}".split()))


@contextmanager
def _messages_to(log: Callable[[str], None]) -> Iterator[None]:
    """What Dask says goes to a log, not between the lines of the command."""
    loggers = [logging.getLogger(name) for name in _LOGGERS]
    before = [(logger, logger.handlers[:], logger.propagate, logger.level) for logger in loggers]
    for logger in loggers:
        logger.handlers, logger.propagate = [_Lines(log)], False
        logger.setLevel(logging.WARNING)
    try:
        yield
    finally:
        for logger, handlers, propagate, level in before:
            logger.handlers, logger.propagate = handlers, propagate
            logger.setLevel(level)
