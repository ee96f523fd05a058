"""The header of a PLY file: which elements follow, how many of each, with which properties."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Reason
from aadm_workbench.scan.file import ScanFile

LONGEST_HEADER_BYTES = 2**20
"""A header has some dozen lines; what has no end in a megabyte is no PLY file."""

_FIRST_LINE = re.compile(rb"(?:\xef\xbb\xbf)?ply[ \t]{0,80}(\r\n|\n|\r)")
_SHORT_TYPES = {"i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint"}
_LONG_TYPES = {"i1": "int8", "u1": "uint8", "i2": "int16", "u2": "uint16", "i4": "int32", "u4": "uint32"}
_TYPES = {name: dtype for names in (_SHORT_TYPES, _LONG_TYPES) for dtype, name in names.items()}
_TYPES |= {"float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}
_BYTE_ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True)
class Property:
    """One property of an element; ``count_dtype`` is the type of the length before a list, None for a plain value."""

    name: str
    dtype: np.dtype[Any]
    count_dtype: np.dtype[Any] | None = None

    @property
    def smallest_bytes(self) -> int:
        """Bytes of the value, or of an empty list."""
        return self.dtype.itemsize if self.count_dtype is None else self.count_dtype.itemsize


@dataclass(frozen=True)
class Element:
    """One element: its rows and what a row holds."""

    name: str
    count: int
    properties: tuple[Property, ...] = ()

    @property
    def has_lists(self) -> bool:
        """Whether the length of its rows differs."""
        return any(item.count_dtype is not None for item in self.properties)

    @property
    def smallest_bytes(self) -> int:
        """Bytes of a row, its lists being empty."""
        return sum(item.smallest_bytes for item in self.properties)


@dataclass(frozen=True)
class PlyHeader:
    """All elements in the order of the file; ``byte_order`` is "<", ">" or, for text, None."""

    byte_order: str | None
    elements: tuple[Element, ...]
    size_bytes: int


def parse_header(file: ScanFile) -> PlyHeader:
    """Read the header of a PLY file; lines may end in LF, CRLF or CR.

    Raises
    ------
    ScanError
        Naming the line that is no PLY header.
    """
    lines, size_bytes = _header_lines(file)
    byte_order: str | None = None
    has_format = False
    elements: list[Element] = []
    for number, line in enumerate(lines[1:], start=2):
        words = line.split()
        match words:
            case [] | ["comment" | "obj_info" | "end_header", *_]:
                pass
            case ["format", name, _] if name in _BYTE_ORDERS:
                byte_order, has_format = _BYTE_ORDERS[name], True
            case ["element", name, count] if re.fullmatch("[0-9]{1,18}", count):
                elements.append(Element(name, int(count)))
            case ["property", *rest] if elements:
                last = elements[-1]
                item = _property(file, number, line, rest, byte_order)
                elements[-1] = Element(last.name, last.count, (*last.properties, item))
            case _:
                raise _bad_line(file, number, line)
    if not has_format:
        raise file.wrong(Reason("points.ply_no_format"))
    return PlyHeader(byte_order, tuple(elements), size_bytes)


def _header_lines(file: ScanFile) -> tuple[list[str], int]:
    content = file.content
    begin = _FIRST_LINE.match(content)
    if begin is None:
        raise file.wrong(Reason("points.no_ply"))
    line_end = b"\r" if begin[1] == b"\r" else b"\n"
    lines: list[str] = []
    position = 0
    while not (lines and lines[-1] == "end_header"):
        end = content.find(line_end, position, LONGEST_HEADER_BYTES)
        if end < 0:
            raise file.wrong(Reason("points.ply_no_end", count=len(lines)))
        lines.append(content[position:end].decode("latin-1").strip())
        position = end + 1
    return lines, position


def _property(file: ScanFile, number: int, line: str, words: list[str], byte_order: str | None) -> Property:
    match words:
        case [kind, name] if kind in _TYPES:
            return Property(name, _dtype(kind, byte_order))
        case ["list", count_kind, kind, name] if _TYPES.get(count_kind, "f")[0] != "f" and kind in _TYPES:
            return Property(name, _dtype(kind, byte_order), _dtype(count_kind, byte_order))
    raise _bad_line(file, number, line)


def _dtype(kind: str, byte_order: str | None) -> np.dtype[Any]:
    return np.dtype(_TYPES[kind]).newbyteorder(byte_order or "=")  # type: ignore[arg-type]


def _bad_line(file: ScanFile, number: int, line: str) -> ScanError:
    return file.wrong(Reason("points.ply_line", number=number, line=repr(line[:80])))
