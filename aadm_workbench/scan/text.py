"""Tables of points in text (.xyz, .txt, .csv, .asc, .pts): n rows of at least three columns."""

from __future__ import annotations

import re
from dataclasses import dataclass

from aadm_workbench.scan.file import Cloud, Declared, ScanFile
from aadm_workbench.scan.records import check_room
from aadm_workbench.scan.rows import LONGEST_LINE_BYTES, parse_rows

_LONGEST_PREAMBLE_LINES = 200  # exporters write up to some dozen lines before the table
_COMMENTS = ("#", "//", "%")
_LINE = re.compile(rb"[^\r\n]*")
_LINE_END = re.compile(rb"\r\n|\r|\n")
_MM_PER_UNIT = {"mm": 1.0, "cm": 10.0, "m": 1000.0}
_NAME_WITH_UNIT = re.compile(r"[xyz][\s_\[(/]{1,3}(mm|cm|m)[\])]?")
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?")


@dataclass(frozen=True)
class Layout:
    """Where the rows of a table begin and how they are to be read.

    ``count`` is the number of rows that a first line announces, as .pts files have it; ``mm_per_unit`` is given by
    names of columns such as ``X [mm]`` or ``x_m``.
    """

    start: int
    delimiter: str | None
    decimal_comma: bool
    columns: tuple[int, int, int] = (0, 1, 2)
    count: int | None = None
    mm_per_unit: float | None = None


def read_text(file: ScanFile, declared: Declared) -> Cloud:
    """Read x, y and z from a table: the columns of that name, else the first three.

    Columns are separated by white space, comma, semicolon or tab (decimal commas are understood where something else
    separates). Lines that begin with ``#``, ``//`` or ``%`` are skipped, as are blank ones; one line may name the
    columns or announce the number of points. Values are float64, for text does not say how precise it is.

    Raises
    ------
    ScanError
        Naming the line that is no row of numbers, or how many rows are missing.
    """
    if file.content.startswith((b"\xff\xfe", b"\xfe\xff")) or b"\0" in file.content[:1024]:
        raise file.wrong("is not plain text; save it as text in UTF-8 or name its real format by its extension")
    layout = _layout(file)
    body = file.content[layout.start :]
    if layout.count is not None:
        # Three digits, each with a separator; the last one may do without.
        check_room(file, layout.start, layout.count, 6, len(body) + 1)
    if layout.decimal_comma:
        body = body.replace(b",", b".")
    points = parse_rows(file, body, layout.start, layout.columns, delimiter=layout.delimiter)
    if layout.count not in (None, len(points)):
        raise file.wrong(
            f"its first line announces {layout.count} points, {len(points)} follow; copy or export it again"
        )
    if layout.mm_per_unit is None:
        return Cloud(points, declared.mm_per_unit)
    return Cloud(points, layout.mm_per_unit, unit_from="the names of its columns say so")


def _layout(file: ScanFile) -> Layout:
    """Find the first row of numbers and what its columns are separated by."""
    columns, count, mm_per_unit = (0, 1, 2), None, None
    has_header = False
    position = 3 if file.content.startswith(b"\xef\xbb\xbf") else 0
    for number in range(1, _LONGEST_PREAMBLE_LINES):
        line = _LINE.match(file.content, position, position + LONGEST_LINE_BYTES)
        text = line.group().decode("latin-1").strip() if line else ""
        separator, decimal_comma = _separator(text)
        if text and not text.startswith(_COMMENTS):
            fields = text.replace(",", ".").split(separator) if decimal_comma else text.split(separator)
            if _is_row(fields, columns):
                return Layout(position, separator, decimal_comma, columns, count, mm_per_unit)
            if has_header:
                raise file.wrong(f"line {number} should begin with three numbers, but reads {text[:80]!r}")
            columns, count = _named_columns(fields), _announced_count(fields)
            mm_per_unit = _named_unit([fields[column] for column in columns] if len(fields) > max(columns) else [])
            has_header = True
        line_end = _LINE_END.search(file.content, position)
        if line_end is None:
            break
        position = line_end.end()
    raise file.wrong("holds no row of three numbers; export the points as rows of x, y, z")


def _separator(line: str) -> tuple[str | None, bool]:
    """Return what separates the columns of a line (None: white space) and whether commas are decimal."""
    if ";" in line:
        return ";", "," in line
    fields = line.split()
    if len(fields) >= 3 and all(_DECIMAL_COMMA.fullmatch(field) for field in fields[:3]):
        return None, True
    return ("," if "," in line else None), False


def _is_row(fields: list[str], columns: tuple[int, int, int]) -> bool:
    try:
        return len([float(fields[column]) for column in columns]) == 3
    except (ValueError, IndexError):
        return False


def _named_columns(fields: list[str]) -> tuple[int, int, int]:
    names = [re.split(r"[\s_\[(]", field.strip().strip("\"'").lower())[0] for field in fields]
    if all(axis in names for axis in "xyz"):
        return names.index("x"), names.index("y"), names.index("z")
    return 0, 1, 2


def _named_unit(fields: list[str]) -> float | None:
    """Return the millimetres in one unit that all three names of columns carry; None where they carry none."""
    found = [_NAME_WITH_UNIT.fullmatch(field.strip().strip("\"'").lower()) for field in fields]
    units = {match[1] for match in found if match}
    return _MM_PER_UNIT[units.pop()] if len(units) == 1 and all(found) and found else None


def _announced_count(fields: list[str]) -> int | None:
    is_count = len(fields) == 1 and re.fullmatch(r"\d{1,12}", fields[0].strip())
    return int(fields[0]) if is_count else None
