"""One run writes into a folder at a time; the system lets go of the lock when the process ends, however it ends."""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from aadm_workbench.errors import AadmError, JobError
from aadm_workbench.model import Reason
from aadm_workbench.own_files import UnsafeFileError, clear_asides, held, open_to_write

_NAME = ".aadm-lock"


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold a folder of results for this process alone; what a killed one left half written there is removed.

    Raises
    ------
    JobError
        Where another process holds it: said with its number, at once.
    AadmError
        Where nothing can be written into the folder.
    """
    with contextlib.ExitStack() as stack:
        try:
            stack.enter_context(held(folder))
            descriptor = open_to_write(folder / _NAME)
        except UnsafeFileError as error:
            raise AadmError.because("run.folder_link", file=folder / _NAME, why=error.strerror) from error
        except OSError as error:
            reason = error.strerror or type(error).__name__
            raise AadmError.because("run.folder_shut", folder=folder, why=reason) from error
        stack.callback(os.close, descriptor)
        if not _lock(descriptor) or not _is_in_place(folder / _NAME, descriptor):
            raise JobError.because("run.folder_held", folder=folder, holder=_holder(descriptor))
        # A full disk must not keep anybody from being told what is in the folder.
        with contextlib.suppress(OSError):
            os.ftruncate(descriptor, 0)
            os.lseek(descriptor, 0, os.SEEK_SET)
            os.write(descriptor, f"{os.getpid()} {socket.gethostname()}".encode())
        clear_asides(folder)
        # The file stays: a lock that is removed can be held twice.
        yield


def _is_in_place(path: Path, descriptor: int) -> bool:
    """Whether the lock is the one that others see: two that replace a link at once make two files."""
    try:
        return os.path.samestat(path.lstat(), os.fstat(descriptor))
    except OSError:
        return False


def _holder(descriptor: int) -> str:
    with contextlib.suppress(OSError, ValueError):
        os.lseek(descriptor, 0, os.SEEK_SET)
        number, _, machine = os.read(descriptor, 200).decode(errors="replace").partition(" ")
        return Reason("run.holder", number=int(number), machine=machine)
    return "another process"


def _lock(descriptor: int) -> bool:
    """Whether the lock was free; True as well where the file system knows no locks."""
    try:
        system: Any = import_module("fcntl")
    except ImportError:
        return _lock_on_windows(descriptor)
    try:
        system.flock(descriptor, system.LOCK_EX | system.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True


def _lock_on_windows(descriptor: int) -> bool:
    system: Any = import_module("msvcrt")
    try:
        # Far behind the text, which others may read.
        os.lseek(descriptor, 1 << 20, os.SEEK_SET)
        system.locking(descriptor, system.LK_NBLCK, 1)
    except OSError:
        return False
    return True
