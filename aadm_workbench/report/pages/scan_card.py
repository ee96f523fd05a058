"""What a scan card shows: how the foot and the bars of a column will look in the camera's picture.

The foot is seen from below and the bars from above: with the same side at the top of the picture, one is the mirror of
the other. ``up`` is the direction of the column frame at the top of the picture, as a job declares it: degrees from +x,
counter-clockwise from above.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from aadm_workbench.design.recognise.pattern import side_labels
from aadm_workbench.model import (
    OPENGL_AXES,
    AssemblyPoint,
    Camera,
    ColumnDesign,
    ColumnReport,
    GridAxis,
    GroupReport,
    JobReport,
    Kind,
    PointResult,
    Verdict,
)
from aadm_workbench.report.column_view import typical_diameter_mm
from aadm_workbench.report.directions import Compass, Grid, compass_of, grid_of
from aadm_workbench.report.drawing.sketch import Point
from aadm_workbench.report.hoist import worst_first
from aadm_workbench.report.words.labels import Phrase, phrase

DEFAULT_UP_DEG = 90.0
"""+y, where nobody says otherwise."""

_VIEW_HEIGHT_PER_DISTANCE = 1200.0 / 2425.33
"""Height of the view over the distance, of the structured-light camera of Long et al. (2.3 Mpx, fy 2425 px)."""

_FILLS = 0.93  # of the picture's height: a hand's breadth is left to aim by
_UP_NAMES = {0: "+x", 90: "+y", 180: "-x", 270: "-y"}


@dataclass(frozen=True)
class CardPoint:
    """A sleeve or bar as it is drawn: label, design place, mm, column frame, and its diameter, mm."""

    label: str
    design_mm: Point
    diameter_mm: float


@dataclass(frozen=True)
class CardPart:
    """One picture to take: its points, which way is up, how far away, and from how far the last one was taken."""

    part: Kind
    points: tuple[CardPoint, ...]
    up_deg: float
    distance_m: float
    last_distance_m: float | None = None


@dataclass(frozen=True)
class ScanCard:
    """The card of one column; ``parts`` is empty where its design is not known."""

    id: str
    place: str
    size_mm: tuple[float, float] | None
    parts: tuple[CardPart, ...]
    compass: Compass | None = None


def scan_cards(report: JobReport) -> list[ScanCard]:
    """The cards of a job that was checked before, for the next scan: in the report's order of the worst first."""
    return [_card(report, column) for column in worst_first(report)]


@dataclass(frozen=True, eq=False)
class CardDesign:
    """A column of a job before any scan: as designed, and which way its pictures are to lie (None: not declared)."""

    id: str
    design: ColumnDesign
    sleeves_up_deg: float | None = None
    rebars_up_deg: float | None = None


def design_cards(
    columns: Sequence[CardDesign], camera: Camera | None = None, axes: Sequence[GridAxis] = ()
) -> list[ScanCard]:
    """The cards of columns that were never scanned, in their order.

    Parameters
    ----------
    camera
        Says how much is seen from how far; without it a camera of 2.3 Mpx and 28° is supposed.
    axes
        Of the model's grid.
    """
    view = _VIEW_HEIGHT_PER_DISTANCE if camera is None else min(camera.height / camera.fy, camera.width / camera.fx)
    likenesses = [_likeness(column) for column in columns]
    grid = Grid.of(likenesses, axes)
    cards = []
    for column, likeness in zip(columns, likenesses, strict=True):
        parts = []
        for kind, up_deg in ((Kind.SLEEVE, column.sleeves_up_deg), (Kind.REBAR, column.rebars_up_deg)):
            points = tuple(_card_point(point) for point in column.design.points(kind))
            if points:
                distance_m = distance_to_fill_m(column.design.size_mm, points, view)
                parts.append(CardPart(kind, points, DEFAULT_UP_DEG if up_deg is None else up_deg, distance_m))
        compass = compass_of(grid, likeness)
        cards.append(ScanCard(column.id, _place(likeness), column.design.size_mm, tuple(parts), compass))
    return cards


def _card_point(point: AssemblyPoint) -> CardPoint:
    return CardPoint(point.label, (float(point.centre[0]), float(point.centre[1])), point.diameter_mm)


def _likeness(column: CardDesign) -> ColumnReport:
    """What report.json will say of the column that its design knows already."""
    design, unknown = column.design, Verdict.NOT_ASSESSED
    return ColumnReport(
        column.id,
        unknown,
        unknown,
        sleeves=_unmeasured(design.sleeves),
        rebars=_unmeasured(design.rebars),
        piece_mark=design.piece_mark,
        storey=design.storey,
        grid=design.grid,
        T_model_column=design.T_model_column,
    )


def _unmeasured(points: Sequence[AssemblyPoint]) -> GroupReport | None:
    unknown, nothing = Verdict.NOT_ASSESSED, (None,) * 8
    places = [(float(point.centre[0]), float(point.centre[1]), float(point.centre[2])) for point in points]
    found = [PointResult(p.label, None, place, *nothing, unknown) for p, place in zip(points, places, strict=True)]
    return GroupReport("", "", "", len(points), 0, unknown, tuple(found), (), None) if found else None


