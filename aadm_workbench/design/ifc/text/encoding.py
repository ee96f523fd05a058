"""In which encoding a file's names are written: decided over all of them, by how likely each reading is."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

from aadm_workbench.design.ifc.words import COLUMN, NOT_REBAR, NOT_SLEEVE, REBAR, SLEEVE, find

ENCODINGS = ("utf-8", "gb18030", "cp950", "cp932", "cp949", "cp1252")
"""What programs write names in: UTF-8, Chinese (simplified, traditional), Japanese, Korean, Western European."""

CALLED = {"cp950": "big5", "cp932": "shift_jis", "cp949": "euc_kr"}
"""Names that people know; the code pages of Windows hold these with a few characters more."""

_PRIOR = {"utf-8": 2.0, "gb18030": 1.0, "cp949": -4.0}
"""Most programs write UTF-8, most of the others that write raw names are Chinese; a few names outweigh this."""

_BROKEN_BYTE = -12.0
"""Bytes that a reading cannot decode count more than the rarest character."""

_WORD = 10.0
"""A word of precast concrete in a reading: accidents hardly ever spell one."""

# a choice, not tuned since: natural logarithms, of a character of 10,000 and of one that no name holds
_RARE, _STRANGE = math.log(0.1 / 10000), -14.0
_LETTER, _KANA, _SYMBOL = math.log(0.9 / 50), math.log(0.9 / 90), -7.0
"""Log odds of one character: some 10,000 ideographs are rare, letters and kana are a few dozen."""

_AMONG_LETTERS = -6.0
"""Ideographs between two small Latin letters: an accented letter was torn apart."""

_FIRST_OF_RUN = -4.0
"""Half-width kana stand in runs."""

_ASCII = -3.5  # natural logarithm: one of some thirty letters
_CLOSE = 3.0
"""Differences in log likelihood below this leave the encoding open; the file's owner is told so."""

_MOST_NAMES = 2000
"""Distinct names that are weighed: what they do not tell, more do not tell either."""

_LEVEL_ONE = {
    "gb18030": ("gb2312", 0xB0, 0xD7, math.log(0.9 / 3755)),
    "cp950": ("big5", 0xA4, 0xC6, math.log(0.9 / 5401)),
    "cp932": ("shift_jis", 0x88, 0x98, math.log(0.9 / 2965)),
}
"""Lead bytes and log odds of the ideographs that GB 2312, Big5 and JIS X 0208 count as common (their level 1)."""

_HANGUL = math.log(0.9 / 2350)
"""KS X 1001 has so many syllables."""

_DOMAIN = (SLEEVE, NOT_SLEEVE, REBAR, NOT_REBAR, COLUMN)
_WESTERN_SIGNS = frozenset("°²³µØø×±½¼§©®«»–—„“”‘’…€·")


@dataclass(frozen=True)
class Evidence:
    """The likeliest encoding of some names, the others after it, and the runner-up where it comes close."""

    best: str
    ranked: tuple[str, ...]
    close: str | None = None


def weigh(names: Iterable[bytes], encodings: Sequence[str] = ENCODINGS, prior: str = "", odds: float = 0.0) -> Evidence:
    """The encoding in which names, none of mere ASCII, are most likely written.

    Parameters
    ----------
    names
        The bytes of names; what they share with other names counts once.
    encodings
        Those that are thought of.
    prior, odds
        One that is meant by the standard, and the log odds for it.
    """
    distinct = list(dict.fromkeys(names))[:_MOST_NAMES]
    scores = {
        encoding: _PRIOR.get(encoding, 0.0)
        + (odds if encoding == prior else 0.0)
        + sum(_likelihood(name, encoding) for name in distinct)
        for encoding in encodings
    }
    ranked = sorted(encodings, key=lambda encoding: -scores[encoding])
    near = scores[ranked[0]] - scores[ranked[1]] < _CLOSE
    differs = near and any(_read(name, ranked[0]) != _read(name, ranked[1]) for name in distinct)
    return Evidence(ranked[0], tuple(ranked), ranked[1] if differs else None)


