"""report.pdf: what report.html shows, on A4, to sign and to file."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from aadm_workbench.atomic import write_atomically
from aadm_workbench.model import JobReport
from aadm_workbench.report.column_view import column_notes
from aadm_workbench.report.drawing.mould import mould_sketch
from aadm_workbench.report.drawing.plan import floor_plans
from aadm_workbench.report.findings import Finding, findings
from aadm_workbench.report.hoist import headline
from aadm_workbench.report.pages.pdf_canvas import A4, MM, reportlab, write
from aadm_workbench.report.pages.pdf_column import column_flowables
from aadm_workbench.report.pages.pdf_parts import drawing, paragraph
from aadm_workbench.report.pages.pdf_tables import table_flowable
from aadm_workbench.report.pages.pdf_tower import tower_flowables
from aadm_workbench.report.sheets.sheets import MOULD, mould_rows, profile_table
from aadm_workbench.report.sheets.tables import narrowed
from aadm_workbench.report.tower import TowerShown
from aadm_workbench.report.words.labels import COLOUR, FAINT, Language, Phrase, phrase, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages

_MARGIN = 14.0 * MM  # printers reach as far
WIDTH = A4[0] - 2.0 * _MARGIN
"""Between the margins."""


def write_pdf(report: JobReport, path: Path, language: Language = "en", *, tower: TowerShown | None = None) -> None:
    """Write report.pdf, whole or not at all; the same report gives the same bytes. ``tower`` as in report.html.

    Raises
    ------
    MissingDependencyError
        Without the package reportlab.
    AadmError
        Where the file cannot be written.
    """
    templates: Any = reportlab("platypus", "report.pdf")
    content = io.BytesIO()
    title = f"{phrase('ui.title').in_language(language)}: {report.job['name']}"
    document = templates.BaseDocTemplate(
        content,
        pagesize=A4,
        leftMargin=_MARGIN,
        rightMargin=_MARGIN,
        topMargin=14.0 * MM,
        bottomMargin=16.0 * MM,
        title=title,
        author=f"{report.tool['name']} {report.tool['version']}",
        invariant=1,
        pageCompression=1,
    )
    frame = templates.Frame(
        _MARGIN, 16.0 * MM, WIDTH, A4[1] - 30.0 * MM, leftPadding=0, rightPadding=0, topPadding=0, bottomPadding=0
    )

    def foot(canvas: Any, page: Any) -> None:
        write(canvas, (_MARGIN, 9.0 * MM), title[:90], 7.5, colour=FAINT)
        write(canvas, (A4[0] - _MARGIN, 9.0 * MM), str(page.page), 7.5, colour=FAINT, anchor="end")

    document.addPageTemplates([templates.PageTemplate(frames=[frame], onPage=foot)])
    document.build(list(_story(report, title, language, tower)))
    write_atomically(path, content.getvalue())


def _story(report: JobReport, title: str, language: Language, tower: TowerShown | None) -> Iterator[Any]:
    templates: Any = reportlab("platypus")
    found = findings(report)
    yield paragraph(title, 17.0, bold=True, outline=0, bookmark="top")
    said = " · ".join(f"{key}: {value}" for key, value in report.capture.items() if value)
    yield paragraph(" · ".join(part for part in (said, report.profile.title) if part), 8.0, colour=FAINT, after=8.0)
    yield from _summary(report, found, language)
    yield from _plans(report, found, language)
    if tower is not None:
        yield templates.PageBreak()
        yield from tower_flowables(tower, WIDTH, language)
    for finding in found:
        yield templates.PageBreak()
        yield from column_flowables(report, finding, WIDTH, language)
        for note in column_notes(finding.column):
            yield paragraph(f"· {in_both_languages(note).in_language(language)}", 7.5, colour=FAINT, after=1.0)
    yield templates.PageBreak()
    yield from _moulds(report, language)
    yield from _profile(report, language)
    yield from _inputs(report, language)


def _summary(report: JobReport, found: list[Finding], language: Language) -> Iterator[Any]:
    """The headline, every column that must not be hoisted with its reasons, and the rest in two lines."""
    bad = any(finding.hoist.state == "no" for finding in found)
    colour = COLOUR["fail" if bad else "pass"]
    yield paragraph(headline(report).in_language(language), 20.0, bold=True, colour=colour, after=6.0)
    for finding in found:
        if finding.hoist.state == "no":
            yield from _forbidden(finding, language)
    for state in ("not_yet", "yes"):
        columns = [finding for finding in found if finding.hoist.state == state]
        if columns:
            said = phrase(f"headline.{state}", number=len(columns)).in_language(language)
            yield paragraph(
                said, 12.0, bold=True, colour=COLOUR["pass" if state == "yes" else "not_measured"], keep=True
            )
            names = ", ".join(finding.column.id for finding in columns)
            why = "" if state == "yes" else f" – {columns[0].hoist.cause.in_language(language)}"
            yield paragraph(f"{names}{why}", 9.5, indent=8.0, after=6.0)


def _forbidden(finding: Finding, language: Language) -> Iterator[Any]:
    column = finding.column
    place = f" ({column.grid})" if column.grid else ""
    verdict = verdict_words(column.verdict, language)
    cause = finding.hoist.cause.in_language(language)
    line = f"{column.id}{place}  {verdict} – {cause}"
    yield paragraph(line, 10.5, bold=True, colour=COLOUR[column.verdict], after=1.0, link=finding.anchor, keep=True)
    more = f" (+{finding.more})" if finding.more else ""
    for k, reason in enumerate(finding.key_reasons):
        last = k == len(finding.key_reasons) - 1
        yield paragraph(
            reason.in_language(language) + (more if last else ""), 9.0, indent=8.0, after=6.0 if last else 0.0
        )


def _plans(report: JobReport, found: list[Finding], language: Language) -> Iterator[Any]:
    anchors = {finding.column.id: finding.anchor for finding in found}
    for plan in floor_plans(report.columns, anchors):
        name = phrase("ui.floor_plan").in_language(language)
        yield paragraph(f"{name} {plan.storey}".strip(), 12.0, bold=True, keep=True)
        yield drawing(plan.sketch, WIDTH)


def _moulds(report: JobReport, language: Language) -> Iterator[Any]:
    for number, mould in enumerate(report.mould_drift):
        name = f"{phrase('ui.mould').in_language(language)}: {mould.name}"
        yield paragraph(name, 13.0, bold=True, outline=0, bookmark=f"mould-{number}")
        yield paragraph(in_both_languages(mould.conclusion).in_language(language), 9.0, bold=True)
        limit = "–" if mould.axis_limit_mm is None else f"{mould.axis_limit_mm:.2f}"
        yield paragraph(phrase("ui.mould_note", limit=limit).in_language(language), 8.0, colour=FAINT)
        yield drawing(mould_sketch(mould), 0.7 * WIDTH)
        yield table_flowable(*narrowed(MOULD, list(mould_rows(mould, language))), WIDTH, language)
        yield paragraph("", 6.0)


def _profile(report: JobReport, language: Language) -> Iterator[Any]:
    name = f"{phrase('ui.profile').in_language(language)}: {report.profile.name}"
    yield paragraph(name, 13.0, bold=True, outline=0, bookmark="profile")
    yield paragraph(phrase("ui.unverified_note").in_language(language), 8.0, colour=FAINT)
    table = profile_table(report)
    yield table_flowable(table.headings, table.rows, WIDTH, language)
    yield paragraph("", 6.0)


def _inputs(report: JobReport, language: Language) -> Iterator[Any]:
    yield paragraph(phrase("ui.inputs").in_language(language), 13.0, bold=True, outline=0, bookmark="inputs")
    lines: list[tuple[Phrase, str]] = [(phrase("ui.job"), f"{report.job['name']}  {report.job['sha256']}")]
    if report.model is not None:
        lines.append((phrase("ui.model"), f"{report.model['source']}  {report.model['sha256']}"))
    rest = ", ".join(f"{key} {value}" for key, value in report.job.items() if key not in ("name", "sha256"))
    lines.append((phrase("ui.settings"), rest))
    lines.append((phrase("ui.made_by"), ", ".join(f"{key} {value}" for key, value in report.tool.items())))
    for word, value in lines:
        yield paragraph(f"{word.in_language(language)}: {value}", 8.0, after=2.0)
    yield paragraph(phrase("ui.frames_note").in_language(language), 8.0, colour=FAINT)
