"""Polygon file format (PLY), text and binary of both byte orders: the coordinates of its vertices."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import FloatArray, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile, narrowed
from aadm_workbench.scan.formats.records import check_room, coordinate_dtype, gather

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


MOST_UNEQUAL_ROWS = 1_000_000
"""Rows of lists before the points that are gone through one by one, at a microsecond each."""


def read_ply(file: ScanFile, declared: Declared) -> Cloud:
    """Read the vertices of a PLY file: x, y and z by name, in any order among other properties.

    Raises
    ------
    ScanError
        For a header that makes no sense, vertices without coordinates or with list properties, and fewer points than
        the header announces.
    """
    header = parse_header(file)
    index = next((k for k, element in enumerate(header.elements) if element.name.lower() == "vertex"), None)
    if index is None:
        raise file.wrong(Reason("points.ply_no_vertex"))
    vertex = header.elements[index]
    columns = _coordinate_columns(file, vertex)
    start = _vertex_start(file, header, header.elements[:index])
    if header.byte_order is None:
        points = _text_points(file, start, vertex, columns, declared.mm_per_unit)
    else:
        points = _binary_points(file, start, vertex, columns)
    return Cloud(points, declared.mm_per_unit)


def _coordinate_columns(file: ScanFile, vertex: Element) -> tuple[int, ...]:
    if vertex.has_lists:
        raise file.wrong(Reason("points.ply_list"))
    names = [item.name.lower() for item in vertex.properties]
    missing = [axis for axis in "xyz" if axis not in names]
    if missing:
        present = ", ".join(names)[:80]
        raise file.wrong(Reason("points.ply_missing", missing=missing, present=present))
    return tuple(names.index(axis) for axis in "xyz")


def _vertex_start(file: ScanFile, header: PlyHeader, before: tuple[Element, ...]) -> int:
    """Return the byte offset of the first vertex, behind the header and the elements that stand before the vertices."""
    start = header.size_bytes
    for element in before:
        if header.byte_order is None:
            start = _lines_end(file, start, element)
        elif element.has_lists:
            start = _lists_end(file, start, element, big_endian=header.byte_order == ">")
        else:
            start += element.count * element.smallest_bytes
    return start


def _lines_end(file: ScanFile, start: int, element: Element) -> int:
    line_end = b"\n" if file.content.endswith(b"\n", 0, start) else b"\r"
    for _ in range(element.count):
        start = file.content.find(line_end, start) + 1
        if start == 0:
            raise file.wrong(Reason("points.ply_ends", name=repr(element.name)))
    return start


def _equal_rows_end(file: ScanFile, start: int, element: Element) -> int | None:
    """Return where rows end whose lists are all as long as those of the first row, as of triangles; None for others."""
    content, position = file.content, start
    counts: list[tuple[int, np.dtype[Any], int]] = []
    for item in element.properties:
        length = 1
        if item.count_dtype is not None:
            if position + item.count_dtype.itemsize > len(content):
                return None
            length = int(np.frombuffer(content, item.count_dtype, 1, position)[0])
            counts.append((position, item.count_dtype, length))
            position += item.count_dtype.itemsize
        position += length * item.dtype.itemsize
        if length < 0 or position > len(content):
            return None
    row_bytes = position - start
    end = start + element.count * row_bytes
    if element.count == 0 or end > len(content):
        return None
    are_equal = all(
        (np.ndarray((element.count,), dtype, content, at, (row_bytes,)) == length).all() for at, dtype, length in counts
    )
    return end if are_equal else None


def _lists_end(file: ScanFile, start: int, element: Element, *, big_endian: bool) -> int:
    equal_end = _equal_rows_end(file, start, element)
    if equal_end is not None:
        return equal_end
    if element.count > MOST_UNEQUAL_ROWS:
        raise file.wrong(Reason("points.ply_rows", count=element.count, name=repr(element.name)))
    end = start
    for row in range(element.count):
        for item in element.properties:
            length = 1
            if item.count_dtype is not None:
                length_bytes = file.content[end : end + item.count_dtype.itemsize]
                signed = item.count_dtype.kind == "i"
                length = int.from_bytes(length_bytes, "big" if big_endian else "little", signed=signed)
                end += item.count_dtype.itemsize
            end += length * item.dtype.itemsize
            if length < 0 or end > len(file.content):
                place = {"row": row, "count": element.count, "name": repr(element.name)}
                raise file.wrong(Reason("points.ply_row_end", **place, size_bytes=len(file.content)))
    return end


def _text_points(
    file: ScanFile, start: int, vertex: Element, columns: tuple[int, ...], mm_per_unit: float
) -> FloatArray:
    # A value takes a digit and a separator; the last one may do without the separator.
    check_room(file, start, vertex.count, 2 * len(vertex.properties), len(file.content) - start + 1)
    from aadm_workbench.scan.formats.rows import parse_rows  # as above

    points = parse_rows(file, file.content[start:], start, columns, count=vertex.count)
    dtype = coordinate_dtype([vertex.properties[column].dtype for column in columns])
    return narrowed(points, dtype, mm_per_unit)


def _binary_points(file: ScanFile, start: int, vertex: Element, columns: tuple[int, ...]) -> FloatArray:
    step_bytes = vertex.smallest_bytes
    check_room(file, start, vertex.count, step_bytes, len(file.content) - start)
    offsets = [sum(item.smallest_bytes for item in vertex.properties[:column]) for column in columns]
    axes = [(offset, vertex.properties[column].dtype) for offset, column in zip(offsets, columns, strict=True)]
    return gather(file.content, start, vertex.count, step_bytes, axes)
