"""The tables of a report: one for each question. HTML, PDF, XLSX and CSV show the same rows.

A cell is None, a text, a verdict or a number (mm, degrees, shares of 1 as report.json has them); its heading says
which.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from aadm_workbench.model import AbsolutePoint, AbsolutePosition, ColumnReport, HoistingReport, JobReport, Kind
from aadm_workbench.report.clauses import clause_of
from aadm_workbench.report.words.labels import Phrase, phrase

Cell: TypeAlias = str | float | int | None
Row: TypeAlias = tuple[Cell, ...]
CellKind: TypeAlias = Literal[
    "text", "rule", "source", "verdict", "mm", "mm_signed", "mm_fine", "deg", "share", "ratio", "count"
]
"""What the cells of a column hold; ``mm_signed`` are offsets and what is measured minus design."""


@dataclass(frozen=True)
class Heading:
    """Name of a column of a table, unit included, and what its cells hold."""

    name: Phrase
    kind: CellKind

    def in_full(self) -> Phrase:
        """With the unit."""
        unit = _UNITS.get(self.kind, "")
        return Phrase(f"{self.name.en}{unit}", f"{self.name.zh}{unit}") if unit else self.name


_UNITS = {"mm": ", mm", "mm_signed": ", mm", "mm_fine": ", mm", "deg": ", °"}


@dataclass(frozen=True)
class Table:
    """Rows under headings; ``name`` is a sheet's name."""

    name: Phrase
    headings: tuple[Heading, ...]
    rows: tuple[Row, ...]


def heading(word: str, kind: CellKind = "text") -> Heading:
    """A heading by the name of its word."""
    return Heading(phrase(f"ui.{word}"), kind)


def _design(axis: str) -> Heading:
    name = phrase("ui.design")
    return Heading(Phrase(f"{name.en} {axis}", f"{name.zh} {axis}"), "mm")


_LIMITED = (heading("u", "mm_fine"), heading("limit", "mm"), heading("clause"), heading("source", "source"))
_BETWEEN_LIMITS = (
    heading("u", "mm_fine"),
    heading("lower_limit", "mm"),
    heading("upper_limit", "mm"),
    heading("clause"),
    heading("source", "source"),
)
_OFFSET = (heading("offset_x", "mm_signed"), heading("offset_y", "mm_signed"))
POINTS = (
    heading("point"),
    _design("x"),
    _design("y"),
    *_OFFSET,
    heading("deviation", "mm"),
    *_LIMITED,
    heading("verdict", "verdict"),
    heading("diameter", "mm"),
    heading("tilt", "deg"),
    heading("exposed", "mm"),
    heading("reason"),
)
SPACING = (
    heading("between"),
    heading("design", "mm"),
    heading("measured", "mm"),
    heading("deviation", "mm_signed"),
    *_BETWEEN_LIMITS,
    heading("verdict", "verdict"),
    heading("reason"),
)


def _by(word: str, item: str, kind: CellKind = "mm") -> Heading:
    pose, name = phrase(f"ui.{word}"), phrase(f"ui.{item}")
    return Heading(Phrase(f"{name.en} ({pose.en})", f"{name.zh}（{pose.zh}）"), kind)


PAIRS = (
    heading("pair"),
    *_OFFSET,
    _by("best", "distance"),
    _by("least_squares", "distance"),
    *_LIMITED,
    heading("room", "mm"),
    heading("verdict", "verdict"),
    _by("least_squares", "verdict", "verdict"),
    heading("reason"),
)
ABSOLUTE = (heading("point"), *_OFFSET, heading("deviation", "mm"), *_LIMITED, heading("verdict", "verdict"))
HOISTING = (
    heading("pair"),
    *_OFFSET,
    heading("distance", "mm"),
    *_LIMITED,
    heading("verdict", "verdict"),
    heading("seen"),
    heading("reason"),
)
RULES = (
    heading("rule", "rule"),
    heading("largest", "mm"),
    heading("verdict", "verdict"),
    heading("counted"),
    heading("clause"),
    heading("source", "source"),
    heading("reason"),
)
INPUTS = (heading("use"), heading("file"), heading("method"), heading("hash"))


