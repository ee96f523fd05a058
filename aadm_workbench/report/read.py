"""Reading report.json back: every other report is made from it alone, so it is checked against the schema first."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, TypeAlias

from aadm_workbench.bounded import BoundsError, read_bounded
from aadm_workbench.errors import MissingDependencyError, ReportError
from aadm_workbench.report.json import SCHEMA, report_schema

Report: TypeAlias = dict[str, Any]
"""A job's report as report.json holds it: mm, degrees, column frame; ``resources/report.schema.json`` describes it."""

LARGEST_REPORT_BYTES = 2**28
"""A column takes 50 KB: this is five thousand of them."""

MOST_VALUES = 2**25
"""Texts of this length that are nothing but brackets and commas would take many gigabytes in memory."""

_SHOWN_CHARACTERS = 80  # of what a file holds: a line
_HALF_CHARACTER = re.compile(r"\\u[dD][89a-fA-F]")


def read_report(path: Path) -> Report:
    """The report that a check has written.

    Raises
    ------
    ReportError
        Where the file is missing, cut off, of another schema version, or holds what the schema does not allow.
    MissingDependencyError
        Without the package jsonschema.
    """
    try:
        text = read_bounded(path, LARGEST_REPORT_BYTES).decode("utf-8-sig")
    except BoundsError as error:
        raise ReportError(f"{path}: {error}; name the report.json of a check") from error
    except OSError as error:
        raise ReportError(f"{path}: cannot be read ({error.strerror}); name the report.json of a check") from error
    except UnicodeDecodeError as error:
        raise ReportError(f"{path}: is no text, but report.json is; name the report.json of a check") from error
    if sum(map(text.count, "[{,")) > MOST_VALUES:
        raise ReportError(f"{path}: holds more than {MOST_VALUES} values, which no check writes")
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}"
        if not text[error.pos :].strip():
            raise ReportError(f"{path}: breaks off at {place}; copy it again or repeat the check") from error
        raise ReportError(f"{path}: is no JSON ({error.msg}, {place}); name the report.json of a check") from error
    except ValueError as error:
        raise ReportError(f"{path}: holds a number that is none ({error}); repeat the check") from error
    except RecursionError as error:
        raise _too_deep(path) from error
    try:
        # Python from 3.12 on reads deeper than it can walk.
        return checked_report(_mended(document) if _HALF_CHARACTER.search(text) else document, str(path))
    except RecursionError as error:
        raise _too_deep(path) from error


def _too_deep(path: Path) -> ReportError:
    return ReportError(f"{path}: is nested too deeply to be a report.json")


def checked_report(document: Any, source: str) -> Report:
    """A document that is a report of this schema; ``source`` is what errors call it.

    Raises
    ------
    ReportError
        Where it is not; the message names the place and what stands there.
    """
    if not isinstance(document, dict) or "schema" not in document:
        raise ReportError(f"{source}: is no report.json of a check: it has no key schema")
    if document["schema"] != SCHEMA:
        found = str(document["schema"])[:_SHOWN_CHARACTERS]
        raise ReportError(
            f"{source}: has schema {found}, this version reads schema {SCHEMA}; "
            "repeat the check, or use the version of aadm that wrote it"
        )
    if "columns" not in document and "assignments" in document:
        raise ReportError(f"{source}: is a match.json; name the report.json of a check")
    slip = _first_slip(document)
    if slip is not None:
        raise ReportError(f"{source}: {slip}; repeat the check")
    return document


def _mended(value: Any) -> Any:
    """A document whose texts no file can hold, for half of a character is missing, with a question mark instead."""
    if isinstance(value, dict):
        return {_mended(key): _mended(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_mended(item) for item in value]
    return value.encode("utf-8", errors="replace").decode("utf-8") if isinstance(value, str) else value


def _first_slip(document: Any) -> str | None:
    """Place and kind of what the schema does not allow: the innermost, which is why what holds it is not allowed."""
    jsonschema: Any
    try:
        jsonschema = import_module("jsonschema")
    except ImportError as error:
        message = "reading report.json"
        raise MissingDependencyError("jsonschema", message) from error
    validator = jsonschema.Draft202012Validator(report_schema())
    found = max(_slips(validator.iter_errors(document)), key=lambda slip: len(slip.absolute_path), default=None)
    if found is None:
        return None
    place = ".".join(str(part) for part in found.absolute_path) or "the document"
    said = found.message if len(found.message) <= _SHOWN_CHARACTERS else f"{found.message[:_SHOWN_CHARACTERS]}…"
    return f"{place} is not what a report holds ({said})"


def _slips(errors: Iterable[Any]) -> Iterator[Any]:
    """Errors of a schema, and those that they consist of."""
    for error in errors:
        yield error
        yield from _slips(error.context)
