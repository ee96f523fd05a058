"""LAS and LAZ, the binary format of laser scanners: integers with scale and offset, plain or packed by LASzip."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from aadm_workbench.model import Array, BoolArray, Reason
from aadm_workbench.scan.file import LARGEST_POINT_COUNT, Cloud, Declared, ScanFile
from aadm_workbench.scan.formats.las_header import LasHeader, Records, parse_header
from aadm_workbench.scan.formats.las_unit import unit_of
from aadm_workbench.scan.formats.laz import unpacked_records
from aadm_workbench.scan.formats.records import check_room

_POINTS_AT_A_TIME = 2**18  # some 8 MB of records: bounds the memory, not the time
_FLAGS_AT = 15  # byte of a record (ASPRS LAS 1.4, tables 7 to 16)
_FIRST_FORMAT_WITH_MORE_FLAGS = 6  # from point format 6 on the flags have a byte of their own


def read_las(file: ScanFile, declared: Declared) -> Cloud:
    """Read the points of a LAS or LAZ file as float64, in the unit of its coordinate system where it names one.

    Points that are flagged as withheld are deleted ones: they are left out and counted.

    Raises
    ------
    ScanError
        For a header that contradicts itself, fewer points than announced, a packed body that does not unpack, and
        coordinates in degrees.
    MissingDependencyError
        For a LAZ file without the LASzip library.
    """
    header = parse_header(file)
    unit = unit_of(file, header.records)
    if header.count > LARGEST_POINT_COUNT:
        raise file.wrong(Reason("formats.las_count", count=header.count))
    if not header.compressed or header.count == 0:
        check_room(file, header.start, header.count, header.record_bytes, len(file.content) - header.start)
    points, withheld = [], 0
    for records in unpacked_records(file, header) if header.compressed else _plain_records(file, header):
        kept = ~_withheld(records, header.point_format)
        withheld += len(kept) - int(np.count_nonzero(kept))
        points.append(_coordinates(records[kept], header))
    mm_per_unit, unit_from = (declared.mm_per_unit, "") if unit is None else unit
    return Cloud(np.concatenate(points), mm_per_unit, unit_from=unit_from, dropped=withheld)


def _plain_records(file: ScanFile, header: LasHeader) -> Iterator[Records]:
    """Yield the records (n, bytes) uint8 of a plain file, some at a time."""
    for first in range(0, header.count, _POINTS_AT_A_TIME):
        count = min(_POINTS_AT_A_TIME, header.count - first)
        start = header.start + first * header.record_bytes
        flat = np.frombuffer(file.content, np.uint8, count * header.record_bytes, start)
        yield flat.reshape(count, header.record_bytes)


def _withheld(records: Records, point_format: int) -> BoolArray:
    mask = 0x80 if point_format < _FIRST_FORMAT_WITH_MORE_FLAGS else 0x04
    return np.asarray((records[:, _FLAGS_AT] & mask) != 0)


def _coordinates(records: Records, header: LasHeader) -> Array:
    """Return (n, 3) float64 of records (n, bytes), whose first twelve bytes are x, y and z."""
    whole = np.ascontiguousarray(records[:, :12]).view("<i4")
    return np.asarray(whole * header.scales + header.offsets)
