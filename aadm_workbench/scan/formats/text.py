"""Tables of points in text (.xyz, .txt, .csv, .asc, .pts): n rows of at least three columns."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.model import Array, Reason
from aadm_workbench.scan.file import Cloud, Declared, ScanFile
from aadm_workbench.scan.formats.records import check_room
from aadm_workbench.scan.formats.rows import (
    LONGEST_LINE_BYTES,
    is_finite,
    is_none,
    number_in,
    parse_rows,
    without_signs,
)
from aadm_workbench.scan.formats.text_names import named_columns, named_unit, names_some_axis

_LONGEST_PREAMBLE_LINES = 200  # exporters write up to some dozen lines before the table
_SAMPLE_LINES, _PLACES = 200, 200  # rows that are looked at, and columns that a row may have
_COMMENTS = ("#", "//", "%")
_LINE = re.compile(rb"[^\r\n]*")
_LINE_END = re.compile(rb"\r\n|\r|\n")
_WITH_NUMBER = re.compile(rb"^(?![^\r\n]{0,400}?(?:#|nan|inf))[^\r\n\d]{0,40}\d", re.MULTILINE | re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?")
_WHOLE = re.compile(r"[-+]?\d+")
_HALVES = re.compile(r"\d{2,}")
_COUNTED = 20  # rows that show whether a column counts them
_INTENSITY_MAX, _LEAST_SPAN_RATIO = 1.0, 50.0  # reflectance goes from 0 to 1; coordinates of a foot span hundreds of mm


@dataclass(frozen=True)
class Layout:
    """Where the rows of a table begin and how they are to be read.

    ``count`` is the number of rows that a first line announces, as .pts files have it; ``mm_per_unit`` is given by
    names of columns such as ``X [mm]`` or ``x_m``. ``spaced`` says that separating commas have a space behind them, and
    decimal ones have none.
    """

    start: int
    delimiter: str | None
    decimal_comma: bool
    columns: tuple[int, int, int] = (0, 1, 2)
    count: int | None = None
    mm_per_unit: float | None = None
    spaced: bool = False
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Heading:
    """The line over the rows that may name their columns: what separates it, and whether it is marked as a comment."""

    fields: tuple[str, ...] = ()
    separator: str = ""
    is_comment: bool = False


def read_text(file: ScanFile, declared: Declared) -> Cloud:
    """Read x, y and z from a table: by the names of its columns, else the first three.

    Columns are separated by white space, comma, semicolon or tab (decimal commas are understood where something else
    separates). Lines that begin with ``#``, ``//`` or ``%`` are skipped, as are blank ones; one line may name the
    columns or announce the number of points. Values are float64, for text does not say how precise it is. Rows in
    which a program wrote that there is no number are NaN.

    Raises
    ------
    ScanError
        Naming the line that is no row of numbers, how many rows are missing, or columns that do not tell what they
        hold.
    """
    if file.content.startswith((b"\xff\xfe", b"\xfe\xff")) or b"\0" in file.content[:1024]:
        raise file.wrong(Reason("points.no_text"))
    layout = _layout(file)
    body = file.content[layout.start :]
    if layout.count is not None:
        # Three digits, each with a separator; the last one may do without.
        check_room(file, layout.start, layout.count, 6, len(body) + 1)
    points = parse_rows(file, _plain(body, layout), layout.start, layout.columns, delimiter=layout.delimiter)
    if layout.count not in (None, len(points)):
        raise file.wrong(Reason("points.text_count", count=layout.count, found=len(points)))
    if layout.mm_per_unit is None:
        return Cloud(points, declared.mm_per_unit, notes=layout.notes)
    unit_from = Reason("points.text_unit")
    return Cloud(points, layout.mm_per_unit, unit_from=unit_from, notes=layout.notes)


def _plain(body: bytes, layout: Layout) -> bytes:
    """Return rows with decimal points and without quotation marks."""
    if layout.spaced:
        body = body.replace(b", ", b"  ")
    if layout.decimal_comma:
        body = body.replace(b",", b".")
    return body.replace(b'"', b" ") if b'"' in body[:LONGEST_LINE_BYTES] else body


def _layout(file: ScanFile) -> Layout:
    """Find the first row of numbers, what its columns are separated by, and which of them are x, y and z."""
    heading, count = _Heading(), None
    has_heading = False
    for number, position, line in _lines(file):
        text = _decoded(line)
        if not text or number >= _LONGEST_PREAMBLE_LINES:
            continue
        if _is_comment(text):
            named = _heading(text.lstrip("#/% \t"), is_comment=True)
            if named_columns(named.fields) is not None and not has_heading:
                heading = named
            continue
        separated = _separated(text)
        fields = _fields(text, separated)
        columns = named_columns(heading.fields) or (0, 1, 2)
        if _is_row(fields, columns) or (heading.is_comment and _is_row(fields, (0, 1, 2))):
            return _with_columns(file, replace(_with_decimals(file, position, separated), count=count), heading, text)
        if has_heading:
            raise file.wrong(Reason("points.text_line", number=number, text=repr(text[:80])))
        heading, count, has_heading = _heading(text), _announced_count(fields), True
    raise file.wrong(Reason("points.text_no_row"))


def _heading(text: str, *, is_comment: bool = False) -> _Heading:
    separated = _separated(text)
    return _Heading(tuple(_fields(text, separated)), _between(text), is_comment)


def _between(text: str) -> str:
    """Return the sign that stands between the columns of a line."""
    return next((sign for sign in ";\t," if sign in text), " ")


def _is_comment(text: str) -> bool:
    return without_signs(text.encode()).startswith(tuple(sign.encode() for sign in _COMMENTS))


def _lines(file: ScanFile, position: int = 0) -> Iterator[tuple[int, int, bytes]]:
    """Yield number, byte offset and content of the lines from an offset on, numbered from 1."""
    if position == 0 and file.content.startswith(b"\xef\xbb\xbf"):
        position = 3
    for number in range(1, max(_LONGEST_PREAMBLE_LINES, _SAMPLE_LINES) + 1):
        line = _LINE.match(file.content, position, position + LONGEST_LINE_BYTES)
        yield number, position, line.group() if line else b""
        line_end = _LINE_END.search(file.content, position)
        if line_end is None:
            return
        position = line_end.end()


def _decoded(line: bytes) -> str:
    """Return a line as text: UTF-8, else as Chinese programs write, else as Western ones do."""
    for encoding in ("utf-8", "gb18030"):
        try:
            return line.decode(encoding).strip()
        except UnicodeDecodeError:
            continue
    return line.decode("latin-1").strip()


def _separated(line: str) -> Layout:
    """Return how a line is separated, as a layout that starts nowhere."""
    if ";" in line:
        return Layout(0, ";", "," in line)
    if re.search(r"\d,[ \t]+[-+]?\d", line) and all(map(_DECIMAL_COMMA.fullmatch, re.split(r",[ \t]+", line)[:3])):
        return Layout(0, None, True, spaced=True)
    fields = line.split()
    if len(fields) >= 3 and all(
        _DECIMAL_COMMA.fullmatch(field) or is_none(field.replace(",", ".")) for field in fields[:3]
    ):
        return Layout(0, None, "," in line)
    if "," in line:
        return Layout(0, ",", False)
    return Layout(0, "\t" if "\t" in line and _is_tabbed(line) else None, False)


def _is_tabbed(line: str) -> bool:
    """Whether tabs alone separate a line: in numbers two of them are an empty column, and names may have spaces."""
    if any(number_in(word) is None for word in line.split()):
        return True
    fields = line.split("\t")
    return "" in fields and not any(" " in field.strip() for field in fields)


def _fields(line: str, separated: Layout) -> list[str]:
    if separated.spaced:
        line = line.replace(", ", "  ")
    return (line.replace(",", ".") if separated.decimal_comma else line).split(separated.delimiter)


def _with_decimals(file: ScanFile, start: int, separated: Layout) -> Layout:
    """Return how rows are separated, from the first one that has numbers, where the first of all has none."""
    line = _LINE.match(file.content, start)
    text = _decoded(line.group()) if line else ""
    if not all(is_finite(field) for field in _fields(text, separated)[:3]):
        found = _WITH_NUMBER.search(file.content, start)
        with_number = _LINE.match(file.content, found.start()) if found else None
        if with_number is not None and len(with_number.group()) < LONGEST_LINE_BYTES:
            separated = _separated(_decoded(with_number.group()))
    return replace(separated, start=start)


def _with_columns(file: ScanFile, layout: Layout, heading: _Heading, row: str) -> Layout:
    """Return a layout with the columns of x, y and z, by the line over a row, else by its values.

    Raises
    ------
    ScanError
        Where neither the names over the columns nor their values tell.
    """
    sample = _sample(file, layout)
    width = len(sample[0])
    columns = named_columns(heading.fields)
    if columns is not None and (not heading.is_comment or len(heading.fields) == width):
        unit = named_unit([heading.fields[column] for column in columns])
        return replace(layout, columns=columns, mm_per_unit=unit)
    is_named = not heading.is_comment and len(heading.fields) == width and heading.separator == _between(row)
    if is_named and (width > 3 or names_some_axis(heading.fields)):
        shown = ", ".join(field.strip() for field in heading.fields)[:120]
        raise file.wrong(Reason("points.text_columns", shown=shown))
    return _by_values(file, layout, sample)


def _sample(file: ScanFile, layout: Layout) -> list[list[str]]:
    """Return the fields of the first rows, and of some all over the file."""
    first = list(_lines(file, layout.start))
    found = [line for _, _, line in first]
    behind = first[-1][1] if len(first) >= _SAMPLE_LINES else len(file.content)
    for at in np.linspace(behind, len(file.content), _PLACES)[1:-1].astype(int).tolist():
        line_end = _LINE_END.search(file.content, at)
        line = _LINE.match(file.content, line_end.end(), line_end.end() + LONGEST_LINE_BYTES) if line_end else None
        found.append(line.group() if line else b"")
    lines = (_decoded(line) for line in found)
    return [_fields(line.replace('"', " "), layout) for line in lines if line and not _is_comment(line)]


def _by_values(file: ScanFile, layout: Layout, sample: list[list[str]]) -> Layout:
    """Return the layout of a table without names: x, y, z come first, but for the number of the point.

    Raises
    ------
    ScanError
        Where the first column looks like an intensity, or commas may be decimal or not.
    """
    width = min(map(len, sample[:-1] or sample))
    rows = [fields[:width] for fields in sample if len(fields) >= width]
    if layout.delimiter == "," and not layout.decimal_comma and _are_halves(rows):
        raise file.wrong(Reason("points.text_commas", shown=",".join(rows[0])[:80]))
    values = np.array([[np.nan if (value := number_in(field)) is None else value for field in row[:4]] for row in rows])
    values = values[np.isfinite(values).all(axis=1)]
    if width < 4 or len(values) < 3:
        return layout
    first, others = values[:, 0], values[:, 1:]
    has_fractions = bool((others != np.rint(others)).any(axis=0).all())
    is_whole = bool((first == np.rint(first)).all() and first.min() >= 0.0 and np.ptp(first) > 0.0)
    if is_whole and has_fractions and bool((np.diff(first[:_COUNTED]) == 1).all() and (np.diff(first) > 0).all()):
        return replace(layout, columns=(1, 2, 3), notes=(Reason("points.text_counts"),))
    if (is_whole and has_fractions) or _is_intensity(first, others):
        raise file.wrong(Reason("points.text_not_x", shown=rows[0][:4]))
    return layout


def _are_halves(rows: list[list[str]]) -> bool:
    """Whether each two fields are the two halves of a number with a decimal comma: whole, the second of one length."""
    width = len(rows[0])
    if width < 6 or width % 2 or not all(_WHOLE.fullmatch(field.strip()) for row in rows for field in row):
        return False
    return all(
        _HALVES.fullmatch(row[k].strip()) and len(row[k].strip()) == len(rows[0][k].strip())
        for row in rows
        for k in range(1, 6, 2)
    )


def _is_intensity(first: Array, others: Array) -> bool:
    """Whether a column of values from 0 to 1 stands before two of lengths: no component is so flat."""
    is_share = first.min() >= 0.0 and first.max() <= _INTENSITY_MAX and bool(np.ptp(first) > 0.0)
    return is_share and int((np.ptp(others[:, :2], axis=0) > _LEAST_SPAN_RATIO * np.ptp(first)).sum()) == 2


def _is_row(fields: list[str], columns: tuple[int, int, int]) -> bool:
    return len(fields) > max(columns) and all(number_in(fields[column]) is not None for column in columns)


def _announced_count(fields: list[str]) -> int | None:
    is_count = len(fields) == 1 and re.fullmatch(r"\d{1,12}", fields[0].strip())
    return int(fields[0]) if is_count else None
