"""report.pdf: what report.html shows, on A4, to sign and to file.

The first page says what to do, has a date and lines to sign on; then follow the columns, each on pages of its own, so
that a thousand of them take no more memory than one. Those of which nothing was measured share pages.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import Any

from aadm_workbench.model import JobReport
from aadm_workbench.report.column_view import column_notes
from aadm_workbench.report.drawing.mould import mould_sketch
from aadm_workbench.report.drawing.plan import floor_plans
from aadm_workbench.report.findings import Finding, findings
from aadm_workbench.report.hoist import headline, worst_state
from aadm_workbench.report.pages.crew import crew_advice, in_steps
from aadm_workbench.report.pages.pdf_canvas import A4, MM, end_page, pages, write
from aadm_workbench.report.pages.pdf_column import column_parts
from aadm_workbench.report.pages.pdf_flow import Block, Page, height_of, paginate
from aadm_workbench.report.pages.pdf_parts import Drawing, fields, paragraph
from aadm_workbench.report.pages.pdf_tables import table
from aadm_workbench.report.pages.pdf_tower import setting_out_blocks, tower_blocks
from aadm_workbench.report.sheets.sheets import MOULD, mould_rows, profile_table
from aadm_workbench.report.sheets.tables import narrowed
from aadm_workbench.report.tower import TowerShown
from aadm_workbench.report.words.labels import (
    COLOUR,
    FAINT,
    MOVE,
    Language,
    Phrase,
    all_words,
    phrase,
    profile_words,
    told,
    verdict_words,
)
from aadm_workbench.report.words.reasons import in_both_languages

_MARGIN = 14.0 * MM  # printers reach as far
WIDTH = A4[0] - 2.0 * _MARGIN
"""Between the margins."""
_HEIGHT = A4[1] - 30.0 * MM  # 14 mm above; 16 below, with the foot
_FULL_ENOUGH = 0.15  # of a last page: seven lines of a table and its heading are no remnant
_MOST_TILES = 140  # fourteen rows of ten fill a page
_SMALLER = (1.0, 0.85, 0.7)  # sketches, where that saves a remnant: their smallest letters stay 4 points high


def write_pdf(report: JobReport, path: Path, language: Language = "en", *, tower: TowerShown | None = None) -> None:
    """Write report.pdf, whole or not at all; the same report gives the same bytes. ``tower`` as in report.html.

    Raises
    ------
    MissingDependencyError
        Without the package reportlab.
    AadmError
        Where the file cannot be written.
    """
    title = told(phrase("ui.title"), report.job["name"]).in_language(language)
    author = f"{report.tool['name']} {report.tool['version']}"
    found = findings(report)
    with pages(path, title, "report.pdf", author) as canvas:
        book = _Book(canvas, title)
        book.add(lambda share: list(_front(report, found, title, language)))
        if tower is not None:
            book.add(lambda share: list(tower_blocks(tower, WIDTH, language, share)))
            book.add(lambda share: list(setting_out_blocks(tower, WIDTH, language)))
        for short, together in groupby(found, key=lambda finding: finding.is_told):
            for chapter in [[*together]] if short else ([finding] for finding in together):
                book.add(partial(_of_columns, report, chapter, language))
        book.add(lambda share: list(_back(report, language)))


class _Book:
    """Pages with a foot."""

    def __init__(self, canvas: Any, title: str) -> None:
        self._canvas, self._title = canvas, title[:90]
        self._number = 0

    def add(self, blocks_of: Callable[[float], list[Block]]) -> None:
        """A chapter, from the head of a page on; with smaller sketches where its last page is but a remnant."""
        for page in _without_remnant(blocks_of):
            self._number += 1
            for placed in page:
                placed.block.draw(self._canvas, _MARGIN, A4[1] - 14.0 * MM - placed.below)
            write(self._canvas, (_MARGIN, 9.0 * MM), self._title, 7.5, colour=FAINT)
            write(self._canvas, (A4[0] - _MARGIN, 9.0 * MM), str(self._number), 7.5, colour=FAINT, anchor="end")
            end_page(self._canvas)


def _without_remnant(blocks_of: Callable[[float], list[Block]]) -> list[Page]:
    """Pages whose last one is no remnant: by smaller sketches, else by fuller ones before it."""
    first = paginate(blocks_of(1.0), _HEIGHT)
    if first == [[]]:
        return []
    found = first
    for share in _SMALLER:
        found = found if share == 1.0 else paginate(blocks_of(share), _HEIGHT)
        if _ends_well(found):
            return found
    shorter = paginate(blocks_of(1.0), (1.0 - _FULL_ENOUGH) * _HEIGHT)
    return shorter if _ends_well(shorter) and len(shorter) == len(first) else first


def _ends_well(found: list[Page]) -> bool:
    return len(found) == 1 or height_of(found[-1]) > _FULL_ENOUGH * _HEIGHT


def _front(report: JobReport, found: list[Finding], title: str, language: Language) -> Iterator[Block]:
    yield paragraph(title, WIDTH, 17.0, bold=True, outline=0, bookmark="top")
    said = " · ".join(told(_named(key), value).in_language(language) for key, value in report.capture.items() if value)
    limits = profile_words(report.profile.name, report.profile.title).in_language(language)
    yield paragraph(" · ".join(part for part in (said, limits) if part), WIDTH, 8.0, colour=FAINT, after=8.0)
    colour = {"no": COLOUR["fail"], "not_yet": COLOUR["not_measured"], "yes": COLOUR["pass"]}[worst_state(report)]
    yield paragraph(headline(report).in_language(language), WIDTH, 20.0, bold=True, colour=colour, after=2.0)
    names = ("checked_by", "signature", "date_signed")
    yield fields([phrase(f"ui.{name}").in_language(language) for name in names], WIDTH)
    for finding in found:
        if finding.hoist.state == "no":
            yield from _forbidden(report, finding, language)
    for state in ("not_yet", "yes"):
        yield from _others([finding for finding in found if finding.hoist.state == state], state, language)
    yield from _plans(report, found, language)


def _named(key: str) -> Phrase:
    """The name of something about the capture; those that people add keep theirs."""
    return all_words().get(f"ui.{key}", Phrase(key, key))


def _forbidden(report: JobReport, finding: Finding, language: Language) -> Iterator[Block]:
    """A column that must not be hoisted: why, and what to do."""
    column = finding.column
    place = f" ({column.grid})" if column.grid else ""
    verdict = verdict_words(column.verdict, language)
    line = f"{column.id}{place}  {verdict} – {finding.hoist.cause.in_language(language)}"
    yield paragraph(
        line, WIDTH, 10.5, bold=True, colour=COLOUR[column.verdict], after=1.0, link=finding.anchor, keep=True
    )
    more = phrase("shown.more", number=finding.more).in_language(language) if finding.more else ""
    for k, reason in enumerate(finding.key_reasons):
        last = more if k == len(finding.key_reasons) - 1 else ""
        yield paragraph(reason.in_language(language) + last, WIDTH, 9.0, indent=8.0, after=0.0, keep=True)
    steps = in_steps(crew_advice(report, column))
    said = told(phrase("ui.what_to_do"), steps).in_language(language)
    yield paragraph(said, WIDTH, 9.0, colour=MOVE, indent=8.0, after=6.0)


def _others(found: list[Finding], state: str, language: Language) -> Iterator[Block]:
    if not found:
        return
    said = phrase(f"headline.{state}", number=len(found)).in_language(language)
    colour = COLOUR["pass" if state == "yes" else "not_measured"]
    yield paragraph(said, WIDTH, 12.0, bold=True, colour=colour, keep=True)
    names = ", ".join(finding.column.id for finding in found)
    why = "" if state == "yes" else f" – {found[0].hoist.cause.in_language(language)}"
    yield paragraph(f"{names}{why}", WIDTH, 9.5, indent=8.0, after=6.0)


def _plans(report: JobReport, found: list[Finding], language: Language) -> Iterator[Block]:
    anchors = {finding.column.id: finding.anchor for finding in found}
    for plan in floor_plans(report.columns, anchors, report.grid, _MOST_TILES):
        name = phrase("ui.floor_plan").in_language(language)
        yield paragraph(f"{name} {plan.storey}".strip(), WIDTH, 12.0, bold=True, keep=True)
        yield Drawing(plan.sketch, WIDTH)


def _of_columns(report: JobReport, found: Sequence[Finding], language: Language, share: float) -> list[Block]:
    """One column; several, where nothing but words is said of each."""
    return [block for finding in found for block in _of_column(report, finding, language, share)]


def _of_column(report: JobReport, finding: Finding, language: Language, share: float) -> list[Block]:
    notes = (in_both_languages(note).in_language(language) for note in column_notes(finding.column))
    said = [paragraph(f"· {note}", WIDTH, 7.5, colour=FAINT, after=1.0) for note in notes]
    return [*column_parts(report, finding, WIDTH, language, share), *said]


def _back(report: JobReport, language: Language) -> Iterator[Block]:
    yield from _moulds(report, language)
    yield from _profile(report, language)
    yield from _inputs(report, language)


def _moulds(report: JobReport, language: Language) -> Iterator[Block]:
    for number, mould in enumerate(report.mould_drift):
        name = told(phrase("ui.mould"), mould.name).in_language(language)
        yield paragraph(name, WIDTH, 13.0, bold=True, outline=0, bookmark=f"mould-{number}")
        yield paragraph(in_both_languages(mould.conclusion).in_language(language), WIDTH, 9.0, bold=True)
        limit = "–" if mould.axis_limit_mm is None else f"{mould.axis_limit_mm:.2f}"
        yield paragraph(phrase("ui.mould_note", limit=limit).in_language(language), WIDTH, 8.0, colour=FAINT)
        yield Drawing(mould_sketch(mould), 0.7 * WIDTH)
        yield table(*narrowed(MOULD, list(mould_rows(mould, language))), WIDTH, language)
        yield paragraph("", WIDTH, 6.0)


def _profile(report: JobReport, language: Language) -> Iterator[Block]:
    name = told(phrase("ui.profile"), report.profile.name).in_language(language)
    yield paragraph(name, WIDTH, 13.0, bold=True, outline=0, bookmark="profile")
    yield paragraph(phrase("ui.unverified_note").in_language(language), WIDTH, 8.0, colour=FAINT)
    limits = profile_table(report)
    yield table(limits.headings, limits.rows, WIDTH, language)
    yield paragraph("", WIDTH, 6.0)


def _inputs(report: JobReport, language: Language) -> Iterator[Block]:
    yield paragraph(phrase("ui.inputs").in_language(language), WIDTH, 13.0, bold=True, outline=0, bookmark="inputs")
    lines: list[tuple[Phrase, str]] = [(phrase("ui.job"), f"{report.job['name']}  {report.job['sha256']}")]
    if report.model is not None:
        lines.append((phrase("ui.model"), f"{report.model['source']}  {report.model['sha256']}"))
    rest = ", ".join(f"{key} {value}" for key, value in report.job.items() if key not in ("name", "sha256"))
    lines.append((phrase("ui.settings"), rest))
    lines.append((phrase("ui.made_by"), ", ".join(f"{key} {value}" for key, value in report.tool.items())))
    for word, value in lines:
        yield paragraph(told(word, value).in_language(language), WIDTH, 8.0, after=2.0)
    yield paragraph(phrase("ui.frames_note").in_language(language), WIDTH, 8.0, colour=FAINT)
