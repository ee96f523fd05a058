"""Alignment while the column hangs (paper, 2.2): how far each sleeve is from its bar, and what the crane must do.

The steps: find the foot face and the bars below it, tell which is which by the patterns, fit all sleeves and all bars,
project the bars onto the foot along its normal, and find the move that leaves the smallest largest distance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.errors import ScanError
from aadm_workbench.hoisting.bar_fit import fit_bars
from aadm_workbench.hoisting.bars import SeenBars, find_bars
from aadm_workbench.hoisting.face import FootFace, NoFace, find_foot
from aadm_workbench.hoisting.foot import FootFit, fit_foot
from aadm_workbench.hoisting.frame import HoistingFrame, NoFrame, frame_of
from aadm_workbench.hoisting.match import Laid, Matched, NoMatch, corner_name, match_hoisting
from aadm_workbench.hoisting.moved import moved_since, still_known, with_scans_named
from aadm_workbench.hoisting.pairs import HungFit, report_pairs, unmeasured
from aadm_workbench.hoisting.pattern_fit import Pattern
from aadm_workbench.hoisting.sense import shown_sleeves, why_half, why_not_bars, why_not_foot
from aadm_workbench.hoisting.sighting import Sighting, with_sighting
from aadm_workbench.hoisting.turn_findings import held_while_ambiguous, with_turn_finding
from aadm_workbench.hoisting.unseen import measured_labels
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    ColumnDesign,
    HoistingMeasurement,
    Kind,
    Profile,
    Reason,
    Scan,
)
from aadm_workbench.scan.plausible import check_plausible, extent_mm

METHOD = "refined"
# what two scans of one point differ by beyond their noise: warps of two poses of the camera, 0.025 mm each
_BEFORE_FLOOR_MM = 0.04
_LOOKED_AT = 40_000  # points: enough for an extent


@dataclass(frozen=True)
class HoistingSettings:
    """How a frame is measured. ``profile`` None: distances are reported without a limit.

    ``scatter_mm`` is how far sleeves and bars stand from their design places, per axis, where no scan from before
    hoisting says it; ``seed`` starts every random draw.
    """

    profile: Profile | None = None
    decision: DecisionRule = "guarded"
    scatter_mm: float = 0.7
    seed: int = 0


def measure_hoisting(
    scan: Scan,
    design: ColumnDesign,
    *,
    near: tuple[int, int] | None,
    sleeves_before: Sequence[AssemblyPoint | None] | None = None,
    rebars_before: Sequence[AssemblyPoint | None] | None = None,
    settings: HoistingSettings | None = None,
) -> HoistingMeasurement:
    """Measure one frame of a column that hangs over its bars.

    Parameters
    ----------
    scan
        Points in mm, scan frame; organised or a cloud whose viewpoint is known or its origin.
    design
        The column, with its bars.
    near
        Signs of x and y of the corner of the bars nearest to the camera; None where it is not known.
    sleeves_before, rebars_before
        As measured before hoisting, in the column frame, in the order of the design; None for what was not measured.
        They replace the places of the design.
    settings
        Limits and decision rule; by default distances without a verdict.

    Returns
    -------
    HoistingMeasurement
        Its verdict is ``not_measured``, with the reason, where the frame cannot support one.
    """
    settings = settings or HoistingSettings()
    if len(design.rebars) != len(design.sleeves) or not design.sleeves:
        return unmeasured(scan, design, METHOD, Reason("hoisting.unpaired"))
    try:
        if check_plausible(_thinned(scan), extent_mm(design.sleeves)).declared_scale != scan.declared_scale:
            scan = check_plausible(scan, extent_mm(design.sleeves))
    except ScanError as error:
        return unmeasured(scan, design, METHOD, error.reason)
    frame = frame_of(scan)
    if isinstance(frame, NoFrame):
        return unmeasured(scan, design, METHOD, frame.reason)
    return _measured(scan, frame, design, near, sleeves_before, rebars_before, settings)


def _thinned(scan: Scan) -> Scan:
    """Enough of a scan to see how large it is."""
    if scan.organised:
        step = max(1, int(np.sqrt(scan.points.size / 3 / _LOOKED_AT)))
        return replace(scan, points=scan.points[::step, ::step])
    return replace(scan, points=scan.points[:: max(1, len(scan.points) // _LOOKED_AT)])


def _measured(
    scan: Scan,
    frame: HoistingFrame,
    design: ColumnDesign,
    near: tuple[int, int] | None,
    sleeves_before: Sequence[AssemblyPoint | None] | None,
    rebars_before: Sequence[AssemblyPoint | None] | None,
    settings: HoistingSettings,
) -> HoistingMeasurement:
    rng = np.random.default_rng(settings.seed)
    sleeve_mm, bar_mm = (float(np.median([p.diameter_mm for p in design.points(kind)])) for kind in Kind)
    sleeve_places, rebar_places = _places(design.sleeves), _places(design.rebars)
    face = find_foot(frame, sleeve_mm, rng)
    if isinstance(face, NoFace):
        return unmeasured(scan, design, METHOD, face.reason)
    reach_mm = 1.5 * float(np.hypot(*np.ptp(rebar_places, axis=0))) + 200.0
    bars = find_bars(frame, face, bar_mm, reach_mm)
    if not len(bars.centres):
        reason = Reason("hoisting.no_bar", bar_mm=bar_mm)
        return unmeasured(scan, design, METHOD, reason)
    matched = match_hoisting(face.mouths, bars.centres, face.eye[:2], sleeve_places, rebar_places, near)
    if isinstance(matched, NoMatch):
        return unmeasured(scan, design, METHOD, matched.reason)
    known = near is not None or matched.orientation == "resolved"
    sleeves_before, rebars_before = (sleeves_before, rebars_before) if known else (None, None)
    foot = _foot(frame, face, design, matched, sleeves_before, sleeve_mm, settings)
    moved = moved_since(sleeves_before, _labels(design.sleeves), foot.centres, foot.covariance, foot.seen)
    if moved and sleeves_before is not None:
        sleeves_before = still_known(sleeves_before, _labels(design.sleeves), foot.seen, moved)
        foot = _foot(frame, face, design, matched, sleeves_before, sleeve_mm, settings)
    hung = _bars(frame, face, foot, bars, design, matched, rebars_before, bar_mm, settings)
    fit = hung.bars
    bent = moved_since(rebars_before, _labels(design.rebars), fit.tops[:, :2], fit.covariance, fit.seen)
    if bent and rebars_before is not None:
        rebars_before = still_known(rebars_before, _labels(design.rebars), fit.seen, bent)
        hung = _bars(frame, face, foot, bars, design, matched, rebars_before, bar_mm, settings)
    before = *measured_labels(sleeves_before, design.sleeves), *measured_labels(rebars_before, design.rebars)
    hung = replace(hung, before=before)
    shown = shown_sleeves(frame, face, foot)
    half = why_half(shown)
    unlike = why_not_foot(face, foot, sleeve_mm) or why_not_bars(frame, hung, bars, matched, bar_mm)
    if unlike:
        return unmeasured(scan, design, METHOD, half or unlike)
    measured = report_pairs(scan, frame, design, hung, matched.orientation, settings.profile, settings.decision, half)
    report = with_scans_named(measured.report, (*moved, *bent), before)
    report = replace(report, near=None if near is None else corner_name(near))
    measured = replace(measured, report=held_while_ambiguous(with_turn_finding(report, near, matched.off_declared)))
    sleeves = _pattern(design.sleeves, sleeves_before, settings.scatter_mm)
    rebars = _pattern(design.rebars, rebars_before, settings.scatter_mm)
    return with_sighting(measured, Sighting(scan, frame, hung, sleeves, rebars, shown, near, matched.orientation))


def _labels(points: Sequence[AssemblyPoint]) -> list[str]:
    return [point.label for point in points]


def _places(points: Sequence[AssemblyPoint]) -> Array:
    return np.array([point.centre[:2] for point in points])


def _pattern(
    design: Sequence[AssemblyPoint], before: Sequence[AssemblyPoint | None] | None, scatter_mm: float
) -> Pattern:
    """Places by design, or as they were measured before hoisting, with what is not known of them."""
    places, scatter = _places(design), np.full(len(design), scatter_mm)
    for k, point in enumerate(before or ()):
        if point is not None:
            places[k] = point.centre[:2]
            variance = 0.1**2 if point.covariance is None else float(np.trace(point.covariance[:2, :2])) / 2.0
            scatter[k] = np.sqrt(variance + _BEFORE_FLOOR_MM**2)
    return Pattern(places, scatter)


def _foot(
    frame: HoistingFrame,
    face: FootFace,
    design: ColumnDesign,
    matched: Matched,
    before: Sequence[AssemblyPoint | None] | None,
    diameter_mm: float,
    settings: HoistingSettings,
) -> FootFit:
    pose = matched.sleeves.pose
    leans = None
    if before is not None:
        known = [np.zeros(2) if point is None else point.axis[:2] / point.axis[2] for point in before]
        leans = np.array(known) @ turn(float(pose[2])).T
    return fit_foot(frame, face, _pattern(design.sleeves, before, settings.scatter_mm), pose, diameter_mm, leans)


def _bars(
    frame: HoistingFrame,
    face: FootFace,
    foot: FootFit,
    bars: SeenBars,
    design: ColumnDesign,
    matched: Matched,
    before: Sequence[AssemblyPoint | None] | None,
    diameter_mm: float,
    settings: HoistingSettings,
) -> HungFit:
    axes = face.along(bars.vertical)
    tops = axes.local(face.to_frame(np.column_stack([bars.centres, bars.tops])))
    laid = matched.rebars
    starts = np.full((len(design.rebars), 2), np.nan)
    found = laid.matched >= 0
    starts[found] = tops[laid.matched[found], :2]
    pose = _refined_pose(laid, _places(design.rebars), starts)
    pattern = _pattern(design.rebars, before, settings.scatter_mm)
    fit = fit_bars(frame, axes, pattern, pose, float(np.median(tops[:, 2])), diameter_mm, starts)
    return HungFit(face, foot, axes, fit, bars.floor)


def _refined_pose(laid: Laid, places: Array, starts: Array) -> Array:
    """The pose of the bars' pattern in their own axes: its turn stays, its shift is that of the found bars."""
    known = np.isfinite(starts[:, 0])
    shift = np.median(starts[known] - places[known] @ turn(float(laid.pose[2])).T, axis=0)
    return np.array([*shift, laid.pose[2]])
