"""Dataclasses as JSON and back, exactly: what was kept gives the same report as what was never kept.

report.json rounds, so that people can read it; this keeps every bit of every number, and what is no number. Types are
read off the annotations, so nothing in a file says which code is to run.
"""

from __future__ import annotations

import json
from contextlib import suppress
from typing import Any, TypeVar, get_origin

import msgspec
import numpy as np

Noun = TypeVar("Noun")


def to_exact_json(value: object) -> str:
    """A dataclass, or what such hold, as JSON on one line; numbers as the shortest text that gives them back."""
    return json.dumps(plainly(value), ensure_ascii=False, separators=(",", ":"))


def plainly(value: object) -> Any:
    """A dataclass, or what such hold, in the types that JSON knows, every number as it is."""
    return msgspec.to_builtins(value, str_keys=True, enc_hook=_plain)


def from_exact_json(kind: type[Noun], text: str) -> Noun:
    """The dataclass that :func:`to_exact_json` wrote.

    Raises
    ------
    ValueError
        For text that is no such dataclass: another version wrote it, or it is broken.
    """
    # What is no number, and half a character, is no JSON: the standard library reads it all the same.
    with suppress(msgspec.DecodeError, UnicodeEncodeError, RecursionError):
        return msgspec.json.decode(text, type=kind, dec_hook=_array)
    try:
        return msgspec.convert(json.loads(text), kind, dec_hook=_array)
    except (msgspec.ValidationError, RecursionError) as error:
        raise ValueError(f"this is no {kind.__name__}: {error}") from error


def _plain(value: object) -> object:
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, str):
        return str(value)
    raise TypeError(f"{type(value).__name__} cannot be kept")


def _array(kind: type, plain: object) -> object:
    if get_origin(kind) is not np.ndarray:
        raise TypeError(f"values of type {kind} cannot be kept")
    return np.array(plain, dtype=np.float64)
