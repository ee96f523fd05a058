"""Drawing on a PDF page: lines of text, sketches, coloured areas.

Coordinates are points (1/72 inch), y upwards. What is drawn is written as operators of PDF (ISO 32000-1, annex A): a
report of a thousand columns has a million texts, and reportlab's own way to each takes ten times as long.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

from aadm_workbench.atomic import write_atomically
from aadm_workbench.report.drawing.sketch import STYLES, Anchor, Circle, Label, Link, Shape, Sketch, arrowhead
from aadm_workbench.report.pages.pdf_text import lines_of, prepared_font, printable, reportlab, width_of
from aadm_workbench.report.words.labels import INK

MM = 72.0 / 25.4
"""Points of a millimetre."""
A4 = (210.0 * MM, 297.0 * MM)
"""Width and height, points (ISO 216)."""

_BOLD_STROKE = 0.028  # of the size: letters are drawn with an outline of that width, since the font has no bold cut
_QUARTER = 0.5522847498  # of the radius: a Bezier curve with this handle is a quarter of a circle to 0.03 %


@contextmanager
def pages(path: Path, title: str, needed_for: str, author: str = "") -> Iterator[Any]:
    """A canvas to draw pages of A4 on; the file is written at the end, whole or not at all.

    Raises
    ------
    MissingDependencyError
        Where reportlab is not installed.
    AadmError
        Where the file cannot be written.
    """
    module: Any = reportlab("pdfgen.canvas", needed_for)
    content = io.BytesIO()
    canvas = module.Canvas(content, pagesize=A4, invariant=1, pageCompression=1)
    canvas.setTitle(title)
    canvas.setAuthor(author)
    yield canvas
    canvas.save()
    write_atomically(path, content.getvalue())


class Letters:
    """Texts of one colour, written with as few operators as they need."""

    def __init__(self, canvas: Any, *, colour: str = INK, bold: bool = False) -> None:
        self._canvas = canvas
        self._written = [f"BT {_paint(colour)} rg"]
        self._bold, self._colour = bold, colour
        self._in_force: tuple[int, float] | None = None
        if bold:
            self._written.append(f"{_paint(colour)} RG 2 Tr")

    def put(self, x: float, y: float, text: str, size: float) -> None:
        """A text of printable signs, its base line at (x, y)."""
        if not text:
            return
        written = self._written
        written.append(f"1 0 0 1 {x:.2f} {y:.2f} Tm")
        for subset, name, shown in _encoded(self._canvas, text):
            if self._in_force != (subset, size):
                written.append(f"{name} {size:g} Tf")
                if self._bold:
                    written.append(f"{size * _BOLD_STROKE:.3f} w")
                self._in_force = subset, size
            written.append(f"({shown}) Tj")

    def done(self) -> None:
        """Put them onto the page."""
        self._canvas.addLiteral("\n".join([*self._written, "0 Tr ET" if self._bold else "ET"]))


def _encoded(canvas: Any, text: str) -> tuple[tuple[int, str, str], ...]:
    """A text in the subsets of the font that the document has so far: number, name in the page, escaped bytes."""
    known = canvas.__dict__.setdefault("aadm_texts", {})
    found = known.get(text)
    if found is None:
        font, document = prepared_font(), canvas._doc
        escape = reportlab("lib.rl_accel").escapePDF
        found = tuple(
            (subset, font.getSubsetInternalName(subset, document), escape(part))
            for subset, part in font.splitString(text, document)
        )
        known[text] = found
    encoded: tuple[tuple[int, str, str], ...] = found
    return encoded


@cache
def _paint(colour: str) -> str:
    """``#1d2730`` as three numbers."""
    return " ".join(f"{int(colour[k : k + 2], 16) / 255.0:.3f}" for k in (1, 3, 5))


def write(
    canvas: Any,
    at: tuple[float, float],
    text: str,
    size: float,
    *,
    colour: str = INK,
    bold: bool = False,
    anchor: Anchor = "start",
) -> None:
    """One line of text; ``at`` is on its base line. The font has one weight: bold letters get a thin outline."""
    shown = printable(text)
    letters = Letters(canvas, colour=colour, bold=bold)
    letters.put(at[0] - _AHEAD[anchor] * width_of(shown, size), at[1], shown, size)
    letters.done()


