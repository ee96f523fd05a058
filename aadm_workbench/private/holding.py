"""Locks that end with their process: who makes environments, and who uses one."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import IO


class InUseError(OSError):
    """Another process holds it."""


def hold(path: Path, *, alone: bool) -> IO[bytes]:
    """Hold a lock file until what is returned is closed; on Windows all holders are alone.

    Raises
    ------
    InUseError
        Where others hold it.
    """
    held = path.open("ab")
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(held.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(held, (fcntl.LOCK_EX if alone else fcntl.LOCK_SH) | fcntl.LOCK_NB)
    except OSError as error:
        held.close()
        raise InUseError(str(path)) from error
    return held
