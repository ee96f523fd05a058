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
from aadm_workbench.hoisting.bars.fit import fit_bars
from aadm_workbench.hoisting.bars.search import find_bars
from aadm_workbench.hoisting.foot.bent import bent_face
from aadm_workbench.hoisting.foot.face import NoFace, find_foot
from aadm_workbench.hoisting.foot.fit import FootFit, fit_foot
from aadm_workbench.hoisting.frame import HoistingFrame, NoFrame, frame_of
from aadm_workbench.hoisting.match import Laid, NoMatch, corner_name, match_hoisting
from aadm_workbench.hoisting.moved import moved_since, still_known, with_scans_named
from aadm_workbench.hoisting.offsets import HungFit
from aadm_workbench.hoisting.pairs import report_pairs, unmeasured
from aadm_workbench.hoisting.pattern_fit import Pattern
from aadm_workbench.hoisting.plain_sight import missing_labels
from aadm_workbench.hoisting.sense import shown_sleeves, why_half, why_not_bars, why_not_foot
from aadm_workbench.hoisting.sequence.sighting import SightedMeasurement, Sighting, with_sighting
from aadm_workbench.hoisting.sequence.track import Found, follow, has_lost_bars, has_lost_foot
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
    after: Sighting | None = None,
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
    after
        What was seen of the column in the frame before, by the same camera: the frame begins where that one ended, and
        by itself where it does not find what was there.

    Returns
    -------
    HoistingMeasurement
        Its verdict is ``not_measured``, with the reason, where the frame cannot support one.
    """
    settings = settings or HoistingSettings()
    if len(design.rebars) != len(design.sleeves) or not design.sleeves:
        return unmeasured(scan, design, METHOD, Reason("hoisting.unpaired"))
    column = _Column(design, near, sleeves_before, rebars_before, settings)
    if after is not None and after.near == near and scan.declared_scale == 1.0:
        tracked = _tracked(scan, column, after)
        if tracked is not None:
            return tracked
    try:
        if check_plausible(_thinned(scan), extent_mm(design.sleeves)).declared_scale != scan.declared_scale:
            scan = check_plausible(scan, extent_mm(design.sleeves))
    except ScanError as error:
        return unmeasured(scan, design, METHOD, error.reason)
    frame = frame_of(scan)
    if isinstance(frame, NoFrame):
        return unmeasured(scan, design, METHOD, frame.reason)
    found = _searched(frame, column)
    return (
        _measured(scan, frame, column, found, 0)
        if isinstance(found, Found)
        else unmeasured(scan, design, METHOD, found)
    )


@dataclass(frozen=True, eq=False)
class _Column:
    """What is known of a column beforehand, as in :func:`measure_hoisting`."""

    design: ColumnDesign
    near: tuple[int, int] | None
    sleeves_before: Sequence[AssemblyPoint | None] | None
    rebars_before: Sequence[AssemblyPoint | None] | None
    settings: HoistingSettings

    def diameter_mm(self, kind: Kind) -> float:
        """Typical of its sleeves or of its bars."""
        return float(np.median([point.diameter_mm for point in self.design.points(kind)]))

    def as_far_as_oriented(self, orientation: str) -> _Column:
        """Without what was measured before hoisting where nobody knows which point is which."""
        is_known = self.near is not None or orientation == "resolved"
        return self if is_known else replace(self, sleeves_before=None, rebars_before=None)


def _thinned(scan: Scan) -> Scan:
    """Enough of a scan to see how large it is."""
    if scan.organised:
        step = max(1, int(np.sqrt(scan.points.size / 3 / _LOOKED_AT)))
        return replace(scan, points=scan.points[::step, ::step])
    return replace(scan, points=scan.points[:: max(1, len(scan.points) // _LOOKED_AT)])


def _tracked(scan: Scan, column: _Column, after: Sighting) -> SightedMeasurement | None:
    """The frame as it follows another one; None where it does not."""
    frame = frame_of(scan)
    found = None if isinstance(frame, NoFrame) else follow(frame, after)
    if found is None or isinstance(frame, NoFrame):
        return None
    with np.errstate(all="ignore"):  # what is lost is fitted to nothing
        foot = _foot(frame, found, column.as_far_as_oriented(after.orientation))
        if has_lost_foot(foot, after.hung.foot):
            return None
        hung = _bars(frame, found, foot, column.as_far_as_oriented(after.orientation))
    if has_lost_bars(hung, after.hung):
        return None
    measured = _measured(scan, frame, column, found, after.tracked + 1, hung)
    return measured if isinstance(measured, SightedMeasurement) else None


def _searched(frame: HoistingFrame, column: _Column) -> Found | str:
    """Where foot and bars are; why not, where they are not found."""
    rng, design = np.random.default_rng(column.settings.seed), column.design
    bar_mm = column.diameter_mm(Kind.REBAR)
    face = find_foot(frame, column.diameter_mm(Kind.SLEEVE), rng)
    if isinstance(face, NoFace):
        return face.reason
    face = bent_face(frame, face, column.diameter_mm(Kind.SLEEVE) / 2.0)
    rebar_places = _places(design.rebars)
    # half a pattern more, and what the column may hang aside of its bars while a camera still sees both
    reach_mm = 1.5 * float(np.hypot(*np.ptp(rebar_places, axis=0))) + 200.0
    bars = find_bars(frame, face, bar_mm, reach_mm)
    if not len(bars.centres):
        return Reason("hoisting.no_bar", bar_mm=bar_mm)
    matched = match_hoisting(
        face.mouths, bars.centres, face.eye[:2], _places(design.sleeves), rebar_places, column.near
    )
    return matched.reason if isinstance(matched, NoMatch) else Found(face, bars, matched)


def _measured(
    scan: Scan, frame: HoistingFrame, column: _Column, found: Found, tracked: int, fitted: HungFit | None = None
) -> HoistingMeasurement:
    """Fit what was found, unless that is done, test it against the scans from before hoisting, and report it."""
    design, settings, matched = column.design, column.settings, found.matched
    column = column.as_far_as_oriented(matched.orientation)
    foot = _foot(frame, found, column) if fitted is None else fitted.foot
    moved = moved_since(column.sleeves_before, _labels(design.sleeves), foot.centres, foot.covariance, foot.seen)
    if moved and column.sleeves_before is not None:
        known = still_known(column.sleeves_before, _labels(design.sleeves), foot.seen, moved)
        column = replace(column, sleeves_before=known)
        foot, fitted = _foot(frame, found, column), None
    hung = _bars(frame, found, foot, column) if fitted is None else fitted
    fit = hung.bars
    bent = moved_since(column.rebars_before, _labels(design.rebars), fit.tops[:, :2], fit.covariance, fit.seen)
    if bent and column.rebars_before is not None:
        known = still_known(column.rebars_before, _labels(design.rebars), fit.seen, bent)
        column = replace(column, rebars_before=known)
        hung = _bars(frame, found, foot, column)
    sleeves_known = measured_labels(column.sleeves_before, design.sleeves)
    missing = missing_labels(frame, hung, design)
    before = (*sleeves_known, *measured_labels(column.rebars_before, design.rebars))
    hung = replace(hung, before=tuple(label for label in before if label not in missing), missing=missing)
    shown = shown_sleeves(frame, found.face, foot)
    half = why_half(shown)
    unlike = why_not_foot(found.face, foot, column.diameter_mm(Kind.SLEEVE))
    unlike = unlike or why_not_bars(frame, hung, found.bars, matched, column.diameter_mm(Kind.REBAR))
    unlike = unlike or (Reason("hoisting.slid") if matched.slid else "")
    if unlike:
        return unmeasured(scan, design, METHOD, half or unlike)
    measured = report_pairs(scan, frame, design, hung, matched.orientation, settings.profile, settings.decision, half)
    report = with_scans_named(measured.report, (*moved, *bent), hung.before)
    report = replace(report, near=None if column.near is None else corner_name(column.near))
    report = held_while_ambiguous(with_turn_finding(report, column.near, matched.off_declared))
    sighting = Sighting(
        scan=scan,
        frame=frame,
        hung=hung,
        sleeves=_pattern(design.sleeves, column.sleeves_before, settings.scatter_mm),
        rebars=_pattern(design.rebars, column.rebars_before, settings.scatter_mm),
        shown=shown,
        near=column.near,
        orientation=matched.orientation,
        off_declared=matched.off_declared,
        tracked=tracked,
        shape=frame.shape,
    )
    return with_sighting(replace(measured, report=report), sighting)


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


def _foot(frame: HoistingFrame, found: Found, column: _Column) -> FootFit:
    pose = found.matched.sleeves.pose
    leans = None
    if column.sleeves_before is not None:
        known = [np.zeros(2) if point is None else point.axis[:2] / point.axis[2] for point in column.sleeves_before]
        leans = np.array(known) @ turn(float(pose[2])).T
    pattern = _pattern(column.design.sleeves, column.sleeves_before, column.settings.scatter_mm)
    earlier = None if found.earlier is None else found.earlier.foot
    return fit_foot(frame, found.face, pattern, pose, column.diameter_mm(Kind.SLEEVE), leans, earlier)


def _bars(frame: HoistingFrame, found: Found, foot: FootFit, column: _Column) -> HungFit:
    bars, laid, rebars = found.bars, found.matched.rebars, column.design.rebars
    axes = found.face.along(bars.vertical)
    tops = axes.local(found.face.to_frame(np.column_stack([bars.centres, bars.tops])))
    starts = np.full((len(rebars), 2), np.nan)
    is_found = laid.matched >= 0
    starts[is_found] = tops[laid.matched[is_found], :2]
    if found.earlier is not None:  # what it did not show then begins where its pattern had it
        last = found.earlier
        places = axes.local(last.axes.to_frame(np.nan_to_num(last.bars.tops, nan=float(np.median(tops[:, 2])))))
        starts[~is_found] = places[~is_found, :2]
    pose = _refined_pose(laid, _places(rebars), starts)
    pattern = _pattern(rebars, column.rebars_before, column.settings.scatter_mm)
    top_mm, diameter_mm = float(np.median(tops[:, 2])), column.diameter_mm(Kind.REBAR)
    earlier = None if found.earlier is None else found.earlier.bars
    fit = fit_bars(frame, axes, pattern, pose, top_mm, diameter_mm, starts, earlier)
    return HungFit(found.face, foot, axes, fit, bars.floor)


def _refined_pose(laid: Laid, places: Array, starts: Array) -> Array:
    """The pose of the bars' pattern in their own axes: its turn stays, its shift is that of the found bars."""
    known = np.isfinite(starts[:, 0])
    shift = np.median(starts[known] - places[known] @ turn(float(laid.pose[2])).T, axis=0)
    return np.array([*shift, laid.pose[2]])
