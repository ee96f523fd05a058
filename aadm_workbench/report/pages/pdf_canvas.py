"""Drawing on a PDF page: lines of text, sketches, coloured areas.

Coordinates are points (1/72 inch), y upwards. What is drawn is written as operators of PDF (ISO 32000-1, annex A): a
report of a thousand columns has a million texts, and reportlab's own way to each takes ten times as long.
"""

from __future__ import annotations

import io
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache, lru_cache
from itertools import groupby
from pathlib import Path
from typing import Any

from aadm_workbench.own_files import write_atomically
from aadm_workbench.report.drawing.sketch import STYLES, Anchor, Circle, Label, Link, Polyline, Shape, Sketch, arrowhead
from aadm_workbench.report.pages.pdf_letters import Letters, paint
from aadm_workbench.report.pages.pdf_text import lines_of, printable, reportlab, width_of
from aadm_workbench.report.words.labels import INK

MM = 72.0 / 25.4
"""Points of a millimetre."""
A4 = (210.0 * MM, 297.0 * MM)
"""Width and height, points (ISO 216)."""

_QUARTER = 0.5522847498  # of the radius: a Bezier curve with this handle is a quarter of a circle to 0.03 %
_KEPT_CIRCLES = 256  # radii: points of a sketch, and sketches of a design, have few
_PACKING = 3  # of zlib: an eighth more bytes than at its usual 6, in half of the time


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


def end_page(canvas: Any) -> None:
    """Close a page, and pack it at once: a thousand columns have more pages than memory should hold unpacked."""
    canvas.showPage()
    pdfdoc = reportlab("pdfbase.pdfdoc")
    page = canvas._doc.Pages.pages[-1]
    packed = pdfdoc.PDFDictionary({"Filter": pdfdoc.PDFName("FlateDecode")})
    page.Contents = pdfdoc.PDFStream(packed, zlib.compress(page.stream.encode("latin-1"), _PACKING))
    page.stream = None


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
    canvas.addLiteral(f"{paint(colour)} rg {at[0]:.2f} {at[1]:.2f} {width:.2f} {height:.2f} re f")


def fill(canvas: Any, ways: Sequence[str], colour: str) -> None:
    """Areas of one colour, each as operators of PDF."""
    if ways:
        canvas.addLiteral(f"{paint(colour)} rg {' '.join(ways)} f")


def stroke(canvas: Any, ways: Sequence[str], width: float, colour: str) -> None:
    """Lines of one width and colour, each as operators of PDF."""
    if ways:
        canvas.addLiteral(f"[] 0 d {paint(colour)} RG {width:.2f} w {' '.join(ways)} S")


def rule(canvas: Any, start: tuple[float, float], end: tuple[float, float], width: float, colour: str = INK) -> None:
    """A straight line."""
    ends = f"{start[0]:.2f} {start[1]:.2f} m {end[0]:.2f} {end[1]:.2f} l S"
    canvas.addLiteral(f"[] 0 d {paint(colour)} RG {width:.2f} w {ends}")


def draw_sketch(canvas: Any, sketch: Sketch, at: tuple[float, float], width: float) -> None:
    """Draw a sketch with its lower left corner at a place, ``width`` pt wide."""
    scale = width / sketch.width
    canvas.saveState()
    canvas.addLiteral(f"{scale:.5f} 0 0 {scale:.5f} {at[0]:.2f} {at[1]:.2f} cm")
    for style, alike in groupby(_unlinked(sketch.shapes), key=_written_alike):
        if style is None:
            canvas.addLiteral("\n".join([_operators(shape) for shape in alike if not isinstance(shape, Label)]))
        else:
            _write_labels(canvas, [shape for shape in alike if isinstance(shape, Label)])
    canvas.restoreState()


def _unlinked(shapes: Sequence[Shape]) -> Iterator[Circle | Polyline | Label]:
    """Shapes without what they lead to."""
    for shape in shapes:
        if isinstance(shape, Link):
            yield from _unlinked(shape.shapes)
        else:
            yield shape


def _written_alike(shape: Circle | Polyline | Label) -> tuple[str, bool] | None:
    """Style and weight of a label; texts of one are written together. None for what is no text."""
    return (shape.style, shape.bold) if isinstance(shape, Label) else None


def _write_labels(canvas: Any, labels: Sequence[Label]) -> None:
    letters = Letters(canvas, colour=STYLES[labels[0].style].fill or "#000000", bold=labels[0].bold)
    for label in labels:
        shown = printable(label.text)
        ahead = _AHEAD[label.anchor] * width_of(shown, label.size)
        letters.put(label.at[0] - ahead, label.at[1] - 0.36 * label.size, shown, label.size)
    letters.done()


def _operators(shape: Circle | Polyline) -> str:
    """Colours, lines and the way of a circle or a path."""
    look, stroked, filled = _look(shape.style)
    if isinstance(shape, Circle):
        x, y = shape.centre
        round_way = _round(shape.radius)
        return f"{look} q 1 0 0 1 {x:.2f} {y:.2f} cm {round_way} {_painted(stroked=stroked, filled=filled)} Q"
    way = (
        f"{look} {_way(shape.points, closed=shape.closed)} {_painted(stroked=stroked, filled=filled and shape.closed)}"
    )
    if shape.head > 0.0:
        way += f" {_way(arrowhead(shape), closed=True)} {_painted(stroked=stroked, filled=filled)}"
    return way


@cache
def _look(name: str) -> tuple[str, bool, bool]:
    """Operators that set a style, whether its lines are drawn, and whether what they enclose is filled."""
    style = STYLES[name]
    dash = " ".join(f"{length:g}" for length in style.dash or ())
    stroke = f" {paint(style.stroke)} RG" if style.stroke else ""
    fill = f" {paint(style.fill)} rg" if style.fill else ""
    return f"{style.width:g} w [{dash}] 0 d{stroke}{fill}", style.stroke is not None, style.fill is not None


def _painted(*, stroked: bool, filled: bool) -> str:
    """The operator that ends a path."""
    return ("B" if stroked else "f") if filled else ("S" if stroked else "n")


def _way(points: Sequence[tuple[float, float]], *, closed: bool) -> str:
    way = " l ".join([f"{x:.2f} {y:.2f}" for x, y in points]).replace(" l ", " m ", 1)
    return f"{way} l{' h' if closed else ''}"


@lru_cache(_KEPT_CIRCLES)
def _round(radius: float) -> str:
    """Four curves about the origin; the last leads back to where the first began."""
    r, h = f"{radius:.2f}", f"{radius * _QUARTER:.2f}"
    return (
        f"{r} 0 m {r} {h} {h} {r} 0 {r} c -{h} {r} -{r} {h} -{r} 0 c "
        f"-{r} -{h} -{h} -{r} 0 -{r} c {h} -{r} {r} -{h} {r} 0 c h"
    )
