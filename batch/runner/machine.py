"""What this machine has to give: cores and memory, as a container or a queue bounds them."""

from __future__ import annotations

import os
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from aadm_workbench.errors import MissingDependencyError

_LIMITS_OF_CONTAINERS = (
    "/sys/fs/cgroup/memory.max",
    "/sys/fs/cgroup/memory.high",
    "/sys/fs/cgroup/memory/memory.limit_in_bytes",
)
"""Where Linux says what a container may hold: control groups of version 2, and of version 1."""


def load_psutil() -> Any:
    """The package that knows how much memory there is, and who holds it.

    Raises
    ------
    MissingDependencyError
        Where it is not installed.
    """
    try:
        return import_module("psutil")
    except ImportError as error:
        raise MissingDependencyError("psutil", "Checking columns in several processes") from error


def cores() -> int:
    """How many processes this one may keep busy: its share of the machine, as a container or a queue gives it."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def memory_per_worker(processes: int) -> int:
    """An even share of the memory that this machine or its container has, bytes."""
    limits = [int(load_psutil().virtual_memory().total)]
    for path in _LIMITS_OF_CONTAINERS:
        with suppress(OSError, ValueError):
            limits.append(int(Path(path).read_text(encoding="ascii")))
    return min(limit for limit in limits if limit > 0) // (processes + 1)
