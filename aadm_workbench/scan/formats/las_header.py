"""The header of a LAS or LAZ file: how many points, how long their records are, scales and offsets, what else it says.

Offsets of the fields: ASPRS, LAS specification 1.4, tables 3, 5 and 8.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from aadm_workbench.model import Array, Reason
from aadm_workbench.scan.file import ScanFile

Records: TypeAlias = "npt.NDArray[np.uint8]"
"""Points as they stand in a file, (n, bytes of one)."""

MOST_VARIABLE_RECORDS = 1000
"""Files have a handful: a coordinate system, what the program adds."""

_SIGNATURE = b"LASF"
_SHORTEST_HEADER_BYTES = 227  # of versions 1.0 to 1.2 (ASPRS LAS)
_SHORTEST_HEADER_OF_14_BYTES = 375  # of version 1.4 (ASPRS LAS)
_COMPRESSED = 0xC0
"""LASzip sets one of the two highest bits of the point format."""

_RECORD_BYTES = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
"""Shortest record of each point format, 0 to 10."""


@dataclass(frozen=True)
class VariableRecord:
    """One variable length record: who wrote it, which it is, its bytes."""

    user: str
    number: int
    content: bytes


@dataclass(frozen=True, eq=False)
class LasHeader:
    """What the header says.

    Parameters
    ----------
    point_format
        0 to 10.
    compressed
        Whether the points are packed by LASzip.
    start
        Byte offset of the points.
    record_bytes
        Length of one point, unpacked.
    count
        Points of the file.
    scales, offsets
        (3,) float64, unit of the file: a coordinate is its integer times scale plus offset.
    records
        The variable length records before the points.
    """

    point_format: int
    compressed: bool
    start: int
    record_bytes: int
    count: int
    scales: Array
    offsets: Array
    records: tuple[VariableRecord, ...]


def parse_header(file: ScanFile) -> LasHeader:
    """Read the header of a LAS file, version 1.0 to 1.4.

    Raises
    ------
    ScanError
        For a header that is cut off or contradicts itself.
    """
    content = file.content
    if not content.startswith(_SIGNATURE):
        raise file.wrong(Reason("formats.no_las"))
    if len(content) < _SHORTEST_HEADER_BYTES:
        raise file.wrong(Reason("formats.ends_in_header", size_bytes=len(content)))
    major, minor = content[24], content[25]
    header_bytes, start, record_count = struct.unpack_from("<HII", content, 94)
    format_byte, record_bytes, count = struct.unpack_from("<BHI", content, 104)
    numbers = np.frombuffer(content, "<f8", 6, 131).astype(np.float64)
    if major != 1 or minor > 4:
        raise file.wrong(Reason("formats.las_version", major=major, minor=minor))
    if minor == 4:
        if min(header_bytes, len(content)) < _SHORTEST_HEADER_OF_14_BYTES:
            raise file.wrong(Reason("formats.las_header", header_bytes=header_bytes))
        count = struct.unpack_from("<Q", content, 247)[0] or count
    point_format = format_byte & ~_COMPRESSED
    if point_format >= len(_RECORD_BYTES) or record_bytes < _RECORD_BYTES[point_format]:
        raise file.wrong(Reason("formats.las_record", point_format=point_format, record_bytes=record_bytes))
    if not header_bytes <= start <= len(content):
        raise file.wrong(Reason("formats.las_start", start=start, size_bytes=len(content)))
    if not np.isfinite(numbers).all() or not numbers[:3].all():
        raise file.wrong(Reason("formats.las_scales", numbers=numbers.tolist()))
    records = _variable_records(file, header_bytes, start, record_count)
    compressed = bool(format_byte & _COMPRESSED)
    return LasHeader(point_format, compressed, start, record_bytes, count, numbers[:3], numbers[3:], records)


def _variable_records(file: ScanFile, position: int, end: int, count: int) -> tuple[VariableRecord, ...]:
    if count > MOST_VARIABLE_RECORDS:
        raise file.wrong(Reason("formats.las_records", count=count))
    records = []
    for number in range(count):
        if position + 54 > end:
            raise file.wrong(Reason("formats.las_overrun", number=number, count=count))
        user, record_id, length = struct.unpack_from("<2x16sHH", file.content, position)
        position += 54
        content = file.content[position : min(position + length, end)]
        records.append(VariableRecord(user.partition(b"\0")[0].decode("latin-1"), record_id, content))
        position += length
    return tuple(records)
