"""scan-card.pdf: one A4 for each column, for the yard, before anything is scanned."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from aadm_workbench.model import Kind
from aadm_workbench.report.drawing.layout import Layout
from aadm_workbench.report.drawing.sketch import Circle, Label, Point, Polyline, Shape, Sketch, arrow, rectangle
from aadm_workbench.report.pages.pdf_canvas import A4, MM, draw_sketch, end_page, pages, write, write_lines
from aadm_workbench.report.pages.pdf_text import lines_of
from aadm_workbench.report.pages.scan_card import (
    CardPart,
    ScanCard,
    corner_of,
    first_bar_corner,
    in_picture,
    top_side,
    up_name,
)
from aadm_workbench.report.words.labels import FAINT, MOVE, Language, Phrase, phrase

_LEFT, _RIGHT = 15.0 * MM, 195.0 * MM  # margins of 15 mm on A4: printers reach as far
_WIDTH = _RIGHT - _LEFT
_SIDE = 200.0  # of the drawing, in its own units
_MARGIN = 22.0  # about the pattern: its labels
_MARK = 7.0  # beyond the edge of S1 or R1: its ring
_SHARES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5)  # of the sizes, where texts are long
_PART_HEIGHT = 111.0 * MM  # half of what head and foot leave of A4


def write_scan_cards(cards: Sequence[ScanCard], path: Path, language: Language = "zh", *, title: str = "") -> None:
    """Write scan-card.pdf, whole or not at all; both languages are on every page, ``language`` stands first.

    Raises
    ------
    MissingDependencyError
        Without the package reportlab.
    AadmError
        Where the file cannot be written.
    """
    with pages(path, phrase("card.title").en, "scan-card.pdf") as canvas:
        for card in cards:
            _Page(canvas, language).draw(card, title)
            end_page(canvas)


def picture_sketch(card: ScanCard, part: CardPart) -> Sketch:
    """The camera's picture: a frame, in it the outline and the points as they will be seen, S1 or R1 marked."""
    seen = {point.label: in_picture(part.part, part.up_deg, point.design_mm) for point in part.points}
    ends = [abs(value) for place in seen.values() for value in place]
    reach = max([*ends, *(side / 2.0 for side in card.size_mm or ()), 1.0])
    scale = (_SIDE / 2.0 - _MARGIN) / reach
    shapes: list[Shape] = [rectangle((4.0, 4.0), (_SIDE - 4.0, _SIDE - 16.0), "guide")]
    if card.size_mm is not None:
        x, y = (side / 2.0 for side in card.size_mm)
        corners = [in_picture(part.part, part.up_deg, c) for c in ((-x, -y), (x, -y), (x, y), (-x, y))]
        shapes.append(Polyline(tuple(_place(corner, scale) for corner in corners), "outline", closed=True))
    first = "S1" if part.part is Kind.SLEEVE else "R1"
    top = Label((_SIDE / 2.0 + 5.0, _SIDE - 8.0), "TOP 上", 9.0, "text-move", "start", bold=True)
    shapes += [arrow((_SIDE / 2.0, _SIDE - 14.0), (_SIDE / 2.0, _SIDE - 1.0), "move", 8.0), top]
    layout = Layout(_SIDE, _SIDE)
    layout.keep_label(top)
    for line in shapes:
        if isinstance(line, Polyline):
            layout.keep_path(line)
    places = {label: _place(mm, scale) for label, mm in seen.items()}
    radii = {point.label: min(max(4.0, point.diameter_mm / 2.0 * scale), _widest(places)) for point in part.points}
    for label, at in places.items():
        shapes += [Circle(at, radii[label] + _MARK, "ring-mark")] * (label == first)
        shapes.append(Circle(at, radii[label], "ink" if part.part is Kind.SLEEVE else "bar"))
        layout.keep_circle(at, radii[label] + (_MARK if label == first else 0.0))
    for label, at in sorted(places.items(), key=lambda item: item[0] != first):
        inwards = (_middle()[0] - at[0], _middle()[1] - at[1])
        marked = label == first
        radius = radii[label] + (_MARK if marked else 0.0)
        shapes += layout.beside(at, label, 13.0 if marked else 8.5, radius, inwards, bold=marked)
    return Sketch(_SIDE, _SIDE, tuple(shapes))


def _widest(places: Mapping[str, Point]) -> float:
    """Radius at which no two points touch, and a name still fits between them."""
    known = list(places.values())
    apart = [math.dist(place, other) for k, place in enumerate(known) for other in known[k + 1 :]]
    return 0.32 * min((one for one in apart if one > 1.0), default=_SIDE)


def _middle() -> Point:
    return _SIDE / 2.0, _SIDE / 2.0 - 6.0


def _place(mm: Point, scale: float) -> Point:
    return _middle()[0] + mm[0] * scale, _middle()[1] + mm[1] * scale


