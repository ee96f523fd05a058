"""Processes of this machine as a pool: one column at a time in each, through pipes, without a port."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, SimpleQueue
from time import monotonic, sleep
from typing import Any

from aadm_workbench.errors import AadmError, JobError
from aadm_workbench.model import Reason

from .engine import Death, Ended
from .local_workers import LocalProcess, LocalWorkers
from .pipes import Conversation, Failed
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

_EXIT_S = 8.0  # one that does not end by then is killed


@dataclass
class _Worker:
    """A worker as this side knows it; ``place`` is of the task that it works on."""

    name: str
    local: LocalProcess
    conversation: Conversation
    known: Introduction | None = None
    place: int | None = None
    began: float = 0.0

    @property
    def is_asked(self) -> bool:
        """Whether an answer of it is due, or word that there will be none."""
        return self.known is None or self.place is not None


class LocalPool:
    """Worker processes of this machine.

    Parameters
    ----------
    workers
        The processes.
    terms
        What is asked of them.
    ship
        Gives the files of a task by content; None where workers read them themselves.
    log
        Is given what workers wrote, line by line.
    """

    def __init__(self, workers: LocalWorkers, terms: Terms, *, ship: Ship | None, log: Say) -> None:
        self._processes = workers
        self._terms = terms
        self._ship = ship
        self._log = log
        self._workers: dict[int, _Worker] = {}
        self._heard: SimpleQueue[tuple[int, Any]] = SimpleQueue()
        self._looked = -LOOK_S
        self._look()

    def idle(self) -> Sequence[str]:
        """Workers that have introduced themselves and have nothing to do."""
        return [worker.name for worker in self._workers.values() if not worker.is_asked]

    def begin(self, name: str, place: int, work: Callable[[Any], Any], task: Any) -> None:
        """Send a task to an idle worker."""
        worker = next(worker for worker in self._workers.values() if worker.name == name)
        files = None if self._ship is None else self._ship(task)
        worker.conversation.ask(run_task, work, task, self._terms.seconds, files)
        worker.place, worker.began = place, monotonic()

    def wait(self) -> Sequence[Ended]:
        """What ended since, or within half a second.

        Raises
        ------
        AadmError
            Where no worker can be started.
        JobError
            Where workers would come to other numbers than this process.
        """
        ended: list[Ended] = []
        with suppress(Empty):
            ended += self._taken(*self._heard.get(timeout=self._pause_s()))
            while True:
                ended += self._taken(*self._heard.get_nowait())
        if monotonic() - self._looked >= self._pause_s():
            self._look()
            self._end_overdue()
        return ended

    def close(self) -> None:
        """End all workers, and remove what they wrote."""
        self._processes.close()
        for worker in self._workers.values():
            worker.conversation.end()
            if worker.known:
                remove_log(worker.known.log)

    def _pause_s(self) -> float:
        """How soon to look again: soon where workers are expected."""
        are_starting = any(worker.known is None for worker in self._workers.values())
        return LOOK_SOON_S if are_starting or not self._workers else LOOK_S

    def _look(self) -> None:
        """See which workers have come, and which have gone while they had nothing to do."""
        self._processes.tend()
        self._looked = monotonic()
        for number in [number for number, worker in self._workers.items() if not worker.is_asked]:
            if number not in self._processes.running:
                self._forgotten(number)
        for number, local in self._processes.running.items():
            if number not in self._workers:
                self._workers[number] = self._met(local)

    def _met(self, local: LocalProcess) -> _Worker:
        conversation = Conversation(local.process, lambda said: self._heard.put((local.number, said)))
        conversation.ask(introduce, self._terms)
        return _Worker(f"worker {local.number}", local, conversation)

    def _taken(self, number: int, said: Any) -> list[Ended]:
        """What an answer means: an introduction, an outcome, or, where there is none, a death."""
        worker = self._workers.get(number)
        if worker is None:
            return []
        if said is None:
            return self._dropped(number, worker)
        place, worker.place = worker.place, None
        if isinstance(said, Introduction):
            self._know(worker, said)
            return []
        if isinstance(said, Failed):
            if place is None:
                raise AadmError.because("run.no_process", why=said.what)
            return [Ended(place, death=Death(Reason("run.stopped", what=said.what)))]
        done: Done = said
        for line in done.written.splitlines():
            self._log(f"{worker.name}: {line}")
        return [] if place is None else [Ended(place, done.outcome)]

    def _know(self, worker: _Worker, known: Introduction) -> None:
        against = objection(known, self._terms, ships=self._ship is not None)
        if against:
            raise JobError.because("run.worker_refused", name=worker.name, why=against)
        worker.known = known
        self._log(f"{worker.name}: process {known.pid} is ready")

    def _forgotten(self, number: int) -> None:
        worker = self._workers.pop(number)
        worker.conversation.end()
        if worker.known:
            remove_log(worker.known.log)
        self._log(f"{worker.name}: gone, with nothing to do")

    def _dropped(self, number: int, worker: _Worker) -> list[Ended]:
        """Forget a worker that no longer answers; its task, where it had one, died with it."""
        if worker.place is None or worker.known is None:
            self._exit(number)
            self._forgotten(number)
            return []
        del self._workers[number]
        death = self._death(number, worker, worker.known)
        self._log(f"{worker.name}: {death.cause}, while it checked a column")
        return [Ended(worker.place, death=death)]

    def _death(self, number: int, worker: _Worker, known: Introduction) -> Death:
        how = self._exit(number)
        written = read_log(known.log)
        remove_log(known.log)
        for line in written.splitlines():
            self._log(f"{worker.name}: {line}")
        return death_of(written, lambda: how, self._terms, is_overdue=self._is_overdue(worker, 0.0))

    def _exit(self, number: int) -> str:
        """How the process ended; one that only fell silent is ended."""
        began = monotonic()
        while (words := self._processes.how_ended(number)) is None and monotonic() - began < 2 * _EXIT_S:
            if monotonic() - began > _EXIT_S:
                self._processes.kill(number)
            sleep(0.01)
        return words or Reason("run.killed_in_vain")

    def _is_overdue(self, worker: _Worker, grace_s: float) -> bool:
        return worker.place is not None and self._terms.is_over(monotonic() - worker.began - grace_s)

    def _end_overdue(self) -> None:
        """End workers that are long over their time and could not end themselves: stopped, or stuck in the system."""
        for number, worker in self._workers.items():
            if self._is_overdue(worker, GRACE_S):
                self._processes.kill(number)


@contextmanager
def local_pool(
    processes: int, terms: Terms, memory_bytes: int, folder: Path, *, ship: Ship | None, log: Say
) -> Iterator[LocalPool]:
    """Some processes of this machine; they end with it.

    Parameters
    ----------
    memory_bytes
        What each may hold.
    folder
        Where they write what they need.

    Raises
    ------
    MissingDependencyError
        Without the package psutil.
    """
    workers = LocalWorkers(processes, folder, memory_bytes)
    try:
        pool = LocalPool(workers, terms, ship=ship, log=log)
        try:
            yield pool
        finally:
            pool.close()
    finally:
        workers.close()
