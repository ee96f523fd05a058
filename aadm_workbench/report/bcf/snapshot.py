"""snapshot.png: what the other reports draw of a foot, under a line that says what the topic is about."""

from __future__ import annotations

from typing import Any

from aadm_workbench.report.bcf.findings import Finding
from aadm_workbench.report.column_view import foot_sketches
from aadm_workbench.report.pages.pdf_canvas import area, draw_sketch, write, write_lines
from aadm_workbench.report.pages.png import png_of
from aadm_workbench.report.words.labels import COLOUR, FAINT, Language, Phrase, phrase, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

_WIDTH = 900  # points
_SCALE = 0.8  # pixels of a point: viewers show 720 pixels at two thirds of that, letters of 12 points are still read
_HEAD = 110  # points: a bar, the name, two lines of its reason
_CAPTION = 60  # points: three lines under each sketch
_FOOT = 34  # points: one line at the end
_MARGIN = 24  # points: a letter of the name


def foot_picture(finding: Finding, language: Language = "en") -> bytes:
    """The PNG of one topic, the same bytes for the same report.

    Sleeves, bars and their pairs as designed, with magnified arrows to what was measured; what a topic of one pair is
    about is ringed. All of it is seen from below, as the camera of the viewpoint sees it.
    """
    every = list(foot_sketches(finding.column, [f"{letter}{finding.number}" for letter in "SR"], from_below=True))
    # What passes has nothing to show; it would be two thirds of the picture.
    sketches = [titled for titled in every if finding.number is not None or titled.speaks] or every
    side = _WIDTH if len(sketches) < 2 else _WIDTH // 2
    rows = -(-len(sketches) // 2)
    height = _HEAD + rows * (side + _CAPTION) + _FOOT

    def draw(canvas: Any) -> None:
        _head(canvas, finding, height, language)
        for number, titled in enumerate(sketches):
            left, top = number % 2 * side, height - _HEAD - number // 2 * (side + _CAPTION)
            draw_sketch(canvas, titled.foot.sketch, (left, top - side), side)
            write(canvas, (left + _MARGIN, top - side - 12), phrase(titled.title).in_language(language), 15, bold=True)
            said = titled.caption.in_language(language)
            write_lines(canvas, (left + _MARGIN, top - side - 30), said, 12, side - 2 * _MARGIN, colour=FAINT, most=2)
        write_lines(canvas, (_MARGIN, 14), _last_line(finding).in_language(language), 15, _WIDTH - 2 * _MARGIN, most=1)

    return png_of(draw, _WIDTH, height, "report.bcf", _SCALE)


def _head(canvas: Any, finding: Finding, height: int, language: Language) -> None:
    """The colour of the verdict, what it is about, and the first reason."""
    colour, wide = COLOUR[finding.verdict], _WIDTH - 2 * _MARGIN
    area(canvas, (0.0, height - 12.0), _WIDTH, 12.0, colour)
    title = f"{finding.name}: {verdict_words(finding.verdict, language)}"
    write_lines(canvas, (_MARGIN, height - 52), title, 28, wide, colour=colour, bold=True, most=1)
    said = in_both_languages(finding.reasons[0]).in_language(language) if finding.reasons else ""
    write_lines(canvas, (_MARGIN, height - 82), said, 16, wide, most=2)


def _last_line(finding: Finding) -> Phrase:
    """That all is seen from below, and the pair of this topic that is furthest apart."""
    if not finding.column.groups:
        return phrase("bcf.nothing_measured")
    names = {f"S{number}" for number in finding.numbers}
    pairs = [pair for pair in finding.column.pairs if pair.sleeve in names]
    below = phrase("bcf.from_below")
    if not pairs:
        return below
    worst = max(pairs, key=lambda pair: pair.distance_mm)
    apart = phrase("bcf.apart", pair=f"{worst.sleeve}/{worst.rebar}", mm=f"{worst.distance_mm:.2f}")
    return Phrase(f"{below.en} {apart.en}", f"{below.zh}{apart.zh}")