_AHEAD = {"start": 0.0, "middle": 0.5, "end": 1.0}  # of its width, what stands before the anchor of a text


def write_lines(
    canvas: Any,
    at: tuple[float, float],
    text: str,
    size: float,
    width: float,
    *,
    colour: str = INK,
    bold: bool = False,
    most: int | None = None,
) -> float:
    """Lines below each other, the first on the base line at ``at``; returns the y below the last one.

    ``most`` is the number of lines that there is room for; the last then ends in an ellipsis.
    """
    lines = lines_of(text, size, width)
    if most is not None and len(lines) > most:
        lines = (*lines[: most - 1], f"{lines[most - 1].rstrip()[:-1]}…")
    y = at[1]
    for line in lines:
        write(canvas, (at[0], y), line, size, colour=colour, bold=bold)
        y -= size * 1.3
    return y


def area(canvas: Any, at: tuple[float, float], width: float, height: float, colour: str) -> None:
    """A filled rectangle, its lower left corner at a place."""
    canvas.addLiteral(f"{_paint(colour)} rg {at[0]:.2f} {at[1]:.2f} {width:.2f} {height:.2f} re f")


def rule(canvas: Any, start: tuple[float, float], end: tuple[float, float], width: float, colour: str = INK) -> None:
    """A straight line."""
    ends = f"{start[0]:.2f} {start[1]:.2f} m {end[0]:.2f} {end[1]:.2f} l S"
    canvas.addLiteral(f"[] 0 d {_paint(colour)} RG {width:.2f} w {ends}")


def draw_sketch(canvas: Any, sketch: Sketch, at: tuple[float, float], width: float) -> None:
    """Draw a sketch with its lower left corner at a place, ``width`` pt wide."""
    scale = width / sketch.width
    canvas.saveState()
    canvas.addLiteral(f"{scale:.5f} 0 0 {scale:.5f} {at[0]:.2f} {at[1]:.2f} cm")
    for shape in sketch.shapes:
        _draw(canvas, shape)
    canvas.restoreState()


def _draw(canvas: Any, shape: Shape) -> None:
    if isinstance(shape, Link):
        for part in shape.shapes:
            _draw(canvas, part)
        return
    style = STYLES[shape.style]
    if isinstance(shape, Label):
        at = (shape.at[0], shape.at[1] - 0.36 * shape.size)
        write(canvas, at, shape.text, shape.size, colour=style.fill or "#000000", bold=shape.bold, anchor=shape.anchor)
        return
    dash = " ".join(f"{length:g}" for length in style.dash or ())
    look = f"{style.width:g} w [{dash}] 0 d"
    look += f" {_paint(style.stroke)} RG" if style.stroke else ""
    look += f" {_paint(style.fill)} rg" if style.fill else ""
    if isinstance(shape, Circle):
        canvas.addLiteral(f"{look} {_round(shape)} {_painted(stroked=bool(style.stroke), filled=bool(style.fill))}")
        return
    filled = style.fill is not None
    way = f"{_way(shape.points, closed=shape.closed)} {_painted(stroked=True, filled=filled and shape.closed)}"
    if shape.head > 0.0:
        way += f" {_way(arrowhead(shape), closed=True)} {_painted(stroked=True, filled=filled)}"
    canvas.addLiteral(f"{look} {way}")


def _painted(*, stroked: bool, filled: bool) -> str:
    """The operator that ends a path."""
    return ("B" if stroked else "f") if filled else ("S" if stroked else "n")


def _way(points: Sequence[tuple[float, float]], *, closed: bool) -> str:
    first, *rest = (f"{x:.2f} {y:.2f}" for x, y in points)
    return " ".join([f"{first} m", *(f"{point} l" for point in rest), *(["h"] if closed else [])])


def _round(circle: Circle) -> str:
    """Four curves; the last leads back to where the first began."""
    (x, y), r = circle.centre, circle.radius
    handle = r * _QUARTER
    corners = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0))
    ways = [f"{x + r:.2f} {y:.2f} m"]
    for (ax, ay), (bx, by) in pairwise(corners):
        first = (x + r * ax + handle * bx, y + r * ay + handle * by)
        second = (x + r * bx + handle * ax, y + r * by + handle * ay)
        ends = (*first, *second, x + r * bx, y + r * by)
        ways.append(" ".join(f"{value:.2f}" for value in ends) + " c")
    return " ".join([*ways, "h"])
