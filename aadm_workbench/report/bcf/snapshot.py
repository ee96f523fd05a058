"""snapshot.png: what the other reports draw of a foot, under a line that says what the topic is about."""

from __future__ import annotations

from typing import Any

from aadm_workbench.report.bcf.findings import Finding
from aadm_workbench.report.column_view import foot_sketches
from aadm_workbench.report.pages.pdf_canvas import area, draw_sketch, write, write_lines
from aadm_workbench.report.pages.png import png_of
from aadm_workbench.report.words.labels import COLOUR, FAINT, phrase, verdict_words

_WIDTH = 900  # points
_SCALE = 0.8  # pixels of a point: viewers show 720 pixels at two thirds of that, letters of 12 points are still read
_HEAD = 110  # points: a bar, the name, two lines of its reason
_CAPTION = 44  # points: two lines under each sketch
_FOOT = 34  # points: one line at the end
_MARGIN = 24  # points: a letter of the name


def foot_picture(finding: Finding) -> bytes:
    """The PNG of one topic, the same bytes for the same report.

    Sleeves, bars and their pairs as designed, seen from above, with magnified arrows to what was measured; what a topic
    of one pair is about is ringed.
    """
    every = list(foot_sketches(finding.column, marked=[f"{letter}{finding.number}" for letter in "SR"]))
    # What passes has nothing to show; it would be two thirds of the picture.
    sketches = [titled for titled in every if finding.number is not None or titled.speaks] or every
    side = _WIDTH if len(sketches) < 2 else _WIDTH // 2
    rows = -(-len(sketches) // 2)
    height = _HEAD + rows * (side + _CAPTION) + _FOOT

    def draw(canvas: Any) -> None:
        _head(canvas, finding, height)
        for number, titled in enumerate(sketches):
            left, top = number % 2 * side, height - _HEAD - number // 2 * (side + _CAPTION)
            draw_sketch(canvas, titled.foot.sketch, (left, top - side), side)
            write(canvas, (left + _MARGIN, top - side - 12), phrase(titled.title).en, 15, bold=True)
            write(canvas, (left + _MARGIN, top - side - 30), titled.caption.en, 12, colour=FAINT)
        write_lines(canvas, (_MARGIN, 14), _last_line(finding), 15, _WIDTH - 2 * _MARGIN, most=1)

    return png_of(draw, _WIDTH, height, "report.bcf", _SCALE)


def _head(canvas: Any, finding: Finding, height: int) -> None:
    """The colour of the verdict, what it is about, and the first reason."""
    colour, wide = COLOUR[finding.verdict], _WIDTH - 2 * _MARGIN
    area(canvas, (0.0, height - 12.0), _WIDTH, 12.0, colour)
    title = f"{finding.name}: {verdict_words(finding.verdict, 'en')}"
    write_lines(canvas, (_MARGIN, height - 52), title, 28, wide, colour=colour, bold=True, most=1)
    write_lines(canvas, (_MARGIN, height - 82), finding.reasons[0] if finding.reasons else "", 16, wide, most=2)


def _last_line(finding: Finding) -> str:
    """The pair of this topic that is furthest apart."""
    if not finding.column.groups:
        return "Nothing was measured on this foot."
    names = {f"S{number}" for number in finding.numbers}
    pairs = [pair for pair in finding.column.pairs if pair.sleeve in names]
    if not pairs:
        return ""
    worst = max(pairs, key=lambda pair: pair.distance_mm)
    return f"Trial assembly: {worst.sleeve}/{worst.rebar} are {worst.distance_mm:.2f} mm apart."
