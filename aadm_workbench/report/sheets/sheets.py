"""The tables of a whole job, one for each question, as the sheets of a workbook hold them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from aadm_workbench.model import (
    ColumnReport,
    JobReport,
    Kind,
    MouldDrift,
    PointResult,
    TrialReport,
    Verdict,
)
from aadm_workbench.report.column_view import declared_up
from aadm_workbench.report.hoist import hoist_of, worst_first
from aadm_workbench.report.sheets.section_rows import SECTION, section_rows
from aadm_workbench.report.sheets.tables import (
    ABSOLUTE,
    HOISTING,
    INPUTS,
    PAIRS,
    POINTS,
    RULES,
    SPACING,
    Heading,
    Row,
    Table,
    absolute_rows,
    heading,
    hoisting_rows,
    input_rows,
    pair_rows,
    point_rows,
    rule_rows,
    spacing_rows,
)
from aadm_workbench.report.words.labels import Language, Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages

_COLUMN = heading("column")


def job_tables(report: JobReport, language: Language = "en") -> list[Table]:
    """Columns, points, spacing, pairs and so on; those without a row are left out, but for the first four.

    ``language`` is that of the sentences; headings bring both.
    """
    columns = worst_first(report)
    always = [
        columns_table(report, language),
        _sheet("points_sheet", POINTS, _each(columns, lambda c: (r for k in Kind for r in point_rows(report, c, k)))),
        _sheet("spacing", SPACING, _each(columns, lambda c: (r for k in Kind for r in spacing_rows(report, c, k)))),
        _sheet("trial", PAIRS, _each(columns, lambda c: pair_rows(report, c))),
    ]
    more = [
        _sheet("section", SECTION, _each(columns, lambda c: section_rows(report, c))),
        _sheet("absolute", ABSOLUTE, _each(columns, lambda c: absolute_rows(report, c))),
        _sheet("hoisting", (heading("frame"), *HOISTING), _each(columns, lambda c: _frames(report, c))),
        _sheet("rules", RULES, _each(columns, rule_rows)),
        _sheet("repair", _REPAIR, _each(columns, _repair_rows)),
        mould_table(report),
        _sheet("inputs", INPUTS, _each(columns, input_rows)),
    ]
    return [*always, *(table for table in more if table.rows), profile_table(report)]


def columns_table(report: JobReport, language: Language = "en") -> Table:
    """One row for each column: may it be hoisted, and why not."""
    headings = (
        _COLUMN,
        heading("may_be_hoisted"),
        heading("verdict", "verdict"),
        heading("goes_on", "verdict"),
        _of("position", "sleeve"),
        _of("position", "rebar"),
        _of("largest_distance", "minimax"),
        _of("largest_distance", "least_squares"),
        Heading(phrase("ui.margin"), "ratio"),
        Heading(phrase("ui.probability"), "share"),
        heading("reasons"),
        heading("repair"),
        heading("grid"),
        heading("storey"),
        heading("piece_mark"),
        heading("global_id"),
        heading("as_declared"),
    )
    rows = tuple(_column_row(column, language) for column in worst_first(report))
    return Table(phrase("ui.columns"), headings, rows)


def _of(word: str, of: str) -> Heading:
    name, what = phrase(f"ui.{word}"), phrase(f"ui.{of}")
    return Heading(Phrase(f"{name.en}, {what.en}", f"{name.zh}（{what.zh}）"), "mm")


def _column_row(column: ColumnReport, language: Language) -> Row:
    hoist = hoist_of(column)
    trial = column.trial_assembly or TrialReport(Verdict.NOT_ASSESSED)
    poses = trial.poses
    return (
        column.id,
        phrase(f"state.{hoist.state}").in_language(language),
        column.verdict,
        column.goes_on,
        *(_largest_mm(column.points(kind)) for kind in Kind),
        *(poses[name].max_mm if name in poses else None for name in ("minimax", "least_squares")),
        trial.margin,
        trial.probability,
        "; ".join(reason.in_language(language) for reason in hoist.reasons),
        None if column.repair is None else in_both_languages(column.repair.advice).in_language(language),
        column.grid,
        column.storey,
        column.piece_mark,
        column.global_id,
        declared_up(column),
    )


def _largest_mm(points: Sequence[PointResult]) -> float | None:
    return max((point.deviation_mm for point in points if point.deviation_mm is not None), default=None)


_REPAIR = (
    heading("step"),
    heading("pair"),
    heading("offset_x", "mm_signed"),
    heading("offset_y", "mm_signed"),
    heading("note"),
)


def _repair_rows(column: ColumnReport) -> Iterator[Row]:
    repair = column.repair
    if repair is None:
        return
    yield (repair.action, "", None, None, repair.advice)
    for step in repair.steps:
        pair = f"{step.sleeve}/{step.rebar}"
        yield (step.action, pair, *(step.bend_mm or (None, None)), step.reason)


def _frames(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    for frame in column.hoisting_frames:
        yield from ((frame.name, *row) for row in hoisting_rows(report, frame))


MOULD = (
    heading("sleeve"),
    Heading(Phrase("Mean dx", "平均 dx"), "mm_signed"),
    Heading(Phrase("Mean dy", "平均 dy"), "mm_signed"),
    Heading(Phrase("95 % ±x", "95 % ±x"), "mm"),
    Heading(Phrase("95 % ±y", "95 % ±y"), "mm"),
    Heading(Phrase("Scatter x", "离散 x"), "mm_fine"),
    Heading(Phrase("Scatter y", "离散 y"), "mm_fine"),
    Heading(Phrase("Cp x", "Cp x"), "ratio"),
    Heading(Phrase("Cpk x", "Cpk x"), "ratio"),
    Heading(Phrase("Cp y", "Cp y"), "ratio"),
    Heading(Phrase("Cpk y", "Cpk y"), "ratio"),
    heading("p_value", "ratio"),
    heading("note"),
)


def mould_rows(mould: MouldDrift, language: Language = "en") -> Iterator[Row]:
    """Rows under :data:`MOULD` of one mould."""
    for sleeve in mould.sleeves:
        by_axis = {item.axis: (item.cp, item.cpk) for item in sleeve.capability}
        capability = [value for axis in "xy" for value in by_axis.get(axis, (None, None))]
        word = "drifts" if sleeve.drifts else "scatters_more" if sleeve.scatters_more else "steady"
        said = phrase(f"ui.{word}").in_language(language)
        moved = (*sleeve.mean_mm, *sleeve.interval_mm, *sleeve.scatter_mm)
        yield (sleeve.label, *moved, *capability, sleeve.p_value, said)


def mould_table(report: JobReport) -> Table:
    """Every sleeve of every mould of the batch."""
    rows = tuple(
        (mould.piece_mark or "", len(mould.columns), *row) for mould in report.mould_drift for row in mould_rows(mould)
    )
    return Table(phrase("ui.mould"), (heading("piece_mark"), heading("columns", "count"), *MOULD), rows)


def profile_table(report: JobReport) -> Table:
    """The limits of the job's tolerance profile."""
    headings = (
        heading("rule", "rule"),
        heading("lower_limit", "mm"),
        heading("upper_limit", "mm"),
        heading("clause"),
        heading("source", "source"),
        heading("severity", "rule"),
        heading("advisory"),
        heading("note"),
    )
    rows = tuple(
        (
            rule.name,
            rule.lower_mm,
            rule.upper_mm,
            rule.clause,
            rule.source,
            rule.severity,
            "✓" if rule.advisory else "",
            rule.note,
        )
        for rule in report.profile.rules
    )
    return Table(phrase("ui.profile"), headings, rows)


def _each(columns: Iterable[ColumnReport], rows_of: Callable[[ColumnReport], Iterable[Row]]) -> tuple[Row, ...]:
    return tuple((column.id, *row) for column in columns for row in rows_of(column))


def _sheet(word: str, headings: tuple[Heading, ...], rows: tuple[Row, ...]) -> Table:
    return Table(phrase(f"ui.{word}"), (_COLUMN, *headings), rows)
