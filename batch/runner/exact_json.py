"""Dataclasses as JSON and back, exactly: what was kept gives the same report as what was never kept.

report.json rounds, so that people can read it; this keeps every bit of every number. Types are read off the
annotations, so nothing in a file says which code is to run.
"""

from __future__ import annotations

import json
import sys
import types
from collections.abc import Callable, Hashable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from typing import Any, Literal, TypeVar, Union, cast, get_args, get_origin, get_type_hints

import numpy as np

Noun = TypeVar("Noun")
Decode = Callable[[Any], Any]


def to_exact_json(value: object) -> str:
    """A dataclass, or what such hold, as JSON on one line; numbers as the shortest text that gives them back."""
    return json.dumps(_plain(value), ensure_ascii=False, separators=(",", ":"))


def from_exact_json(kind: type[Noun], text: str) -> Noun:
    """The dataclass that :func:`to_exact_json` wrote.

    Raises
    ------
    ValueError
        For text that is no such dataclass: another version wrote it, or it is broken.
    """
    try:
        noun: Noun = _decoder_of(cast(Hashable, kind))(json.loads(text))
    except (KeyError, TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"this is no {kind.__name__}: {error}") from error
    return noun


def _plain(value: object) -> Any:
    if isinstance(value, Enum):
        return value.value
    if is_dataclass(value) and not isinstance(value, type):
        return {item.name: _plain(getattr(value, item.name)) for item in fields(value)}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if value is None or isinstance(value, bool | int | float | str):
        return value
    raise TypeError(f"{type(value).__name__} cannot be kept")


@cache
def _decoder_of(kind: Hashable) -> Decode:
    return _decoder(kind)


def _decoder(hint: Any) -> Decode:
    """What turns plain values into those that an annotation names; TypeError for an annotation that is not known."""
    hint = _unnamed(hint)
    origin, arguments = get_origin(hint), get_args(hint)
    if hint is str:
        # Labels, clauses and reasons come again in every column.
        return sys.intern
    if hint is Any or hint in (int, float, bool, type(None)) or origin is Literal:
        return lambda plain: plain
    if origin is np.ndarray:
        return lambda plain: np.array(plain, dtype=np.float64)
    if origin in (Union, types.UnionType):
        return _optional([_decoder(one) for one in arguments if one is not type(None)])
    if origin is tuple:
        return _tuple(arguments)
    if origin is list:
        each = _decoder(arguments[0])
        return lambda plain: [each(item) for item in plain]
    if origin is dict:
        each = _decoder(arguments[1])
        return lambda plain: {key: each(item) for key, item in plain.items()}
    if isinstance(hint, type) and issubclass(hint, Enum):
        return hint
    if is_dataclass(hint):
        return _dataclass(hint)
    raise TypeError(f"values of type {hint} cannot be kept")


def _unnamed(hint: Any) -> Any:
    """What a name of a ``type`` statement stands for; numpy's NDArray is such a name from 2.5 on."""
    origin = get_origin(hint)
    return getattr(hint if origin is None else origin, "__value__", hint)


def _optional(others: list[Decode]) -> Decode:
    if len(others) != 1:
        raise TypeError("only one type and None can be told apart")
    (decode,) = others
    return lambda plain: None if plain is None else decode(plain)


def _tuple(arguments: tuple[Any, ...]) -> Decode:
    if len(arguments) == 2 and arguments[1] is Ellipsis:
        each = _decoder(arguments[0])
        return lambda plain: tuple(each(item) for item in plain)
    places = [_decoder(one) for one in arguments]
    return lambda plain: tuple(decode(item) for decode, item in zip(places, plain, strict=True))


def _dataclass(kind: Any) -> Decode:
    hints = get_type_hints(kind)
    names = {item.name for item in fields(kind)}
    decoders = {name: _decoder(hints[name]) for name in names}

    def decode(plain: dict[str, Any]) -> Any:
        if plain.keys() != names:
            raise ValueError(f"this is no {kind.__name__}: its fields are others")
        return kind(**{name: decoders[name](item) for name, item in plain.items()})

    return decode
