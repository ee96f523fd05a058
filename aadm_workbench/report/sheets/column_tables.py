"""The tables of one column in the order in which HTML and PDF show them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from aadm_workbench.model import ColumnReport, GroupReport, HoistingReport, JobReport, Kind
from aadm_workbench.report.sheets.numbers import number_text, signed
from aadm_workbench.report.sheets.section_rows import SECTION, section_line, section_rows
from aadm_workbench.report.sheets.tables import (
    ABSOLUTE,
    HOISTING,
    INPUTS,
    PAIRS,
    POINTS,
    RULES,
    SPACING,
    Cell,
    Heading,
    Row,
    absolute_rows,
    hoisting_rows,
    input_rows,
    narrowed,
    pair_rows,
    point_rows,
    rule_rows,
    spacing_rows,
)
from aadm_workbench.report.words.labels import Phrase, all_words, phrase


@dataclass(frozen=True)
class Block:
    """A table under its title; ``line`` says more about it."""

    title: Phrase
    headings: Sequence[Heading]
    rows: Sequence[Row]
    line: Phrase | None = None
    verdict: str | None = None


def column_blocks(report: JobReport, column: ColumnReport) -> list[Block]:
    """Trial pairs, then sleeves and rebars with spacing and scan quality, hoisting, rules, inputs."""
    return [
        *_block(phrase("ui.pairs"), *_unexplained(PAIRS, pair_rows(report, column))),
        *(block for kind, group in column.groups.items() for block in _group(report, column, kind, group)),
        *_section(report, column),
        *_absolute(report, column),
        *_hoisting(report, column),
        *_block(phrase("ui.rules"), RULES, _rules(column)),
        *_block(phrase("ui.inputs"), INPUTS, input_rows(column)),
    ]


def _block(
    title: Phrase,
    headings: Sequence[Heading],
    rows: Iterable[Row],
    line: Phrase | None = None,
    verdict: str | None = None,
) -> Iterator[Block]:
    kept = list(rows)
    if kept:
        yield Block(title, *narrowed(*_with_source(headings, kept)), line, verdict)


def _with_source(headings: Sequence[Heading], rows: Sequence[Row]) -> tuple[Sequence[Heading], list[Row]]:
    """Clause and source in one cell: a tick behind a clause whose text was verified, a word behind any other."""
    at = next((k for k, heading in enumerate(headings) if heading.kind == "source"), None)
    if at is None:
        return headings, list(rows)
    clause = Heading(phrase("ui.clause_verified"), "text")
    merged = [(*row[: at - 1], _clause(row[at - 1], row[at]), *row[at + 1 :]) for row in rows]
    return (*headings[: at - 1], clause, *headings[at + 1 :]), merged


def _clause(clause: Cell, source: Cell) -> str:
    if not clause:
        return ""
    return f"{clause} ✓" if source == "verified" else f"{clause}, {source}"


def _unexplained(headings: Sequence[Heading], rows: Iterable[Row]) -> tuple[Sequence[Heading], list[Row]]:
    """Without the reasons at the end of each row: the column lists them all above its tables."""
    return headings[:-1], [row[:-1] for row in rows]


def _rules(column: ColumnReport) -> Iterator[Row]:
    """Each rule once; why it was not assessed is said here, why it failed stands above all tables."""
    for row in dict.fromkeys(rule_rows(column)):
        yield row if row[2] == "not_assessed" else (*row[:-1], "")


def _joined(kind: Kind, what: str) -> Phrase:
    a, b = phrase(f"ui.{kind.plural}"), phrase(f"ui.{what}")
    return Phrase(f"{a.en}: {b.en[0].lower()}{b.en[1:]}", f"{a.zh}：{b.zh}")


def _group(report: JobReport, column: ColumnReport, kind: Kind, group: GroupReport) -> Iterator[Block]:
    points = _unexplained(POINTS, point_rows(report, column, kind))
    yield from _block(_joined(kind, "position"), *points, _found(group), group.verdict)
    yield from _block(_joined(kind, "spacing"), *_unexplained(SPACING, spacing_rows(report, column, kind)))
    yield from _quality(kind, group)


def _found(group: GroupReport) -> Phrase:
    """How many points were found, how the scan lies, how well it fits."""
    parts = [phrase("ui.found_of", found=group.found, expected=group.expected)]
    fit = group.fit
    if fit is not None:
        rms = phrase("ui.fit_rms")
        said = f"{fit.rms_mm:.2f} mm"
        parts += [phrase(f"ui.{fit.orientation}"), Phrase(f"{rms.en} {said}", f"{rms.zh} {said}")]
    return Phrase(" · ".join(part.en for part in parts), " · ".join(part.zh for part in parts))


def _quality(kind: Kind, group: GroupReport) -> Iterator[Block]:
    """What the extraction says about its scan: one heading for each figure, with its unit."""
    figures = {name: value for name, value in group.quality.items() if isinstance(value, str | int | float)}
    if not figures:
        return
    headings = []
    for name in figures:
        said = name.removesuffix("_mm").removesuffix("_deg").replace("_", " ")
        known = all_words().get(f"quality.{name}", Phrase(said, said))
        headings.append(Heading(known, "mm_fine" if name.endswith("_mm") else "text"))
    row = tuple(
        _figure(value) if h.kind == "text" else value for h, value in zip(headings, figures.values(), strict=True)
    )
    yield from _block(_joined(kind, "quality"), headings, [row], phrase("ui.quality_note"))


def _figure(value: str | float | int | bool) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def _section(report: JobReport, column: ColumnReport) -> Iterator[Block]:
    if column.section is not None:
        measured = [row for row in section_rows(report, column) if row[2] is not None]
        yield from _block(phrase("ui.section"), *_unexplained(SECTION, measured), section_line(column.section))


def _absolute(report: JobReport, column: ColumnReport) -> Iterator[Block]:
    absolute = None if column.rebars is None else column.rebars.absolute
    if absolute is not None:
        reason = Phrase(absolute.reason, absolute.reason) if absolute.reason else None
        rows = absolute_rows(report, column)
        yield from _block(phrase("ui.absolute"), ABSOLUTE, rows, reason, absolute.verdict)


def _hoisting(report: JobReport, column: ColumnReport) -> Iterator[Block]:
    for frame in column.hoisting_frames:
        title = phrase("ui.hoisting")
        said = Phrase(f"{title.en}: {frame.name}", f"{title.zh}：{frame.name}")
        yield from _block(said, HOISTING, hoisting_rows(report, frame), _correction(frame), frame.verdict)


def _correction(frame: HoistingReport) -> Phrase:
    """What the crane has to do, and how the column hangs."""
    parts = []
    if frame.correction is not None:
        move = frame.correction
        figures = f"dx {signed(move.dx_mm)} mm, dy {signed(move.dy_mm)} mm, {signed(move.yaw_deg, 3)}°"
        if move.left_mm is not None:
            figures += f" → {move.left_mm:.2f} mm"
        word = phrase("ui.correction")
        parts.append(Phrase(f"{word.en}: {figures}", f"{word.zh}：{figures}"))
    if frame.column_tilt_deg is not None:
        word, tilt = phrase("ui.column_tilt"), number_text(frame.column_tilt_deg, "deg")
        parts.append(Phrase(f"{word.en} {tilt}°", f"{word.zh} {tilt}°"))
    return Phrase(" · ".join(part.en for part in parts), " · ".join(part.zh for part in parts))
