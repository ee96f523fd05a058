"""Columns spread over processes of this machine by Dask; a column that kills its process costs itself alone."""

from __future__ import annotations

import logging
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from typing import Any, TypeVar

from aadm_workbench.errors import MissingDependencyError

from .column_task import ColumnTask

Outcome = TypeVar("Outcome")
Work = Callable[[ColumnTask], Outcome]
Lost = Callable[[ColumnTask, str], Outcome]


def in_any_order(
    tasks: Sequence[ColumnTask], processes: int, work: Work[Outcome], lost: Lost[Outcome]
) -> Iterator[tuple[int, Outcome]]:
    """Work on columns one by one, or in several processes where there are several; as :func:`spread_tasks`."""
    if min(processes, len(tasks)) > 1:
        yield from spread_tasks(tasks, processes, work, lost)
    else:
        yield from ((place, work(task)) for place, task in enumerate(tasks))


def spread_tasks(
    tasks: Sequence[ColumnTask], processes: int, work: Work[Outcome], lost: Lost[Outcome]
) -> Iterator[tuple[int, Outcome]]:
    """Work on columns in several processes; yields the place of a task and its outcome as they finish.

    Parameters
    ----------
    work
        A function of a module, which catches what can go wrong.
    lost
        Makes the outcome of a task whose process was killed, from the task and the reason.

    Raises
    ------
    MissingDependencyError
        Where Dask's ``distributed`` is not installed.
    """
    try:
        distributed: Any = import_module("distributed")
    except ImportError as error:
        install = "pip install 'aadm-workbench[batch]'"
        raise MissingDependencyError("distributed", "Checking columns in several processes", install) from error
    with _interrupts_ignored():
        cluster = distributed.LocalCluster(
            n_workers=min(processes, len(tasks)),
            threads_per_worker=1,
            processes=True,
            dashboard_address=None,
            silence_logs=logging.CRITICAL,
        )
    with cluster, distributed.Client(cluster) as client:
        futures = client.map(work, tasks, pure=False)
        place_of = {future.key: place for place, future in enumerate(futures)}
        for future in distributed.as_completed(futures):
            place = place_of[future.key]
            death = future.exception()
            # Everything else is caught in the worker, so this is a worker that died, several times.
            reason = f"the process that checked it was killed ({type(death).__name__})"
            yield place, future.result() if death is None else lost(tasks[place], reason)


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Processes started inside leave Ctrl-C to this one, which ends them; each would print its own traceback."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
