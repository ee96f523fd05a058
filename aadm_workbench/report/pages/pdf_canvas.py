"""Writing on a PDF page: one font that knows Latin and Chinese, lines that break in both, sketches.

Coordinates are points (1/72 inch), y upwards, as reportlab has them.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from aadm_workbench.atomic import write_atomically
from aadm_workbench.errors import MissingDependencyError
from aadm_workbench.report.drawing.sketch import STYLES, Anchor, Circle, Label, Link, Polyline, Shape, Sketch, arrowhead
from aadm_workbench.report.pages.fonts import FONT_FILE
from aadm_workbench.report.words.labels import INK

FONT = "AADM"
MM = 72.0 / 25.4
"""Points of a millimetre."""
A4 = (210.0 * MM, 297.0 * MM)
"""Width and height, points (ISO 216)."""

_BOLD_STROKE = 0.028  # of the size: letters are drawn with an outline of that width, since the font has no bold cut
_CHINESE = r"[\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef\u3000-\u303f]"
_NEVER_FIRST = "。,、;:!?)》」』】〕%"
_TOKEN = re.compile(rf"{_CHINESE}|[^\s\u2e80-\u9fff\uf900-\ufaff\uff00-\uffef\u3000-\u303f]+|\s+")
_INSTEAD = str.maketrans({"✗": "×", "○": "o", "\t": " ", "\u00a0": " "})
_UNKNOWN = "□"


def reportlab(module: str, needed_for: str = "a PDF report") -> Any:
    """A module of reportlab.

    Raises
    ------
    MissingDependencyError
        Where reportlab is not installed.
    """
    try:
        return import_module(f"reportlab.{module}")
    except ImportError as error:
        raise MissingDependencyError("reportlab", needed_for) from error


@cache
def _face() -> Any:
    """The font, known to reportlab under its name from now on."""
    metrics, fonts = reportlab("pdfbase.pdfmetrics"), reportlab("pdfbase.ttfonts")
    font = fonts.TTFont(FONT, str(FONT_FILE))
    metrics.registerFont(font)
    return font.face


def prepare_font() -> str:
    """Make the font known, and return its name."""
    _face()
    return FONT


@contextmanager
def pages(path: Path, title: str, needed_for: str) -> Iterator[Any]:
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
    yield canvas
    canvas.save()
    write_atomically(path, content.getvalue())


def printable(text: str) -> str:
    """A text in signs that the font has; what it lacks becomes an empty box."""
    known = _face().charToGlyph
    return "".join(sign if ord(sign) in known or sign == "\n" else _UNKNOWN for sign in text.translate(_INSTEAD))


def width_of(text: str, size: float) -> float:
    """Width of one line, pt."""
    prepare_font()
    return float(reportlab("pdfbase.pdfmetrics").stringWidth(text, FONT, size))


def shortened(text: str, most: int, most_lines: int) -> str:
    """A text of at most so many characters and lines: it comes from the files of others, and must fit on a page."""
    lines = text.split("\n", most_lines)
    kept = "\n".join(lines[:most_lines])
    return text if len(kept) == len(text) <= most else f"{kept[: most - 1]}…"


def lines_of(text: str, size: float, width: float) -> list[str]:
    """A text broken into lines of a width, pt: between words, between Chinese characters, in words too long."""
    lines: list[str] = []
    for paragraph in printable(text).split("\n"):
        line = ""
        for token in _TOKEN.findall(paragraph):
            for piece in _pieces(token, size, width):
                if line and width_of(line + piece, size) > width:
                    # A full stop takes the character before it along: it never stands at the start of a line.
                    keep = -1 if piece in _NEVER_FIRST and len(line) > 1 else len(line)
                    lines.append(line[:keep].rstrip())
                    line = line[keep:]
                line += piece if line else piece.lstrip()
        lines.append(line.rstrip())
    return lines


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
    x = at[0] - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * width_of(shown, size)
    paint = reportlab("lib.colors").HexColor(colour)
    line = canvas.beginText(x, at[1])
    line.setFont(prepare_font(), size)
    line.setFillColor(paint)
    line.setTextRenderMode(2 if bold else 0)
    if bold:
        line.setStrokeColor(paint)
        canvas.setLineWidth(size * _BOLD_STROKE)
    line.textOut(shown)
    line.setTextRenderMode(0)
    canvas.drawText(line)


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
        lines = [*lines[: most - 1], f"{lines[most - 1].rstrip()[:-1]}…"]
    y = at[1]
    for line in lines:
        write(canvas, (at[0], y), line, size, colour=colour, bold=bold)
        y -= size * 1.3
    return y


def draw_sketch(canvas: Any, sketch: Sketch, at: tuple[float, float], width: float) -> None:
    """Draw a sketch with its lower left corner at a place, ``width`` pt wide."""
    canvas.saveState()
    canvas.translate(*at)
    canvas.scale(width / sketch.width, width / sketch.width)
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
    colors = reportlab("lib.colors")
    canvas.setLineWidth(style.width)
    canvas.setDash(list(style.dash) if style.dash else [])
    if style.stroke:
        canvas.setStrokeColor(colors.HexColor(style.stroke))
    if style.fill:
        canvas.setFillColor(colors.HexColor(style.fill))
    if isinstance(shape, Circle):
        canvas.circle(
            *shape.centre, shape.radius, stroke=int(style.stroke is not None), fill=int(style.fill is not None)
        )
    else:
        _draw_line(canvas, shape, filled=style.fill is not None)


def _draw_line(canvas: Any, line: Polyline, *, filled: bool) -> None:
    _path(canvas, line.points, closed=line.closed, filled=filled and line.closed)
    if line.head > 0.0:
        _path(canvas, arrowhead(line), closed=True, filled=filled)


def _path(canvas: Any, points: Sequence[tuple[float, float]], *, closed: bool, filled: bool) -> None:
    path = canvas.beginPath()
    path.moveTo(*points[0])
    for point in points[1:]:
        path.lineTo(*point)
    if closed:
        path.close()
    canvas.drawPath(path, stroke=1, fill=int(filled))
