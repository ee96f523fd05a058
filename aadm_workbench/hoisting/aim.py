"""The correction of a hanging column, to the pose that it is to be set in: not always the middle of its play."""

from __future__ import annotations

from dataclasses import replace

from aadm_workbench.hoisting.swing.motion import moved_correction
from aadm_workbench.model import AimedPose, HoistingReport


def aimed(report: HoistingReport, target: AimedPose | None) -> HoistingReport:
    """A frame's report whose correction leads to ``target``; as it is without a target, or without a correction.

    The frame's own correction leads to the smallest largest distance; what the target is off from there was found in
    the scans from before hoisting. Both are small, so that they add up: 0.1° on 5 mm is 0.01 mm.
    """
    if target is None or report.correction is None:
        return report
    dx, dy, yaw_deg = target.from_minimax
    correction = moved_correction(report.correction, (-dx, -dy), -yaw_deg)
    limits = [pair.limit_mm for pair in report.pairs if pair.limit_mm is not None]
    margin = 1.0 - target.max_mm / min(limits) if limits else None
    return replace(report, correction=replace(correction, left_mm=target.max_mm, margin=margin))
