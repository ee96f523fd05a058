"""The text of a report, packed for the journal: an eighth of its length, and back to the last sign.

Numbers have digits that nothing foretells, and texts are much alike from column to column. So numbers are taken out as
what they are over a thousandth, a millionth and so on, and the rest is deflated against the text of a report of the
sample floor, without its numbers: ``journal_words.json``, which ``python -m benchmarks.words`` makes.
"""

from __future__ import annotations

import json
import re
import struct
import zlib
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

LONGEST_TEXT_BYTES = 2**26
"""A column takes 50 KB, one with a hundred hoisting frames 2 MB; what unpacks to more is none of this program."""

_KINDS: dict[str, tuple[int | None, str]] = {
    "\x01": (4, "I"),
    "\x02": (6, "I"),
    "\x03": (9, "Q"),
    "\x04": (12, "Q"),
    "\x05": (None, "d"),
}
"""By the mark in the text, which stands in no JSON, for there it is written as an escape: decimals, and the form.

Lengths in reports have four decimals, angles and ratios six, directions nine, others nine digits; the rest are doubles.
"""

_DOUBLE = "\x05"
_MARK = re.compile("[\x01-\x05]")
_NUMBER = re.compile(r"-?\d{1,15}\.(\d{2,20})(?:e-?\d{1,3})?")  # a shorter one is best told where it stands
_LEVEL = 9  # a seventh more time than the usual one, once for each column that is measured, and a hundredth less

_SIGNS = np.frombuffer(
    b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;<=>?@^_`{|}~", dtype=np.uint8
)
"""Of base 85, as RFC 1924 and ``base64.b85encode`` have it: four bytes in five signs, each of them one byte in JSON."""

_NO_SIGN = 255  # no digit is as large
_DIGITS = np.full(256, _NO_SIGN, dtype=np.uint8)  # one for each byte
_DIGITS[_SIGNS] = np.arange(len(_SIGNS))
_PLACES = len(_SIGNS) ** np.arange(4, -1, -1)  # of five digits, the highest first


def pack(text: str) -> str:
    """Pack a text of JSON; what comes back holds signs of ASCII alone, no quotes and no backslashes."""
    found: dict[str, list[Any]] = {mark: [] for mark in _KINDS}

    def aside(number: re.Match[str]) -> str:
        value = float(number[0])
        if repr(value) != number[0]:
            return number[0]
        for mark, (decimals, form) in _KINDS.items():
            if decimals is not None and len(number[1]) <= decimals and "e" not in number[0]:
                count = _in_units(number[0], decimals)
                if count < 256 ** struct.calcsize(form) and repr(_of_units([count], 10**decimals)[0]) == number[0]:
                    found[mark].append(count)
                    return mark
        found[_DOUBLE].append(value)
        return _DOUBLE

    words = _NUMBER.sub(aside, text)
    packer = zlib.compressobj(_LEVEL, zdict=_words())
    packed = packer.compress(words.encode(errors="surrogatepass")) + packer.flush()
    numbers = b"".join(_gathered(found[mark], form) for mark, (_, form) in _KINDS.items())
    return f"{in_signs(packed)} {in_signs(zlib.compress(numbers, _LEVEL))}"


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
        numbers = _inflated(parts[1], zlib.decompressobj())
    except zlib.error as error:
        raise ValueError(str(error)) from error
    pieces, marks = _MARK.split(words), _MARK.findall(words)
    told = _told(numbers, marks)
    found = [""] * (2 * len(marks) + 1)
    found[::2], found[1::2] = pieces, [next(told[mark]) for mark in marks]
    return "".join(found)


def words_of(text: str) -> str:
    """What is alike from report to report: the text without its numbers."""
    return _NUMBER.sub("", text)


def _told(numbers: bytes, marks: Sequence[str]) -> dict[str, Iterator[str]]:
    """The texts of the numbers that stand for each mark, in their order."""
    told: dict[str, Iterator[str]] = {}
    place = 0
    for mark, (decimals, form) in _KINDS.items():
        found, place = _spread(numbers, place, form, marks.count(mark))
        values = found if decimals is None else _of_units(found, 10**decimals)
        told[mark] = map(repr, values)
    if place != len(numbers):
        raise ValueError(f"{len(numbers) - place} bytes are too many")
    return told


def _in_units(text: str, decimals: int) -> int:
    """A number without its point, not negative: twice as much, and one less for what is below zero."""
    whole, _, part = text.partition(".")
    count = int(whole + part.ljust(decimals, "0"))
    return -2 * count - 1 if count < 0 else 2 * count


def _of_units(counts: Sequence[int], unit: int) -> list[float]:
    return [(-(count + 1) // 2 if count & 1 else count // 2) / unit for count in counts]


def _gathered(values: Sequence[Any], form: str) -> bytes:
    """The lowest bytes of all numbers, then the next ones: the highest are much alike."""
    content = struct.pack(f"<{len(values)}{form}", *values)
    size = struct.calcsize(form)
    return b"".join(content[byte::size] for byte in range(size))


def _spread(numbers: bytes, place: int, form: str, count: int) -> tuple[Sequence[Any], int]:
    """So many numbers that :func:`_gathered` has written at a place, and the place behind them."""
    size = struct.calcsize(form)
    end = place + size * count
    if end > len(numbers):
        raise ValueError("numbers are missing")
    content = bytearray(size * count)
    for byte in range(size):
        content[byte::size] = numbers[place + byte * count : place + (byte + 1) * count]
    return struct.unpack(f"<{count}{form}", content), end


def _inflated(text: str, packer: zlib._Decompress) -> bytes:
    content = packer.decompress(_of_signs(text), LONGEST_TEXT_BYTES)
    if not packer.eof:
        raise ValueError("it breaks off, or is far too long")
    return content


def in_signs(content: bytes) -> str:
    """Bytes as signs of base 85; numpy takes a twentieth of the time that the standard library does."""
    left = -len(content) % 4
    quads = np.frombuffer(content + bytes(left), dtype=">u4").astype(np.int64)
    signs: bytes = _SIGNS[quads[:, np.newaxis] // _PLACES % len(_SIGNS)].tobytes()
    return signs[: len(signs) - left].decode()


def _of_signs(text: str) -> bytes:
    """The bytes that :func:`in_signs` was given."""
    left = -len(text) % 5
    digits = _DIGITS[np.frombuffer(text.encode("ascii", "replace") + b"~" * left, dtype=np.uint8)].reshape(-1, 5)
    quads = digits.astype(np.int64) @ _PLACES
    if (digits == _NO_SIGN).any() or (quads >= 2**32).any():
        raise ValueError("there are signs that no bytes are written in")
    content: bytes = quads.astype(">u4").tobytes()
    return content[: len(content) - left]


@cache
def _words() -> bytes:
    path = Path(__file__).resolve().parents[1] / "journal_words.json"
    words: str = json.loads(path.read_text(encoding="utf-8"))
    return words.encode()
