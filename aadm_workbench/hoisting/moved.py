"""What moved since the scans from before hoisting: a bar that was bent on the way, by a boot or by the column itself.

Every point that the frame shows is tested against its place then: the seen ones are laid on their places of then by the
rigid pose with the least sum of absolute distances, which one bent bar does not pull, and each residual by its χ².
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.pose.eopa import robust_offsets
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    BoolArray,
    HoistingReport,
    MovedSince,
    Reason,
    Repair,
    Verdict,
)

_CHI2 = 18.42  # of two axes at one in ten thousand: a frame of twelve bars accuses wrongly once in a thousand
_LEAST_MM = 0.3  # a tenth of the limit of 3 mm; less is of no account, and cameras warp by as much as a third of it
_MODEL_MM = 0.1  # what tops at unlike heights, leans and two cameras leave between a scan and a frame
_THEN_MM = 0.1  # of a place then, where no uncertainty is told
_FEWEST = 4  # three fit a pose of which nothing can be said


def moved_since(
    before: Sequence[AssemblyPoint | None] | None, labels: Sequence[str], now: Array, covariance: Array, seen: BoolArray
) -> tuple[MovedSince, ...]:
    """The points that stand elsewhere than before hoisting.

    Parameters
    ----------
    before
        As measured then, in the order of ``labels``; None for what was not.
    now
        (k, 2) mm, in axes along the bars or along the column.
    covariance
        (2k, 2k) mm² of ``now``.
    seen
        (k,): which have evidence of their own now; only these are tested.
    """
    tested = [k for k, point in enumerate(before or ()) if point is not None and seen[k]]
    if before is None or len(tested) < _FEWEST:
        return ()
    then = [point for k in tested if (point := before[k]) is not None]
    offsets = robust_offsets(now[tested], np.array([point.centre[:2] for point in then]))
    fit_share = 1.0 + 2.0 / len(tested)  # of the variance: the pose has three unknowns for two axes of each point
    found = []
    for k, offset, point in zip(tested, offsets, then, strict=True):
        own = float(np.trace(covariance[2 * k : 2 * k + 2, 2 * k : 2 * k + 2])) / 2.0
        earlier = _THEN_MM**2 if point.covariance is None else float(np.trace(point.covariance[:2, :2])) / 2
        variance = fit_share * (own + earlier) + _MODEL_MM**2
        moved_mm = float(np.hypot(*offset))
        if moved_mm > _LEAST_MM and moved_mm**2 / variance > _CHI2:
            found.append(MovedSince(labels[k], moved_mm, float(np.sqrt(variance))))
    return tuple(found)


def still_known(
    before: Sequence[AssemblyPoint | None], labels: Sequence[str], seen: BoolArray, moved: Sequence[MovedSince]
) -> tuple[AssemblyPoint | None, ...]:
    """What scans from before hoisting still say once something has moved: of seen points that stand as they stood."""
    gone = {one.label for one in moved}
    return tuple(
        point if is_seen and label not in gone else None
        for point, label, is_seen in zip(before, labels, seen, strict=True)
    )


def with_scans_named(report: HoistingReport, moved: Sequence[MovedSince], before: Sequence[str]) -> HoistingReport:
    """The report of a frame with what moved since the scans from before hoisting, and what is known from them alone."""
    hidden = _hidden(report)
    resting = tuple(label for label in hidden if label in before)
    reasons = report.reasons
    if resting and report.verdict is Verdict.PASS:
        reasons = (*reasons, Reason("hoisting.not_seen", labels=resting))
    if moved:
        open_now = [label for label in hidden if label not in before]
        reasons = (*reasons, moved_in_words([(one.label, one.moved_mm) for one in moved], open_now))
    return replace(report, reasons=reasons, moved_since=tuple(moved), rests_on_scans=resting)


def moved_in_words(moved: Sequence[tuple[str, float]], unseen: Sequence[str]) -> Reason:
    """Labels that moved, by how much, mm, and those that nobody sees: they may have moved too."""
    points = [Reason("hoisting.moved", label=label, moved_mm=moved_mm) for label, moved_mm in moved]
    code = "hoisting.moved_since.look" if unseen else "hoisting.moved_since"
    return Reason(code, points=points, labels=unseen)


def repair_in_words(repair: Repair) -> Reason:
    """How far a bar that stands beside all others is to be bent, for whoever stands before the bars."""
    if not repair.towards:
        return Reason("hoisting.repair", label=repair.label, dx_mm=repair.dx_mm, dy_mm=repair.dy_mm)
    parts = [Reason("hoisting.repair.part", mm=one.mm, first=one.first, last=one.last) for one in repair.towards]
    return Reason("hoisting.repair.towards", label=repair.label, parts=parts)


def _hidden(report: HoistingReport) -> list[str]:
    sleeves = [pair.sleeve for pair in report.pairs if not pair.sleeve_seen]
    return sleeves + [pair.rebar for pair in report.pairs if not pair.rebar_seen]
