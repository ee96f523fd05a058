"""Files from others, read within bounds: not a byte, an entry or a level more than such a file can sensibly have.

Bounds hold for what a file declares and for what it turns out to be. What is beyond them raises :class:`BoundsError`,
whose text says what is wrong with the file; who reads it adds its name and what to do.
"""

from __future__ import annotations

import ast
import os
import re
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO
from xml.parsers import expat

from aadm_workbench.model import Reason
from aadm_workbench.model.reason import as_said_by

_DEFLATED_OR_STORED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_ENCRYPTED = 0x1  # bit 0 of the flags of an entry (APPNOTE 4.4.4)
_SMALL_BYTES = 2**26
"""What unpacks to no more than this may pack as well as it likes: an empty drawing does."""

_END = struct.Struct("<4s4H2LH")
_END_MARK, _LARGE_MARK = re.compile(b"PK\x05\x06"), b"PK\x06\x07"
_LARGE_LOCATOR_BYTES = 20  # of the locator of ZIP64 (APPNOTE 4.3.15)
_LONGEST_COMMENT_BYTES = 2**16  # its length is written in two bytes
_ENTRY_BYTES = 2**9
"""What an entry may take in the list of an archive: its name, and some extra fields."""

_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    EOFError,
    NotImplementedError,
    OverflowError,
    RuntimeError,
    ValueError,
)
"""What the standard library raises for archives that are damaged, on purpose too."""


class BoundsError(Exception):
    """A file is more, or other, than such a file can be: too large, too deep, a pipe, damaged."""


@dataclass(frozen=True)
class ArchiveBounds:
    """The most that an archive may hold: entries, bytes of one and of all of them unpacked, times its own size.

    ``kind`` is what the archive is, for messages: "BCF file".
    """

    kind: str
    entries: int
    entry_bytes: int
    all_bytes: int
    ratio: int = 200


def open_bounded(path: Path, most_bytes: int) -> IO[bytes]:
    """A file that is one, open; a pipe or a device is neither read nor waited for. Links are followed.

    Raises
    ------
    BoundsError
        For what is no file, or a larger one.
    OSError
        Where it is not there or cannot be opened.
    """
    # Looked at before it is opened, for opening a device may already do something; and again, for it may be another.
    _check_file(path.stat(), most_bytes)
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    stream = os.fdopen(descriptor, "rb")
    try:
        _check_file(os.fstat(descriptor), most_bytes)
    except BaseException:
        stream.close()
        raise
    return stream


def read_bounded(path: Path, most_bytes: int) -> bytes:
    """All bytes of a file; errors as :func:`open_bounded`."""
    with open_bounded(path, most_bytes) as stream:
        content = stream.read(most_bytes + 1)
    if len(content) > most_bytes:
        raise BoundsError(Reason("bounded.grew", most_bytes=most_bytes))
    return content


def _check_file(status: os.stat_result, most_bytes: int) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise BoundsError(Reason("bounded.folder"))
    if not stat.S_ISREG(status.st_mode):
        raise BoundsError(Reason("bounded.device"))
    if status.st_size > most_bytes:
        raise BoundsError(Reason("bounded.large", size_bytes=status.st_size, most_bytes=most_bytes))


@contextmanager
def opened_archive(path: Path, bounds: ArchiveBounds) -> Iterator[zipfile.ZipFile]:
    """A zip archive whose list of entries was looked at before anything in it is unpacked.

    Raises
    ------
    BoundsError
        For an archive beyond the bounds, damaged, encrypted, packed in another way than by deflate, or with an entry
        that leads out of it; also while its entries are read.
    OSError
        Where it is not there or cannot be opened.
    """
    with open_bounded(path, bounds.all_bytes) as stream:
        try:
            _check_list(stream, bounds)
            with zipfile.ZipFile(stream) as archive:
                _check_entries(archive.infolist(), os.fstat(stream.fileno()).st_size, bounds)
                yield archive
        except _DAMAGED as error:
            raise BoundsError(Reason("bounded.no_zip", kind=bounds.kind, why=error)) from error


