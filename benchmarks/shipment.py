"""How long a shipment takes, and what memory: the whole command against a bare loop, and one column against 2,000.

    python -m benchmarks.shipment [--columns 100] [--sizes 10 100 1000 2000] [--only start floor growth resume]
        [--json FILE]

``start`` times the command alone. ``floor`` checks columns with two depth maps of 2.3 megapixels each, with two
processes and with one, and compares with two processes that do nothing but the same checks in a loop. ``growth`` checks
more and more columns with small scans. ``resume`` goes on with checks of which all is done: the results of five
columns, under other names and of other scans; once the report is still to be written, once it stands there. Memory is
sampled from outside while the command runs.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import closing
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import psutil

from aadm_workbench.inspection.tasks import plan_job
from batch.job.file import read_job
from batch.job.inputs import looks, order_key, program_key, program_versions, task_key
from batch.runner.journal import Journal
from batch.runner.packed import pack, unpack
from batch.switches import calculate_in_one_thread
from benchmarks.floors import SMALL, SOUND, write_floor

PARTS = ("start", "floor", "growth", "resume")
_SAMPLE_S = 0.05
_SHA256 = re.compile(r'(?<="sha256":")[0-9a-f]{64}(?=")')
_REPEATS = 5


@dataclass
class Run:
    """One run of the command: wall time, processor time of all its processes, largest resident memory in MB.

    Processor time hardly depends on what else the machine does; wall time does.
    """

    seconds: float
    cpu_s: float
    exit_code: int
    main_mb: float = 0.0
    worker_mb: float = 0.0
    main_mb_by_share: list[float] = field(default_factory=list)


def run_check(job: Path, *arguments: str) -> Run:
    """Run ``aadm check`` and watch its memory."""
    command = [sys.executable, "-m", "batch", "check", str(job), "--quiet", *arguments]
    began, cpu_before_s = time.perf_counter(), _cpu_of_children_s()
    process = subprocess.Popen(command)
    samples: list[tuple[float, float]] = []
    watcher = threading.Thread(target=_watch, args=(process.pid, samples))
    watcher.start()
    code = process.wait()
    seconds = time.perf_counter() - began
    watcher.join()
    main_mb = [main for main, _ in samples]
    quarters = [max(main_mb[len(main_mb) * part // 4 : len(main_mb) * (part + 1) // 4 + 1]) for part in range(4)]
    cpu_s = _cpu_of_children_s() - cpu_before_s
    return Run(seconds, cpu_s, code, max(main_mb), max(worker for _, worker in samples), quarters)


def _watch(pid: int, samples: list[tuple[float, float]]) -> None:
    """Sample resident memory, MB, of a process and of the largest of those that it started, until it ends."""
    try:
        process = psutil.Process(pid)
        while True:
            main_mb = process.memory_info().rss / 1e6
            samples.append((main_mb, max((_resident_mb(child) for child in process.children()), default=0.0)))
            time.sleep(_SAMPLE_S)
    except psutil.Error:
        samples.append((0.0, 0.0))


def _cpu_of_children_s() -> float:
    times = os.times()
    return times.children_user + times.children_system


def _resident_mb(process: psutil.Process) -> float:
    try:
        return float(process.memory_info().rss / 1e6)
    except psutil.Error:
        return 0.0


def start_up(folder: Path) -> dict[str, float]:
    """Best time of ``aadm --help`` and of ``aadm check`` on one column, seconds."""
    job = write_floor(folder / "one", 1)
    commands = {"help": ["--help"], "check of one column": ["check", str(job), "--quiet"]}
    return {name: min(_timed(words) for _ in range(_REPEATS)) for name, words in commands.items()}


def _timed(words: list[str]) -> float:
    began = time.perf_counter()
    subprocess.run([sys.executable, "-m", "batch", *words], check=False, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def floor(folder: Path, columns: int) -> dict[str, Any]:
    """The whole command with two processes and with one, and the same checks in bare loops, seconds."""
    job = write_floor(folder / "floor", columns)
    cpu_before_s = _cpu_of_children_s()
    bare_s = _bare_loops(job, 2)
    bare_cpu_s = _cpu_of_children_s() - cpu_before_s
    two = run_check(job, "--jobs", "2", "--out", str(folder / "two"))
    one = run_check(job, "--jobs", "1", "--out", str(folder / "one-process"))
    assert (folder / "two/report.json").read_bytes() == (folder / "one-process/report.json").read_bytes()
    times = json.loads((folder / "two/timing.json").read_text("utf-8"))["columns"].values()
    stages = {stage: sum(column[stage] for column in times) / columns for stage in ("read", "extract", "assembly")}
    return {
        "columns": columns,
        "two": asdict(two),
        "one": asdict(one),
        "bare_s": bare_s,
        "bare_cpu_s": bare_cpu_s,
        "over_bare": two.seconds / bare_s,
        "two_over_one": one.seconds / two.seconds,
        "seconds_per_column": stages,
    }


def _bare_loops(job: Path, processes: int) -> float:
    """Wall time of processes that share a job's columns and do nothing but check them."""
    command = [sys.executable, "-m", "benchmarks.shipment", "--loop", str(job)]
    began = time.perf_counter()
    loops = [subprocess.Popen([*command, f"{part}/{processes}"]) for part in range(processes)]
    assert [loop.wait() for loop in loops] == [0] * processes
    return time.perf_counter() - began


