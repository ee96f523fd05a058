"""Coordinates out of rows of text, as ASCII PLY, ASCII PCD and XYZ files store them."""

from __future__ import annotations

import io
import math
import re
import warnings
from collections.abc import Sequence

import numpy as np

from aadm_workbench.errors import ScanError
from aadm_workbench.model import Array, Reason
from aadm_workbench.scan.file import ScanFile

LONGEST_LINE_BYTES = 2**20
"""A row of numbers takes some hundred bytes: what has no end in a megabyte is no text of points."""

_WITH_SIGN = re.compile(rb"[-+]?\d\.[#$]\w*|#(?:N/?A|NUM!|VALUE!|DIV/0!|REF!|NAME\?|NULL!|NV|ZAHL!|WERT!)")
_WORDS = re.compile(
    rb"(?<![^\s,;])(?:[-+]?s?q?nan[sq]?(?:\s?\([^()\s]{0,20}\))?|n/?a|null|none|nil|invalid|(?:---?))(?![^\s,;])",
    re.IGNORECASE,
)


def parse_rows(
    file: ScanFile,
    body: bytes,
    start: int,
    columns: Sequence[int],
    *,
    count: int | None = None,
    delimiter: str | None = None,
) -> Array:
    """Return some columns of a table of numbers in text.

    Parameters
    ----------
    file
        The file, for messages.
    body
        The rows; what follows ``count`` of them is not looked at.
    start
        Byte offset of ``body`` in the file, for the line numbers in messages.
    columns
        Their indices, those of x, y and z first.
    count
        Rows that the header announces; None where the file has no header and ends with its last row.
    delimiter
        One character, or None for white space.

    Returns
    -------
    Array
        (n, k) float64, unit of the file; what programs print for no number is NaN.

    Raises
    ------
    ScanError
        Naming the line that is no row of numbers, or how many rows are missing.
    """
    if b"\n" not in body and b"\r" in body:
        body = body.replace(b"\r", b"\n")
    _check_lines(file, body, start)
    try:
        points = _numbers(without_signs(body), columns, count, delimiter)
    except ValueError:
        try:
            points = _numbers(without_words(body), columns, count, delimiter)
        except ValueError as error:
            raise _bad_row(file, body, start, columns, delimiter, str(error)) from error
    found = len(points)
    if count is not None and found < count:
        raise file.wrong(Reason("points.rows_short", count=count, found=found, size_bytes=len(file.content)))
    return points.reshape(-1, len(columns))


def _numbers(body: bytes, columns: Sequence[int], count: int | None, delimiter: str | None) -> Array:
    with warnings.catch_warnings():
        # numpy warns of blank lines and of a body without rows; both are judged by their number.
        warnings.simplefilter("ignore", UserWarning)
        return np.loadtxt(
            io.TextIOWrapper(io.BytesIO(body), encoding="latin-1"),
            usecols=tuple(columns),
            max_rows=count,
            delimiter=delimiter,
            ndmin=2,
        )


def _check_lines(file: ScanFile, body: bytes, start: int) -> None:
    """Refuse lines that no exporter writes before they are unpacked to four times their size."""
    for begin in range(0, len(body) - LONGEST_LINE_BYTES, LONGEST_LINE_BYTES):
        if body.find(b"\n", begin, begin + LONGEST_LINE_BYTES) < 0:
            raise file.wrong(Reason("points.long_row", most_bytes=LONGEST_LINE_BYTES, place=start + begin))


def _bad_row(
    file: ScanFile, body: bytes, start: int, columns: Sequence[int], delimiter: str | None, reason: str
) -> ScanError:
    first_line = file.content.count(b"\n", 0, start) + 1
    for number, line in enumerate(without_words(body).splitlines(), start=first_line):
        text = line.decode("latin-1").partition("#")[0].strip()
        fields = text.split(delimiter)
        if text and (len(fields) <= max(columns) or any(number_in(fields[column]) is None for column in columns)):
            shown = text if len(text) <= 80 else f"{text[:80]}..."
            needed = max(columns) + 1
            return file.wrong(Reason("points.bad_row", number=number, needed=needed, shown=repr(shown)))
    return file.wrong(Reason("points.bad_rows", why=reason, first_line=first_line))


def without_signs(body: bytes) -> bytes:
    """Return rows in which what has a ``#`` and is no comment is "nan", before anybody takes it for one."""
    return _WITH_SIGN.sub(b"nan", body) if b"#" in body or b".$" in body else body


def without_words(body: bytes) -> bytes:
    """Return rows in which all that programs write for no number is "nan"."""
    return _WORDS.sub(b"nan", without_signs(body))


def number_in(field: str) -> float | None:
    """Return the number in a field, NaN where it says that there is none, None where it is something else."""
    text = without_words(field.strip().strip("\"'").encode()).decode()
    try:
        return float(text)
    except ValueError:
        return None


def is_finite(field: str) -> bool:
    """Whether a field holds a number that is one."""
    value = number_in(field)
    return value is not None and math.isfinite(value)


def is_none(field: str) -> bool:
    """Whether a field says that there is no number."""
    return number_in(field) is not None and not is_finite(field)
