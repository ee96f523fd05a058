"""A job file as a table of values, read and written; what a panel does not show of it is kept."""

from __future__ import annotations

import datetime
import json
import math
import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from aadm_workbench.bounded import BoundsError, read_bounded
from aadm_workbench.errors import JobError

LARGEST_JOB_BYTES = 16 * 2**20
"""As the command has it: a job of a thousand columns with designs of their own takes a megabyte."""

Table = dict[str, object]
"""A table of TOML: texts, numbers, flags, dates, lists and tables, by their keys."""

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def read_job_table(path: Path) -> Table:
    """The values of a job file; whether they are a job is looked at by the command that runs it.

    Raises
    ------
    JobError
        Where the file cannot be read, or is no TOML with columns in it.
    """
    try:
        text = read_bounded(path, LARGEST_JOB_BYTES).decode("utf-8-sig").replace("\r\n", "\n")
        table = tomllib.loads(text)
    except BoundsError as error:
        raise JobError.about(path, "document.job_unusable", why=error) from error
    except OSError as error:
        raise JobError.about(path, "document.job_unread", why=error.strerror) from error
    except (ValueError, RecursionError) as error:
        raise JobError.about(path, "document.no_job", why=error) from error
    columns = table.get("columns")
    if not isinstance(columns, list) or not all(isinstance(one, dict) and "id" in one for one in columns):
        raise JobError.about(path, "document.no_columns")
    return table


def job_toml(table: Mapping[str, Any]) -> str:
    """The text of a job: :func:`read_job_table` gives back the same values."""
    return "\n".join(_lines(table, ())).strip("\n") + "\n"


def _lines(table: Mapping[str, Any], at: tuple[str, ...]) -> Iterator[str]:
    """Plain values first: TOML takes what follows a table's heading for that table."""
    plain = {key: value for key, value in table.items() if not _is_table(value) and not _is_tables(value)}
    for key, value in plain.items():
        yield f"{_key(key)} = {_value(value)}"
    for key, value in table.items():
        name = ".".join(map(_key, (*at, key)))
        if _is_table(value):
            yield from ("", f"[{name}]", *_lines(value, (*at, key)))
        elif _is_tables(value):
            for entry in value:
                yield from ("", f"[[{name}]]", *_lines(entry, (*at, key)))


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(one, Mapping) for one in value)


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _quoted(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, datetime.date | datetime.time):
        return value.isoformat()
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{_key(key)} = {_value(one)}' for key, one in value.items())} }}"
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)  # inf, -inf and nan are TOML's own words
    return repr(value)


def _quoted(text: str) -> str:
    """A text of TOML: JSON's escapes are its own, but for the sign DEL, which TOML wants escaped, too."""
    return json.dumps(str(text), ensure_ascii=False).replace("\x7f", "\\u007f")
