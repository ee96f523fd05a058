"""A frame whose ``near`` hardly says which turn is meant: the column, or the camera, is nearly at the next one."""

from __future__ import annotations

import math
from dataclasses import replace

from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.model import HoistingReport, Verdict, worst

DOUBTFUL_DEG = 40.5
"""More than 40°, to the degree. At 45° a square ring is as near to its next turn as to this one."""


def with_turn_finding(report: HoistingReport, near: tuple[int, int] | None, off_declared: float) -> HoistingReport:
    """The report of a frame, held back where it hangs more than 40° off what ``near`` claims; ``off_declared`` rad."""
    if near is None or math.degrees(off_declared) <= DOUBTFUL_DEG:
        return report
    said = "".join(f"{'+' if sign > 0 else '-'}{axis}" for sign, axis in zip(near, "xy", strict=True))
    finding = make_finding(
        "hoisting_turn_doubtful", ["column"], source=report.source, near=said, turn_deg=math.degrees(off_declared)
    )
    return replace(
        report,
        verdict=worst((report.verdict, Verdict.INCONCLUSIVE)),
        reasons=(finding.text, *report.reasons),
        findings=(finding,),
    )
