"""What of a foot's section somebody should look at; none of it says anything against the sleeves and their bars."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from aadm_workbench.assembly.findings.finding import make_finding
from aadm_workbench.model import Finding, Verdict
from aadm_workbench.model.reports import SectionReport

_NAMED_MM = 1.0  # a pattern off its place in the section by half of what a sleeve may be is said, whatever the limit
_COVERAGE = 2.0  # of the expanded uncertainty, 95 %
_CHIP_MM = 5.0  # deep: shallower ones are usual at the edges of feet
_SIDES = {"x": "-x, +x", "y": "-y, +y"}


def section_findings(section: SectionReport | None) -> Iterator[Finding]:
    """Findings that do not hold back."""
    if section is None:
        return
    for finding in (*_pattern(section), *_sizes(section), *_face(section), *_chips(section)):
        yield replace(finding, holds_back=False)


def _pattern(section: SectionReport) -> Iterator[Finding]:
    place = section.pattern
    if place.offset_mm is None or place.u_mm is None:
        return
    beyond = max(abs(value) - _COVERAGE * u for value, u in zip(place.offset_mm, place.u_mm, strict=True))
    if beyond > _NAMED_MM:
        dx, dy = place.offset_mm
        yield make_finding(
            "pattern_off_section",
            ["sleeves"],
            dx_mm=dx,
            dy_mm=dy,
            U_mm=_COVERAGE * max(place.u_mm),
            turn_deg=place.turn_deg or 0.0,
            limit_mm=0.0 if place.limit_mm is None else place.limit_mm,
        )


def _sizes(section: SectionReport) -> Iterator[Finding]:
    for length in section.lengths[:2]:
        if length.deviation_mm is None or length.verdict is Verdict.PASS or length.limit_mm is None:
            continue
        yield make_finding(
            "section_size_differs",
            ["column"],
            between=_SIDES[length.name],
            measured_mm=length.measured_mm,
            U_mm=_COVERAGE * (length.u_mm or 0.0),
            design_mm=length.design_mm,
            limit_mm=length.limit_mm[1],
        )


def _face(section: SectionReport) -> Iterator[Finding]:
    flat = section.lengths[2]
    if flat.measured_mm is not None and flat.limit_mm is not None and flat.verdict is not Verdict.PASS:
        yield make_finding(
            "face_not_flat",
            ["column"],
            range_mm=flat.measured_mm,
            U_mm=_COVERAGE * (flat.u_mm or 0.0),
            limit_mm=flat.limit_mm[1],
        )


def _chips(section: SectionReport) -> Iterator[Finding]:
    for edge in section.edges:
        for chip in edge.chips:
            if chip.depth_mm >= _CHIP_MM:
                yield make_finding(
                    "edge_chipped",
                    ["column"],
                    side=edge.side,
                    at_mm=chip.at_mm,
                    length_mm=chip.length_mm,
                    depth_mm=chip.depth_mm,
                )
