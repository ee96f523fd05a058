"""A scheduler and two workers as processes of their own, as docs/overnight.md has them started: the same report."""

import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import psutil
import pytest

from aadm_workbench.errors import JobError
from batch.main import main
from batch.runner.engine import Unwatched, work_through
from batch.runner.pools import PoolOptions, open_pool

from .conftest import WriteJob, column_text
from .killers import Chore, do, give_up

NAMES = [f"C-{number}" for number in range(4)]


@dataclass
class Cluster:
    """Processes of a cluster; ``folder`` is where its workers run."""

    address: str
    workers: list[subprocess.Popen[bytes]]
    folder: Path


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """A scheduler on a free port, and two workers with their nannies."""
    pytest.importorskip("distributed")
    folder = tmp_path_factory.mktemp("cluster")
    root = Path(__file__).resolve().parents[2]
    environment = {**os.environ, "PYTHONPATH": str(root)}
    started: list[subprocess.Popen[bytes]] = []

    def start(*words: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "dask", *words]
        with (folder / f"{words[0]}-{len(started)}.txt").open("wb") as log:
            process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
        started.append(process)
        return process

    said = folder / "scheduler.json"
    start("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(said))
    until = time.monotonic() + 30.0
    while not said.exists() and time.monotonic() < until:
        time.sleep(0.05)
    address = json.loads(said.read_text())["address"]
    workers = [start("worker", address, "--nthreads", "1", "--no-dashboard") for _ in range(2)]
    yield Cluster(address, workers, folder)
    for process in reversed(started):
        process.send_signal(signal.SIGTERM)
    for process in started:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(10)
        process.kill()


@pytest.fixture
def job(write_job: WriteJob) -> Path:
    """Four columns, one of which has no scan."""
    columns = [column_text(name, f"{name}.ply") for name in NAMES]
    return write_job(*columns, clouds=tuple(f"{name}.ply" for name in NAMES[:3]))


def report(job: Path, out: str, *arguments: str) -> bytes:
    """The bytes of the report of a check."""
    main(["check", str(job), "--out", str(job.parent / out), "--quiet", *arguments])
    return (job.parent / out / "report.json").read_bytes()


def test_the_same_report_by_path_and_by_content(cluster: Cluster, job: Path) -> None:
    here = report(job, "here")
    assert report(job, "there", "--scheduler", cluster.address) == here
    log = (job.parent / "there" / "workers.log").read_text("utf-8")
    assert log.count(" is ready") == 2
    assert report(job, "shipped", "--scheduler", cluster.address, "--ship-inputs") == here
    # Nothing is left of what was shipped, nor of what was written on the way.
    assert not list(cluster.folder.rglob("*.ply"))


def test_a_worker_that_does_not_see_the_scans_gets_none(cluster: Cluster, tmp_path: Path) -> None:
    said: list[str] = []
    nowhere = tmp_path / "nowhere"
    with open_pool(
        PoolOptions(scheduler=cluster.address),
        1,
        nowhere,
        ship=lambda task: (),
        say=said.append,
        log=lambda line: None,
        log_folder=tmp_path,
    ) as pool:
        chores = [Chore("one", "work", tmp_path)]
        with pytest.raises(JobError, match=r"no worker can be used: .+it does not see .+nowhere.+add --ship-inputs"):
            list(work_through(chores, pool, do, give_up, Unwatched()))
    assert len(said) == 2


def test_a_worker_that_dies_is_named_by_its_signal(cluster: Cluster, job: Path) -> None:
    """Killed while it works: its nanny starts another, the column is tried again, and the report is the same."""
    here = report(job, "here")
    out = job.parent / "killed"
    events = job.parent / "events.jsonl"
    words = ["check", str(job), "--out", str(out), "--scheduler", cluster.address, "--events", str(events), "--quiet"]
    root = Path(__file__).resolve().parents[2]
    process = subprocess.Popen([sys.executable, "-m", "batch", *words], cwd=root)
    killed = 0
    journal = out / "journal.jsonl"
    while process.poll() is None and not killed:
        if journal.exists() and b'"began"' in journal.read_bytes():
            for worker in psutil.Process(cluster.workers[0].pid).children():
                if "spawn_main" in " ".join(worker.cmdline()):
                    worker.kill()
                    killed += 1
        time.sleep(0.002)
    process.wait(60)
    assert (out / "report.json").read_bytes() == here
    lost = [event for line in events.read_text("utf-8").splitlines() if (event := json.loads(line))["event"] == "lost"]
    assert killed == 1
    assert {event["cause"] for event in lost} <= {"killed by signal 9 (SIGKILL)"}
    shutil.rmtree(out)
