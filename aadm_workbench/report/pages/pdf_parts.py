"""Paragraphs, drawings and bands of report.pdf, in the one font that the reports have."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from aadm_workbench.report.drawing.sketch import Sketch
from aadm_workbench.report.pages.pdf_canvas import area, draw_sketch, rule
from aadm_workbench.report.pages.pdf_flow import Block
from aadm_workbench.report.pages.pdf_letters import Letters
from aadm_workbench.report.pages.pdf_text import lines_of, shortened
from aadm_workbench.report.words.labels import COLOUR, FAINT, INK

_LONGEST_PARAGRAPH, _LONGEST_KEPT, _LONGEST_BAND = (4000, 100), (600, 10), (250, 3)
"""Characters and lines: what fills a page or two, what may be held together with what follows, what a band holds."""
_LEADING = 1.35  # of the size
_FEWEST_LINES = 2  # of a paragraph that is cut, on either page


class Paragraph(NamedTuple):
    """Lines of a text; with a bookmark they are found, with an outline level they stand in the table of contents."""

    lines: tuple[str, ...]
    size: float
    colour: str
    bold: bool
    indent: float
    after: float
    outline: int | None
    bookmark: str
    link: str
    keep: bool
    title: str

    @property
    def height(self) -> float:
        """Of its lines, and the room behind them, pt."""
        return len(self.lines) * self.size * _LEADING + self.after

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Between two lines."""
        fit = min(int(room / (self.size * _LEADING)), len(self.lines) - _FEWEST_LINES)
        if fit < _FEWEST_LINES or self.keep:
            return None
        rest = self._replace(lines=self.lines[fit:], outline=None, bookmark="")
        return self._replace(lines=self.lines[:fit], after=0.0), rest

    def shrunk(self, height: float) -> Block:
        """As many lines as fit."""
        return self._replace(lines=self.lines[: max(1, int(height / (self.size * _LEADING)))], after=0.0)

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """Its lines, its bookmark, its link."""
        if any(self.lines):  # what but keeps others apart has none
            letters = Letters(canvas, colour=self.colour, bold=self.bold)
            y = top - self.size * (_LEADING - 0.25)
            for line in self.lines:
                letters.put(x + self.indent, y, line, self.size)
                y -= self.size * _LEADING
            letters.done()
        if self.bookmark:
            canvas.bookmarkHorizontal(self.bookmark, 0, top + self.size)
        if self.outline is not None:
            canvas.addOutlineEntry(self.title, self.bookmark, level=self.outline, closed=self.outline == 0)
        if self.link:
            canvas.linkRect("", self.link, (x, top - self.height, x + 300.0, top), thickness=0)


def paragraph(
    text: str,
    width: float,
    size: float = 9.0,
    *,
    colour: str = INK,
    bold: bool = False,
    indent: float = 0.0,
    after: float = 3.0,
    outline: int | None = None,
    bookmark: str = "",
    link: str = "",
    keep: bool = False,
) -> Paragraph:
    """A text broken to a width; ``outline`` is its level in the table of contents.

    ``keep`` holds it together with what follows, as headings are.
    """
    keep = keep or outline is not None
    text = shortened(text, *(_LONGEST_KEPT if keep else _LONGEST_PARAGRAPH))
    lines = lines_of(text, size, width - indent)
    return Paragraph(lines, size, colour, bold, indent, after, outline, bookmark, link, keep, text)


@dataclass(frozen=True)
class Drawing:
    """A sketch of a width, pt; it is never cut."""

    sketch: Sketch
    width: float
    keep: bool = False

    @property
    def height(self) -> float:
        """By its proportions."""
        return self.width * self.sketch.height / self.sketch.width + 4.0

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Never."""
        return None

    def shrunk(self, height: float) -> Block:
        """The whole sketch, smaller."""
        return replace(self, width=min(self.width, (height - 4.0) * self.sketch.width / self.sketch.height))

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """The sketch."""
        draw_sketch(canvas, self.sketch, (x, top - self.height + 4.0), self.width)


@dataclass(frozen=True)
class Band:
    """A heading across the page on the colour of a verdict."""

    lines: tuple[str, ...]
    verdict: str
    width: float
    keep: bool = True

    @property
    def height(self) -> float:
        """Of its lines, with a margin."""
        return 17.0 * len(self.lines) + 13.0

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Never."""
        return None

    def shrunk(self, height: float) -> Block:
        """It has three lines at most."""
        return self

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """White letters on the colour."""
        height = 17.0 * len(self.lines) + 7.0
        area(canvas, (x, top - height), self.width, height, COLOUR[self.verdict])
        letters = Letters(canvas, colour="#ffffff", bold=True)
        for number, line in enumerate(self.lines):
            letters.put(x + 8.0, top - 17.0 * number - 15.0, line, 13.0)
        letters.done()


def band(text: str, verdict: str, width: float) -> Band:
    """A heading across the page; a text that is too long ends in an ellipsis."""
    return Band(
        tuple(lines_of(shortened(text, *_LONGEST_BAND), 13.0, width - 16.0)[: _LONGEST_BAND[1]]), verdict, width
    )


@dataclass(frozen=True)
class Beside:
    """Stacks of blocks beside each other, each of a width, pt; they are never cut."""

    stacks: tuple[tuple[Block, ...], ...]
    each: float
    keep: bool = False

    @property
    def height(self) -> float:
        """Of the highest stack."""
        return max((sum(block.height for block in stack) for stack in self.stacks), default=0.0) + 2.0

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Never."""
        return None

    def shrunk(self, height: float) -> Block:
        """Each of its blocks, by the same share."""
        share = height / self.height
        stacks = tuple(tuple(block.shrunk(block.height * share) for block in stack) for stack in self.stacks)
        return replace(self, stacks=stacks)

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """Stack by stack."""
        for number, stack in enumerate(self.stacks):
            below = top
            for block in stack:
                block.draw(canvas, x + number * self.each, below)
                below -= block.height


@dataclass(frozen=True)
class Fields:
    """Lines to write on, a name under each: who has looked at a report, and when."""

    names: tuple[str, ...]
    width: float
    keep: bool = False
    height: float = 46.0

    def split(self, room: float) -> tuple[Block, Block] | None:
        """Never."""
        return None

    def shrunk(self, height: float) -> Block:
        """It is low."""
        return self

    def draw(self, canvas: Any, x: float, top: float) -> None:
        """A line for each."""
        each = self.width / len(self.names)
        letters = Letters(canvas, colour=FAINT)
        for number, name in enumerate(self.names):
            left = x + number * each
            rule(canvas, (left, top - 28.0), (left + each - 14.0, top - 28.0), 0.7)
            letters.put(left, top - 37.0, name, 7.5)
        letters.done()


def fields(names: Sequence[str], width: float) -> Fields:
    """Lines to sign on."""
    return Fields(tuple(names), width)
