"""Files that are either whole or not there: a reader never meets half a report or half a scan."""

from __future__ import annotations

import contextlib
import os
import uuid
from collections.abc import Iterable
from pathlib import Path

from aadm_workbench.errors import AadmError


def write_atomically(path: Path, content: bytes | Iterable[bytes]) -> None:
    """Write a file aside, flush it to the disk, then put it in place of what was there.

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
    aside = path.with_name(f".{path.name}.{uuid.uuid4().hex}.part")
    try:
        with aside.open("xb") as stream:
            stream.writelines((content,) if isinstance(content, bytes) else content)
            stream.flush()
            os.fsync(stream.fileno())
        aside.replace(path)
        _flush_folder(path.parent)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        message = f"{path}: cannot be written ({reason}); check that its folder exists, is writable and has room"
        raise AadmError(message) from error
    finally:
        # Gone already where all went well.
        with contextlib.suppress(OSError):
            aside.unlink(missing_ok=True)


def _flush_folder(folder: Path) -> None:
    """Make the rename itself survive a power cut, where the system can (Windows cannot open a folder)."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        # Some network file systems refuse to flush a folder; the file itself is already on the disk.
        with contextlib.suppress(OSError):
            os.fsync(descriptor)
    finally:
        os.close(descriptor)
