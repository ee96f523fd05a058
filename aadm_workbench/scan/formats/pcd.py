"""Point cloud data (PCD) of versions 0.5 to 0.7, all three storages: coordinates, grid and pose of the sensor."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

import numpy as np

from aadm_workbench.errors import needed
from aadm_workbench.model import FloatArray, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile, narrowed
from aadm_workbench.scan.formats.pcd_header import Field, PcdHeader, parse_header
from aadm_workbench.scan.formats.records import check_room, coordinate_dtype, gather

_SIZES_BYTES = 8
"""Before a compressed body stand its length packed and its length unpacked, uint32 each."""

GREATEST_EXPANSION = 88
"""Three bytes, a longest back reference, unpack to 264: no honest stream announces more than 88 times its size."""


def read_pcd(file: ScanFile, declared: Declared) -> Cloud:
    """Read the points of a PCD file, as a grid where it has one.

    A VIEWPOINT at the origin of a cloud without a grid is what every writer puts where it does not know the sensor's
    pose: it is taken for unknown. That of a grid, and any other one, is believed.

    Raises
    ------
    ScanError
        For a header that contradicts itself, fields without x, y or z, fewer points than announced, and a compressed
        body that does not unpack.
    """
    header = parse_header(file)
    axes = _coordinate_fields(file, header)
    if header.storage == "ascii":
        points = _text_points(file, header, axes, declared.mm_per_unit)
    elif header.storage == "binary":
        check_room(file, header.size_bytes, header.count, header.step_bytes, len(file.content) - header.size_bytes)
        records = [(field.offset_bytes, field.dtype) for field in axes]
        points = gather(file.content, header.size_bytes, header.count, header.step_bytes, records)
    else:
        points = _compressed_points(file, header, axes)
    if header.organised:
        points = points.reshape(header.height, header.width, 3)
    is_known = header.organised or not np.array_equal(header.T_scan_file, np.eye(4))
    return Cloud(points, declared.mm_per_unit, header.T_scan_file if is_known else None)


def _coordinate_fields(file: ScanFile, header: PcdHeader) -> tuple[Field, ...]:
    by_name = {field.name.lower(): field for field in reversed(header.fields)}
    missing = [axis for axis in "xyz" if axis not in by_name or by_name[axis].count != 1]
    if missing:
        names = ", ".join(field.name for field in header.fields)
        raise file.wrong(Reason("points.pcd_fields", missing=missing, names=names[:80]))
    return tuple(by_name[axis] for axis in "xyz")


def _text_points(file: ScanFile, header: PcdHeader, axes: tuple[Field, ...], mm_per_unit: float) -> FloatArray:
    start = header.size_bytes
    # A value takes a digit and a separator; the last one may do without the separator.
    check_room(file, start, header.count, 2 * header.columns, len(file.content) - start + 1)
    columns = [field.column for field in axes]
    from aadm_workbench.scan.formats.rows import parse_rows  # as above

    points = parse_rows(file, file.content[start:], start, columns, count=header.count)
    return narrowed(points, coordinate_dtype([field.dtype for field in axes]), mm_per_unit)


def _compressed_points(file: ScanFile, header: PcdHeader, axes: tuple[Field, ...]) -> FloatArray:
    start = header.size_bytes
    body = file.content[start + _SIZES_BYTES :]
    if len(file.content) < start + _SIZES_BYTES:
        raise file.wrong(Reason("points.pcd_ends", size_bytes=len(file.content)))
    packed_bytes, unpacked_bytes = (int(size) for size in np.frombuffer(file.content, "<u4", 2, start))
    if packed_bytes > len(body):
        raise file.wrong(
            Reason(
                "points.pcd_cut", packed_bytes=packed_bytes, start=start + _SIZES_BYTES, size_bytes=len(file.content)
            )
        )
    needed_bytes = header.count * header.step_bytes
    if header.count == 0 or needed_bytes != unpacked_bytes or needed_bytes > GREATEST_EXPANSION * packed_bytes:
        raise file.wrong(
            Reason(
                "points.pcd_header_wrong",
                count=header.count,
                step_bytes=header.step_bytes,
                packed_bytes=packed_bytes,
                unpacked_bytes=unpacked_bytes,
            )
        )
    unpacked = decompress(body[:packed_bytes], unpacked_bytes)
    if unpacked is None:
        raise file.wrong(
            Reason(
                "points.pcd_damaged",
                start=start + _SIZES_BYTES,
                end=start + _SIZES_BYTES + packed_bytes,
                count=header.count,
            )
        )
    return _planes(unpacked, header.count, axes)


def _planes(unpacked: bytes, count: int, axes: tuple[Field, ...]) -> FloatArray:
    """Return the points of an unpacked body, in which all values of a field stand together."""
    points = np.empty((count, 3), coordinate_dtype([field.dtype for field in axes]))
    for axis, field in enumerate(axes):
        points[:, axis] = np.frombuffer(unpacked, field.dtype, count, count * field.offset_bytes)
    return points


def _lzf() -> ModuleType:
    with needed("python-neo-lzf", "a compressed PCD file (DATA binary_compressed)"):
        return import_module("lzf")


def decompress(packed: bytes, size_bytes: int) -> bytes | None:
    """Return the ``size_bytes`` bytes that an LZF stream unpacks to, or None where it does not unpack to that.

    Raises
    ------
    MissingDependencyError
        Where the LZF library is not installed.
    """
    if size_bytes > GREATEST_EXPANSION * len(packed):
        return None
    try:
        unpacked: bytes | None = _lzf().decompress(packed, size_bytes)
    except ValueError:
        return None
    return unpacked if unpacked is not None and len(unpacked) == size_bytes else None


def compress(content: bytes) -> bytes:
    """Return bytes packed by LZF; what does not shrink grows by one byte in 32.

    Raises
    ------
    MissingDependencyError
        Where the LZF library is not installed.
    """
    longest_bytes = len(content) + len(content) // 16 + 64
    packed: bytes = _lzf().compress(content, longest_bytes)
    return packed
