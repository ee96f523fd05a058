"""The section of a foot as rows of a table: its sides, its edges, the pattern in it, and how flat its face is."""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.model import ColumnReport, JobReport, Reason, Verdict
from aadm_workbench.model.reports import SectionLength, SectionReport
from aadm_workbench.report.clauses import clause_of
from aadm_workbench.report.sheets.numbers import number_text
from aadm_workbench.report.sheets.tables import SPACING, Row, heading
from aadm_workbench.report.words.labels import Phrase, phrase
from aadm_workbench.report.words.reasons import in_both_languages, recognised

SECTION = (heading("part"), *SPACING[1:])

_LIMITS = {"x": "section_size", "y": "section_size", "flatness": "face_flatness"}


def section_rows(report: JobReport, column: ColumnReport) -> Iterator[Row]:
    """Rows under :data:`SECTION`; none where the section was not looked at."""
    section = column.section
    if section is None:
        return
    for length in section.lengths:
        yield _length(report, length)
    yield from _pattern(report, section)
    for edge in section.edges:
        off_mm = None if edge.measured_mm is None else edge.measured_mm - edge.design_mm
        yield (
            Reason("said.section_edge", side=edge.side),
            edge.design_mm,
            edge.measured_mm,
            off_mm,
            edge.u_mm,
            *(None, None),
            *("", ""),
            None if edge.measured_mm is not None else Verdict.NOT_MEASURED,  # no rule limits an edge
            edge.reason,
        )


def _length(report: JobReport, length: SectionLength) -> Row:
    lower, upper = length.limit_mm or (None, None)
    flat = length.name == "flatness"
    return (
        Reason("said.section_flatness") if flat else Reason("said.section_side", axis=length.name),
        length.design_mm,
        length.measured_mm,
        length.deviation_mm,
        length.u_mm,
        lower,
        upper,
        *clause_of(report, _LIMITS[length.name], upper),
        length.verdict,
        length.reason,
    )


def _pattern(report: JobReport, section: SectionReport) -> Iterator[Row]:
    place = section.pattern
    for axis, name in enumerate("xy"):
        off_mm = None if place.offset_mm is None else place.offset_mm[axis]
        limit_mm = place.limit_mm
        yield (
            Reason("said.section_pattern", axis=name),
            0.0,
            off_mm,
            off_mm,
            None if place.u_mm is None else place.u_mm[axis],
            None if limit_mm is None else -limit_mm,
            limit_mm,
            *clause_of(report, "pattern_in_section", limit_mm),
            place.verdict,
            place.reason,
        )


def section_line(section: SectionReport) -> Phrase | None:
    """How square the section is, how the pattern is turned in it, and which edges were not measured, and why."""
    parts = []
    for word, value, u in (
        ("squareness", section.squareness_deg, section.u_squareness_deg),
        ("pattern_turn", section.pattern.turn_deg, section.pattern.u_turn_deg),
    ):
        if value is not None and u is not None:
            said = f"{number_text(value, 'deg')}° (±{number_text(2.0 * u, 'deg')}°)"
            parts.append(Phrase(f"{phrase(f'ui.{word}').en} {said}", f"{phrase(f'ui.{word}').zh} {said}"))
    unseen = [
        in_both_languages(Reason("assembly.section_edge", side=edge.side, why=recognised(edge.reason)))
        for edge in section.edges
        if edge.measured_mm is None
    ]
    if unseen:
        label = phrase("ui.edges_unseen")
        told = "; ".join(one.en for one in unseen), "；".join(one.zh for one in unseen)
        parts.append(Phrase(f"{label.en}: {told[0]}", f"{label.zh}：{told[1]}"))
    if not parts:
        return None
    return Phrase(" · ".join(part.en for part in parts), " · ".join(part.zh for part in parts))
