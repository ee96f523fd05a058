"""One column in report.pdf: heading, reasons, advice, sketches, trial, tables."""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.model import ColumnReport, JobReport
from aadm_workbench.report.column_view import (
    advice_notes,
    column_facts,
    foot_sketches,
    trial_facts,
    window_sketch,
    window_text,
)
from aadm_workbench.report.findings import Finding
from aadm_workbench.report.pages.pdf_flow import Block
from aadm_workbench.report.pages.pdf_parts import Beside, Drawing, band, paragraph
from aadm_workbench.report.pages.pdf_tables import table
from aadm_workbench.report.sheets.column_tables import column_blocks
from aadm_workbench.report.words.labels import COLOUR, FAINT, INK, Language, Phrase, phrase, told, verdict_words
from aadm_workbench.report.words.reasons import in_both_languages


def column_parts(
    report: JobReport, finding: Finding, width: float, language: Language, share: float = 1.0
) -> Iterator[Block]:
    """All that the report says of one column, its sketches smaller by a share."""
    column = finding.column
    verdict = verdict_words(column.verdict, language)
    state = phrase(f"state.{finding.hoist.state}").in_language(language)
    yield paragraph(column.id, width, 1.0, colour="#ffffff", outline=0, bookmark=finding.anchor, after=0.0)
    cause = finding.hoist.cause.in_language(language)
    yield band(f"{column.id}   {verdict} – {cause}", column.verdict, width)
    facts = [f"{phrase(name).in_language(language)} {value}" for name, value in column_facts(column)]
    goes_on = told(phrase("ui.goes_on"), verdict_words(column.goes_on, language)).in_language(language)
    yield paragraph(" · ".join([*facts, goes_on, state]), width, 8.5, colour=FAINT, after=5.0)
    for reason in finding.hoist.reasons:
        yield paragraph(f"· {reason.in_language(language)}", width, 9.0, after=1.0)
    yield from _repair(column, width, language)
    yield from _sketches(column, width, language, share)
    yield from _trial(column, width, language, share)
    for block in column_blocks(report, column):
        said = block.title.in_language(language)
        verdict = f"   {verdict_words(block.verdict, language)}" if block.verdict else ""
        colour = COLOUR[block.verdict] if block.verdict else INK
        yield paragraph("", width, 3.0, after=2.0)
        yield paragraph(f"{said}{verdict}", width, 10.0, bold=True, colour=colour, keep=True)
        if block.line is not None:
            yield paragraph(block.line.in_language(language), width, 8.0, colour=FAINT, keep=True)
        yield table(block.headings, block.rows, width, language)
    yield paragraph("", width, 3.0, after=3.0)


def _repair(column: ColumnReport, width: float, language: Language) -> Iterator[Block]:
    repair = column.repair
    if repair is None:
        return
    yield paragraph("", width, 3.0, after=2.0)
    yield paragraph(phrase("ui.repair").in_language(language), width, 10.0, bold=True, colour="#0b4a80", keep=True)
    yield paragraph(in_both_languages(repair.advice).in_language(language), width, 9.5, bold=True, indent=8.0)
    if repair.subject_to not in repair.advice:
        yield paragraph(phrase("ui.release").in_language(language), width, 8.5, indent=8.0)
    for note in advice_notes(column):
        yield paragraph(note.in_language(language), width, 8.5, indent=8.0)


def _sketches(column: ColumnReport, width: float, language: Language, share: float) -> Iterator[Block]:
    third = width / 3.0
    stacks = tuple(
        (
            Drawing(titled.foot.sketch, share * (third - 8.0)),
            paragraph(phrase(titled.title).in_language(language), third - 8.0, 8.0, bold=True, after=0.0),
            paragraph(titled.caption.in_language(language), third - 8.0, 7.0, colour=FAINT),
        )
        for titled in foot_sketches(column)
    )
    if stacks:
        yield Beside(stacks, third)


def _trial(column: ColumnReport, width: float, language: Language, share: float) -> Iterator[Block]:
    trial = column.trial_assembly
    if trial is None:
        return
    title = f"{phrase('ui.trial').in_language(language)}   {verdict_words(trial.verdict, language)}"
    yield paragraph(title, width, 10.0, bold=True, colour=COLOUR[trial.verdict], keep=True)
    facts = [told(phrase(name), value).in_language(language) for name, value in trial_facts(trial)]
    for name, pose in trial.poses.items():
        largest = phrase("ui.largest_distance")
        furthest = Phrase(f"{largest.en} {pose.max_mm:.2f} mm", f"{largest.zh} {pose.max_mm:.2f} mm")
        facts.append(told(phrase(f"ui.{name}"), furthest).in_language(language))
    yield paragraph(" · ".join(facts), width, 8.5)
    window = window_sketch(trial)
    room = window_text(trial) or phrase("ui.no_window")
    yield paragraph(told(phrase("ui.window"), room).in_language(language), width, 8.5, keep=window is not None)
    if window is not None:
        yield Drawing(window, share * 0.45 * width)