def point_rows(report: JobReport, column: ColumnReport, kind: Kind) -> Iterator[Row]:
    """Rows under :data:`POINTS` of sleeves or rebars."""
    for point in column.points(kind):
        clause = clause_of(report, f"{kind}_position", point.limit_mm)
        yield (
            point.label,
            *point.design_mm[:2],
            *(point.offset_mm or (None, None)),
            point.deviation_mm,
            point.u_mm,
            point.limit_mm,
            *clause,
            point.verdict,
            point.diameter_mm,
            point.axis_tilt_deg,
            point.exposed_length_mm,
            point.reason,
        )


def spacing_rows(report: JobReport, column: ColumnReport, kind: Kind) -> Iterator[Row]:
    """Rows under :data:`SPACING` of sleeves or rebars."""
    group = column.group(kind)
    for spacing in () if group is None else group.spacing:
        lower, upper = spacing.limit_mm or (None, None)
        yield (
            "–".join(spacing.between),
            spacing.design_mm,
            spacing.measured_mm,
            spacing.deviation_mm,
            spacing.u_mm,
            lower,
            upper,
            *clause_of(report, f"{kind}_spacing", upper),
            spacing.verdict,
            spacing.reason,
        )


def pair_rows(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    """Rows under :data:`PAIRS`: the best pose, with least squares beside it."""
    trial = column.trial_assembly
    least = None if trial is None else trial.least_squares
    squares = {(pair.sleeve, pair.rebar): pair for pair in (() if least is None else least.pairs)}
    for pair in column.pairs:
        other = squares.get((pair.sleeve, pair.rebar))
        yield (
            f"{pair.sleeve}/{pair.rebar}",
            *pair.offset_mm,
            pair.distance_mm,
            None if other is None else other.distance_mm,
            pair.u_mm,
            pair.limit_mm,
            *clause_of(report, "sleeve_rebar_distance", pair.limit_mm),
            pair.clearance_mm,
            pair.verdict,
            None if other is None else other.verdict,
            pair.reason,
        )
    for label in () if trial is None else trial.missing:
        yield (label, *(None,) * 9, "not_measured", None, "")


def absolute_rows(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    """Rows under :data:`ABSOLUTE`: the group of bars first, then each bar."""
    absolute = None if column.rebars is None else column.rebars.absolute
    if absolute is None:
        return
    entries: list[tuple[str, AbsolutePosition | AbsolutePoint]] = [("", absolute)]
    for label, found in entries + [(point.label, point) for point in absolute.points]:
        clause = clause_of(report, "group_position", found.limit_mm)
        offset = found.offset_mm or (None, None)
        yield (label, *offset, found.deviation_mm, found.u_mm, found.limit_mm, *clause, found.verdict)


def hoisting_rows(report: JobReport, frame: HoistingReport) -> Iterator[Row]:
    """Rows under :data:`HOISTING` of one frame."""
    for pair in frame.pairs:
        yield (
            f"{pair.sleeve}/{pair.rebar}",
            *(pair.offset_mm or (None, None)),
            pair.distance_mm,
            pair.u_mm,
            pair.limit_mm,
            *clause_of(report, "sleeve_rebar_distance", pair.limit_mm),
            pair.verdict,
            "✓" if pair.seen else "",
            pair.reason,
        )


def rule_rows(column: ColumnReport) -> Iterator[Row]:
    """Rows under :data:`RULES`: the rules of the column, of its groups and of its trial."""
    for part in column.parts:
        for rule in part.rules:
            counted = "✓" if rule.counted else ""
            source = rule.source
            clause = rule.clause.removesuffix(f", {source}")
            yield (rule.rule, rule.worst_mm, rule.verdict, counted, clause, source, rule.reason)


def input_rows(column: ColumnReport) -> Iterator[Row]:
    """Rows under :data:`INPUTS`: the scans of a column with their hashes."""
    for kind, group in column.groups.items():
        yield (kind.plural, group.source, group.method, group.sha256)
    for frame in column.hoisting:
        yield ("hoisting", frame.source, frame.method, frame.sha256)


def narrowed(headings: Sequence[Heading], rows: Sequence[Row]) -> tuple[tuple[Heading, ...], list[Row]]:
    """Without the columns that are empty in every row."""
    filled = [
        column for column in enumerate(zip(*rows, strict=True)) if any(cell not in (None, "") for cell in column[1])
    ]
    kept = tuple(headings[k] for k, _ in filled)
    return kept, list(zip(*(column for _, column in filled), strict=True))
