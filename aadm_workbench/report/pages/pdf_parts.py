"""Paragraphs and drawings as reportlab's flowables, in the one font that the reports have."""

from __future__ import annotations

from functools import partial
from typing import Any

from aadm_workbench.report.drawing.sketch import Sketch
from aadm_workbench.report.pages.pdf_canvas import draw_sketch, lines_of, reportlab, shortened, write
from aadm_workbench.report.words.labels import COLOUR, INK

_LONGEST_PARAGRAPH, _LONGEST_KEPT, _LONGEST_BAND = (4000, 100), (600, 10), (250, 3)
"""Characters and lines: what fills a page or two, what may be held together with what follows, what a band holds."""


def _flowable() -> Any:
    return reportlab("platypus").Flowable


def paragraph(
    text: str,
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
) -> Any:
    """A text broken to the width of the page; ``outline`` is its level in the table of contents.

    ``keep`` holds it together with what follows, as headings are.
    """
    text = shortened(text, *(_LONGEST_KEPT if keep or outline is not None else _LONGEST_PARAGRAPH))

    class Paragraph(_flowable()):  # type: ignore[misc]  # reportlab brings no types
        def wrap(self, width: float, height: float) -> tuple[float, float]:
            self.lines = lines_of(text, size, width - indent)
            return width, len(self.lines) * size * 1.35 + after

        def split(self, width: float, height: float) -> list[Any]:
            self.wrap(width, height)
            fit = int((height - after) / (size * 1.35))
            if fit < 1 or fit >= len(self.lines):
                return []
            part = partial(paragraph, size=size, colour=colour, bold=bold, indent=indent)
            first = part("\n".join(self.lines[:fit]), after=0.0, outline=outline, bookmark=bookmark)
            return [first, part("\n".join(self.lines[fit:]), after=after)]

        def draw(self) -> None:
            y = (len(self.lines) - 1) * size * 1.35 + after + 0.25 * size
            for line in self.lines:
                write(self.canv, (indent, y), line, size, colour=colour, bold=bold)
                y -= size * 1.35
            if bookmark:
                self.canv.bookmarkHorizontal(bookmark, 0, y + 4.0 * size)
            if outline is not None:
                self.canv.addOutlineEntry(text, bookmark, level=outline, closed=outline == 0)
            if link:
                top = len(self.lines) * size * 1.35 + after
                self.canv.linkRect("", link, (0, 0, 300, top), relative=1, thickness=0)

    flowable = Paragraph()
    flowable.keepWithNext = 1 if keep or outline is not None else 0
    return flowable


def drawing(sketch: Sketch, width: float) -> Any:
    """A sketch as a block of its own."""

    class Drawing(_flowable()):  # type: ignore[misc]
        def wrap(self, *_: float) -> tuple[float, float]:
            return width, width * sketch.height / sketch.width + 4.0

        def draw(self) -> None:
            draw_sketch(self.canv, sketch, (0.0, 4.0), width)

    return Drawing()


def band(text: str, verdict: str, width: float) -> Any:
    """A heading across the page on the colour of a verdict."""
    text = shortened(text, *_LONGEST_BAND)

    class Band(_flowable()):  # type: ignore[misc]
        def wrap(self, *_: float) -> tuple[float, float]:
            self.lines = lines_of(text, 13.0, width - 16.0)
            return width, 17.0 * len(self.lines) + 13.0

        def draw(self) -> None:
            height = 17.0 * len(self.lines) + 7.0
            self.canv.setFillColor(reportlab("lib.colors").HexColor(COLOUR[verdict]))
            self.canv.rect(0, 4.0, width, height, stroke=0, fill=1)
            for k, line in enumerate(self.lines):
                write(self.canv, (8.0, height - 8.0 - 17.0 * k - 3.0), line, 13.0, colour="#ffffff", bold=True)

    flowable = Band()
    flowable.keepWithNext = 1
    return flowable


def beside(parts: list[Any], width: float) -> Any:
    """Flowables beside each other, all equally wide."""
    platypus: Any = reportlab("platypus")
    table = platypus.Table([parts], colWidths=[width / len(parts)] * len(parts), hAlign="LEFT")
    table.setStyle(
        platypus.TableStyle(
            [("VALIGN", (0, 0), (-1, -1), "TOP")]
            + [(f"{side}PADDING", (0, 0), (-1, -1), 1.0) for side in ("LEFT", "RIGHT", "TOP", "BOTTOM")]
        )
    )
    return table
