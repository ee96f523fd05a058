"""The order in which columns are worked on, and what becomes of one whose process died: one loop for all pools.

A column costs its process when the process dies while it works on that column alone; nobody else is blamed. The column
is tried again after all others, the last time with nothing else running; then it is given up and the rest goes on.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeVar

from aadm_workbench.model import Reason

Task = TypeVar("Task")
Outcome = TypeVar("Outcome")

MOST_DEATHS = 3
"""So many processes may a column cost before it is given up."""


@dataclass(frozen=True)
class Death:
    """How a process ended while it worked on a column.

    Parameters
    ----------
    cause
        In words: ``killed by signal 11 (SIGSEGV)``.
    last_words
        The end of what it wrote, one line.
    is_final
        Whether there is no use in another try (it took too long).
    """

    cause: str
    last_words: str = ""
    is_final: bool = False


@dataclass(frozen=True, eq=False)
class Ended:
    """A task that is no longer worked on: its ``outcome``, or the ``death`` of its process."""

    place: int
    outcome: Any = None
    death: Death | None = None


class Pool(Protocol):
    """Places where tasks are worked on, one at a time in each."""

    def idle(self) -> Sequence[str]:
        """Names of places where nothing is worked on."""

    def begin(self, name: str, place: int, work: Callable[[Any], Any], task: Any) -> None:
        """Work on a task in an idle place."""

    def wait(self) -> Sequence[Ended]:
        """Wait a moment for tasks to end."""


class Watcher(Protocol):
    """Is told what becomes of tasks, by their number in the sequence."""

    def began(self, place: int) -> None:
        """A task is being worked on."""

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        """A process died; its task is tried again where tries are left."""


@dataclass
class _Order:
    """Which task comes next: those without suspicion, then those with, then those alone that are nearly given up."""

    fresh: deque[int]
    doubtful: deque[int]
    alone: deque[int] = field(default_factory=deque)

    def next(self, running: Collection[int], alone_running: bool) -> int | None:
        if alone_running:
            return None
        if self.fresh:
            return self.fresh.popleft()
        if self.doubtful:
            return self.doubtful.popleft()
        return self.alone.popleft() if self.alone and not running else None

    def again(self, place: int, deaths: int) -> None:
        (self.alone if deaths + 1 >= MOST_DEATHS else self.doubtful).append(place)


def work_through(
    tasks: Sequence[Task],
    pool: Pool | None,
    work: Callable[[Task], Outcome],
    lost: Callable[[Task, str], Outcome],
    watcher: Watcher,
    doubtful: Collection[int] = (),
) -> Iterator[tuple[int, Outcome]]:
    """Work on all tasks; yields the place of each in the sequence and its outcome, as they end.

    Parameters
    ----------
    pool
        None for this process itself: each task is done when its outcome is asked for, and what kills it kills all.
    work
        A function of a module, which catches what can go wrong.
    lost
        Makes the outcome of a task that was given up, from the task and the reason.
    doubtful
        Places of tasks that come after the others: an earlier run ended while it worked on them.
    """
    fresh = [place for place in range(len(tasks)) if place not in doubtful]
    if pool is not None:
        return _spread(tasks, pool, work, lost, watcher, _Order(deque(fresh), deque(sorted(doubtful))))
    order = (*fresh, *sorted(doubtful))
    return zip(order, map(work, _begun(tasks, order, watcher)), strict=True)


def _begun(tasks: Sequence[Task], order: Sequence[int], watcher: Watcher) -> Iterator[Task]:
    for place in order:
        watcher.began(place)
        yield tasks[place]


def _spread(
    tasks: Sequence[Task],
    pool: Pool,
    work: Callable[[Task], Outcome],
    lost: Callable[[Task, str], Outcome],
    watcher: Watcher,
    order: _Order,
) -> Iterator[tuple[int, Outcome]]:
    deaths: dict[int, list[Death]] = {}
    running: set[int] = set()
    left = len(tasks)
    while left:
        for name in pool.idle():
            alone_running = any(len(deaths.get(place, ())) + 1 >= MOST_DEATHS for place in running)
            place = order.next(running, alone_running)
            if place is None:
                break
            running.add(place)
            watcher.began(place)
            pool.begin(name, place, work, tasks[place])
        for ended in pool.wait():
            running.discard(ended.place)
            if ended.death is None:
                left -= 1
                yield ended.place, ended.outcome
                continue
            died = deaths.setdefault(ended.place, [])
            died.append(ended.death)
            tries_left = 0 if ended.death.is_final else MOST_DEATHS - len(died)
            watcher.lost(ended.place, ended.death, tries_left)
            if tries_left:
                order.again(ended.place, len(died))
            else:
                left -= 1
                yield ended.place, lost(tasks[ended.place], _reason(died))


class Unwatched:
    """A watcher for work that nobody follows."""

    def began(self, place: int) -> None:
        """Nothing."""

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        """Nothing."""


def _reason(died: Sequence[Death]) -> str:
    last = died[-1]
    code = "run.died" if len(died) == 1 else "run.died.several"
    how = Reason(code, count=len(died), cause=last.cause)
    return Reason("run.last_words", what=how, words=last.last_words) if last.last_words else how
