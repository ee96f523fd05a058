"""Which files a column of a job is checked from."""

from __future__ import annotations

from dataclasses import fields

from .model import JobColumn

_NO_FILES = ("id", "axes")


def files_of(column: JobColumn) -> tuple[str, ...]:
    """The files that a column names, as it names them; every other text of a column is one."""
    found: dict[str, None] = {}
    for item in fields(column):
        value = getattr(column, item.name)
        if item.name not in _NO_FILES:
            texts = value if isinstance(value, tuple) else (value,)
            found.update((text, None) for text in texts if isinstance(text, str))
    return tuple(found)
