"""Files in a folder that others may have prepared: opened only where they are files, and never through a link.

A folder of results may have come with the job, or be shared. A link in it is replaced, never followed; so is a file
that has a second name elsewhere (a hard link); a pipe, a device or a folder under the name of a file is refused without
being opened. Where the system can (Linux, macOS), names are looked up in the folder that was opened first, so that
nobody can put another in its place meanwhile.

What is written is either whole or not there: a reader never meets half a report or half a scan.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import stat
import uuid
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from aadm_workbench.errors import AadmError

_TRIES = 5
"""So often is looked again where somebody else creates or replaces the file at the same moment."""

_FLAGS = ("O_NOFOLLOW", "O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY", "O_NOINHERIT")
_ALWAYS = sum(getattr(os, name, 0) for name in _FLAGS)  # of systems that have them
_KNOWS_FOLDERS = os.open in os.supports_dir_fd and hasattr(os, "O_DIRECTORY")
ASIDE_FOLDER = ".aadm-freecad-"
"""So begin the names of folders in which another program writes what is put in its place afterwards."""

_ASIDE = re.compile(r"\..+\.[0-9a-f]{32}\.part", re.DOTALL)
_held: dict[Path, int] = {}


class UnsafeFileError(OSError):
    """What stands under the name of a file is none; ``strerror`` says what it is and what to do."""


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Keep a folder open: while this lasts, its files are those of this very folder, whatever its name leads to.

    Raises
    ------
    OSError
        Where there is no such folder.
    """
    if not _KNOWS_FOLDERS or folder in _held:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    _held[folder] = descriptor
    try:
        yield
    finally:
        del _held[folder]
        os.close(descriptor)


@contextmanager
def looked_up(path: Path) -> Iterator[tuple[str | Path, int | None]]:
    """A file's name and the open folder that it is to be looked up in; the whole path and None on Windows.

    Raises
    ------
    OSError
        Where there is no such folder.
    """
    if not _KNOWS_FOLDERS:
        yield path, None
    elif path.parent in _held:
        yield path.name, _held[path.parent]
    else:
        descriptor = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            yield path.name, descriptor
        finally:
            os.close(descriptor)


def open_to_write(path: Path, flags: int = os.O_RDWR) -> int:
    """Descriptor of a file to be written, made where it is not there; nothing of what it holds is cut off.

    Raises
    ------
    UnsafeFileError
        For what is no file.
    OSError
        Where it cannot be opened.
    """
    with looked_up(path) as (name, folder):
        for _ in range(_TRIES):
            with suppress(FileExistsError, FileNotFoundError):
                if _status(path, name, folder, replace=True) is None:
                    return os.open(name, flags | os.O_CREAT | os.O_EXCL | _ALWAYS, 0o666, dir_fd=folder)
                return _with_one_name(_opened(path, name, folder, flags))
    raise _unsafe(path, "bounded.own_replaced_again")


def open_to_read(path: Path) -> int:
    """Descriptor of a file in such a folder, to be read.

    Raises
    ------
    UnsafeFileError
        For what is no file.
    OSError
        Where it is not there, or cannot be opened.
    """
    with looked_up(path) as (name, folder):
        if _status(path, name, folder, replace=False) is None:
            raise FileNotFoundError(2, "No such file or directory", str(path))
        return _opened(path, name, folder, os.O_RDONLY)


def create(path: Path) -> int:
    """Descriptor of a file that nothing had the name of, to be read and written by this user alone.

    Raises
    ------
    OSError
        Where something is there already, or it cannot be made.
    """
    with looked_up(path) as (name, folder):
        return os.open(name, os.O_RDWR | os.O_CREAT | os.O_EXCL | _ALWAYS, 0o600, dir_fd=folder)


def is_there(path: Path) -> bool:
    """Whether there is a file that can be read; a link, a pipe, a device or a folder is none."""
    try:
        status = os.lstat(path)
    except (OSError, ValueError):
        return False
    return stat.S_ISREG(status.st_mode)


def clear_asides(folder: Path) -> None:
    """Remove what killed runs were writing aside; nobody else may be writing there. No link is followed."""
    names: list[str] = []
    with suppress(OSError), os.scandir(_held.get(folder, folder)) as entries:
        names = [entry.name for entry in entries]
    for name in names:
        if _ASIDE.fullmatch(name):
            with suppress(OSError), looked_up(folder / name) as (place, opened):
                os.unlink(place, dir_fd=opened)
        elif name.startswith(ASIDE_FOLDER):
            remove(folder / name)


def remove(path: Path) -> None:
    """Remove a folder and what is in it, or whatever stands for it; no link is followed and no pipe opened."""
    with suppress(OSError):
        if stat.S_ISDIR(path.lstat().st_mode):
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink()


def _status(path: Path, name: str | Path, folder: int | None, *, replace: bool) -> os.stat_result | None:
    """What stands there, a file; None where nothing does, or what is not to be written through was removed."""
    try:
        status = os.stat(name, dir_fd=folder, follow_symlinks=False)
    except FileNotFoundError:
        return None
    if replace and (_is_link(status) or (stat.S_ISREG(status.st_mode) and status.st_nlink > 1)):
        os.unlink(name, dir_fd=folder)
        return None
    _check(path, status)
    return status


def _opened(path: Path, name: str | Path, folder: int | None, flags: int) -> int:
    """Open what was looked at; what was put there since is closed again, unread and unwritten."""
    descriptor = os.open(name, flags | _ALWAYS, dir_fd=folder)
    try:
        opened, now = os.fstat(descriptor), os.stat(name, dir_fd=folder, follow_symlinks=False)
        _check(path, opened)
        if not os.path.samestat(opened, now):
            raise _unsafe(path, "bounded.own_replaced")
    except BaseException:
        os.close(descriptor)
        raise
    return descriptor


def _with_one_name(descriptor: int) -> int:
    """The same descriptor; FileExistsError where its file got a second name while it was opened."""
    if os.fstat(descriptor).st_nlink > 1:
        os.close(descriptor)
        raise FileExistsError
    return descriptor


def _is_link(status: os.stat_result) -> bool:
    # Windows has other things than symbolic links that lead elsewhere (junctions).
    return stat.S_ISLNK(status.st_mode) or bool(getattr(status, "st_reparse_tag", 0))


def _check(path: Path, status: os.stat_result) -> None:
    if _is_link(status):
        raise _unsafe(path, "bounded.own_link")
    if not stat.S_ISREG(status.st_mode):
        raise _unsafe(path, "bounded.own_no_file", kind=_named(status.st_mode))


def _unsafe(path: Path, code: str, **values: object) -> UnsafeFileError:
    from aadm_workbench.model.reason import Reason  # not before it is needed: it loads numpy

    return UnsafeFileError(0, Reason(code, **values), str(path))


def _named(mode: int) -> str:
    kinds = {stat.S_ISDIR: "a folder", stat.S_ISFIFO: "a pipe", stat.S_ISSOCK: "a socket"}
    return next((name for is_kind, name in kinds.items() if is_kind(mode)), "a device")


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
