"""Work that worker processes can import: some of it kills them."""

import os
import signal
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Chore:
    """What is to be done: ``what`` names it; ``folder`` remembers how often it was tried."""

    name: str
    what: str
    folder: Path
    content: bytes = b""


def do(chore: Chore) -> str:
    """Do a chore; whatever it is, the try is noted first."""
    with (chore.folder / f"{chore.name}-{time.monotonic_ns()}").open("w") as stream:
        stream.write(str(os.getpid()))
    tries = len(list(chore.folder.glob(f"{chore.name}-*")))
    if chore.what == "die" or (chore.what == "die once" and tries == 1):
        sys.stderr.write(f"about to die in {chore.folder}/x.tiff\n")
        sys.stderr.flush()
        os.kill(os.getpid(), signal.SIGKILL)
    if chore.what == "crash":
        os.kill(os.getpid(), signal.SIGSEGV)
    if chore.what == "threads":
        return f"in {'one thread' if os.environ['OPENBLAS_NUM_THREADS'] == '1' else 'many threads'}"
    if chore.what == "hang":
        time.sleep(60.0)
    if chore.what == "memory":
        try:
            np.ones(2**28).sum()
        except MemoryError:
            return "too large"
    return f"{chore.name} done"


def give_up(chore: Chore, reason: str) -> str:
    """The outcome of a chore that was given up."""
    return f"{chore.name} given up: {reason}"
