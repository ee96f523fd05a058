"""Drawings of a report as shapes: what they show is decided once, HTML draws them as SVG and PDF on its pages.

Coordinates are the drawing's own units, x to the right and y upwards; a style is a name, such as ``fail``, and
:data:`STYLES` holds its colours and line widths.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from aadm_workbench.report.words.labels import COLOUR, FAINT, INK, MOVE

Point: TypeAlias = tuple[float, float]
Anchor: TypeAlias = Literal["start", "middle", "end"]


@dataclass(frozen=True)
class Style:
    """Colours (None: none), line width in the drawing's units, and the dashes of the line."""

    stroke: str | None = None
    fill: str | None = None
    width: float = 0.8
    dash: tuple[float, float] | None = None


STYLES: dict[str, Style] = {
    "outline": Style("#6b7682", "#eef1f3", 1.0),
    "design": Style("#8b97a3", "#ffffff", 0.6),
    "bar": Style("#4a5560", "#d4dade", 0.6),
    "limit": Style("#8b97a3", None, 0.5, (1.6, 1.4)),
    "axis": Style("#b3bcc4", None, 0.6, (4.0, 2.0)),
    "guide": Style("#8b97a3", None, 0.5),
    "paper": Style(None, "#ffffff"),
    "ink": Style(INK, INK, 0.9),
    "pass": Style(COLOUR["pass"], COLOUR["pass"], 1.2),
    "fail": Style(COLOUR["fail"], COLOUR["fail"], 1.6),
    "inconclusive": Style("#b87a00", "#b87a00", 1.4),
    "not_measured": Style(COLOUR["not_measured"], "#ffffff", 1.2, (2.0, 1.5)),
    "error": Style(COLOUR["error"], COLOUR["error"], 1.2),
    "not_assessed": Style(COLOUR["not_assessed"], COLOUR["not_assessed"], 1.0),
    "fill-pass": Style("#00543d", "#8fd6b8", 1.2),
    "fill-fail": Style("#8a2900", "#f28e5c", 2.2),
    "fill-inconclusive": Style("#6b4800", "#f7d070", 1.6),
    "fill-not_measured": Style("#3d444d", "#e3e6ea", 1.6, (3.0, 2.0)),
    "fill-error": Style("#7a1f5c", "#e0a3cb", 1.6),
    "fill-not_assessed": Style(COLOUR["not_assessed"], "#ffffff", 1.2),
    "ring-fail": Style(COLOUR["fail"], None, 2.2),
    "ring-open": Style("#b87a00", None, 1.6, (3.0, 1.6)),
    "follows": Style("#8a6a55", "#ffffff", 0.9, (2.0, 1.2)),
    "ring-mark": Style(INK, "#ffd84d", 1.2),
    "move": Style(MOVE, MOVE, 3.0),
    "window": Style(COLOUR["pass"], "#bfe6d6", 0.8),
    "text": Style(None, INK),
    "text-fail": Style(None, "#8a2900"),
    "text-faint": Style(None, FAINT),
    "text-light": Style(None, "#ffffff"),
    "text-move": Style(None, MOVE),
    "ring-named": Style(MOVE, None, 1.6),
}


@dataclass(frozen=True)
class Circle:
    """A circle."""

    centre: Point
    radius: float
    style: str


@dataclass(frozen=True)
class Polyline:
    """A line through points, closed or open; an arrowhead of that length at its last point where above zero."""

    points: tuple[Point, ...]
    style: str
    closed: bool = False
    head: float = 0.0


@dataclass(frozen=True)
class Label:
    """A text whose middle height stands at a point."""

    at: Point
    text: str
    size: float
    style: str = "text"
    anchor: Anchor = "middle"
    bold: bool = False


@dataclass(frozen=True)
class Link:
    """Shapes that lead to a place of the document when they are clicked, and their title."""

    target: str
    title: str
    shapes: tuple[Shape, ...]


Shape: TypeAlias = Circle | Polyline | Label | Link


@dataclass(frozen=True)
class Sketch:
    """Shapes in a frame from (0, 0) to (width, height)."""

    width: float
    height: float
    shapes: tuple[Shape, ...]


def rectangle(low: Point, high: Point, style: str) -> Polyline:
    """A rectangle between two of its corners."""
    return Polyline((low, (high[0], low[1]), high, (low[0], high[1])), style, closed=True)


def arrow(start: Point, end: Point, style: str, head: float) -> Polyline:
    """A straight arrow; the head is never longer than half of it."""
    length = ((end[0] - start[0]) ** 2 + (end[1] - start[1]) ** 2) ** 0.5
    return Polyline((start, end), style, head=min(head, 0.5 * length))


def arrowhead(line: Polyline) -> tuple[Point, Point, Point]:
    """Tip and both barbs of the head of a line."""
    (x0, y0), (x1, y1) = line.points[-2:]
    length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5 or 1.0
    ux, uy = (x1 - x0) / length * line.head, (y1 - y0) / length * line.head
    return (x1, y1), (x1 - ux - 0.45 * uy, y1 - uy + 0.45 * ux), (x1 - ux + 0.45 * uy, y1 - uy - 0.45 * ux)
