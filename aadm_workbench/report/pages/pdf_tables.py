"""Tables of a report on A4: columns as wide as they need, texts broken where they must, headings on every page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

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
        texts = _Texts(canvas)
        self._write(texts, self.head, x, top, lift=True)
        stripes, lines = [], []
        for number, row in enumerate(self.rows, start=self.first):
            below = y - row.height
            if number % 2:
                stripes.append(f"{x:.2f} {below:.2f} {width:.2f} {y - below:.2f} re")
            lines.append(f"{x:.2f} {below:.2f} m {x + width:.2f} {below:.2f} l")
            self._write(texts, row, x, y)
            y = below
        fill(canvas, stripes, _STRIPE)
        self._fills(canvas, x, top - self.head.height)
        stroke(canvas, lines, 0.3, _LINE)
        for letters in texts.values():
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

    def _write(self, texts: _Texts, row: TableRow, x: float, top: float, *, lift: bool = False) -> None:
        """Where each line of a row stands; headings stand on the foot of their row."""
        first = top - _ABOVE - SIZE
        heights = [f"{first - number * _LEADING:.2f}" for number in range(row.lines)]
        for cell, width, right in zip(row.cells, self.widths, self.flush_right, strict=True):
            start = f"{x + _PADDING:.2f}"
            x += width
            letters = texts[cell.colour]
            for line, height in zip(cell.lines, heights[-len(cell.lines) :] if lift else heights, strict=False):
                left = f"{x - _PADDING - width_of(line, SIZE):.2f}" if right else start
                letters.put_at(left, height, line, SIZE)


class _Texts(dict[str, Letters]):
    """Letters of a page by their colour."""

    def __init__(self, canvas: Any) -> None:
        super().__init__()
        self._canvas = canvas

    def __missing__(self, colour: str) -> Letters:
        self[colour] = letters = Letters(self._canvas, colour=colour)
        return letters


def table(headings: Sequence[Heading], rows: Sequence[Row], width: float, language: Language) -> Table:
    """A table of a report, at most ``width`` pt wide."""
    names = [heading.in_full().in_language(language) for heading in headings]
    kinds = [heading.kind for heading in headings]
    columns: list[Row] = list(zip(*rows, strict=True)) if rows else [()] * len(headings)
    texts = [_written(cells, kind, language) for cells, kind in zip(columns, kinds, strict=True)]
    widest = [max(map(_width, set(column)), default=0.0) for column in texts]
    widths = _widths(names, widest, headings, width)
    rooms = [round(each - 2.0 * _PADDING, 1) for each in widths]
    head = _row([TableCell(_wrapped(name, room), "#ffffff") for name, room in zip(names, rooms, strict=True)])
    body = [
        [_number(text) for text in written]
        if is_number(kind) and wide <= room
        else [_words(cell, kind, text, room) for cell, text in zip(cells, written, strict=True)]
        for cells, kind, written, wide, room in zip(columns, kinds, texts, widest, rooms, strict=True)
    ]
    return Table(head, tuple(map(_row, zip(*body, strict=True))), tuple(widths), tuple(map(is_number, kinds)))


def _written(cells: Row, kind: CellKind, language: Language) -> list[str]:
    """The cells of a column as texts."""
    if is_number(kind):
        return ["" if cell is None or cell == "" else number_text(cell, kind) for cell in cells]
    return [_text(cell, kind, language) for cell in cells]


def _row(cells: Sequence[TableCell]) -> TableRow:
    return TableRow(tuple(cells), max([len(cell.lines) for cell in cells]))


@lru_cache(KEPT_TEXTS)
def _number(text: str) -> TableCell:
    """A cell that is no wider than its column."""
    return TableCell((printable(text),))


@lru_cache(KEPT_TEXTS)
def _words(cell: Cell, kind: CellKind, text: str, room: float) -> TableCell:
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


def _widths(names: list[str], widest: list[float], headings: Sequence[Heading], width: float) -> list[float]:
    """As wide as the widest cells, headings may break; texts give way where the page is too narrow."""
    wanted = []
    for k, (heading, cells) in enumerate(zip(headings, widest, strict=True)):
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