def loop(job: Path, part: str) -> None:
    """Check every so many-th column of a job, one after the other."""
    calculate_in_one_thread()
    from aadm_workbench.inspection.column import inspect_column
    from aadm_workbench.inspection.tasks import plan_job

    first, step = (int(number) for number in part.split("/"))
    tasks = plan_job(read_job(job)).tasks
    for task in tasks[first::step]:
        inspect_column(task)


def growth(folder: Path, sizes: list[int]) -> list[dict[str, Any]]:
    """The cost of a column, ms of wall time, and memory, as a job of small scans grows."""
    found = []
    for columns in sizes:
        job = write_floor(folder / f"small-{columns}", columns, shrink=SMALL)
        run = run_check(job, "--jobs", "2")
        found.append({"columns": columns, "ms_per_column": 1000.0 * run.seconds / columns, **asdict(run)})
    return found


def resume(folder: Path, sizes: list[int]) -> list[dict[str, Any]]:
    """What it costs to go on where all is done, by the number of columns: ms of processor time each, memory, bytes."""
    found = []
    for columns in sizes:
        job = write_floor(folder / f"done-{columns}", columns, shrink=SMALL)
        empty = run_check(job, "--only", *(f"K-{number:04d}" for number in range(len(SOUND))), "--jobs", "1")
        entries_bytes = _repeat_results(job)
        writes, stands = (run_check(job, "--resume", "--jobs", "1") for _ in range(2))
        found.append(
            {
                "columns": columns,
                "bytes_per_column": entries_bytes / columns,
                "ms_writing": 1000.0 * writes.cpu_s / columns,
                "ms_standing": 1000.0 * stands.cpu_s / columns,
                "mb_writing": writes.main_mb,
                "mb_standing": stands.main_mb,
                "mb_of_five": empty.main_mb,
            }
        )
    return found


def _of_its_own(sha256: str, name: str) -> str:
    """The hash of another scan: in a shipment no two columns have the same."""
    return hashlib.sha256(f"{sha256} {name}".encode()).hexdigest()


def _repeat_results(job: Path) -> int:
    """Fill the journal of a job with the results of its first columns, under the names of all; its size."""
    folder = job.parent / "job-report"
    program = program_key()
    with closing(Journal(folder, resume=True)) as journal:
        tasks = plan_job(read_job(job)).tasks
        first = [journal.record(task.column.id) for task in tasks[: len(SOUND)]]
        texts = [unpack(record.report) for record in first]
        for place, task in enumerate(tasks[len(SOUND) :]):
            like, name = place % len(SOUND), task.column.id
            order = order_key(task, program)
            text = texts[like].replace(f'"id":"{first[like].id}"', f'"id":"{name}"', 1)
            text = _SHA256.sub(lambda found, name=name: _of_its_own(found[0], name), text)
            key, seen = task_key(task, order), looks(task, order).hash
            journal.add(replace(first[like], id=name, key=key, seen=seen, report=pack(text)))
        return journal.path.stat().st_size


