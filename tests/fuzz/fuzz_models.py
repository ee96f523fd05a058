"""Fuzz the readers of models: ``python -m tests.fuzz.fuzz_models plain --seconds 600``.

Kinds: ``plain`` (.ifc), ``ifczip``, ``elements`` (what FreeCAD's process hands over of a document). Inputs are read in
processes of their own, a few hundred in each, so that a crash of a parser in C++, a hang and memory without end are
seen too. Inputs that do harm are kept in a folder (``--keep``); the same ``--seed`` gives the same inputs. At the end
it says how many were read, refused and found harmful, the slowest, and the peak of memory.
"""

from __future__ import annotations

import argparse
import json
import resource
import select
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from tests.fuzz.dice import Dice
from tests.fuzz.model_targets import KINDS, tried

HANGS_S = 30.0
"""An input of some kilobytes that takes longer hangs for whoever waits for it."""

MOST_MEMORY_BYTES = 4 * 2**30
BATCH = 400
"""Inputs of one process: what they leave in memory goes with it."""

_ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Tally:
    """What a run came to."""

    kind: str
    keep: Path
    outcomes: dict[str, int] = field(default_factory=dict)
    harmful: list[str] = field(default_factory=list)
    slowest_s: float = 0.0
    slowest: int = 0
    peak_bytes: int = 0

    def add(self, number: int, outcome: str, took_s: float = 0.0, peak_bytes: int = 0) -> None:
        """One input."""
        self.outcomes[outcome] = self.outcomes.get(outcome, 0) + 1
        if took_s > self.slowest_s:
            self.slowest_s, self.slowest = took_s, number
        self.peak_bytes = max(self.peak_bytes, peak_bytes)
        if outcome not in ("read", "refused"):
            self.harmful.append(f"{self.kind}-{number}: {outcome}")
            self.keep.mkdir(parents=True, exist_ok=True)
            (self.keep / f"{self.kind}-{number}").write_bytes(KINDS[self.kind](Dice(number)))

    def told(self) -> str:
        """All of it in a few lines."""
        counted = ", ".join(f"{count} {outcome}" for outcome, count in sorted(self.outcomes.items()))
        slowest = f"slowest {self.slowest_s:.2f} s (input {self.slowest})"
        peak = f"peak memory {self.peak_bytes / 2**20:.0f} MiB"
        return "\n".join([f"{self.kind}: {counted}; {slowest}; {peak}", *self.harmful])


def main(arguments: list[str]) -> int:
    """Fuzz for some time; 1 where an input did harm."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=sorted(KINDS))
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path, default=Path("crashes"))
    parser.add_argument("--from", type=int, dest="first", help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.first is not None:
        return _work(options.kind, options.first)
    tally, number, end = Tally(options.kind, options.keep), options.seed * 10**6, time.monotonic() + options.seconds
    while time.monotonic() < end:
        number = _batch(tally, number, end)
    sys.stderr.write(f"{tally.told()}\n")
    return 1 if tally.harmful else 0


def _batch(tally: Tally, number: int, end: float) -> int:
    """Inputs one after the other in one process, until it dies, hangs or has had its share; the next number."""
    command = [sys.executable, "-m", "tests.fuzz.fuzz_models", tally.kind, "--from", str(number)]
    with subprocess.Popen(command, cwd=_ROOT, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        for _ in range(BATCH):
            if time.monotonic() > end:
                break
            if not select.select([process.stdout], [], [], HANGS_S)[0]:
                tally.add(number, "hangs")
                process.kill()
                return number + 1
            line = process.stdout.readline()
            if not line:
                tally.add(number, f"dies with {process.wait()}")
                return number + 1
            tally.add(number, *json.loads(line))
            number += 1
        process.kill()
    return number


def _work(kind: str, number: int) -> int:
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY_BYTES, MOST_MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    while True:
        began = time.perf_counter()
        outcome = tried(kind, KINDS[kind](Dice(number)))
        peak_bytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
        sys.stdout.write(json.dumps([outcome, time.perf_counter() - began, peak_bytes]) + "\n")
        sys.stdout.flush()
        number += 1


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
