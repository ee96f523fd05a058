"""What a column is checked from: its files by content, and the hash of everything that its result follows from."""

from __future__ import annotations

import hashlib
import platform
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from itertools import islice
from pathlib import Path

import aadm_workbench
from aadm_workbench.inspection.tasks import ColumnTask, tool_entry
from aadm_workbench.model import Reason
from aadm_workbench.scan.file import LARGEST_FILE_BYTES

from ..runner.exact_json import to_exact_json

_CODE = (".py", ".toml", ".json")


@cache
def program_versions() -> dict[str, str]:
    """Everything that may change a number: versions, and a hash of the program's own files.

    The hash tells apart two states of a working tree that call themselves by one version.
    """
    python = ".".join(platform.python_version_tuple()[:2])
    return {**tool_entry(), "python": python, "code": _code_hash()}


def program_key() -> str:
    """Hash of :func:`program_versions`: with another one a result has to be calculated again."""
    return hashlib.sha256(to_exact_json(program_versions()).encode()).hexdigest()


def difference(ours: dict[str, str], theirs: dict[str, str]) -> str:
    """What two installations have in different versions, in words; empty where nothing."""
    names = [name for name in {**ours, **theirs} if ours.get(name) != theirs.get(name) and name != "code"]
    said = [f"{name} {theirs.get(name, 'missing')} instead of {ours.get(name, 'none')}" for name in names]
    if not said and ours != theirs:
        return Reason("run.other_code")
    return ", ".join(re.sub(r"^version ", "aadm ", text) for text in said)


def _code_hash() -> str:
    found = hashlib.sha256()
    for folder in (Path(aadm_workbench.__file__).parent, Path(__file__).parent):
        for path in sorted(path for path in folder.rglob("*") if path.suffix in _CODE):
            content = path.read_bytes()
            found.update(f"{path.relative_to(folder).as_posix()} {len(content)}\n".encode())
            found.update(content)
    return found.hexdigest()[:16]


_CHUNK_BYTES = 1 << 20  # bounds the memory, not the time
_TICK_NS = 2_500_000_000  # FAT counts in two seconds; no other file system counts more coarsely
_LOOKS_DIGITS = 32  # 128 bits: no two alike by chance


def order_key(task: ColumnTask, program: str, shared: dict[int, str] | None = None) -> str:
    """Hash of what a column's report follows from but for its files: program, settings, profile, design, camera.

    Where the job lies is not in it, so a job may be moved. ``shared`` gets what all tasks of a job share, by its
    identity, and is to be let go of with them.
    """
    said = (
        # Its own design is the task's already.
        replace(task.column, design=None),
        task.design,
        task.units,
        task.depth_scale_mm,
        task.no_design,
        task.others,
        task.learned_notes,
    )
    known = {} if shared is None else shared
    parts = [program, to_exact_json(said)]
    for part in (task.settings, task.camera, task.learned):
        if id(part) not in known:
            known[id(part)] = to_exact_json(part)
        parts.append(known[id(part)])
    return hashlib.sha256("\n".join([*parts, ""]).encode(errors="surrogatepass")).hexdigest()


def task_key(task: ColumnTask, order: str) -> str:
    """Hash of all that a column's report follows from: its :func:`order_key`, and the bytes of its files.

    Where the files lie is not in it; a file that cannot be read counts as what it is.
    """
    found = hashlib.sha256(f"{order}\n".encode())
    for name in task.column.files():
        found.update(f"{content_hash(task.path_of(name))}\n".encode())
    return found.hexdigest()


@dataclass(frozen=True)
class Looks:
    """What the files of a column look like from outside: a hash, and when one of them was changed last, ns.

    ``hash`` is empty where a file is missing.
    """

    hash: str
    changed_ns: int = 0

    def tell_at(self, now_ns: int) -> bool:
        """Whether what looks the same later is the same: no file may be changed again within that tick of its clock."""
        return self.hash != "" and self.changed_ns < now_ns - _TICK_NS


def looks(task: ColumnTask, order: str) -> Looks:
    """The :func:`order_key` of a column, and name, place, size and both times of its files, without reading them.

    Where a file is written to, the system sets the second time (``ctime``), which no program can set back; only who
    sets the clock, or writes to the disk below its file system, can.
    """
    found = hashlib.sha256(f"{order}\n".encode())
    changed_ns = 0
    try:
        for name in task.column.files():
            for path, inside in _files_of(task.path_of(name)):
                status = path.stat()
                times = (status.st_mtime_ns, status.st_ctime_ns)
                changed_ns = max(changed_ns, *times)
                place = (status.st_dev, status.st_ino, status.st_size)
                found.update(f"{name}\n{inside}\n{place} {times}\n".encode(errors="surrogatepass"))
    except (OSError, ValueError):
        return Looks("")
    return Looks(found.hexdigest()[:_LOOKS_DIGITS], changed_ns)


def _files_of(path: Path) -> Iterable[tuple[Path, str]]:
    """A file, or the files of a folder, with their names in it."""
    return _inside(path) if path.is_dir() else ((path, ""),)


def content_hash(path: Path) -> str:
    """SHA-256 of a file's bytes, or of the files of a folder with their names; what is wrong with it otherwise."""
    found = hashlib.sha256()
    try:
        if path.is_dir():
            for inside, name in _inside(path):
                found.update(f"{name} {content_hash(inside)}\n".encode(errors="surrogatepass"))
            return f"folder {found.hexdigest()}"
        if not path.is_file() or path.stat().st_size > LARGEST_FILE_BYTES:
            return "no file to be read"
        with path.open("rb") as stream:
            while chunk := stream.read(_CHUNK_BYTES):
                found.update(chunk)
    except (OSError, ValueError) as error:
        return f"unreadable: {getattr(error, 'errno', '')}"
    return found.hexdigest()


@dataclass(frozen=True)
class ShippedFile:
    """One file on its way to a machine that does not see the disk, with the name that the job calls it by.

    ``inside`` is its own name where ``name`` is that of a capture's folder; empty where ``name`` is the file's.
    """

    name: str
    inside: str
    content: bytes


def read_for_shipping(task: ColumnTask) -> tuple[ShippedFile, ...]:
    """The files of a column by content; what cannot be read is left out, and its worker finds it missing."""
    shipped: list[ShippedFile] = []
    left_bytes = LARGEST_FILE_BYTES
    for name in task.column.files():
        path = task.path_of(name)
        try:
            for file, inside in _files_of(path):
                if file.is_file() and file.stat().st_size <= left_bytes:
                    shipped.append(ShippedFile(name, inside, file.read_bytes()))
                    left_bytes -= len(shipped[-1].content)
        except (OSError, ValueError):
            continue
    return tuple(shipped)


def unpack(files: tuple[ShippedFile, ...], folder: Path) -> dict[str, Path]:
    """Write shipped files into a folder; returns where each name lies now.

    Files are numbered there and keep only their extension: nothing in a job decides where is written.
    """
    places: dict[str, Path] = {}
    for file in files:
        place = places.setdefault(file.name, folder / f"{len(places)}{Path(file.name).suffix}")
        target = place / file.inside if file.inside else place
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(file.content)
    return places


def _inside(folder: Path) -> Iterator[tuple[Path, str]]:
    """The files of a folder with their names, in one order everywhere; none of a folder that is no capture.

    Folders in it are not looked into, as the reader of captures does not: a job may name the root of the disk.
    """
    from aadm_workbench.scan.capture import MOST_FILES

    found = list(islice(folder.iterdir(), MOST_FILES + 1))
    if len(found) <= MOST_FILES:
        yield from ((path, path.name) for path in sorted(found) if path.is_file())
