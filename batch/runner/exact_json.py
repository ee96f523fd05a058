"""Dataclasses as JSON and back, exactly: what was kept gives the same report as what was never kept.

report.json rounds, so that people can read it; this keeps every bit of every number, and what is no number. Types are
read off the annotations, so nothing in a file says which code is to run.

The text of a report is packed for the journal: to a tenth to a quarter of its length, and back to the last sign.

Long numbers have digits that nothing foretells, and texts are much alike from column to column. So the numbers are
taken out as doubles, and the rest is deflated against the text of a report of the sample floor, without its numbers:
``journal_words.json``, which ``python -m benchmarks.words`` makes.
"""

from __future__ import annotations

import base64
import json
import re
import struct
import zlib
from functools import cache
from pathlib import Path
from typing import TypeVar, get_origin

import msgspec
import numpy as np

Noun = TypeVar("Noun")


def to_exact_json(value: object) -> str:
    """A dataclass, or what such hold, as JSON on one line; numbers as the shortest text that gives them back."""
    plain = msgspec.to_builtins(value, str_keys=True, enc_hook=_plain)
    return json.dumps(plain, ensure_ascii=False, separators=(",", ":"))


def from_exact_json(kind: type[Noun], text: str) -> Noun:
    """The dataclass that :func:`to_exact_json` wrote.

    Raises
    ------
    ValueError
        For text that is no such dataclass: another version wrote it, or it is broken.
    """
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


LONGEST_TEXT_BYTES = 2**26
"""A column takes 50 KB, one with a hundred hoisting frames 2 MB; what unpacks to more is none of this program."""

_MARK = "\x01"  # stands in no JSON: there it is written as an escape
_LONG = re.compile(r"-?\d{1,20}\.\d{9,20}(?:e-?\d{1,3})?")  # a double takes eight bytes, and such a number ten and more
_DOUBLE_BYTES = 8  # of IEEE 754, binary64
_LEVEL = 6  # the best one saves a hundredth more, in twice the time


def pack(text: str) -> str:
    """Pack a text of JSON; what comes back holds signs of ASCII alone, no quotes and no backslashes."""
    numbers: list[float] = []

    def aside(found: re.Match[str]) -> str:
        value = float(found[0])
        if repr(value) != found[0]:
            return found[0]
        numbers.append(value)
        return _MARK

    words = _LONG.sub(aside, text)
    packer = zlib.compressobj(_LEVEL, zdict=_words())
    packed = packer.compress(words.encode(errors="surrogatepass")) + packer.flush()
    doubles = zlib.compress(struct.pack(f"<{len(numbers)}d", *numbers), _LEVEL)
    return f"{base64.b85encode(packed).decode()} {base64.b85encode(doubles).decode()}"


def unpack(packed: str) -> str:
    """The text that was packed.

    Raises
    ------
    ValueError
        For what :func:`pack` has not made.
    """
    parts = packed.split(" ")
    if len(parts) != 2:
        raise ValueError("two parts are expected")
    try:
        words = _inflated(parts[0], zlib.decompressobj(zdict=_words())).decode(errors="surrogatepass")
        doubles = _inflated(parts[1], zlib.decompressobj())
    except zlib.error as error:
        raise ValueError(str(error)) from error
    pieces, count = words.split(_MARK), len(doubles) // _DOUBLE_BYTES
    if len(doubles) % _DOUBLE_BYTES or len(pieces) != count + 1:
        raise ValueError(f"{len(pieces) - 1} numbers are missing, {count} are there")
    numbers = map(repr, struct.unpack(f"<{count}d", doubles))
    return "".join(part for pair in zip(pieces, (*numbers, ""), strict=True) for part in pair)


def words_of(text: str) -> str:
    """What is alike from report to report: the text without its long numbers."""
    return _LONG.sub("", text)


def _inflated(text: str, packer: zlib._Decompress) -> bytes:
    content = packer.decompress(base64.b85decode(text), LONGEST_TEXT_BYTES)
    if not packer.eof:
        raise ValueError("it breaks off, or is far too long")
    return content


@cache
def _words() -> bytes:
    path = Path(__file__).resolve().parents[1] / "journal_words.json"
    words: str = json.loads(path.read_text(encoding="utf-8"))
    return words.encode()
