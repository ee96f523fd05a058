"""Reading report.json back: every other report is made from it alone, so each key must hold what its type says.

Keys that this version does not know are passed over; those that an older one did not write yet have their defaults.
"""

from __future__ import annotations

import codecs
import json
import re
from collections.abc import Iterator
from pathlib import Path

import msgspec
import numpy as np

from aadm_workbench.bounded import BoundsError, read_bounded
from aadm_workbench.errors import ReportError
from aadm_workbench.model import SUMMED, Array, ColumnReport, JobReport, Kind
from aadm_workbench.model.reports import LONGEST_ID
from aadm_workbench.report.json import SCHEMA

LARGEST_REPORT_BYTES = 2**28
"""A column takes 50 KB: this is five thousand of them."""

MOST_VALUES = 2**25
"""Texts of this length that are nothing but brackets and commas would take many gigabytes in memory."""

_PIECE = 2**20  # bytes that are looked at as a text at once: the whole of it takes twice its size
_SHOWN_CHARACTERS = 80  # of what a file holds: a line
NAMED = {"tool": ("name", "version"), "job": ("name", "sha256"), "model": ("source", "sha256")}
"""What the parts that are lists of names and texts hold at least."""

_LABEL = {Kind.SLEEVE: re.compile("S[1-9][0-9]*"), Kind.REBAR: re.compile("R[1-9][0-9]*")}


def read_report(path: Path) -> JobReport:
    """The report that a check has written: mm, degrees, column frame.

    Raises
    ------
    ReportError
        Where the file is missing, cut off, of another schema version, or a key holds what it cannot.
    """
    try:
        content = read_bounded(path, LARGEST_REPORT_BYTES).removeprefix(codecs.BOM_UTF8)
        for _ in codecs.iterdecode((content[k : k + _PIECE] for k in range(0, len(content), _PIECE)), "utf-8"):
            pass
    except BoundsError as error:
        raise ReportError.about(path, "report.unusable", why=error) from error
    except OSError as error:
        raise ReportError.about(path, "report.unread", why=error.strerror) from error
    except UnicodeDecodeError as error:
        raise ReportError.about(path, "report.no_text") from error
    if sum(map(content.count, (b"[", b"{", b","))) > MOST_VALUES:
        raise ReportError.about(path, "report.many", most=MOST_VALUES)
    return parsed_report(content, str(path))


def parsed_report(text: str | bytes, source: str) -> JobReport:
    """The report that a text holds; ``source`` is what errors call it.

    Raises
    ------
    ReportError
        Where it holds none; the message names the key and what stands there.
    """
    try:
        try:
            return _report(text, source)
        except msgspec.ValidationError:
            raise
        except msgspec.DecodeError:
            # Python's parser says in which line, and takes what is half of a character: no file can hold it.
            document = json.dumps(json.loads(text), ensure_ascii=False, allow_nan=False)
            return _report(document.encode(errors="replace"), source)
    except msgspec.ValidationError as error:
        raise _slip(source, str(error)) from error
    except json.JSONDecodeError as error:
        code = "report.no_json" if error.doc[error.pos :].strip() else "report.cut"
        raise ReportError.about(source, code, line=error.lineno, column=error.colno, why=error.msg) from error
    except (ValueError, msgspec.DecodeError) as error:
        raise ReportError.about(source, "report.no_number", why=error) from error
    except RecursionError as error:
        raise ReportError.about(source, "report.deep") from error


def parsed_column(text: str | bytes) -> ColumnReport:
    """One entry of a report's ``columns``.

    Raises
    ------
    ValueError
        Where the text holds none.
    """
    return msgspec.json.decode(text, type=ColumnReport, dec_hook=_transform)


def _report(text: str | bytes, source: str) -> JobReport:
    try:
        keys = msgspec.json.decode(text, type=dict[str, msgspec.Raw])
    except msgspec.ValidationError:
        keys = {}
    if "schema" not in keys:
        raise ReportError.about(source, "report.no_schema")
    found = msgspec.json.decode(keys["schema"])
    if found != SCHEMA:
        raise ReportError.about(source, "report.schema", found=str(found)[:_SHOWN_CHARACTERS], schema=SCHEMA)
    if "columns" not in keys and "assignments" in keys:
        raise ReportError.about(source, "report.match")
    report = msgspec.json.decode(text, type=JobReport, dec_hook=_transform)
    for said in _contradictions(report):
        raise _slip(source, said)
    return report


def _transform(kind: type, rows: object) -> Array:
    """The one kind of array that a report holds: (4, 4)."""
    found = np.array(rows, dtype=np.float64)
    if found.shape != (4, 4):
        raise ValueError("Expected four rows of four numbers")
    return found


def _slip(source: str, error: str) -> ReportError:
    """A key that holds something else than its type, as msgspec says it: ``Expected … - at `$.columns[0].id```."""
    said, _, place = error.partition(" - at `$")
    keys = re.sub(r"\[(\w+)\]", r".\1", place.rstrip("`").replace("[...]", "")).strip(".")
    said = said if len(said) <= _SHOWN_CHARACTERS else f"{said[:_SHOWN_CHARACTERS]}…"
    return ReportError.about(source, "report.slip", key=keys or "the document", why=said)


def _contradictions(report: JobReport) -> Iterator[str]:
    """What types alone do not tell: names that must be there, and verdicts and labels that must be such."""
    for part, names in NAMED.items():
        known = getattr(report, part)
        for name in names if known is not None else ():
            if name not in known:
                yield f"Object missing required field `{name}` - at `$.{part}`"
    if not report.columns:
        yield "Expected a column or more - at `$.columns`"
    for number, column in enumerate(report.columns):
        yield from (f"{said} - at `$.columns[{number}].{key}`" for said, key in _of_column(column))


def _of_column(column: ColumnReport) -> Iterator[tuple[str, str]]:
    """The same of one column, each with its key."""
    if column.verdict not in SUMMED:
        yield f"Invalid enum value '{column.verdict}'", "verdict"
    if not 0 < len(column.id) <= LONGEST_ID:
        yield f"Expected 1 to {LONGEST_ID} characters", "id"
    for kind in Kind:
        for place, point in enumerate(column.points(kind)):
            if not _LABEL[kind].fullmatch(point.label):
                yield f"'{point.label}' is no label", f"{kind.plural}.points[{place}].label"
