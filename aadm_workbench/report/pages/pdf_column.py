"""One column in report.pdf: heading, reasons, advice, sketches, trial, tables."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from aadm_workbench.model import ColumnReport, JobReport
from aadm_workbench.report.column_view import column_facts, foot_sketches, trial_facts, window_sketch, window_text
from aadm_workbench.report.findings import Finding
from aadm_workbench.report.pages.pdf_parts import band, beside, drawing, paragraph
from aadm_workbench.report.pages.pdf_tables import table_flowable
from aadm_workbench.report.sheets.column_tables import column_blocks
from aadm_workbench.report.words.labels import COLOUR, FAINT, INK, Language, phrase, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages


def column_flowables(report: JobReport, finding: Finding, width: float, language: Language) -> Iterator[Any]:
    """All that the report says of one column."""
    column = finding.column
    verdict = verdict_words(column.verdict, language)
    state = phrase(f"state.{finding.hoist.state}").in_language(language)
    yield paragraph(column.id, 1.0, colour="#ffffff", outline=0, bookmark=finding.anchor, after=0.0)
    cause = finding.hoist.cause.in_language(language)
    yield band(f"{column.id}   {verdict} – {cause}", column.verdict, width)
    facts = [f"{phrase(name).in_language(language)} {value}" for name, value in column_facts(column)]
    goes_on = f"{phrase('ui.goes_on').in_language(language)}: {verdict_words(column.goes_on, language)}"
    yield paragraph(" · ".join([*facts, goes_on, state]), 8.5, colour=FAINT, after=5.0)
    for reason in finding.hoist.reasons:
        yield paragraph(f"· {reason.in_language(language)}", 9.0, after=1.0)
    yield from _repair(column, language)
    yield from _sketches(column, width, language)
    yield from _trial(column, width, language)
    for block in column_blocks(report, column):
        said = block.title.in_language(language)
        verdict = f"   {verdict_words(block.verdict, language)}" if block.verdict else ""
        colour = COLOUR[block.verdict] if block.verdict else INK
        yield paragraph("", 3.0, after=2.0)
        yield paragraph(f"{said}{verdict}", 10.0, bold=True, colour=colour, keep=True)
        if block.line is not None:
            yield paragraph(block.line.in_language(language), 8.0, colour=FAINT, keep=True)
        yield table_flowable(block.headings, block.rows, width, language)
    yield paragraph("", 3.0, after=3.0)


def _repair(column: ColumnReport, language: Language) -> Iterator[Any]:
    repair = column.repair
    if repair is None:
        return
    yield paragraph(phrase("ui.repair").in_language(language), 10.0, bold=True, colour="#0b4a80", keep=True)
    yield paragraph(in_both_languages(repair.advice).in_language(language), 9.5, bold=True, indent=8.0)
    if repair.subject_to not in repair.advice:
        yield paragraph(phrase("ui.release").in_language(language), 8.5, indent=8.0)
    for note in repair.notes:
        yield paragraph(in_both_languages(note).in_language(language), 8.5, indent=8.0)


def _sketches(column: ColumnReport, width: float, language: Language) -> Iterator[Any]:
    found = list(foot_sketches(column))
    if found:
        third = width / 3.0
        cells = [
            [
                drawing(titled.foot.sketch, third - 8.0),
                paragraph(phrase(titled.title).in_language(language), 8.0, bold=True, after=0.0),
                paragraph(titled.caption.in_language(language), 7.0, colour=FAINT),
            ]
            for titled in found
        ]
        yield beside(cells, third * len(cells))


def _trial(column: ColumnReport, width: float, language: Language) -> Iterator[Any]:
    trial = column.trial_assembly
    if trial is None:
        return
    title = f"{phrase('ui.trial').in_language(language)}   {verdict_words(trial.verdict, language)}"
    yield paragraph(title, 10.0, bold=True, colour=COLOUR[trial.verdict], keep=True)
    facts = [f"{phrase(name).in_language(language)}: {value}" for name, value in trial_facts(trial)]
    for name, pose in trial.poses.items():
        said = phrase(f"ui.{name}").in_language(language)
        largest = phrase("ui.largest_distance").in_language(language)
        facts.append(f"{said}: {largest} {pose.max_mm:.2f} mm")
    yield paragraph(" · ".join(facts), 8.5)
    window = window_sketch(trial)
    label = phrase("ui.window").in_language(language)
    if window is None:
        yield paragraph(f"{label}: {phrase('ui.no_window').in_language(language)}", 8.5)
    else:
        yield paragraph(f"{label}: {window_text(trial)}", 8.5, keep=True)
        yield drawing(window, 0.45 * width)