def _place(column: ColumnReport) -> str:
    return " · ".join(str(part) for part in (column.grid, column.storey, column.piece_mark) if part)


def _card(report: JobReport, column: ColumnReport) -> ScanCard:
    parts = [_part(column, kind, group) for kind, group in column.groups.items() if group.points]
    return ScanCard(column.id, _place(column), column.size_mm, tuple(parts), compass_of(grid_of(report), column))


def _part(column: ColumnReport, kind: Kind, group: GroupReport) -> CardPart:
    nominal_mm = typical_diameter_mm(column, kind)
    points = tuple(
        CardPoint(point.label, (point.design_mm[0], point.design_mm[1]), nominal_mm) for point in group.points
    )
    distance_m = distance_to_fill_m(column.size_mm, points)
    return CardPart(kind, points, _up_deg(group), distance_m, _last_distance_m(group))


def _up_deg(group: GroupReport) -> float:
    """The direction that was at the top of the last picture, to the nearest side of the column; +y where unknown."""
    if group.fit is None or group.fit.orientation == "ambiguous":
        return DEFAULT_UP_DEG
    T = group.fit.T_design_scan
    # The top of the picture is -y of the file, and +y in OpenGL's axes.
    sign = 1.0 if group.quality.get("axes") == OPENGL_AXES else -1.0
    return (round(math.degrees(math.atan2(sign * T[1][1], sign * T[0][1])) / 90.0) * 90.0) % 360.0


def _last_distance_m(group: GroupReport) -> float | None:
    """Median depth of the points of the last scan; None where its frame is no camera's."""
    depths = sorted(abs(point.scan_mm[2]) for point in group.points if point.scan_mm is not None)
    middle = depths[len(depths) // 2] if depths else 0.0
    return middle / 1000.0 if 200.0 < middle < 20_000.0 else None


def distance_to_fill_m(
    size_mm: Sequence[float] | None,
    points: Sequence[CardPoint],
    view_height_per_distance: float = _VIEW_HEIGHT_PER_DISTANCE,
) -> float:
    """How far away the camera shows the whole foot with a little room around it, m, to 5 cm."""
    sides = [*(size_mm or ()), *(2.2 * abs(value) for point in points for value in point.design_mm)]
    distance_m = max([*sides, 100.0]) / _FILLS / view_height_per_distance / 1000.0
    return max(0.3, math.ceil(distance_m * 20.0) / 20.0)


def in_picture(part: Kind, up_deg: float, place: Point) -> Point:
    """Where a place of the column frame appears: to the right and upwards in the camera's picture, mm.

    With z forward, the right of the picture is forward × up: the camera looks along +z at a foot and along -z at bars.
    """
    up = (math.cos(math.radians(up_deg)), math.sin(math.radians(up_deg)))
    forward = 1.0 if part is Kind.SLEEVE else -1.0
    right = (-forward * up[1], forward * up[0])
    return right[0] * place[0] + right[1] * place[1], up[0] * place[0] + up[1] * place[1]


def corner_of(part: CardPart, label: str) -> Phrase:
    """Where a point appears in the picture: ``bottom right``."""
    seen = {point.label: in_picture(part.part, part.up_deg, point.design_mm) for point in part.points}
    x, y = seen[label]
    reach = max((max(abs(a), abs(b)) for a, b in seen.values()), default=1.0) or 1.0
    across = "right" if x > reach / 3.0 else "left" if x < -reach / 3.0 else ""
    high = "top" if y > reach / 3.0 else "bottom" if y < -reach / 3.0 else ""
    return phrase(f"place.{'_'.join(word for word in (high, across) if word) or 'middle'}")


def top_side(card: ScanCard, part: CardPart) -> Phrase:
    """What lies at the top of the picture: the labels of that side, and for bars in the model, where it leads to."""
    up = (round(math.cos(math.radians(part.up_deg)), 6), round(math.sin(math.radians(part.up_deg)), 6))
    ends = side_labels({point.label: point.design_mm for point in part.points}, up)
    side = phrase("card.between_labels", first=ends[0], last=ends[1]) if ends else up_name(part.up_deg)
    if part.part is Kind.REBAR and card.compass is not None and card.compass.placed:
        ways = card.compass.parts(up)
        if len(ways) == 1:
            return Phrase(f"{side.en}, {ways[0][1].en}", f"{side.zh}，{ways[0][1].zh}")
    return side


def first_bar_corner(card: ScanCard, part: CardPart) -> Phrase | None:
    """Where R1 stands among the bars, in directions of the building; None where the model does not say."""
    place = next((point.design_mm for point in part.points if point.label == "R1"), None)
    if place is None or card.compass is None or not card.compass.placed or part.part is not Kind.REBAR:
        return None
    reach = max(abs(value) for point in part.points for value in point.design_mm)
    ways = [way for length, way in card.compass.parts(place) if length > reach / 3.0]
    return Phrase(", ".join(way.en for way in ways), "，".join(way.zh for way in ways)) if ways else None


def up_name(up_deg: float) -> Phrase:
    """As a job writes it: ``+y``, or degrees."""
    name = _UP_NAMES.get(round(up_deg) % 360) if abs(up_deg - round(up_deg)) < 1e-6 else None
    said = name or f"{up_deg:g}"
    return Phrase(said, said)
