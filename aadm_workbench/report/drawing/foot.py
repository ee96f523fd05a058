"""The foot of a column seen from above: where each point should be, and a magnified arrow to where it is."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from aadm_workbench.model import ColumnReport, GroupReport, Kind
from aadm_workbench.report.drawing.sketch import Circle, Label, Point, Polyline, Shape, Sketch, arrow, rectangle

SIDE = 200.0
"""Width and height of the sketch, its own units."""

_MARGIN = 24.0  # about the foot: labels of its outermost points
_LIMIT_RADIUS = 15.0  # of the ring that stands for the limit: seen, and clear of its neighbours
_LIMIT_OF_PITCH = 0.42  # of the distance of neighbours: rings do not touch
_LONGEST_ARROW = 38.0  # two and a half rings: what is far beyond its limit still ends on the sketch
_FACTORS = (200, 100, 50, 40, 25, 20, 15, 10, 8, 5, 4, 3, 2, 1)  # magnifications that a person can divide by


@dataclass(frozen=True)
class Mark:
    """A point of a sketch: its design place and its offset, mm, column frame, and what was said of it."""

    label: str
    design_mm: Point
    offset_mm: Point | None
    limit_mm: float | None
    verdict: str


@dataclass(frozen=True)
class FootSketch:
    """The sketch, and how many times the arrows are longer than the offsets that they show."""

    sketch: Sketch
    factor: int
    limit_mm: float | None


def group_marks(group: GroupReport) -> list[Mark]:
    """The points of sleeves or of rebars, measured minus design."""
    return [
        Mark(
            point.label,
            (point.design_mm[0], point.design_mm[1]),
            point.offset_mm,
            point.limit_mm,
            point.verdict,
        )
        for point in group.points
    ]


def pair_marks(column: ColumnReport) -> list[Mark]:
    """Bars against their sleeves at the pose that is shown, rebar minus sleeve, drawn at the sleeve."""
    places = {point.label: (point.design_mm[0], point.design_mm[1]) for point in column.points(Kind.SLEEVE)}
    return [
        Mark(pair.sleeve, places[pair.sleeve], pair.offset_mm, pair.limit_mm, pair.verdict)
        for pair in column.pairs
        if pair.sleeve in places
    ]


def foot_sketch(
    marks: Sequence[Mark], size_mm: Sequence[float] | None, diameter_mm: float, marked: Collection[str] = ()
) -> FootSketch:
    """Outline, points, rings of the limit and arrows, seen from above with +y at the top.

    Parameters
    ----------
    size_mm
        Of the cross-section; where unknown the outline is left out.
    diameter_mm
        Of the points as they are drawn.
    marked
        Labels of the points that get a ring more.
    """
    reach = _reach(marks, size_mm)
    scale = (SIDE - 2.0 * _MARGIN) / (2.0 * reach)
    limit_mm = next((mark.limit_mm for mark in marks if mark.limit_mm), None)
    ring = min(_LIMIT_RADIUS, _LIMIT_OF_PITCH * _pitch_mm(marks) * scale)
    factor = _factor(marks, limit_mm, scale, ring)
    shapes: list[Shape] = []
    if size_mm is not None:
        x, y = size_mm[0] / 2.0 * scale, size_mm[1] / 2.0 * scale
        shapes.append(rectangle((SIDE / 2 - x, SIDE / 2 - y), (SIDE / 2 + x, SIDE / 2 + y), "outline"))
    shapes += _axes()
    radius = max(2.2, diameter_mm / 2.0 * scale)
    for mark in marks:
        shapes += _mark(mark, scale, factor, radius, ring)
        if mark.label in marked:
            at = (SIDE / 2 + mark.design_mm[0] * scale, SIDE / 2 + mark.design_mm[1] * scale)
            shapes.append(Circle(at, max(radius, ring) + 4.5, "ring-named"))
    shapes.sort(key=_layer)
    return FootSketch(Sketch(SIDE, SIDE, tuple(shapes)), factor, limit_mm)


def _layer(shape: Shape) -> tuple[int, str]:
    """Outline and circles lie below arrows, and these below labels; what is alike lies together."""
    if isinstance(shape, Circle):
        return 1, shape.style
    if isinstance(shape, Label):
        return 3, f"{shape.size}{shape.style}"
    return (2, shape.style) if isinstance(shape, Polyline) and not shape.closed else (0, "")


def _reach(marks: Sequence[Mark], size_mm: Sequence[float] | None) -> float:
    ends = [abs(value) for mark in marks for value in mark.design_mm] + [value / 2.0 for value in size_mm or ()]
    return max([*ends, 1.0])


def _pitch_mm(marks: Sequence[Mark]) -> float:
    """Smallest distance between two points, mm."""
    places = [mark.design_mm for mark in marks]
    found = [_length((x1 - x0, y1 - y0)) for k, (x0, y0) in enumerate(places) for x1, y1 in places[k + 1 :]]
    return min((apart for apart in found if apart > 1.0), default=1000.0)


def _factor(marks: Sequence[Mark], limit_mm: float | None, scale: float, ring: float) -> int:
    """The largest round factor at which neither ring nor arrow leaves its place."""
    longest_mm = max((_length(mark.offset_mm) for mark in marks if mark.offset_mm), default=0.0)
    fits = min(
        ring / (limit_mm * scale) if limit_mm else float(_FACTORS[0]),
        _LONGEST_ARROW / (longest_mm * scale) if longest_mm else float(_FACTORS[0]),
    )
    return next((factor for factor in _FACTORS if factor <= fits), 1)


def _length(vector: Point) -> float:
    return float((vector[0] ** 2 + vector[1] ** 2) ** 0.5)


def _axes() -> Iterator[Shape]:
    """Where x and y point, in the lower left corner."""
    for end, name in (((16.0, 3.0), "x"), ((3.0, 16.0), "y")):
        yield arrow((3.0, 3.0), end, "guide", 3.0)
        yield Label((end[0] + 3.5, end[1]) if name == "x" else (end[0], end[1] + 4.0), name, 7.0, "text-faint")


def _mark(mark: Mark, scale: float, factor: int, radius: float, ring: float) -> Iterator[Shape]:
    x, y = SIDE / 2 + mark.design_mm[0] * scale, SIDE / 2 + mark.design_mm[1] * scale
    yield Circle((x, y), radius, "design")
    if mark.limit_mm is not None and mark.offset_mm is not None:
        yield Circle((x, y), mark.limit_mm * scale * factor, "limit")
    if mark.verdict in ("fail", "inconclusive"):
        yield Circle((x, y), max(radius, ring) + 2.0, "ring-fail" if mark.verdict == "fail" else "limit")
    if mark.offset_mm is None:
        yield from _unmeasured((x, y), radius)
    else:
        end = (x + mark.offset_mm[0] * scale * factor, y + mark.offset_mm[1] * scale * factor)
        yield arrow((x, y), end, mark.verdict, 3.6)
    sign = {"fail": " ✗", "inconclusive": " ?", "not_measured": " –"}.get(mark.verdict, "")
    # Towards the middle of the foot, where no arrow of another point and no edge is.
    inwards = (SIDE / 2 - x, SIDE / 2 - y)
    apart = max(radius, ring) + 8.5
    away = _length(inwards) or 1.0
    at = (x + inwards[0] / away * apart, y + inwards[1] / away * apart)
    failed = mark.verdict == "fail"
    yield Label(at, f"{mark.label}{sign}", 7.5, "text-fail" if failed else "text", bold=failed)


def _unmeasured(at: Point, radius: float) -> Iterator[Shape]:
    """A dashed cross: nothing is known here."""
    r = radius * 0.9
    yield Polyline(((at[0] - r, at[1] - r), (at[0] + r, at[1] + r)), "not_measured")
    yield Polyline(((at[0] - r, at[1] + r), (at[0] + r, at[1] - r)), "not_measured")