class _Page:
    """Draws one card from the top down."""

    def __init__(self, canvas: Any, language: Language) -> None:
        self.canvas = canvas
        self.first: Language = language
        self.second: Language = "en" if language == "zh" else "zh"

    def draw(self, card: ScanCard, title: str) -> None:
        """The whole page."""
        canvas = self.canvas
        top = A4[1] - 20.0 * MM
        size = next((s for s in (34.0, 26.0, 18.0) if len(lines_of(card.id, s, 0.62 * _WIDTH)) == 1), 13.0)
        write_lines(canvas, (_LEFT, top), card.id, size, 0.62 * _WIDTH, bold=True, most=1)
        said = phrase("card.title")
        write(canvas, (_RIGHT, top), said.in_language(self.first), 22.0, colour=MOVE, bold=True, anchor="end")
        write(canvas, (_RIGHT, top - 7.0 * MM), said.in_language(self.second), 12.0, colour=MOVE, anchor="end")
        write_lines(canvas, (_LEFT, top - 8.0 * MM), card.place, 12.0, 0.62 * _WIDTH, colour=FAINT, most=1)
        canvas.setLineWidth(1.0)
        canvas.line(_LEFT, top - 12.0 * MM, _RIGHT, top - 12.0 * MM)
        y = top - 18.0 * MM
        self._line((_LEFT, y), phrase("card.chalk"), 12.0, _WIDTH)
        if not card.parts:
            self._line((_LEFT, y - 16.0 * MM), phrase("card.no_design"), 14.0, _WIDTH)
        for number, part in enumerate(card.parts):
            self._part(card, part, A4[1] - 50.0 * MM - number * _PART_HEIGHT)
        third = _WIDTH / 3.0 - 3.0 * MM
        for k, name in enumerate(("card.straight", "card.clean", "card.smoothing")):
            self._line((_LEFT + k * _WIDTH / 3.0, 25.0 * MM), phrase(name), 9.0, third)
        write_lines(canvas, (_LEFT, 9.0 * MM), title, 8.0, _WIDTH, colour=FAINT, most=1)

    def _part(self, card: ScanCard, part: CardPart, top: float) -> None:
        """One picture to take, and beside it what to heed: in letters so small that all of it ends above the tick."""
        side = 96.0 * MM
        draw_sketch(self.canvas, picture_sketch(card, part), (_LEFT, top - side), side)
        x, wide = _LEFT + side + 6.0 * MM, _WIDTH - side - 6.0 * MM
        texts, low = list(_to_heed(card, part)), top - side + 9.0 * MM
        room = top - 6.0 * MM - (low + 6.0 * MM)
        share = next((share for share in _SHARES if self._height(texts, share, wide) <= room), _SHARES[-1])
        y = top - 6.0 * MM
        for text, size, bold in texts:
            if y - 2.0 * size < low:
                break
            y = self._line((x, y), text, size * share, wide, bold=bold)
        is_foot = part.part is Kind.SLEEVE
        self._tick((x, low), phrase("card.tick_foot" if is_foot else "card.tick_bars"), wide)

    def _height(self, texts: Sequence[tuple[Phrase, float, bool]], share: float, width: float) -> float:
        """What texts take below each other, pt."""
        used = 0.0
        for text, size, _ in texts:
            for said, one in ((text.in_language(self.first), size), (text.in_language(self.second), _second(size))):
                used += len(lines_of(said, one * share, width)) * one * share * 1.3
            used += 1.2 * MM
        return used

    def _line(self, at: Point, text: Phrase, size: float, width: float, *, bold: bool = False) -> float:
        """A text in both languages, the second below the first and smaller."""
        y = write_lines(self.canvas, at, text.in_language(self.first), size, width, bold=bold)
        if text.en == text.zh:
            return y - 1.5 * MM
        smaller = _second(size)
        y += 0.25 * (size - smaller)
        return (
            write_lines(self.canvas, (at[0], y), text.in_language(self.second), smaller, width, colour=FAINT) - 1.2 * MM
        )

    def _tick(self, at: Point, text: Phrase, width: float) -> None:
        """A box to tick, and a line for the file's name."""
        self.canvas.setLineWidth(1.0)
        self.canvas.rect(at[0], at[1], 5.0 * MM, 5.0 * MM, stroke=1, fill=0)
        said = f"{text.in_language(self.first)} · {text.in_language(self.second)}"
        write(self.canvas, (at[0] + 7.0 * MM, at[1] + 1.2 * MM), said, 9.0)
        name = phrase("card.file_named")
        write(
            self.canvas,
            (at[0], at[1] - 6.0 * MM),
            f"{name.in_language(self.first)} · {name.in_language(self.second)}:",
            8.0,
        )
        self.canvas.line(at[0] + 30.0 * MM, at[1] - 6.5 * MM, at[0] + width, at[1] - 6.5 * MM)


def _second(size: float) -> float:
    """Size of the second language."""
    return max(6.5, 0.72 * size)


def _to_heed(card: ScanCard, part: CardPart) -> Iterator[tuple[Phrase, float, bool]]:
    """Texts beside a picture, each with its size and weight."""
    is_foot = part.part is Kind.SLEEVE
    yield phrase("card.foot" if is_foot else "card.bars"), 16.0, True
    yield phrase("card.foot_seen" if is_foot else "card.bars_seen"), 10.0, False
    first = "S1" if is_foot else "R1"
    if any(point.label == first for point in part.points):
        yield _placed(f"card.{first.lower()}_here", place=corner_of(part, first)), 13.0, True
    yield _placed("card.up_side", side=top_side(card, part)), 11.0, False
    yield _placed("card.in_job", up=_quoted(up_name(part.up_deg))), 9.0, False
    yield phrase("card.distance", m=f"{part.distance_m:.2f}"), 11.0, False
    if part.last_distance_m is not None:
        yield phrase("card.distance_last", m=f"{part.last_distance_m:.2f}"), 9.0, False
    corner = first_bar_corner(card, part)
    if corner is not None:
        yield _placed("card.r1_corner", corner=corner), 10.0, False
    elif is_foot:
        yield phrase("card.s1_is"), 10.0, False


def _placed(name: str, **phrases: Phrase) -> Phrase:
    """A text whose places are filled in each language with that of its own."""
    text = phrase(name)
    return Phrase(
        text.en.format(**{key: value.en for key, value in phrases.items()}),
        text.zh.format(**{key: value.zh for key, value in phrases.items()}),
    )


def _quoted(text: Phrase) -> Phrase:
    return text if text.en.lstrip("-").replace(".", "").isdigit() else Phrase(f'"{text.en}"', f'"{text.zh}"')