def entry_bytes(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """An entry, unpacked to no more than it declares."""
    with archive.open(entry) as stream:
        content = stream.read(entry.file_size + 1)
    if len(content) != entry.file_size:
        raise BoundsError(Reason("bounded.entry_length", name=repr(entry.filename)))
    return content


def _check_list(stream: IO[bytes], bounds: ArchiveBounds) -> None:
    """Bound the list of entries before it is read: forty-six bytes of it become a kilobyte in memory."""
    size = stream.seek(0, os.SEEK_END)
    begin = max(0, size - _LONGEST_COMMENT_BYTES - _END.size - _LARGE_LOCATOR_BYTES)
    stream.seek(begin)
    tail = stream.read(size - begin)
    # Readers differ in which of several ends they believe: each must keep the bound.
    for found in re.finditer(_END_MARK, tail):
        record = tail[found.start() : found.start() + _END.size]
        list_bytes = _END.unpack(record)[5] if len(record) == _END.size else 0
        is_large = tail[max(0, found.start() - _LARGE_LOCATOR_BYTES) :].startswith(_LARGE_MARK)
        if is_large or list_bytes > bounds.entries * _ENTRY_BYTES:
            raise BoundsError(Reason("bounded.lists_many", kind=bounds.kind, most=bounds.entries))
    stream.seek(0)


def _check_entries(entries: list[zipfile.ZipInfo], packed_bytes: int, bounds: ArchiveBounds) -> None:
    if len(entries) > bounds.entries:
        raise BoundsError(Reason("bounded.many", count=len(entries), kind=bounds.kind, most=bounds.entries))
    for entry in entries:
        _check_entry(entry, bounds)
    unpacked = sum(entry.file_size for entry in entries)
    if unpacked > bounds.all_bytes or (unpacked > _SMALL_BYTES and unpacked > bounds.ratio * packed_bytes):
        raise BoundsError(
            Reason("bounded.unpacks", packed_bytes=packed_bytes, unpacked_bytes=unpacked, kind=bounds.kind)
        )


def _check_entry(entry: zipfile.ZipInfo, bounds: ArchiveBounds) -> None:
    name = entry.filename.replace("\\", "/")
    if not name:
        raise BoundsError(Reason("bounded.no_name"))
    if name.startswith("/") or ":" in name or ".." in name.split("/"):
        raise BoundsError(Reason("bounded.leads_out", name=repr(entry.filename)))
    if entry.flag_bits & _ENCRYPTED:
        raise BoundsError(Reason("bounded.encrypted", name=repr(entry.filename)))
    if entry.compress_type not in _DEFLATED_OR_STORED:
        raise BoundsError(Reason("bounded.packs", name=repr(entry.filename), kind=bounds.kind))
    if entry.file_size > bounds.entry_bytes:
        raise BoundsError(
            Reason(
                "bounded.entry_large",
                name=repr(entry.filename),
                size_bytes=entry.file_size,
                most_bytes=bounds.entry_bytes,
            )
        )


def check_xml(content: bytes, *, deepest: int, most_elements: int) -> None:
    """Walk through XML without keeping any of it.

    Raises
    ------
    BoundsError
        For what is no XML, declares a type or entities of its own, or has more levels or elements.
    """
    walk = _Walk(deepest, most_elements)
    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = walk.declares
    parser.StartElementHandler = walk.begins
    parser.EndElementHandler = walk.ends
    try:
        parser.Parse(content, True)
    except (expat.ExpatError, LookupError, ValueError) as error:
        raise BoundsError(Reason("bounded.no_xml", why=error)) from error


class _Walk:
    """Counts levels and elements."""

    def __init__(self, deepest: int, most_elements: int) -> None:
        self._deepest, self._most = deepest, most_elements
        self._depth = self._elements = 0

    def declares(self, *_: object) -> None:
        raise BoundsError(Reason("bounded.doctype"))

    def begins(self, *_: object) -> None:
        self._depth += 1
        self._elements += 1
        if self._depth > self._deepest or self._elements > self._most:
            raise BoundsError(Reason("bounded.xml_deep", deepest=self._deepest, most=self._most))

    def ends(self, *_: object) -> None:
        self._depth -= 1


def toml_fault(error: Exception | str) -> Reason:
    """What :mod:`tomllib` has against a text, in both languages; what else was raised is quoted.

    Keys of several parts are named as they are written: ``a.b``, not as a tuple.
    """
    keys = r"\((?:'[^']*',? ?)+\)"
    return as_said_by("bounded.toml", re.sub(keys, lambda found: ".".join(ast.literal_eval(found[0])), str(error)))
