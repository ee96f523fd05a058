"""The exact text of a report, packed for the journal: a tenth to a quarter of its length, and back to the last sign.

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
