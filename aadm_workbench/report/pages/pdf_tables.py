"""Tables of a report on A4: columns as wide as they need, texts broken where they must, headings on every page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import accumulate, pairwise
from typing import Any, NamedTuple

from aadm_workbench.report.pages.pdf_canvas import area, fill, stroke
from aadm_workbench.report.pages.pdf_flow import Block
from aadm_workbench.report.pages.pdf_letters import Letters, Shown
from aadm_workbench.report.pages.pdf_text import KEPT_TEXTS, lines_of, printable, shortened, thousandths_of
from aadm_workbench.report.sheets.numbers import is_number, number_texts
from aadm_workbench.report.sheets.tables import Cell, CellKind, Heading, Row
from aadm_workbench.report.words.labels import COLOUR, HEAD, INK, Language, phrase, rule_words, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

SIZE = 7.0
"""Of the letters, points: the smallest that is read on paper."""
_OF_THOUSAND = SIZE / 1000.0  # points of a thousandth of the letters' size
_LEADING = 1.25 * SIZE  # points: lines of a cell do not touch
_PADDING = 2.6  # points: between text and line
_ABOVE, _BELOW = 1.4, 1.8  # points: between a text and the lines of its row
_NARROWEST = 30.0  # points: a column of a word of five letters
_LONGEST_CELL = (500, 20)
"""Characters and lines: in the narrowest column they fill less than a page."""
_FEWEST_ROWS = 3  # of a table that is cut, on either page

_STRIPE, _LINE, _FAIL_FILL, _UNVERIFIED, _ON_HEAD = "#f6f8f9", "#d5dbe0", "#fbe3d7", "#8a4b00", "#ffffff"


class TableCell(NamedTuple):
    """Lines of a cell, with their colour, and with one under them where it is to be seen."""

    lines: tuple[str, ...]
    colour: str = INK
    fill: str = ""


class TableColumn(NamedTuple):
    """Cells below each other, of a width, pt; nearly all have one line, in ink."""

    head: tuple[str, ...]
    cells: tuple[TableCell, ...]
    width: float
    flush_right: bool
    one_line: bool
    in_ink: bool

    def operators(self, shown: Shown, lines: Sequence[str], x: float, heights: Sequence[str]) -> list[str]:
        """What puts lines of this column where they stand: one at each of these heights; empty where there is none."""
        if not self.flush_right:
            left = f"1 0 0 1 {x + _PADDING:.2f}"
            return [f"{left} {y} Tm {shown[line]}" if line else "" for line, y in zip(lines, heights, strict=False)]
        end = x + self.width - _PADDING
        return [
            f"1 0 0 1 {end - thousandths_of(line) * _OF_THOUSAND:.2f} {y} Tm {shown[line]}" if line else ""
            for line, y in zip(lines, heights, strict=False)
        ]


@dataclass(frozen=True)
class Table:
    """Rows of heights, pt, under a heading that every page repeats; ``first`` is the number of the first row."""

    columns: tuple[TableColumn, ...]
    heights: tuple[float, ...]
    first: int = 0
    keep: bool = False

    @property
    def height(self) -> float:
        """Of heading and rows, pt."""
        return self._head_height + sum(self.heights)

    @property
    def _head_height(self) -> float:
        return _height_of(max([len(column.head) for column in self.columns]))

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Between two rows."""
        fit = min(self._fitting(room), len(self.heights) - _FEWEST_ROWS)
        return None if fit < _FEWEST_ROWS else (self._cut(0, fit), self._cut(fit, len(self.heights)))

    def shrunk(self, height: float) -> Block:
        """As many rows as fit: where the first one fills a page, its cells lose lines."""
        return self._cut(0, max(1, self._fitting(height)))

    def _fitting(self, room: float) -> int:
        """So many rows are no higher than that together with the heading."""
        ends = accumulate(self.heights, initial=self._head_height)
        return sum(end <= room for end in ends) - 1

    def _cut(self, start: int, end: int) -> Table:
        columns = tuple([column._replace(cells=column.cells[start:end]) for column in self.columns])
        return replace(self, columns=columns, heights=self.heights[start:end], first=self.first + start)

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """Fills and lines first, then texts, those of a colour together."""
        width = sum([column.width for column in self.columns])
        head = top - self._head_height
        edges = [head - below for below in accumulate(self.heights, initial=0.0)]
        area(canvas, (x, head), width, top - head, HEAD)
        rows = enumerate(pairwise(edges), start=self.first)
        stripes = [f"{x:.2f} {low:.2f} {width:.2f} {high - low:.2f} re" for number, (high, low) in rows if number % 2]
        fill(canvas, stripes, _STRIPE)
        self._fills(canvas, x, edges)
        stroke(canvas, [f"{x:.2f} {low:.2f} m {x + width:.2f} {low:.2f} l" for low in edges[1:]], 0.3, _LINE)
        self._heads(canvas, x, head)
        self._texts(canvas, x, edges)

    def _fills(self, canvas: Any, x: float, edges: Sequence[float]) -> None:
        """Under the verdicts that one has to look at."""
        for column in self.columns:
            if not column.in_ink:
                for cell, (high, low) in zip(column.cells, pairwise(edges), strict=True):
                    if cell.fill:
                        area(canvas, (x, low), column.width, high - low, cell.fill)
            x += column.width

    def _heads(self, canvas: Any, x: float, foot: float) -> None:
        """Headings stand on the foot of their row."""
        letters = Letters(canvas, colour=_ON_HEAD)
        shown = letters.of_size(SIZE)
        for column in self.columns:
            lines = column.head
            first = foot + _height_of(len(lines)) - _ABOVE - SIZE
            letters.add(column.operators(shown, lines, x, _heights(first, len(lines))))
            x += column.width
        letters.done()

    def _texts(self, canvas: Any, x: float, edges: Sequence[float]) -> None:
        """Row by row, for who copies a table wants its rows; what has a colour of its own behind the others."""
        letters = {INK: Letters(canvas)}
        shown = letters[INK].of_size(SIZE)
        firsts = [high - _ABOVE - SIZE for high in edges[:-1]]
        heights = [f"{first:.2f}" for first in firsts]
        placed: list[Sequence[str]] = []
        for column in self.columns:
            if column.one_line:
                operators = column.operators(shown, [cell.lines[0] for cell in column.cells], x, heights)
            else:
                operators = [
                    "\n".join(column.operators(shown, cell.lines, x, _heights(first, len(cell.lines))))
                    for cell, first in zip(column.cells, firsts, strict=True)
                ]
            for colour, coloured in () if column.in_ink else _by_colour(column.cells, operators):
                if colour == INK:
                    operators = coloured
                    continue
                if colour not in letters:
                    letters[colour] = Letters(canvas, colour=colour)
                    letters[colour].of_size(SIZE)
                letters[colour].add(filter(None, coloured))
            placed.append(operators)
            x += column.width
        letters[INK].add([operators for row in zip(*placed, strict=True) for operators in row if operators])
        for each in letters.values():
            each.done()


