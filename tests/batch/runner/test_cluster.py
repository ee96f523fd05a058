"""Worker processes of this machine: each death is one column's, each limit is kept, everything else is finished."""

import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aadm_workbench.errors import AadmError, JobError, MissingDependencyError
from batch.runner import local_workers, worker
from batch.runner.cluster import exit_in_words
from batch.runner.engine import Death, Unwatched, work_through
from batch.runner.pools import MOST_COLUMNS_HERE, PoolOptions, open_pool
from batch.runner.worker import last_words
from tests.batch.killers import Chore, do, give_up


class Heard(Unwatched):
    """Remembers deaths by the number of their task."""

    def __init__(self) -> None:
        self.deaths: list[tuple[int, Death]] = []

    def lost(self, place: int, death: Death, tries_left: int) -> None:
        self.deaths.append((place, death))


def done(chores: dict[str, str], folder: Path, heard: Unwatched, **options: Any) -> dict[str, str]:
    """What came of chores, in two processes."""
    tasks = [Chore(name, what, folder) for name, what in chores.items()]
    logged: list[str] = []
    pool_options = PoolOptions(processes=2, **options)
    scratch = folder / "scratch"
    scratch.mkdir()
    with open_pool(
        pool_options, len(tasks), folder, ship=lambda task: (), say=logged.append, log=logged.append, log_folder=scratch
    ) as pool:
        found = {tasks[place].name: outcome for place, outcome in work_through(tasks, pool, do, give_up, heard)}
    (folder / "log").write_text("\n".join(logged))
    return found


def tries(folder: Path, name: str) -> int:
    """How often a chore was begun."""
    return len(list(folder.glob(f"{name}-*")))


def test_deaths_and_limits(tmp_path: Path) -> None:
    heard = Heard()
    plain = {f"plain{number}": "work" for number in range(8)}
    deadly = {"killer": "die", "unlucky": "die once", "crash": "crash", "slow": "hang", "large": "memory"}
    chores = {**deadly, "threads": "threads", **plain}
    found = done(chores, tmp_path, heard, seconds=4.0, memory_bytes=400 * 10**6)
    assert found.pop("killer") == (
        "killer given up: 3 processes that checked it died, the last was killed by signal 9 (SIGKILL); "
        "the last that it wrote: about to die in x.tiff"
    )
    assert found.pop("crash").startswith(
        "crash given up: 3 processes that checked it died, the last was killed by signal 11 (SIGSEGV); "
        "the last that it wrote: Fatal Python error: Segmentation fault | "
    )
    assert found.pop("slow") == (
        "slow given up: the process that checked it was ended after 4 s, the time limit for one column (--time-limit)"
    )
    assert found.pop("large") == "too large"
    assert found.pop("threads") == "in one thread"
    assert found == {name: f"{name} done" for name in ("unlucky", *(f"plain{number}" for number in range(8)))}
    counted = {name: tries(tmp_path, name) for name in chores}
    assert counted == {name: {"killer": 3, "crash": 3, "unlucky": 2}.get(name, 1) for name in chores}
    assert sorted(place for place, _ in heard.deaths) == [0, 0, 0, 1, 2, 2, 2, 3]
    assert "about to die" in (tmp_path / "log").read_text()
    pids = {int(path.read_text()) for path in tmp_path.glob("*-*")}
    assert os.getpid() not in pids
    # None of them is left.
    assert not any(Path(f"/proc/{pid}").exists() for pid in pids)


def test_workers_that_cannot_start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(local_workers, "MOST_FALSE_STARTS", 2)
    monkeypatch.setitem(local_workers._ENVIRONMENT, "PYTHONMALLOC", "no_such_allocator")
    with pytest.raises(
        AadmError, match=r"no worker process can be started on this machine: Fatal Python error: .+allocator"
    ):
        done({"one": "work", "two": "work"}, tmp_path, Unwatched())


def test_workers_of_another_version(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    other = {**worker.program_versions(), "numpy": "0.9"}
    monkeypatch.setattr(worker, "program_versions", lambda: other)
    with pytest.raises(JobError, match=rf"no worker can be used: .+it has numpy {np.__version__} instead of 0\.9"):
        done({"one": "work", "two": "work"}, tmp_path, Unwatched())


def pool_for(columns: int, tmp_path: Path, say: Callable[[str], None] = lambda text: None, **options: Any) -> Any:
    """The pool that some columns get."""
    return open_pool(
        PoolOptions(**options), columns, tmp_path, ship=lambda task: (), say=say, log=say, log_folder=tmp_path
    )


def test_a_few_columns_are_done_here(tmp_path: Path) -> None:
    for options in ({}, {"processes": 1}):
        with pool_for(MOST_COLUMNS_HERE, tmp_path, **options) as pool:
            assert pool is None
    with pool_for(1, tmp_path, processes=4) as pool:
        assert pool is None


def test_without_the_packages_for_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "psutil", None)
    monkeypatch.setitem(sys.modules, "distributed", None)
    said: list[str] = []
    with pool_for(500, tmp_path, said.append) as pool:
        assert pool is None
    assert said == ["one column at a time, all in one process: pip install 'aadm-workbench[batch]' to use every core"]
    for options in ({"processes": 2}, {"seconds": 5.0}, {"memory_bytes": 10**9}, {"scheduler": "tcp://h:1"}):
        asked = pytest.raises(MissingDependencyError, match=r"pip install 'aadm-workbench\[batch\]'")
        with asked, pool_for(500, tmp_path, **options):
            pass


def test_processes_of_this_machine_need_no_dask(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert done({"one": "work", "two": "work"}, tmp_path, Unwatched()) == {"one": "one done", "two": "two done"}


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense://x", "127.0.0.1:9"])
def test_no_scheduler_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("batch.runner.cluster._CONNECT_S", 1.0)
    began = time.monotonic()
    refused = pytest.raises(JobError, match=r"no scheduler of Dask answers at .+ start one with: dask scheduler")
    with refused, pool_for(2, tmp_path, scheduler=address):
        pass
    assert time.monotonic() - began < 10.0


def test_what_nannies_say() -> None:
    assert exit_in_words("Worker process 12 was killed by signal 9", 12) == "killed by signal 9 (SIGKILL)"
    assert exit_in_words("Worker process 12 exited with status 3", 12) == "ended with status 3"
    assert exit_in_words("Worker process 12 was killed by signal 9", 1) is None
    assert exit_in_words("Restarting worker 12", 12) is None


def test_last_words() -> None:
    fault = (
        'Fatal Python error: Aborted\n\nThread 0x00007f12 (most recent):\n  File "/opt/x y/a/b.py", line 3 in f\nm\nn'
    )
    assert last_words(fault).startswith("Fatal Python error: Aborted | Thread 0x… (most recent):")
    assert "/opt" not in last_words(fault)
    assert last_words("a\nb\n\nc /home/me/scans/C-1.ply: bad\nd\ne\n") == "b | c C-1.ply: bad | d | e"
    assert last_words("") == ""
