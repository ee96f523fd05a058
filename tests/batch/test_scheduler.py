"""A scheduler and two workers as processes of their own, as docs/overnight.md has them started: the same report."""

import contextlib
import hashlib
import json
import os
import re
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

from aadm_workbench.errors import AadmError, JobError
from batch.main import main
from batch.runner import cluster as cluster_of_dask
from batch.runner.dask_pool import DaskPool
from batch.runner.engine import Unwatched, work_through
from batch.runner.pools import PoolOptions, open_pool
from batch.runner.worker import Terms
from benchmarks.faults import address_in

from .conftest import WriteJob, column_text
from .killers import Chore, do, give_up

NAMES = [f"C-{number}" for number in range(4)]


@dataclass
class Cluster:
    """Processes of a cluster; ``folder`` is where its workers run."""

    address: str
    workers: list[subprocess.Popen[bytes]]
    folder: Path
    scheduler: subprocess.Popen[bytes]


@contextlib.contextmanager
def running_cluster(folder: Path, count: int) -> Iterator[Cluster]:
    """A scheduler on a free port, and some workers with their nannies."""
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
    try:
        start("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(said))
        address = address_in(said, 60.0)
        workers = [start("worker", address, "--nthreads", "1", "--no-dashboard") for _ in range(count)]
        yield Cluster(address, workers, folder, started[0])
    finally:
        for process in reversed(started):
            process.send_signal(signal.SIGTERM)
        for process in started:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(10)
            process.kill()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """A scheduler and two workers."""
    pytest.importorskip("distributed")
    with running_cluster(tmp_path_factory.mktemp("cluster"), 2) as running:
        yield running


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
    # Each of the two, once or again: on a busy machine a worker may be lost and met a second time.
    assert len(set(re.findall(r"process (\d+) on .+ is ready", log))) == 2
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


def test_a_worker_that_sees_an_empty_folder_gets_none(cluster: Cluster, tmp_path: Path) -> None:
    """The folder of the job is there, but the disk is not mounted, or it is the worker's own folder of that name."""
    file = tmp_path / "job.toml"
    sha256 = hashlib.sha256(b"schema = 1").hexdigest()
    options = PoolOptions(scheduler=cluster.address, job_file=file, job_sha256=sha256)

    def outcomes() -> list[tuple[int, str]]:
        pool = open_pool(options, 1, tmp_path, ship=lambda _: (), say=print, log=lambda _: None, log_folder=tmp_path)
        with pool as there:
            return list(work_through([Chore("one", "work", tmp_path)], there, do, give_up, Unwatched()))

    said = r"no worker can be used: .+it does not see .+job\.toml as it is here; share that folder"
    with pytest.raises(JobError, match=said):
        outcomes()
    file.write_bytes(b"schema = 2")
    with pytest.raises(JobError, match=said):
        outcomes()
    file.write_bytes(b"schema = 1")
    assert outcomes() == [(0, "one done")]


class LostClient:
    """A client of Dask whose scheduler is gone: it knows of itself, and of no workers."""

    def scheduler_info(self, n_workers: int) -> dict[str, str]:
        return {"type": "Scheduler", "id": "none"}


class ClosedClient:
    """A client of Dask that has given up its scheduler: it remembers a worker, and sends nothing any more."""

    def scheduler_info(self, n_workers: int) -> dict[str, dict[str, str]]:
        return {"workers": {"tcp://127.0.0.1:1": ""}}

    def submit(self, *call: object, **where: object) -> None:
        raise pytest.importorskip("distributed.client").ClosedClientError("Client is closed.")


@pytest.mark.parametrize("client", [LostClient(), ClosedClient()])
def test_a_client_that_has_lost_its_scheduler_says_so(tmp_path: Path, client: LostClient | ClosedClient) -> None:
    lost = cluster_of_dask.Cluster(client, cluster_of_dask.RemoteWorkers(client))
    with pytest.raises(AadmError, match="the scheduler of Dask is gone; look at its own messages"):
        DaskPool(lost, Terms(tmp_path, tmp_path), ship=None, say=print, log=print)


def test_a_scheduler_that_dies_in_mid_run_is_said_to_be_gone(tmp_path: Path, job: Path) -> None:
    """What was kept is kept, the exit code is that of a check that could not go on, and it goes on elsewhere."""
    pytest.importorskip("distributed")
    here = report(job, "here")
    folder = tmp_path / "cluster"
    folder.mkdir()
    out = job.parent / "there"
    with running_cluster(folder, 1) as running:
        words = ["check", str(job), "--out", str(out), "--scheduler", running.address, "--quiet"]
        root = Path(__file__).resolve().parents[2]
        process = subprocess.Popen([sys.executable, "-m", "batch", *words], cwd=root, stderr=subprocess.PIPE, text=True)
        journal = out / "journal.jsonl"
        while process.poll() is None and not (journal.exists() and b'"key"' in journal.read_bytes()):
            time.sleep(0.002)
        running.scheduler.kill()
        _, said = process.communicate(timeout=120)
    assert "the scheduler of Dask is gone; look at its own messages" in said
    assert process.returncode == 70
    assert "repeat the command with --resume" in said
    assert "Traceback" not in said
    assert report(job, "there", "--resume") == here


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
