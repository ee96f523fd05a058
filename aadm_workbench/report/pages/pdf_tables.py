"""Tables of a report on A4: columns as wide as they need, texts broken where they must, headings on every page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

from aadm_workbench.report.pages.pdf_canvas import Letters, area, fill, stroke
from aadm_workbench.report.pages.pdf_flow import Block
from aadm_workbench.report.pages.pdf_text import KEPT_TEXTS, lines_of, printable, shortened, width_of
from aadm_workbench.report.sheets.numbers import is_number, number_text
from aadm_workbench.report.sheets.tables import Cell, CellKind, Heading, Row
from aadm_workbench.report.words.labels import COLOUR, HEAD, INK, Language, phrase, rule_words, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

SIZE = 7.0
"""Of the letters, points: the smallest that is read on paper."""
_LEADING = 1.25 * SIZE  # points: lines of a cell do not touch
_PADDING = 2.6  # points: between text and line
_ABOVE, _BELOW = 1.4, 1.8  # points: between a text and the lines of its row
_NARROWEST = 30.0  # points: a column of a word of five letters
_LONGEST_CELL = (500, 20)
"""Characters and lines: in the narrowest column they fill less than a page."""
_FEWEST_ROWS = 3  # of a table that is cut, on either page

_STRIPE, _LINE, _FAIL_FILL, _UNVERIFIED = "#f6f8f9", "#d5dbe0", "#fbe3d7", "#8a4b00"


class TableCell(NamedTuple):
    """Lines of a cell, with their colour, and with one under them where it is to be seen."""

    lines: tuple[str, ...]
    colour: str = INK
    fill: str = ""


class TableRow(NamedTuple):
    """Cells beside each other, and the lines of the highest."""

    cells: tuple[TableCell, ...]
    lines: int

    @property
    def height(self) -> float:
        """With the room above and below its texts, pt."""
        return self.lines * _LEADING + _ABOVE + _BELOW


_Text: TypeAlias = tuple[str, str, str]
"""Where a text stands, as the page has it, and the text."""


@dataclass(frozen=True)
class Table:
    """Rows under a heading that every page repeats; ``first`` is the number of the first row, for the stripes."""

    head: TableRow
    rows: tuple[TableRow, ...]
    widths: tuple[float, ...]
    flush_right: tuple[bool, ...]
    first: int = 0
    keep: bool = False

    @property
    def height(self) -> float:
        """Of heading and rows, pt."""
        return self.head.height + sum(row.height for row in self.rows)

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Between two rows."""
        fit, used = 0, self.head.height
        for row in self.rows:
            used += row.height
            if used > room:
                break
            fit += 1
        fit = min(fit, len(self.rows) - _FEWEST_ROWS)
        if fit < _FEWEST_ROWS:
            return None
        return replace(self, rows=self.rows[:fit]), replace(self, rows=self.rows[fit:], first=self.first + fit)

    def shrunk(self, height: float) -> Block:
        """As many rows as fit: where the first one fills a page, its cells lose lines."""
        fit, used = 0, self.head.height
        for row in self.rows:
            used += row.height
            fit += used <= height
        return replace(self, rows=self.rows[: max(1, fit)])

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """Fills and lines first, then texts, those of a colour together."""
        width = sum(self.widths)
        y = top - self.head.height
        area(canvas, (x, y), width, top - y, HEAD)
        texts: dict[str, list[_Text]] = {}
        self._texts(texts, self.head, x, top, lift=True)
        stripes, lines = [], []
        for number, row in enumerate(self.rows, start=self.first):
            below = y - row.height
            if number % 2:
                stripes.append(f"{x:.2f} {below:.2f} {width:.2f} {y - below:.2f} re")
            lines.append(f"{x:.2f} {below:.2f} m {x + width:.2f} {below:.2f} l")
            self._texts(texts, row, x, y)
            y = below
        fill(canvas, stripes, _STRIPE)
        self._fills(canvas, x, top - self.head.height)
        stroke(canvas, lines, 0.3, _LINE)
        for colour, written in texts.items():
            letters = Letters(canvas, colour=colour)
            for left, base, text in written:
                letters.put_at(left, base, text, SIZE)
            letters.done()

    def _fills(self, canvas: Any, x: float, y: float) -> None:
        """Under the verdicts that one has to look at."""
        for row in self.rows:
            y -= row.height
            left = x
            for cell, width in zip(row.cells, self.widths, strict=True):
                if cell.fill:
                    area(canvas, (left, y), width, row.height, cell.fill)
                left += width

    def _texts(self, texts: dict[str, list[_Text]], row: TableRow, x: float, top: float, *, lift: bool = False) -> None:
        """Where each line of a row stands; headings stand on the foot of their row."""
        first = top - _ABOVE - SIZE
        heights = [f"{first - number * _LEADING:.2f}" for number in range(row.lines)]
        for cell, width, right in zip(row.cells, self.widths, self.flush_right, strict=True):
            start = f"{x + _PADDING:.2f}"
            x += width
            kept = texts.setdefault(cell.colour, [])
            for line, height in zip(cell.lines, heights[-len(cell.lines) :] if lift else heights, strict=False):
                left = f"{x - _PADDING - width_of(line, SIZE):.2f}" if right else start
                kept.append((left, height, line))


