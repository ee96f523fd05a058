"""Files that are either whole or not there: a reader never meets half a report or half a scan."""

from __future__ import annotations

import contextlib
import os
import uuid
from collections.abc import Iterable
from pathlib import Path

from aadm_workbench.errors import AadmError
from aadm_workbench.own_files import looked_up

_NEW = ("O_CREAT", "O_EXCL", "O_WRONLY", "O_NOFOLLOW", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT")


def write_atomically(path: Path, content: bytes | Iterable[bytes]) -> None:
    """Write a file aside, flush it to the disk, then put it in place of what was there; a link is replaced, too.

    Parameters
    ----------
    path
        The file. Its folder must exist; the aside file stands in the same folder, for a rename is
        atomic only within one file system.
    content
        All bytes of the file, at once or in parts.

    Raises
    ------
    AadmError
        Where the folder is missing, read-only or full. What stood at ``path`` before is untouched.
    """
    path = Path(path)
    try:
        with looked_up(path) as (name, folder):
            _write(name, folder, content)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise AadmError.about(path, "bounded.unwritten", why=reason) from error


def _write(name: str | Path, folder: int | None, content: bytes | Iterable[bytes]) -> None:
    place = Path(name)
    aside = place.with_name(f".{place.name}.{uuid.uuid4().hex}.part")
    descriptor = os.open(aside, sum(getattr(os, flag, 0) for flag in _NEW), 0o666, dir_fd=folder)
    try:
        with open(descriptor, "wb") as stream:  # noqa: PTH123 - of a descriptor
            stream.writelines((content,) if isinstance(content, bytes) else content)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(aside, place, src_dir_fd=folder, dst_dir_fd=folder)
        # Some network file systems refuse to flush a folder; the file itself is already on the disk.
        if folder is not None:
            with contextlib.suppress(OSError):
                os.fsync(folder)
    finally:
        # Gone already where all went well.
        with contextlib.suppress(OSError):
            os.unlink(aside, dir_fd=folder)
