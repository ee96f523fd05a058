"""Text for PDF pages: one font that knows Latin and Chinese, its widths, and lines that break in both."""

from __future__ import annotations

import re
from functools import cache, lru_cache
from importlib import import_module
from typing import Any

from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.pages.fonts import FONT_FILE

FONT = "AADM"

_CHINESE = r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef\u3000-\u303f]"
_NEVER_FIRST = "。，、；：！？）》」』】〕%,;:!?)"
_NEVER_LAST = "（《「『【〔("
_TOKEN = re.compile(rf"{_CHINESE}|[^\s\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef\u3000-\u303f]+|\s+")
_INSTEAD = str.maketrans({"✗": "×", "○": "o", "\t": " ", "\u00a0": " "})
_UNKNOWN = "□"


KEPT_TEXTS = 50_000
"""Widths of so many are kept: a report repeats its numbers and names."""


@cache
def reportlab(module: str, needed_for: str = "a PDF report") -> Any:
    """A module of reportlab.

    Raises
    ------
    MissingDependencyError
        Where reportlab is not installed.
    """
    try:
        # Streams of text as ASCII are a quarter longer, and take a third of the time.
        setattr(import_module("reportlab.rl_config"), "useA85", 0)  # noqa: B010 - the module declares it elsewhere
        return import_module(f"reportlab.{module}")
    except ImportError as error:
        raise MissingDependencyError("reportlab", needed_for) from error


@cache
def prepared_font() -> Any:
    """The font, known to reportlab under its name from now on."""
    metrics, fonts = reportlab("pdfbase.pdfmetrics"), reportlab("pdfbase.ttfonts")
    font = fonts.TTFont(FONT, str(FONT_FILE), asciiReadable=1)
    metrics.registerFont(font)
    return font


@lru_cache(KEPT_TEXTS)
def printable(text: str) -> str:
    """A text in signs that the font has; what it lacks becomes an empty box."""
    if text.isascii() and text.isprintable():
        return text  # the font has all of these
    known = prepared_font().face.charToGlyph
    return "".join(sign if ord(sign) in known or sign == "\n" else _UNKNOWN for sign in text.translate(_INSTEAD))


def width_of(text: str, size: float) -> float:
    """Width of one line, pt."""
    return thousandths_of(text) * size / 1000.0


@lru_cache(KEPT_TEXTS)
def thousandths_of(text: str) -> float:
    """Width of one line of printable signs, thousandths of its size."""
    widths = _widths()
    return sum([widths[sign] for sign in text])


@cache
def _widths() -> _Widths:
    return _Widths()


class _Widths(dict[str, float]):
    """Widths of signs in thousandths of their size, each looked up once."""

    def __missing__(self, sign: str) -> float:
        face = prepared_font().face
        self[sign] = width = float(face.charWidths.get(ord(sign), face.defaultWidth))
        return width


def shortened(text: str, most: int, most_lines: int) -> str:
    """A text of at most so many characters and lines: it comes from the files of others, and must fit on a page."""
    lines = text.split("\n", most_lines)
    kept = "\n".join(lines[:most_lines])
    return text if len(kept) == len(text) <= most else f"{kept[: most - 1]}…"


@lru_cache(KEPT_TEXTS)
def lines_of(text: str, size: float, width: float) -> tuple[str, ...]:
    """A text broken into lines of a width, pt: between words, between Chinese characters, in words too long."""
    lines: list[str] = []
    for paragraph in printable(text).split("\n"):
        if width_of(paragraph, size) <= width:
            lines.append(paragraph.strip())
            continue
        line, used = "", 0.0
        for piece in (part for token in _TOKEN.findall(paragraph) for part in _pieces(token, size, width)):
            wide = width_of(piece, size)
            if line and used + wide > width:
                keep = _break(line, piece)
                lines.append(line[:keep].rstrip())
                line = line[keep:]
                used = width_of(line, size)
            piece = piece if line else piece.lstrip()
            line, used = line + piece, used + (wide if piece else 0.0)
        lines.append(line.rstrip())
    return tuple(lines)


def _break(line: str, piece: str) -> int:
    """Where a line ends that a piece does not fit on: signs that never stand first, or last, take others along.

    What is taken along is a word, "mm" in one piece; of a word that fills the line, its last letter.
    """
    keep, first = len(line), piece
    words = _TOKEN.findall(line)
    while first in _NEVER_FIRST and len(words) > 1:
        first = words.pop()
        keep -= len(first)
    if first in _NEVER_FIRST:
        keep = max(1, keep - 1)
    while keep > 1 and line[keep - 1] in _NEVER_LAST:
        keep -= 1
    return keep


def _pieces(token: str, size: float, width: float) -> list[str]:
    """A word that is wider than the line, cut."""
    if width_of(token, size) <= width:
        return [token]
    pieces, piece = [], ""
    for sign in token:
        if piece and width_of(piece + sign, size) > width:
            pieces.append(piece)
            piece = ""
        piece += sign
    return [*pieces, piece]