def table(headings: Sequence[Heading], rows: Sequence[Row], width: float, language: Language) -> Table:
    """A table of a report, at most ``width`` pt wide."""
    names = [heading.in_full().in_language(language) for heading in headings]
    kinds = [heading.kind for heading in headings]
    numbers = [is_number(kind) for kind in kinds]
    texts = [
        [
            _number(cell, kind) if number else _text(cell, kind, language)
            for cell, kind, number in zip(row, kinds, numbers, strict=True)
        ]
        for row in rows
    ]
    widths = _widths(names, texts, headings, width)
    rooms = [round(each - 2.0 * _PADDING, 1) for each in widths]
    head = _row([TableCell(_wrapped(name, room), "#ffffff") for name, room in zip(names, rooms, strict=True)])
    body = tuple(
        _row([_cell(*said) for said in zip(row, kinds, written, rooms, strict=True)])
        for row, written in zip(rows, texts, strict=True)
    )
    return Table(head, body, tuple(widths), tuple(numbers))


def _number(cell: Cell, kind: CellKind) -> str:
    return "" if cell is None or cell == "" else number_text(cell, kind)


def _row(cells: Sequence[TableCell]) -> TableRow:
    return TableRow(tuple(cells), max([len(cell.lines) for cell in cells]))


def _cell(cell: Cell, kind: CellKind, text: str, room: float) -> TableCell:
    """Numbers are as wide as their column or narrower; few of them are alike, and none is kept."""
    if isinstance(cell, str):
        return _words(cell, kind, text, room)
    return TableCell((text,) if width_of(text, SIZE) <= room else _wrapped(text, room))


@lru_cache(KEPT_TEXTS)
def _words(cell: str, kind: CellKind, text: str, room: float) -> TableCell:
    return TableCell(_wrapped(text, room), *_look(cell, kind))


def _look(cell: Cell, kind: CellKind) -> tuple[str, str]:
    """Colour of a cell's letters, and what lies under them."""
    if isinstance(cell, str) and cell:
        if kind == "verdict":
            return COLOUR[cell], _FAIL_FILL if cell == "fail" else ""
        if cell.endswith("unverified"):
            return _UNVERIFIED, ""
    return INK, ""


def _wrapped(text: str, room: float) -> tuple[str, ...]:
    return (printable(text),) if _width(text) <= room else lines_of(text, SIZE, room)


def _width(text: str) -> float:
    return width_of(text if text.isascii() else printable(text), SIZE)


@lru_cache(KEPT_TEXTS, typed=True)  # 1 and 1.0 are not written alike
def _text(cell: Cell, kind: CellKind, language: Language) -> str:
    if cell is None or cell == "":
        return ""
    if kind == "verdict":
        return verdict_words(str(cell), language)
    if kind == "rule":
        return rule_words(str(cell)).in_language(language)
    if kind == "source" or cell in ("sleeves", "rebars", "hoisting"):
        return phrase(f"ui.{cell}").in_language(language)
    return shortened(in_both_languages(str(cell)).in_language(language), *_LONGEST_CELL)


def _widths(names: list[str], texts: list[list[str]], headings: Sequence[Heading], width: float) -> list[float]:
    """As wide as the cells, headings may break; texts give way where the page is too narrow."""
    wanted = []
    for k, heading in enumerate(headings):
        cells = max([_width(text) for text in {row[k] for row in texts}], default=0.0)
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