def machine() -> dict[str, Any]:
    """What the numbers were measured on."""
    return {
        "cores": len(psutil.Process().cpu_affinity() or []) or os.cpu_count(),
        "processor": _processor(),
        "memory_gb": round(psutil.virtual_memory().total / 1e9, 1),
        "load": os.getloadavg()[0],
        "system": platform.platform(),
        **program_versions(),
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.partition(": ")[2] for line in lines if line.startswith("model name")), platform.processor())


def show(found: dict[str, Any]) -> None:
    """Print what was found, with the limits that are aimed at."""
    print("machine: " + ", ".join(f"{name} {value}" for name, value in found["machine"].items()))
    for name, seconds in found.get("start", {}).items():
        print(f"start-up, {name}: {seconds:.2f} s (at most {0.3 if name == 'help' else 1.2} s)")
    if "floor" in found:
        one = found["floor"]
        stages = ", ".join(f"{name} {1000 * seconds:.0f} ms" for name, seconds in one["seconds_per_column"].items())
        print(f"{one['columns']} columns with two depth maps of 1920 x 1200 pixels; per column: {stages}")
        print(
            f"  two processes {one['two']['seconds']:.1f} s (at most 30 s for 100), one {one['one']['seconds']:.1f} s"
        )
        print(f"  two against one: {one['two_over_one']:.2f} (at least 1.8)")
        print(f"  bare loop on two cores {one['bare_s']:.1f} s; over it: {one['over_bare']:.2f} (at most 1.3)")
        cpu_s, bare_cpu_s = one["two"]["cpu_s"], one["bare_cpu_s"]
        print(f"  processor time {cpu_s:.1f} s, of the bare loop {bare_cpu_s:.1f} s: {cpu_s / bare_cpu_s:.2f}")
        print(
            f"  largest worker {one['two']['worker_mb']:.0f} MB (at most 600), scheduler {one['two']['main_mb']:.0f} MB"
        )
    if "growth" in found:
        print("small scans, two processes (the scheduler's memory is to stay flat from 100 to 2,000 columns)")
        print("columns  ms/column  seconds  cpu s  scheduler MB (by quarter of the run)  worker MB")
        for row in found["growth"]:
            quarters = " ".join(f"{value:5.0f}" for value in row["main_mb_by_share"])
            print(
                f"{row['columns']:7d} {row['ms_per_column']:10.1f} {row['seconds']:8.1f} {row['cpu_s']:6.1f}"
                f"  {row['main_mb']:12.0f}  ({quarters})  {row['worker_mb']:9.0f}"
            )


def _show_resume(rows: list[dict[str, Any]]) -> None:
    print("all is done; one process, ms of processor time a column and MB: the report written / the report stands")
    for row in rows:
        print(
            f"{row['columns']:7d} columns: {row['ms_writing']:.2f} / {row['ms_standing']:.2f} ms, "
            f"{row['mb_writing']:.0f} / {row['mb_standing']:.0f} MB (a check of five columns of it: "
            f"{row['mb_of_five']:.0f} MB), journal {row['bytes_per_column']:.0f} bytes a column"
        )


def main() -> int:
    """Measure what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--columns", type=int, default=100)
    parser.add_argument("--sizes", type=int, nargs="+", default=[10, 100, 1000, 2000])
    parser.add_argument("--only", nargs="+", choices=PARTS, default=PARTS)
    parser.add_argument("--json", type=Path, help="write the numbers into a file too")
    parser.add_argument("--loop", nargs=2, metavar=("JOB", "PART"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.loop:
        loop(Path(options.loop[0]), options.loop[1])
        return 0
    found: dict[str, Any] = {"machine": machine()}
    with tempfile.TemporaryDirectory(prefix="aadm-shipment-") as name:
        folder = Path(name)
        if "start" in options.only:
            found["start"] = start_up(folder)
        if "floor" in options.only:
            found["floor"] = floor(folder, options.columns)
        if "growth" in options.only:
            found["growth"] = growth(folder, options.sizes)
        if "resume" in options.only:
            found["resume"] = resume(folder, options.sizes)
    show(found)
    _show_resume(found.get("resume", []))
    if options.json:
        options.json.write_text(json.dumps(found, indent=1), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
