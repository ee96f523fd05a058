"""Workers of Dask as a pool: one column at a time in each, so that a worker's death is the death of one column.

Each worker introduces itself before it gets work; one that would come to other numbers (another version), or that does
not see the scans, gets none.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from queue import Empty, SimpleQueue
from time import monotonic, sleep
from typing import Any

from aadm_workbench.errors import AadmError, JobError
from aadm_workbench.model import Reason

from ..job.inputs import ShippedFile
from .cluster import GONE, Cluster
from .engine import Death, Ended
from .worker import (
    GRACE_S,
    LOOK_S,
    LOOK_SOON_S,
    Done,
    Introduction,
    Say,
    Ship,
    Terms,
    death_of,
    introduce,
    objection,
    read_log,
    remove_log,
    run_task,
)

_LAST_WORKER_S = 90.0
"""So long is waited for a worker where there is none."""

# A client that has lost its scheduler lacks the key of its workers, too.
_NO_ANSWER: tuple[type[BaseException], ...] = (*GONE, KeyError)
_RESULT_S = 30.0  # a result is sent within a second: what has not come by then has gone with its worker
_EXIT_S = 8.0  # a scheduler hears of a worker's end by its next heartbeats


@dataclass
class _Worker:
    """A worker as this side knows it; ``place`` is of the task that it works on."""

    address: str
    future: Any
    known: Introduction | None = None
    place: int | None = None
    began: float = 0.0
    input: Any = None
    refused: bool = False


class DaskPool:
    """The workers of a Dask client.

    Parameters
    ----------
    cluster
        Where the workers are.
    terms
        What is asked of workers.
    ship
        Gives the files of a task by content; None where workers see them.
    say
        Is told what a person should know of workers: one that left, one that is refused.
    log
        Is given what workers wrote, line by line.
    """

    def __init__(self, cluster: Cluster, terms: Terms, *, ship: Ship | None, say: Say, log: Say) -> None:
        self._client = cluster.client
        self._keeper = cluster.keeper
        self._terms = terms
        self._ship = ship
        self._say = say
        self._log = log
        self._workers: dict[str, _Worker] = {}
        self._ended: SimpleQueue[tuple[str, Any]] = SimpleQueue()
        self._looked = -LOOK_S
        self._alive = monotonic()
        self._refusal = ""
        self._run = os.urandom(4).hex()
        self._number = 0
        self._silent_hosts: set[str] = set()
        self._look()

    def idle(self) -> Sequence[str]:
        """Workers that have introduced themselves and have nothing to do."""
        return [worker.address for worker in self._workers.values() if worker.known and worker.place is None]

    def begin(self, name: str, place: int, work: Callable[[Any], Any], task: Any) -> None:
        """Send a task to an idle worker."""
        worker = self._workers[name]
        worker.place, worker.began = place, monotonic()
        try:
            worker.input = None if self._ship is None else self._sent(self._ship(task), name)
        except (*GONE, _closed()):
            # It can no longer be reached, which is as good as dead; then it is seen to be gone.
            self._keeper.kill(name, worker.known.pid if worker.known else 0)
            return
        worker.future = self._submitted(name, run_task, work, task, self._terms.seconds, worker.input)

    def wait(self) -> Sequence[Ended]:
        """What ended since, or within half a second.

        Raises
        ------
        AadmError
            Where the scheduler is gone, or there is no worker any more.
        JobError
            Where the only workers are such as may not be used.
        """
        ended: list[Ended] = []
        with contextlib.suppress(Empty):
            address, future = self._ended.get(timeout=self._pause_s())
            ended += self._taken(address, future)
            while True:
                address, future = self._ended.get_nowait()
                ended += self._taken(address, future)
        if monotonic() - self._looked >= self._pause_s():
            ended += self._look()
            self._end_overdue()
        return ended

    def _pause_s(self) -> float:
        """How soon to look again: soon where workers are expected."""
        waited_for = [worker for worker in self._workers.values() if worker.known is None and not worker.refused]
        return LOOK_SOON_S if waited_for or not self._workers else LOOK_S

    def close(self) -> None:
        """Take back what is still being worked on, and the logs of workers that are left."""
        futures = [worker.future for worker in self._workers.values() if worker.place is not None]
        logs = [worker.known.log for worker in self._workers.values() if worker.known]
        with contextlib.suppress(*GONE, _closed()):
            if futures:
                self._client.cancel(futures, force=True)
        for path in logs:
            remove_log(path)

    def _submitted(self, address: str, *call: Any) -> Any:
        # Dask keeps something for each kind of key, which it takes from its first part.
        self._number += 1
        key = (f"aadm-{self._run}", self._number)
        where = {"workers": [address], "allow_other_workers": False}
        try:
            future = self._client.submit(*call, **where, pure=False, key=key)
        except _closed() as error:
            raise AadmError.because("run.scheduler_gone") from error
        future.add_done_callback(lambda done: self._ended.put((address, done)))
        return future

    def _sent(self, files: tuple[ShippedFile, ...], address: str) -> Any:
        return self._client.scatter([files], workers=[address], hash=False, broadcast=False)[0]

    def _taken(self, address: str, future: Any) -> list[Ended]:
        """What a future that is done means: an introduction, an outcome, or a death."""
        worker = self._workers.get(address)
        if worker is None or worker.future is not future:
            return []
        if future.status == "error" and type(error := future.exception()).__name__ != "KilledWorker":
            return self._failed(worker, error)
        if future.status != "finished":
            return self._dropped(worker)
        result = self._result(worker)
        if result is None:
            return self._dropped(worker)
        worker.future = None
        if isinstance(result, Introduction):
            self._met(worker, result)
            return []
        place, worker.place, worker.input = worker.place, None, None
        done: Done = result
        for line in done.written.splitlines():
            self._log(f"{address}: {line}")
        return [] if place is None else [Ended(place, done.outcome)]

    def _result(self, worker: _Worker) -> Any:
        """What a finished future holds; None where the worker died before it could hand it over."""
        until = monotonic() + _RESULT_S
        while monotonic() < until:
            try:
                return worker.future.result(timeout=1.0)
            except TimeoutError:
                if worker.address not in self._addresses():
                    return None
            except (*GONE, _killed_worker()):
                return None
        return None

    def _failed(self, worker: _Worker, error: BaseException) -> list[Ended]:
        """Work catches its own errors, so here a worker lacks what it needs, or Dask has dropped a task."""
        what = f"{type(error).__name__}: {error}".splitlines()[0]
        place, worker.place, worker.future, worker.input = worker.place, None, None, None
        if place is not None:
            return [Ended(place, death=Death(Reason("run.stopped_by_dask", what=what)))]
        self._refuse(worker, Reason("run.cannot_run", what=what))
        return []

    def _met(self, worker: _Worker, known: Introduction) -> None:
        against = objection(known, self._terms, ships=self._ship is not None)
        if against:
            self._refuse(worker, against)
        else:
            worker.known = known
            self._log(f"{worker.address}: process {known.pid} on {known.host} is ready")

    def _refuse(self, worker: _Worker, why: str) -> None:
        worker.refused = True
        self._refusal = Reason("run.gets_no_work", name=worker.address, why=why)
        self._say(self._refusal)

    def _look(self) -> list[Ended]:
        """See which workers have come and gone."""
        there = self._addresses()
        self._looked = monotonic()
        ended: list[Ended] = []
        for address in [address for address in self._workers if address not in there]:
            ended += self._dropped(self._workers[address])
        for address in there:
            if address not in self._workers:
                self._workers[address] = _Worker(address, self._submitted(address, introduce, self._terms))
        if any(worker.known for worker in self._workers.values()):
            self._alive = monotonic()
        elif self._workers and all(worker.refused for worker in self._workers.values()):
            raise JobError.because("run.no_worker", why=self._refusal)
        elif monotonic() - self._alive > _LAST_WORKER_S:
            raise AadmError.because("run.no_worker_for", seconds=_LAST_WORKER_S)
        return ended

    def _addresses(self) -> set[str]:
        try:
            return set(self._client.scheduler_info(n_workers=-1)["workers"])
        except _NO_ANSWER as error:
            raise AadmError.because("run.scheduler_gone") from error

    def _dropped(self, worker: _Worker) -> list[Ended]:
        """Forget a worker that died; its task, where it had one, died with it."""
        self._workers.pop(worker.address, None)
        with contextlib.suppress(*GONE, AttributeError, _closed()):
            worker.future.cancel(force=True)
        if worker.place is None or worker.known is None:
            self._log(f"{worker.address}: gone, with nothing to do")
            return []
        death = self._death(worker, worker.known)
        self._log(f"{worker.address}: {death.cause}, while it checked a column")
        return [Ended(worker.place, death=death)]

    def _death(self, worker: _Worker, known: Introduction) -> Death:
        written = self._last_written(known)
        for line in written.splitlines():
            self._log(f"{worker.address}: {line}")
        return death_of(
            written,
            lambda: self._exit(worker, known) or Reason("run.killed_unseen"),
            self._terms,
            is_overdue=self._overdue(worker, 0.0),
        )

    def _last_written(self, known: Introduction) -> str:
        """What a dead worker left in its log: read here, or on its own machine, where another worker runs there."""
        if Path(known.log).exists():
            written = read_log(known.log)
            remove_log(known.log)
            return written
        for other in self._workers.values():
            if other.known and other.known.host == known.host:
                with contextlib.suppress(*GONE, KeyError):
                    found = self._client.run(read_log, known.log, workers=[other.address], nanny=True)
                    return str(found[other.address])
        return ""

    def _exit(self, worker: _Worker, known: Introduction) -> str | None:
        """How the process ended; it takes a moment to be noticed, but a machine that is gone is waited for once."""
        until = monotonic() + (0.0 if known.host in self._silent_hosts else _EXIT_S)
        while (words := self._keeper.how_ended(worker.address, known.pid)) is None and monotonic() < until:
            sleep(0.1)
        (self._silent_hosts.add if words is None else self._silent_hosts.discard)(known.host)
        return words

    def _overdue(self, worker: _Worker, grace_s: float) -> bool:
        return worker.place is not None and self._terms.is_over(monotonic() - worker.began - grace_s)

    def _end_overdue(self) -> None:
        """End workers that are long over their time and could not end themselves: stopped, or stuck in the system."""
        for worker in list(self._workers.values()):
            if worker.known is not None and self._overdue(worker, GRACE_S):
                self._keeper.kill(worker.address, worker.known.pid)


def _killed_worker() -> type[BaseException]:
    kind: type[BaseException] = import_module("distributed").KilledWorker
    return kind


def _closed() -> type[BaseException]:
    """What a client raises that has given up its scheduler and is asked for more."""
    kind: type[BaseException] = import_module("distributed.client").ClosedClientError
    return kind
