"""Point cloud data (PCD) of versions 0.5 to 0.7, all three storages: coordinates, grid and pose of the sensor."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from itertools import accumulate
from types import ModuleType
from typing import Any

import numpy as np

from aadm_workbench.errors import ScanError, needed
from aadm_workbench.model import Array, FloatArray, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile, narrowed
from aadm_workbench.scan.formats.records import check_room, coordinate_dtype, gather

LONGEST_HEADER_BYTES = 2**20
"""A header has eleven lines; what has none in a megabyte is no PCD file."""
STORAGES = ("ascii", "binary", "binary_compressed")

_DTYPES = {("F", 4), ("F", 8)} | {(kind, size) for kind in "IU" for size in (1, 2, 4, 8)}
_DEFAULTS = {"HEIGHT": ["1"], "VIEWPOINT": ["0", "0", "0", "1", "0", "0", "0"]}


@dataclass(frozen=True)
class Field:
    """One field of a point: ``count`` values of one type, from a byte offset and a column of the point on."""

    name: str
    dtype: np.dtype[Any]
    count: int
    offset_bytes: int
    column: int


@dataclass(frozen=True, eq=False)
class PcdHeader:
    """What the header of a PCD file says.

    Parameters
    ----------
    fields
        The fields in the order of the file.
    width, height
        The grid; height 1 for a cloud without one.
    T_scan_file
        (4, 4) float64: the pose in VIEWPOINT, unit of the file.
    storage
        One of ``STORAGES``.
    size_bytes
        Length of the header.
    """

    fields: tuple[Field, ...]
    width: int
    height: int
    T_scan_file: Array
    storage: str
    size_bytes: int

    @property
    def count(self) -> int:
        """Points of the file."""
        return self.width * self.height

    @property
    def organised(self) -> bool:
        """Whether the points form a grid; a single row or column of them is none."""
        return self.width > 1 and self.height > 1

    @property
    def step_bytes(self) -> int:
        """Bytes of one point."""
        return sum(field.dtype.itemsize * field.count for field in self.fields)

    @property
    def columns(self) -> int:
        """Values of one point."""
        return sum(field.count for field in self.fields)


def parse_header(file: ScanFile) -> PcdHeader:
    """Read the header of a PCD file, version 0.5 to 0.7; keywords and storage in any case.

    Raises
    ------
    ScanError
        For a header that is cut off, lacks an entry or contradicts itself.
    """
    entries, size_bytes = _entries(file)
    storage = " ".join(entries["DATA"]).lower()
    if storage not in STORAGES:
        raise file.wrong(Reason("points.pcd_storage", storage=storage, known=STORAGES))
    fields = _fields(file, entries)
    width, height = _grid(file, entries)
    return PcdHeader(fields, width, height, _pose(file, entries), storage, size_bytes)


def _entries(file: ScanFile) -> tuple[dict[str, list[str]], int]:
    entries: dict[str, list[str]] = dict(_DEFAULTS)
    position = 3 if file.content.startswith(b"\xef\xbb\xbf") else 0
    while "DATA" not in entries:
        end = file.content.find(b"\n", position, LONGEST_HEADER_BYTES)
        if end < 0:
            raise file.wrong(Reason("points.no_pcd"))
        words = file.content[position:end].decode("latin-1").split()
        if words and not words[0].startswith("#"):
            entries[words[0].upper()] = words[1:]
        position = end + 1
    return entries, position


def _numbers(file: ScanFile, entries: dict[str, list[str]], key: str, least: int) -> list[int]:
    words = entries.get(key, [])
    # Longer numbers cannot be meant, and their product would.
    numbers = [int(word) for word in words if word.isascii() and word.isdigit() and len(word) <= 15]
    if not words or len(numbers) != len(words) or min(numbers) < least:
        code = "points.pcd_says" if words else "points.pcd_has_no"
        raise file.wrong(Reason(code, key=key, said=" ".join(words)[:60], least=least))
    return numbers


def _fields(file: ScanFile, entries: dict[str, list[str]]) -> tuple[Field, ...]:
    # Versions before 0.6 wrote COLUMNS instead of FIELDS.
    names = entries.get("FIELDS") or entries.get("COLUMNS") or []
    sizes = _numbers(file, entries, "SIZE", 1)
    counts = _numbers(file, entries, "COUNT", 1) if "COUNT" in entries else [1] * len(names)
    kinds = [kind.upper() for kind in entries.get("TYPE", [])]
    if not len(names) == len(sizes) == len(counts) == len(kinds):
        raise file.wrong(Reason("points.pcd_lengths"))
    unknown = [f"{kind}{size}" for kind, size in zip(kinds, sizes, strict=True) if (kind, size) not in _DTYPES]
    if unknown:
        raise file.wrong(Reason("points.pcd_types", unknown=unknown))
    dtypes = [np.dtype(f"<{kind.lower()}{size}") for kind, size in zip(kinds, sizes, strict=True)]
    offsets = accumulate((dtype.itemsize * count for dtype, count in zip(dtypes, counts, strict=True)), initial=0)
    columns = accumulate(counts, initial=0)
    # Offsets and columns have one entry more than fields: where the next point begins.
    return tuple(Field(*row) for row in zip(names, dtypes, counts, offsets, columns, strict=False))


def _grid(file: ScanFile, entries: dict[str, list[str]]) -> tuple[int, int]:
    if "WIDTH" not in entries:
        entries = {**entries, "WIDTH": entries.get("POINTS", [])}
    width, height = _numbers(file, entries, "WIDTH", 0)[0], _numbers(file, entries, "HEIGHT", 0)[0]
    points = _numbers(file, entries, "POINTS", 0)[0] if "POINTS" in entries else width * height
    if points != width * height:
        raise file.wrong(Reason("points.pcd_points", points=points, width=width, height=height))
    return width, height


def _pose(file: ScanFile, entries: dict[str, list[str]]) -> Array:
    """Return VIEWPOINT, translation then quaternion w x y z, as a (4, 4) transform."""
    wrong: ScanError = file.wrong(Reason("points.pcd_viewpoint", said=" ".join(entries["VIEWPOINT"])[:80]))
    try:
        values = np.array([float(word) for word in entries["VIEWPOINT"]])
    except ValueError as error:
        raise wrong from error
    if values.shape != (7,) or not np.isfinite(values).all() or not values[3:].any():
        raise wrong
    pose = np.eye(4)
    from scipy.spatial.transform import Rotation  # slow to import, and few files need it

    pose[:3, :3] = Rotation.from_quat(values[[4, 5, 6, 3]]).as_matrix()
    pose[:3, 3] = values[:3]
    return pose


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
