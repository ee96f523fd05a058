"""A frame whose ``near`` hardly says which turn is meant: the column, or the camera, is nearly at the next one."""

from __future__ import annotations

import math
from dataclasses import replace

from aadm_workbench.assembly.findings.finding import make_finding
from aadm_workbench.hoisting.match import corner_name
from aadm_workbench.model import Finding, HoistingReport, Reason, Verdict, worst

DOUBTFUL_DEG = 40.5
"""More than 40°, to the degree. At 45° a square ring is as near to its next turn as to this one."""


def with_turn_finding(report: HoistingReport, near: tuple[int, int] | None, off_declared: float) -> HoistingReport:
    """The report of a frame, held back where it hangs more than 40° off what ``near`` claims; ``off_declared`` rad."""
    if near is None or math.degrees(off_declared) <= DOUBTFUL_DEG:
        return report
    turn_deg = math.degrees(off_declared)
    finding = make_finding(
        "hoisting_turn_doubtful", ["column"], source=report.source, near=corner_name(near), turn_deg=turn_deg
    )
    return _held(report, finding)


def with_contradiction(report: HoistingReport, finding: Finding) -> HoistingReport:
    """The report of a frame that another frame contradicts: which way to push is open, so it shows none."""
    return replace(_held(report, finding), correction=None)


def _held(report: HoistingReport, finding: Finding) -> HoistingReport:
    return replace(
        report,
        verdict=worst((report.verdict, Verdict.INCONCLUSIVE)),
        reasons=(finding.text, *report.reasons),
        findings=(*report.findings, finding),
    )


def held_while_ambiguous(report: HoistingReport) -> HoistingReport:
    """The report of a frame without a correction where it is open which sleeve is which.

    A ring turned by a quarter shows the same distances, and the opposite way to push.
    """
    if report.orientation != "ambiguous":
        return report
    verdict = Verdict.NOT_MEASURED if report.verdict is Verdict.NOT_MEASURED else Verdict.INCONCLUSIVE
    said = Reason("hoisting.which_sleeve")
    return replace(report, verdict=verdict, correction=None, reasons=(said, *report.reasons))