def _by_colour(cells: Sequence[TableCell], operators: Sequence[str]) -> Iterator[tuple[str, list[str]]]:
    """What is written in each colour, empty in the other rows; ink first, even where nothing is written in it."""
    for colour in dict.fromkeys([INK, *(cell.colour for cell in cells)]):
        yield colour, [each if cell.colour == colour else "" for cell, each in zip(cells, operators, strict=True)]


def _heights(first: float, number: int) -> list[str]:
    """Of the lines of a cell."""
    return [f"{first - line * _LEADING:.2f}" for line in range(number)]


def _height_of(lines: int) -> float:
    """Of a row of so many lines, with the room above and below them, pt."""
    return lines * _LEADING + _ABOVE + _BELOW


def table(headings: Sequence[Heading], rows: Sequence[Row], width: float, language: Language) -> Table:
    """A table of a report, at most ``width`` pt wide."""
    names = [heading.in_full().in_language(language) for heading in headings]
    kinds = [heading.kind for heading in headings]
    columns: list[Row] = list(zip(*rows, strict=True)) if rows else [()] * len(headings)
    texts = [_written(cells, kind, language) for cells, kind in zip(columns, kinds, strict=True)]
    widest = [max(map(_width, column), default=0.0) for column in texts]
    widths = _widths(names, widest, headings, width)
    parts = zip(kinds, columns, texts, widest, strict=True)
    made = [
        _column(_wrapped(name, round(each - 2.0 * _PADDING, 1)), each, *part)
        for name, each, part in zip(names, widths, parts, strict=True)
    ]
    return Table(tuple(made), _row_heights(made, len(rows)))


def _column(
    head: tuple[str, ...], width: float, kind: CellKind, cells: Row, texts: list[str], widest: float
) -> TableColumn:
    room = round(width - 2.0 * _PADDING, 1)
    number = is_number(kind)
    if number and widest <= room:
        return TableColumn(head, tuple(map(_number, texts)), width, number, one_line=True, in_ink=True)
    made = tuple([_words(cell, kind, text, room) for cell, text in zip(cells, texts, strict=True)])
    one_line = all(len(cell.lines) == 1 for cell in made)
    return TableColumn(head, made, width, number, one_line, in_ink=all(cell.colour == INK for cell in made))


def _row_heights(columns: Sequence[TableColumn], rows: int) -> tuple[float, ...]:
    """Of the lines of the highest cell of each row, pt."""
    lines = [1] * rows
    for column in columns:
        if not column.one_line:
            lines = [max(most, len(cell.lines)) for most, cell in zip(lines, column.cells, strict=True)]
    return tuple([_height_of(most) for most in lines])


def _written(cells: Row, kind: CellKind, language: Language) -> list[str]:
    """The cells of a column as texts."""
    return number_texts(cells, kind) if is_number(kind) else [_text(cell, kind, language) for cell in cells]


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


@lru_cache(KEPT_TEXTS)
def _width(text: str) -> float:
    return thousandths_of(printable(text)) * _OF_THOUSAND


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
        words = max(map(_width, names[k].split()), default=0.0)
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
