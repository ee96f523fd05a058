"""The order of the work, with a pool whose places die when they are told to."""

from collections.abc import Callable, Sequence
from typing import Any

import pytest

from batch.runner.engine import MOST_DEATHS, Death, Ended, Unwatched, work_through

SEGFAULT = Death("killed by signal 11 (SIGSEGV)", "Fatal Python error: Segmentation fault")


class Places:
    """Some places; a task that is listed in ``deaths`` ends its place so often."""

    def __init__(self, places: int, deaths: dict[str, list[Death]]) -> None:
        self.names = [f"w{number}" for number in range(places)]
        self.deaths = deaths
        self.running: dict[str, tuple[int, Callable[[Any], Any], Any]] = {}
        self.begun: list[tuple[str, tuple[str, ...]]] = []

    def idle(self) -> Sequence[str]:
        return [name for name in self.names if name not in self.running]

    def begin(self, name: str, place: int, work: Callable[[Any], Any], task: Any) -> None:
        self.begun.append((task, tuple(sorted(other for _, _, other in self.running.values()))))
        self.running[name] = (place, work, task)

    def wait(self) -> Sequence[Ended]:
        name = next(iter(self.running))
        place, work, task = self.running.pop(name)
        if self.deaths.get(task):
            return (Ended(place, death=self.deaths[task].pop()),)
        return (Ended(place, work(task)),)


class Heard(Unwatched):
    """Remembers what was lost."""

    def __init__(self) -> None:
        self.losses: list[tuple[int, int]] = []

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        self.losses.append((place, tries_left))


def outcomes(pool: Any, tasks: str, heard: Any = None, doubtful: Sequence[int] = ()) -> dict[str, str]:
    """What came of some tasks."""
    found = work_through(
        list(tasks), pool, str.upper, lambda task, reason: reason, heard or Unwatched(), doubtful=doubtful
    )
    return {tasks[place]: outcome for place, outcome in found}


def test_one_after_the_other_in_this_process() -> None:
    found = list(work_through(["a", "b"], None, str.upper, lambda task, reason: reason, Unwatched()))
    assert found == [(0, "A"), (1, "B")]
    assert list(work_through([], None, str.upper, lambda task, reason: reason, Unwatched())) == []


def test_a_task_that_kills_ends_after_three_and_harms_nobody() -> None:
    pool, heard = Places(2, {"c": [SEGFAULT] * MOST_DEATHS}), Heard()
    found = outcomes(pool, "abcdefgh", heard)
    assert found.pop("c") == (
        "3 processes that checked it died, the last was killed by signal 11 (SIGSEGV); the last that it wrote: "
        "Fatal Python error: Segmentation fault"
    )
    assert found == {name: name.upper() for name in "abdefgh"}
    assert heard.losses == [(2, 2), (2, 1), (2, 0)]
    tries = [place for place, (task, _) in enumerate(pool.begun) if task == "c"]
    # The first where it stands, the second behind all others, the third with nothing else running.
    assert tries[1] >= 8
    assert pool.begun[tries[2]][1] == ()


def test_nothing_runs_beside_a_last_try() -> None:
    pool = Places(3, {"a": [SEGFAULT] * 2, "b": [SEGFAULT] * 2})
    assert outcomes(pool, "abcd") == {name: name.upper() for name in "abcd"}
    last = [beside for task, beside in pool.begun if [other for other, _ in pool.begun].count(task) == 3][-2:]
    assert last == [(), ()]


def test_a_death_that_would_repeat_is_final() -> None:
    pool = Places(1, {"b": [Death("ended after 5 s, the time limit", is_final=True)]})
    assert outcomes(pool, "abc")["b"] == "the process that checked it was ended after 5 s, the time limit"
    assert [task for task, _ in pool.begun].count("b") == 1


def test_what_an_earlier_run_ended_at_comes_last() -> None:
    pool = Places(1, {})
    outcomes(pool, "abcd", doubtful=(0, 2))
    assert [task for task, _ in pool.begun] == list("bdac")


@pytest.mark.parametrize("places", [1, 2, 5])
def test_everything_ends_whatever_dies(places: int) -> None:
    deaths = {name: [SEGFAULT] * (number % 5) for number, name in enumerate("abcdefghij")}
    found = outcomes(Places(places, deaths), "abcdefghij")
    assert {name for name, outcome in found.items() if outcome != name.upper()} == set("deij")