def decoded(name: bytes, ranked: Sequence[str]) -> tuple[str, bool]:
    """A name in the first encoding that can hold it, and whether that is not the first of all; never fails."""
    for encoding in ranked:
        text = _read(name, encoding)
        if text is not None:
            return text, encoding != ranked[0]
    return name.decode("latin-1"), True


def _read(name: bytes, encoding: str) -> str | None:
    try:
        return name.decode(encoding)
    except UnicodeDecodeError:
        return None


def _likelihood(name: bytes, encoding: str) -> float:
    text = _read(name, encoding)
    if text is None:
        return sum(_BROKEN_BYTE if byte > 0x7F else _ASCII for byte in name)
    score = sum(_of_character(text, place, encoding) for place in range(len(text)))
    words = (find(pattern, text) for pattern in _DOMAIN)
    return score + _WORD * any(word is not None and not word.isascii() for word in words)


def _of_character(text: str, place: int, encoding: str) -> float:
    sign = text[place]
    if sign < "\x80":
        return _ASCII
    before, after = text[place - 1 : place], text[place + 1 : place + 2]
    own = _odds(sign, encoding)
    if unicodedata.category(sign) == "Lo" and not _is_half_width(sign):
        torn = _is_small_latin(before) and _is_small_latin(after)
        return own + (_AMONG_LETTERS if torn else 0.0)
    if _is_half_width(sign) and not _is_half_width(before):
        return own + _FIRST_OF_RUN
    if own == _LETTER:
        return own + _beside_latin(sign, before, after)
    return own


@lru_cache(maxsize=65536)
def _odds(sign: str, encoding: str) -> float:
    """Log odds of one character that is not ASCII, whatever stands beside it."""
    code = ord(sign)
    for is_one, odds in _SCRIPTS:
        if is_one(code):
            return odds
    if 0x4E00 <= code < 0xA000:
        return _of_ideograph(sign, encoding)
    if _is_half_width(sign):
        return _KANA
    if sign in _WESTERN_SIGNS:
        return -6.0
    if 0xC0 <= code < 0x180 and sign.isalpha():
        return _LETTER
    if sign in "ΦφØ" or 0x3000 <= code < 0x3040 or 0xFF00 <= code < 0xFFEF or 0x2000 <= code < 0x2700:
        return _SYMBOL
    return _STRANGE


# natural logarithms: a choice, not tuned since
_SCRIPTS: tuple[tuple[Callable[[int], bool], float], ...] = (
    (lambda code: 0x3040 <= code < 0x3100, _KANA),
    (lambda code: 0xAC00 <= code < 0xD7A4, _HANGUL),
    (lambda code: 0x80 <= code < 0xA0, _STRANGE),
    (lambda code: 0xE000 <= code < 0xF900, 2.0 * _STRANGE),
)


def _of_ideograph(sign: str, encoding: str) -> float:
    standards = [_LEVEL_ONE[encoding]] if encoding in _LEVEL_ONE else list(_LEVEL_ONE.values())
    held = False
    for codec, first, last, common in standards:
        try:
            lead = sign.encode(codec)[0]
        except UnicodeEncodeError:
            continue
        held = True
        if first <= lead <= last:
            return common
    return _RARE if held else _STRANGE


def _is_half_width(sign: str) -> bool:
    """Whether a sign is half-width kana, of which whatever is read as Shift-JIS is full."""
    return "\uff61" <= sign <= "\uff9f"


def _beside_latin(sign: str, before: str, after: str) -> float:
    """What speaks against an accented letter: others beside it, a capital among small letters, nothing of a word."""
    against = 0.0
    if (before and not before.isascii()) or (after and not after.isascii()):
        against -= 3.0
    if not ((before.isascii() and before.isalpha()) or (after.isascii() and after.isalpha())):
        against -= 5.0
    if sign.isupper():
        against -= 5.0 if _is_small_latin(before) else 1.5
    return against


def _is_small_latin(sign: str) -> bool:
    return sign.isascii() and sign.islower()
