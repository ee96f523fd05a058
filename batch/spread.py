"""Columns spread over processes of this machine by Dask; a column that kills its process costs itself alone."""

from __future__ import annotations

import logging
import signal
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from aadm_workbench.errors import MissingDependencyError

from .column_task import ColumnOutcome, ColumnTask, check_task, error_report


def spread_tasks(tasks: Sequence[ColumnTask], processes: int) -> Iterator[tuple[int, ColumnOutcome]]:
    """Check columns in several processes; yields the place of a task and its outcome as they finish.

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
        futures = client.map(check_task, tasks, pure=False)
        place_of = {future.key: place for place, future in enumerate(futures)}
        for future in distributed.as_completed(futures):
            place = place_of[future.key]
            yield place, _outcome(future, tasks[place])


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


def _outcome(future: Any, task: ColumnTask) -> ColumnOutcome:
    error = future.exception()
    if error is None:
        outcome: ColumnOutcome = future.result()
        return outcome
    # Everything else is caught in the worker, so this is a worker that died, several times.
    return ColumnOutcome(error_report(task, f"the process that checked it was killed ({type(error).__name__})"))
