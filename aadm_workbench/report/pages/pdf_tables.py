"""Tables of a report on A4: columns as wide as they need, texts broken where they must, headings on every page."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from aadm_workbench.report.pages.pdf_canvas import lines_of, prepare_font, printable, reportlab, shortened, width_of
from aadm_workbench.report.sheets.numbers import is_number, number_text
from aadm_workbench.report.sheets.tables import Cell, Heading, Row
from aadm_workbench.report.words.labels import COLOUR, HEAD, Language, phrase, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

SIZE = 7.0
"""Of the letters, points: the smallest that is read on paper."""
_PADDING = 2.6  # points: between text and line
_NARROWEST = 30.0  # points: a column of a word of five letters
_LONGEST_CELL = (500, 20)
"""Characters and lines: in the narrowest column they fill less than a page."""

_STRIPE, _LINE, _FAIL_FILL = "#f6f8f9", "#d5dbe0", "#fbe3d7"


def table_flowable(headings: Sequence[Heading], rows: Sequence[Row], width: float, language: Language) -> Any:
    """A reportlab table, at most ``width`` pt wide."""
    names = [heading.in_full().in_language(language) for heading in headings]
    texts = [[_text(cell, heading, language) for cell, heading in zip(row, headings, strict=True)] for row in rows]
    widths = _widths(names, texts, headings, width)
    wide = [_wrapped(names, widths), *(_wrapped(row, widths) for row in texts)]
    platypus: Any = reportlab("platypus")
    table = platypus.Table(wide, colWidths=widths, repeatRows=1, hAlign="LEFT")
    table.setStyle(platypus.TableStyle([*_look(headings), *_verdict_colours(headings, rows)]))
    return table


def _text(cell: Cell, heading: Heading, language: Language) -> str:
    if cell is None or cell == "":
        return ""
    if is_number(heading.kind):
        return number_text(cell, heading.kind)
    if heading.kind == "verdict":
        return verdict_words(str(cell), language)
    if heading.kind == "source" or cell in ("sleeves", "rebars", "hoisting"):
        return phrase(f"ui.{cell}").in_language(language)
    return shortened(in_both_languages(str(cell)).in_language(language), *_LONGEST_CELL)


@lru_cache(maxsize=20_000)
def _width(text: str) -> float:
    return width_of(printable(text), SIZE)


def _widths(names: list[str], texts: list[list[str]], headings: Sequence[Heading], width: float) -> list[float]:
    """As wide as the cells, headings may break; texts give way where the page is too narrow."""
    wanted = []
    for k, heading in enumerate(headings):
        cells = max((_width(row[k]) for row in texts), default=0.0)
        words = max((_width(word) for word in names[k].split()), default=0.0)
        head = words if heading.kind != "text" else min(_width(names[k]), max(words, cells))
        wanted.append(max(cells, min(head, 60.0)) + 2.0 * _PADDING + 1.0)
    excess = sum(wanted) - width
    if excess > 0.0:
        soft = [max(0.0, w - _NARROWEST) if h.kind == "text" else 0.0 for w, h in zip(wanted, headings, strict=True)]
        # What is widest gives first: a long reason breaks before a label does.
        weight = [value**2 for value in soft]
        total = sum(weight) or 1.0
        wanted = [w - min(s, excess * g / total) for w, s, g in zip(wanted, soft, weight, strict=True)]
    factor = min(1.0, width / sum(wanted))
    return [w * factor for w in wanted]


def _wrapped(texts: Sequence[str], widths: Sequence[float]) -> list[str]:
    return [
        printable(text)
        if _width(text) <= room - 2.0 * _PADDING
        else "\n".join(lines_of(text, SIZE, room - 2.0 * _PADDING))
        for text, room in zip(texts, widths, strict=True)
    ]


def _look(headings: Sequence[Heading]) -> list[tuple[Any, ...]]:
    colour = reportlab("lib.colors").HexColor
    font = prepare_font()
    look: list[tuple[Any, ...]] = [
        ("FONT", (0, 0), (-1, -1), font, SIZE, SIZE * 1.25),
        ("BACKGROUND", (0, 0), (-1, 0), colour(HEAD)),
        ("TEXTCOLOR", (0, 0), (-1, 0), colour("#ffffff")),
        ("VALIGN", (0, 0), (-1, 0), "BOTTOM"),
        ("VALIGN", (0, 1), (-1, -1), "TOP"),
        ("LINEBELOW", (0, 1), (-1, -1), 0.3, colour(_LINE)),
        ("ROWBACKGROUNDS", (0, 1), (-1, -1), [colour("#ffffff"), colour(_STRIPE)]),
        ("LEFTPADDING", (0, 0), (-1, -1), _PADDING),
        ("RIGHTPADDING", (0, 0), (-1, -1), _PADDING),
        ("TOPPADDING", (0, 0), (-1, -1), 1.4),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 1.8),
    ]
    look += [("ALIGN", (k, 0), (k, -1), "RIGHT") for k, heading in enumerate(headings) if is_number(heading.kind)]
    return look


def _verdict_colours(headings: Sequence[Heading], rows: Sequence[Row]) -> list[tuple[Any, ...]]:
    colour = reportlab("lib.colors").HexColor
    found: list[tuple[Any, ...]] = []
    for k, heading in enumerate(headings):
        for number, row in enumerate(rows, start=1):
            cell = row[k]
            if heading.kind == "verdict" and isinstance(cell, str) and cell:
                found.append(("TEXTCOLOR", (k, number), (k, number), colour(COLOUR[cell])))
                if cell == "fail":
                    found.append(("BACKGROUND", (k, number), (k, number), colour(_FAIL_FILL)))
            if isinstance(cell, str) and cell.endswith("unverified"):
                found.append(("TEXTCOLOR", (k, number), (k, number), colour("#8a4b00")))
    return found
