"""LASzip, the compression of LAZ files, through the library of that name in Rust.

That library ends the whole process where it is asked for more memory than there is, so what a file announces is
compared with its size before.
"""

from __future__ import annotations

import io
import math
import struct
from collections.abc import Iterator, Sequence
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np

from aadm_workbench.errors import needed
from aadm_workbench.model import Reason
from aadm_workbench.scan.file import ScanFile
from aadm_workbench.scan.formats.las_header import LasHeader, Records

_UNPACKED_BYTES_AT_A_TIME = 2**24  # bounds the memory, not the time
_RECORD_NUMBER = 22204  # of the record that says how points are packed (LASzip)
_SHORTEST_RECORD_BYTES = 34  # its fixed part (LASzip)
_ITEM_BYTES = {6: 20, 7: 8, 8: 6, 9: 29, 10: 30, 11: 6, 12: 8, 13: 29}
"""Size of each kind of item of a record; kinds 0 and 14 are extra bytes of any number."""

_LAYERS = {10: 9, 11: 1, 12: 2, 13: 1}
"""Layers of each kind of item in a layered chunk; extra bytes have one each."""

# kinds of items of no fixed size: extra bytes of a point, plain and by layers (LASzip)
_PLAIN_BYTES, _LAYERED_BYTES = 0, 14
_OF_ANY_LENGTH = 2**32 - 1
"""Where each chunk has its own number of points."""

_POINT_WISE, _CHUNKED, _LAYERED = 1, 2, 3  # kinds of compressors: of point formats below 6, and from 6 on (LASzip)
_COORDINATES = {_POINT_WISE: 6, _CHUNKED: 6, _LAYERED: 10}
"""With which kind of item records begin."""


def _lazrs() -> ModuleType:
    with needed("lazrs", "a compressed LAZ file"):
        return import_module("lazrs")


def unpacked_records(file: ScanFile, header: LasHeader) -> Iterator[Records]:
    """Yield the records (n, bytes) uint8 of a LAZ file, some at a time.

    Raises
    ------
    ScanError
        Where it does not unpack to what its header announces.
    MissingDependencyError
        Where the LASzip library is not installed.
    """
    packing = _packing(file, header)
    lazrs = _lazrs()
    stream = io.BytesIO(file.content)
    stream.seek(header.start)
    at_a_time = max(1, _UNPACKED_BYTES_AT_A_TIME // header.record_bytes)
    decompressor, done = None, 0
    while done < header.count:
        count = min(at_a_time, header.count - done)
        buffer = bytearray(count * header.record_bytes)
        try:
            decompressor = decompressor or lazrs.LasZipDecompressor(stream, packing)
            decompressor.decompress_many(buffer)
        except BaseException as error:
            if not _is_of_lazrs(error):
                raise
            raise file.wrong(
                Reason("formats.laz_unpack", first=done, last=done + count, count=header.count, why=_first_line(error))
            ) from error
        yield np.frombuffer(buffer, np.uint8).reshape(count, header.record_bytes)
        done += count


def _is_of_lazrs(error: BaseException) -> bool:
    """Whether an error comes from the library; where it panics, that is no ``Exception``."""
    return isinstance(error, OSError | RuntimeError | ValueError) or type(error).__name__ in (
        "LazrsError",
        "PanicException",
    )


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0][:120]


def _packing(file: ScanFile, header: LasHeader) -> bytes:
    """Return the record that says how the points are packed, once it is certain that it fits them."""
    found = [record.content for record in header.records if record.number == _RECORD_NUMBER]
    if not found or len(found[0]) < _SHORTEST_RECORD_BYTES:
        raise file.wrong(Reason("formats.laz_unsaid"))
    content = found[0]
    compressor, chunk_points, item_count = (
        struct.unpack_from(kind, content, at)[0] for kind, at in (("<H", 0), ("<I", 12), ("<H", 32))
    )
    items = list(_items(content, item_count))
    fits = (
        0 < len(items) == item_count
        and items[0][0] == _COORDINATES.get(compressor)
        and all((kind in _LAYERS or kind == _LAYERED_BYTES) == (compressor == _LAYERED) for kind, _ in items)
        and all(kind in (_PLAIN_BYTES, _LAYERED_BYTES) or _ITEM_BYTES.get(kind) == size for kind, size in items)
        and sum(size for _, size in items) == header.record_bytes
    )
    if not fits or (chunk_points == 0 and compressor != _POINT_WISE):
        raise file.wrong(Reason("formats.laz_unfit"))
    if compressor == _POINT_WISE:
        # The first kind of LAZ: one stream of points, without chunks.
        return content
    table, chunks = _table_of_chunks(file, header)
    needed = chunks if chunk_points == _OF_ANY_LENGTH else math.ceil(header.count / chunk_points)
    if chunks < needed:
        raise file.wrong(Reason("formats.laz_chunks", chunks=chunks, needed=needed))
    if compressor == _LAYERED:
        _check_layers(file, header, items, table, needed)
    return content


def _items(content: bytes, count: int) -> Iterator[tuple[int, int]]:
    for at in range(34, min(34 + 6 * count, len(content) - 5), 6):
        kind, size = struct.unpack_from("<HH", content, at)
        yield kind, size


def _table_of_chunks(file: ScanFile, header: LasHeader) -> tuple[int, int]:
    """Return where the table of chunks stands and how many it announces: each holds at least one whole record."""
    content = file.content
    room = len(content) - header.start
    table: Any = struct.unpack_from("<q", content, header.start)[0] if room >= 8 else 0
    if table == -1:
        table = struct.unpack_from("<q", content, len(content) - 8)[0]
    if not header.start + 8 <= table <= len(content) - 8:
        raise file.wrong(Reason("formats.laz_table", table=table, size_bytes=len(content)))
    version, chunks = struct.unpack_from("<II", content, table)
    if version != 0:
        raise file.wrong(Reason("formats.laz_table_version", table=table, version=version))
    # Some writers close with a chunk that is empty.
    if chunks - 1 > header.count or (chunks - 1) * header.record_bytes > room:
        raise file.wrong(Reason("formats.laz_too_many", chunks=chunks))
    return table, chunks


def _check_layers(file: ScanFile, header: LasHeader, items: Sequence[tuple[int, int]], table: int, chunks: int) -> None:
    """Check that the layers of each chunk, whose sizes stand before them, are in the file."""
    layers = sum(_LAYERS.get(kind, size) for kind, size in items)
    position = header.start + 8
    for chunk in range(chunks):
        # A chunk begins with a whole record, the number of its points, and the sizes of its layers.
        sizes_at = position + header.record_bytes + 4
        end = sizes_at + 4 * layers
        if end <= table:
            end += int(np.frombuffer(file.content, "<u4", layers, sizes_at).sum(dtype=np.int64))
        if end > table:
            # A chunk that is empty may close the file.
            if chunk == chunks - 1 and position == table:
                return
            raise file.wrong(Reason("formats.laz_chunk", chunk=chunk + 1, chunks=chunks, position=position))
        position = end
