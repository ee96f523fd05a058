"""Sketches as SVG inside of HTML: few bytes, styles by class, every text escaped."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from itertools import groupby

from aadm_workbench.report.drawing.sketch import STYLES, Circle, Label, Link, Point, Polyline, Shape, Sketch, arrowhead


def svg_of(sketch: Sketch, *, label: str, css_class: str = "sketch") -> str:
    """An ``<svg>`` element; ``label`` is what a screen reader says of it."""
    size = f"0 0 {_number(sketch.width)} {_number(sketch.height)}"
    drawn = _drawn(sketch.shapes, sketch.height)
    return f'<svg class="{css_class}" viewBox="{size}" role="img" aria-label="{escape(label)}">{drawn}</svg>'


def svg_styles() -> str:
    """The style sheet of the classes that sketches use."""
    lines = []
    for name, style in STYLES.items():
        dash = f";stroke-dasharray:{_number(style.dash[0])} {_number(style.dash[1])}" if style.dash else ""
        stroke = f"{style.stroke};stroke-width:{_number(style.width)}" if style.stroke else "none"
        lines.append(f"svg .{_CLASS[name]}{{fill:{style.fill or 'none'};stroke:{stroke}{dash}}}")
    # Lines are never filled; what is closed and arrowheads are.
    return "\n".join([*lines, "svg .l{fill:none}"])


_CLASS = {name: f"s{number}" for number, name in enumerate(STYLES)}
"""Short names of the styles: a report of a hundred columns holds 20,000 shapes."""


def _drawn(shapes: Sequence[Shape], height: float) -> str:
    """Neighbours of one kind and style share an element.

    Attributes stand without quotes, as HTML allows where a value holds no space and no text of others.
    """
    return "".join(_together(list(group), height) for _, group in groupby(shapes, key=_kind))


def _kind(shape: Shape) -> tuple[object, ...]:
    if isinstance(shape, Link):
        return (id(shape),)
    if isinstance(shape, Label):
        return (Label, shape.style, shape.size, shape.anchor, shape.bold)
    return (Polyline, shape.style, shape.closed) if isinstance(shape, Polyline) else (Circle, shape.style)


def _together(shapes: Sequence[Shape], height: float) -> str:
    first = shapes[0]
    if isinstance(first, Link):
        inner = _drawn(first.shapes, height)
        return f'<a href="#{escape(first.target)}"><title>{escape(first.title)}</title>{inner}</a>'
    name = _CLASS[first.style]
    if isinstance(first, Polyline):
        way = "".join(_way(line, height) for line in shapes if isinstance(line, Polyline))
        # A line of two points has no inside, so that the fill shows in arrowheads alone.
        filled = first.closed or all(isinstance(line, Polyline) and len(line.points) == 2 for line in shapes)
        return f'<path class={name if filled else _unfilled(name)} d="{way}"/>'
    if isinstance(first, Label):
        anchor = "" if first.anchor == "middle" else f" text-anchor={first.anchor}"
        bold = " font-weight=700" if first.bold else ""
        texts = "".join(_text(label, height) for label in shapes if isinstance(label, Label))
        return f"<g class={name} font-size={_number(first.size)}{anchor}{bold}>{texts}</g>"
    circles = "".join(_circle(circle, height) for circle in shapes if isinstance(circle, Circle))
    return f"<g class={name}>{circles}</g>"


def _unfilled(name: str) -> str:
    return f'"{name} l"'


def _circle(circle: Circle, height: float) -> str:
    x, y = _place(circle.centre, height)
    return f"<circle cx={x} cy={y} r={_number(circle.radius)} />"


def _text(label: Label, height: float) -> str:
    x, y = _place((label.at[0], label.at[1] - 0.36 * label.size), height)
    return f"<text x={x} y={y}>{escape(label.text)}</text>"


def _way(line: Polyline, height: float) -> str:
    way = f"M{'L'.join(' '.join(_place(point, height)) for point in line.points)}{'Z' if line.closed else ''}"
    if line.head > 0.0:
        way += f"M{'L'.join(' '.join(_place(point, height)) for point in arrowhead(line))}Z"
    return way


def _place(point: Point, height: float) -> tuple[str, str]:
    return _number(point[0]), _number(height - point[1])


def _number(value: float) -> str:
    text = f"{value:.1f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
