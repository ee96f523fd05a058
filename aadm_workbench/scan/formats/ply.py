"""Polygon file format (PLY), text and binary of both byte orders: the coordinates of its vertices."""

from __future__ import annotations

from typing import Any

import numpy as np

from aadm_workbench.model import FloatArray, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile, narrowed
from aadm_workbench.scan.formats.ply_header import Element, PlyHeader, parse_header
from aadm_workbench.scan.formats.records import check_room, coordinate_dtype, gather

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
