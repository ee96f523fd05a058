"""A check whose workers, inputs and own process come to harm at random, against one that nothing happened to.

    python -m benchmarks.chaos [--columns 300] [--full-size] [--seed 1] [--kill-every 2.0] [--folder DIR]

The calm check comes first. Then inputs are corrupted, some before and some during the second check, whose workers are
killed one by one and whose own process is killed twice, each time to be resumed; then the disk is full, a scheduler
dies, and a worker sees an empty mount (:mod:`benchmarks.faults`); strangers put links and pipes into its folder, and
reach for its ports, pipes and files. Every column whose inputs were sound must come to the same report, bit
by bit; every other must be an error of its own; no stranger may get anywhere. Ends with 1 where it is not so.
"""

from __future__ import annotations

import argparse
import functools
import json
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from benchmarks.faults import Faults, meet_faults
from benchmarks.floors import SMALL, write_floor
from benchmarks.strangers import Strangers

_SHARE_CORRUPT = 0.1
_PROCESS_DEATHS = 2
_POLL_S = 0.05
_PLANTED = 6
"""So many links and pipes lie in the folder before each run."""


@dataclass
class Chaos:
    """What came to harm, and what came of it: ids of columns by how they ended."""

    columns: int
    calm_s: float
    strangers: Strangers
    chaos_s: float = 0.0
    corrupt: list[str] = field(default_factory=list)
    workers_killed: int = 0
    processes_killed: int = 0
    differ: list[str] = field(default_factory=list)
    not_noticed: list[str] = field(default_factory=list)
    exit_codes: list[int] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    harm: list[str] = field(default_factory=list)
    faults: Faults = field(default_factory=Faults)

    @property
    def ended_well(self) -> bool:
        """Whether sound columns are as in the calm check, the others are errors, and no stranger got anywhere."""
        sound = not self.differ and not self.not_noticed and not self.harm
        return sound and self.processes_killed == _PROCESS_DEATHS and self.faults.all_said


def run_chaos(
    folder: Path, columns: int, rng: np.random.Generator, *, shrink: int = SMALL, kill_every_s: float = 2.0
) -> Chaos:
    """Check a floor calmly and in chaos; files go into a folder that is there and empty."""
    calm, harmed = write_floor(folder / "calm", columns, shrink=shrink, linked=False), folder / "chaos"
    began = time.perf_counter()
    subprocess.run(_command(calm), check=False, capture_output=True)
    strangers = Strangers(harmed / "job-report", folder / "precious")
    chaos = Chaos(columns, time.perf_counter() - began, strangers)
    job = write_floor(harmed, columns, shrink=shrink, linked=False)
    doomed = [f"K-{number:04d}" for number in rng.permutation(columns)[: max(2, round(_SHARE_CORRUPT * columns))]]
    before, during = doomed[::2], doomed[1::2]
    for name in before:
        chaos.corrupt.append(_corrupt(harmed / "scans", name, rng))
    began = time.perf_counter()
    for number in range(_PROCESS_DEATHS + 1):
        for _ in range(_PLANTED):
            strangers.plant(rng)
        dies_at = (number + 1) * columns // (_PROCESS_DEATHS + 1) if number < _PROCESS_DEATHS else None
        chaos.exit_codes.append(_run(job, chaos, rng, during, kill_every_s, dies_at, resume=number > 0))
        if number == _PROCESS_DEATHS - 1:
            kept = functools.partial(_kept, harmed / "job-report" / "journal.jsonl")
            chaos.faults = meet_faults([*_command(job, scheduler=True), "--resume"], job, kept)
    while during:
        chaos.corrupt.append(_corrupt(harmed / "scans", during.pop(), rng))
    # What was spoilt after its column had been checked is found now: nothing else is checked again.
    chaos.exit_codes.append(subprocess.run([*_command(job), "--resume"], check=False, capture_output=True).returncode)
    chaos.chaos_s = time.perf_counter() - began
    chaos.harm = strangers.harm
    _compare(chaos, _columns(calm), _columns(job))
    return chaos


def _command(job: Path, *, scheduler: bool = False) -> list[str]:
    """A check in two processes, or by a scheduler that is still to be named."""
    processes = [] if scheduler else ["--jobs", "2"]
    return [
        sys.executable,
        "-m",
        "batch",
        "check",
        str(job),
        *processes,
        "--quiet",
        *([] if scheduler else ["--debug"]),
    ]


