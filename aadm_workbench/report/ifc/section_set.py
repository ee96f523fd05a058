"""The property set of a column's own section: what its element is told about sides, edges, face, and the sleeves in it.

Property names and types are a contract: ``resources/aadm-results.ids`` checks them.
"""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.model import ColumnReport, JobReport
from aadm_workbench.model.reports import SectionLength, SectionReport
from aadm_workbench.report.clauses import clause_of
from aadm_workbench.report.ifc.addition import Property, Scalar

SECTION_SET = "AADM_SectionCheck"
_LENGTH, _POSITIVE, _ANGLE, _LABEL, _TEXT, _COUNT = (
    "IfcLengthMeasure",
    "IfcPositiveLengthMeasure",
    "IfcPlaneAngleMeasure",
    "IfcLabel",
    "IfcText",
    "IfcInteger",
)

_Told = Iterator[tuple[str, str, Scalar | None]]


def section_properties(report: JobReport, column: ColumnReport) -> list[Property]:
    """AADM_SectionCheck; empty where the section was not looked at. What was not measured is left out.

    ``PatternOffset`` is the sleeves' as a group in the section, measured minus design, column frame; uncertainties are
    k = 1, of the pattern per axis.
    """
    section = column.section
    if section is None:
        return []
    told = [*_sides(report, section), *_pattern(report, section), *_face(report, section), *_edges(section)]
    return [Property(name, measure, value) for name, measure, value in told if value is not None]


def _sides(report: JobReport, section: SectionReport) -> _Told:
    for length in section.lengths[:2]:
        name = f"Side{length.name.upper()}"
        yield f"{name}Verdict", _LABEL, length.verdict
        yield name, _POSITIVE, length.measured_mm
        yield f"{name}Deviation", _LENGTH, length.deviation_mm
        yield f"{name}Uncertainty", _LENGTH, length.u_mm
        yield f"{name}Reason", _TEXT, length.reason or None
    yield from _limited(report, "Side", "section_size", section.lengths[0])
    yield "Squareness", _ANGLE, section.squareness_deg
    yield "SquarenessUncertainty", _ANGLE, section.u_squareness_deg


def _pattern(report: JobReport, section: SectionReport) -> _Told:
    place = section.pattern
    yield "PatternVerdict", _LABEL, place.verdict
    if place.offset_mm is not None and place.u_mm is not None:
        yield "PatternOffsetX", _LENGTH, place.offset_mm[0]
        yield "PatternOffsetY", _LENGTH, place.offset_mm[1]
        yield "PatternUncertainty", _LENGTH, max(place.u_mm)
    yield "PatternTurn", _ANGLE, place.turn_deg
    yield "PatternTurnUncertainty", _ANGLE, place.u_turn_deg
    yield "PatternLimit", _POSITIVE, place.limit_mm
    yield "PatternClause", _TEXT, clause_of(report, "pattern_in_section", place.limit_mm).text or None
    yield "PatternReason", _TEXT, place.reason or None


def _face(report: JobReport, section: SectionReport) -> _Told:
    flat = section.lengths[2]
    yield "FlatnessVerdict", _LABEL, flat.verdict
    yield "Flatness", _LENGTH, flat.measured_mm
    yield "FlatnessUncertainty", _LENGTH, flat.u_mm
    yield from _limited(report, "Flatness", "face_flatness", flat)


def _limited(report: JobReport, name: str, quantity: str, length: SectionLength) -> _Told:
    upper = None if length.limit_mm is None else length.limit_mm[1]
    clause = clause_of(report, quantity, upper)
    yield f"{name}Limit", _POSITIVE, upper
    yield f"{name}Clause", _TEXT, clause.text or None
    yield f"{name}ClauseSource", _LABEL, clause.source or None


def _edges(section: SectionReport) -> _Told:
    chips = [chip.depth_mm for edge in section.edges for chip in edge.chips]
    unseen = "; ".join(f"{edge.side}: {edge.reason}" for edge in section.edges if edge.measured_mm is None)
    yield "EdgesMeasured", _COUNT, sum(edge.measured_mm is not None for edge in section.edges)
    yield "EdgesNotMeasured", _TEXT, unseen or None
    yield "Chips", _COUNT, len(chips)
    yield "DeepestChip", _LENGTH, max(chips, default=None)
