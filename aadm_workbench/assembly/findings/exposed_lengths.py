"""Bars that stick out of the floor too little or too much to be what the sleeves need.

Where the design says how far they stick out, that is what they are held against; elsewhere the other bars are, whose
tops may differ by centimetres by right: then only what lies far outside of their own spread is told.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.model import Finding, Kind

PLAY_MM = 20.0
"""What a sleeve gives at the end that is assembled on site, beyond the embedded length: JG/T 398-2019 (recalled)."""

U_MM = 1.0
"""Standard uncertainty of an exposed length: the floor about a bar is no plane."""

_SIGMAS = 3.0  # of sound bars one in 370 is farther off, before the play
_FEWEST = 4  # of fewer bars no median tells what is usual
_TO_SIGMA = 1.4826  # of a median of absolute deviations, for the normal law


def exposed_length_findings(group: SeenGroup, design_exposed_mm: float | None) -> Iterator[Finding]:
    """One finding for each bar that is too short, or too long."""
    if group.kind is not Kind.REBAR:
        return
    seen = [
        (target, float(point.exposed_length_mm))
        for target, point in group.placed()
        if point.exposed_length_mm is not None
    ]
    if not seen or (design_exposed_mm is None and len(seen) < _FEWEST):
        return
    # A bar that is designed to end higher sticks out further.
    heights = np.array([float(target.centre[2]) for target, _ in seen])
    over = np.array([length for _, length in seen]) - (heights - np.median(heights))
    usual_mm = float(np.median(over)) if design_exposed_mm is None else design_exposed_mm
    spread_mm = _TO_SIGMA * float(np.median(np.abs(over - usual_mm))) if design_exposed_mm is None else 0.0
    threshold_mm = PLAY_MM + _SIGMAS * float(np.hypot(U_MM, spread_mm))
    of = "as the others do" if design_exposed_mm is None else "by design"
    for (target, length), deviation in zip(seen, over - usual_mm, strict=True):
        if abs(deviation) > threshold_mm:
            name = "short" if deviation < 0.0 else "long"
            yield make_finding(
                f"exposed_length_differs.{name}",
                [target.label],
                measured_mm=length,
                expected_mm=length - float(deviation),
                of=of,
            )