def _run(
    job: Path,
    chaos: Chaos,
    rng: np.random.Generator,
    during: list[str],
    kill_every_s: float,
    dies_at: int | None,
    *,
    resume: bool,
) -> int:
    """One run: workers are killed in it, and itself once so many columns are kept."""
    said = job.parent / "said.txt"
    with said.open("wb") as stream:
        command = [*_command(job), *(["--resume"] if resume else [])]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=stream)
    journal = job.parent / "job-report" / "journal.jsonl"
    next_kill = time.perf_counter() + kill_every_s
    while process.poll() is None:
        time.sleep(_POLL_S)
        if dies_at is not None and _kept(journal) >= dies_at:
            process.kill()
            chaos.processes_killed += 1
            break
        if time.perf_counter() > next_kill:
            next_kill = time.perf_counter() + kill_every_s * rng.uniform(0.5, 1.5)
            chaos.strangers.come_near(process.pid)
            chaos.strangers.plant(rng)
            chaos.workers_killed += _kill_one(process.pid, rng)
            if during:
                chaos.corrupt.append(_corrupt(job.parent / "scans", during.pop(), rng))
    code = process.wait()
    chaos.said.append(said.read_text("utf-8", errors="replace")[-2000:])
    return code


def _kept(journal: Path) -> int:
    """How many columns have a result."""
    if not journal.exists():
        return 0
    with journal.open("rb") as stream:
        return len({line[:20] for line in stream if line.startswith(b'{"id":')})


def _kill_one(parent: int, rng: np.random.Generator) -> int:
    try:
        workers = [child for child in psutil.Process(parent).children() if "local_worker" in " ".join(child.cmdline())]
        if workers:
            workers[int(rng.integers(len(workers)))].kill()
        return len(workers[:1])
    except psutil.NoSuchProcess:
        return 0


def _corrupt(scans: Path, name: str, rng: np.random.Generator) -> str:
    """Spoil one of a column's two scans in one of several ways; returns the column's id."""
    path = scans / f"{name}-{('foot', 'bars')[int(rng.integers(2))]}.tiff"
    content = path.read_bytes()
    spoilt = [
        b"",
        content[: len(content) // 2],
        content[:8] + rng.bytes(len(content) - 8),
        rng.bytes(5000),
        b"\x00" * len(content),
    ]
    choice = int(rng.integers(len(spoilt) + 1))
    path.unlink()
    if choice < len(spoilt):
        path.write_bytes(spoilt[choice])
    return name


def _columns(job: Path) -> dict[str, Any]:
    report = json.loads((job.parent / "job-report" / "report.json").read_text("utf-8"))
    return {column["id"]: column for column in report["columns"]}


def _compare(chaos: Chaos, calm: dict[str, Any], found: dict[str, Any]) -> None:
    assert list(calm) == list(found)
    for name, column in calm.items():
        if name in chaos.corrupt:
            if found[name]["verdict"] != "error":
                chaos.not_noticed.append(name)
        elif found[name] != column:
            chaos.differ.append(name)


def main() -> int:
    """Run it as the command line says, and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--columns", type=int, default=300)
    parser.add_argument("--full-size", action="store_true", help="scans of 2.3 megapixels instead of small ones")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kill-every", type=float, default=2.0, metavar="SECONDS")
    parser.add_argument("--folder", type=Path, help="where the floors are written (default: a temporary folder)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        shrink = 1 if options.full_size else SMALL
        rng = np.random.default_rng(options.seed)
        chaos = run_chaos(Path(folder), options.columns, rng, shrink=shrink, kill_every_s=options.kill_every)
    print(f"{chaos.columns} columns, seed {options.seed}: calm in {chaos.calm_s:.1f} s, in chaos {chaos.chaos_s:.1f} s")
    print(f"workers killed: {chaos.workers_killed}, the check itself: {chaos.processes_killed}")
    them = chaos.strangers
    print(f"strangers: {them.links} links, {them.pipes} pipes, {them.users} attempts as another user: ", end="")
    print("; ".join(chaos.harm) or "nothing written, opened or found listening")
    print(*chaos.faults.lines(), sep="\n")
    print(f"columns with spoilt inputs: {len(chaos.corrupt)}, not noticed: {chaos.not_noticed or 'none'}")
    if not chaos.ended_well:
        print(*chaos.said, sep="\n---\n")
    print(f"sound columns that differ from the calm check: {chaos.differ or 'none'}; exit codes {chaos.exit_codes}")
    return 0 if chaos.ended_well else 1


if __name__ == "__main__":
    raise SystemExit(main())
