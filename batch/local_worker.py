"""A worker process of this machine: ``python -m aadm_batch.local_worker ADDRESS FOLDER PARENT``, started by a check.

It ends with the process that started it, however that ends.
"""

from __future__ import annotations

import asyncio
import contextlib
import ctypes
import os
import signal
import sys
from importlib import import_module

from .one_thread import calculate_in_one_thread

_HERE = "127.0.0.1"
_SET_SIGNAL_OF_PARENTS_DEATH = 1  # PR_SET_PDEATHSIG of prctl(2)


def main(address: str, folder: str, parent: str) -> None:
    """Work for a scheduler until it goes away."""
    _end_with(int(parent))
    calculate_in_one_thread()
    with contextlib.suppress(OSError, KeyboardInterrupt):
        asyncio.run(_work(address, folder))
    # Nothing is left to be tidied up, and threads of native libraries may never end.
    os._exit(0)


async def _work(address: str, folder: str) -> None:
    distributed = import_module("distributed")
    # Whoever reaches a worker can have it run anything: it listens to this machine alone.
    async with distributed.Worker(
        address,
        host=_HERE,
        dashboard=False,
        dashboard_address=f"{_HERE}:0",
        nthreads=1,
        memory_limit=0,
        local_directory=folder,
        death_timeout=60,
    ) as worker:
        await worker.finished()


def _end_with(parent: int) -> None:
    """Where the system can (Linux): be killed when the parent dies, at once and in the middle of native code."""
    if sys.platform != "linux":
        return
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None, use_errno=True).prctl(_SET_SIGNAL_OF_PARENTS_DEATH, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
