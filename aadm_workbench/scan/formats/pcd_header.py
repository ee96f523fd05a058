"""The header of a PCD file: its fields, its grid, the pose of its sensor and how its points are stored."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, Reason
from aadm_workbench.scan.file import ScanFile

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
