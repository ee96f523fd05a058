"""Texts on a PDF page, as operators of PDF: those of a document that repeat are put together once.

A text is shown with the font's first subset in force, in which reportlab gives each sign of ASCII its own code, and
leaves that in force: so whatever was written before, the same text needs the same operators.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from itertools import groupby
from typing import Any

from aadm_workbench.report.pages.pdf_text import KEPT_TEXTS, prepared_font, reportlab
from aadm_workbench.report.words.labels import INK

_BOLD_STROKE = 0.028  # of the size: letters are drawn with an outline of that width, since the font has no bold cut
_ESCAPED = str.maketrans({sign: f"\\{sign}" for sign in "()\\"})  # in a string of PDF (ISO 32000-1, 7.3.4.2)


class Letters:
    """Texts of one colour, written with as few operators as they need."""

    def __init__(self, canvas: Any, *, colour: str = INK, bold: bool = False) -> None:
        self._canvas = canvas
        self._written = [f"BT {paint(colour)} rg"]
        self._bold = bold
        self._size = 0.0
        self._shown = shown_of(canvas, self._size)
        if bold:
            self._written.append(f"[] 0 d {paint(colour)} RG 2 Tr")

    def put(self, x: float, y: float, text: str, size: float) -> None:
        """A text of printable signs, its base line at (x, y)."""
        if text:
            self.of_size(size)
            self._written.append(f"1 0 0 1 {x:.2f} {y:.2f} Tm {self._shown[text]}")

    def of_size(self, size: float) -> Shown:
        """What shows texts of a size, which is in force from now on."""
        if size != self._size:
            self._size, self._shown = size, shown_of(self._canvas, size)
            self._written.append(self._shown.first)
            if self._bold:
                self._written.append(f"{size * _BOLD_STROKE:.3f} w")
        return self._shown

    def add(self, operators: Iterable[str]) -> None:
        """Texts of the size in force: each its place (``Tm``) and what shows it."""
        self._written += operators

    def done(self) -> None:
        """Put them onto the page."""
        self._canvas.addLiteral("\n".join([*self._written, "0 Tr ET" if self._bold else "ET"]))


class Shown(dict[str, str]):
    """Operators that show texts of a size, each put together once as long as not too many are kept."""

    def __init__(self, canvas: Any, size: float) -> None:
        super().__init__()
        self._canvas, self._size = canvas, size
        self.first = f"{_first_subset(canvas)} {size:g} Tf"

    def __missing__(self, text: str) -> str:
        if len(self) >= KEPT_TEXTS:
            self.clear()
        shown = f"({text.translate(_ESCAPED)}) Tj" if text.isascii() else self._of_subsets(text)
        self[text] = shown
        return shown

    def _of_subsets(self, text: str) -> str:
        """In the subsets that have its signs, and back to the first."""
        signs = _signs(self._canvas)
        parts, in_force = [], self.first
        for name, group in groupby([signs[sign] for sign in text], key=lambda sign: sign[0]):
            font = f"{name} {self._size:g} Tf"
            if font != in_force:
                parts.append(font)
            in_force = font
            parts.append(f"({''.join([sign[1] for sign in group])}) Tj")
        if in_force != self.first:
            parts.append(self.first)
        return " ".join(parts)


def shown_of(canvas: Any, size: float) -> Shown:
    """What shows texts of a size in the document of a canvas."""
    kept: dict[float, Shown] = canvas.__dict__.setdefault("aadm_shown", {})
    found = kept.get(size)
    if found is None:
        found = kept[size] = Shown(canvas, size)
    return found


class _Signs(dict[str, tuple[str, str]]):
    """Signs of a document: the name of the subset that has one, and its escaped byte there."""

    def __init__(self, canvas: Any) -> None:
        super().__init__()
        self._document = canvas._doc

    def __missing__(self, sign: str) -> tuple[str, str]:
        font = prepared_font()
        ((subset, code),) = font.splitString(sign, self._document)
        name = font.getSubsetInternalName(subset, self._document)
        self[sign] = found = name, reportlab("lib.rl_accel").escapePDF(code)
        return found


def _signs(canvas: Any) -> _Signs:
    kept: _Signs | None = canvas.__dict__.get("aadm_signs")
    if kept is None:
        kept = canvas.__dict__["aadm_signs"] = _Signs(canvas)
    return kept


def _first_subset(canvas: Any) -> str:
    """Its name; every document has it, for all signs of ASCII are in it."""
    return _signs(canvas)["0"][0]


@cache
def paint(colour: str) -> str:
    """``#1d2730`` as three numbers."""
    return " ".join(f"{int(colour[k : k + 2], 16) / 255.0:.3f}" for k in (1, 3, 5))
