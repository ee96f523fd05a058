"""From fitted sleeves and bars to pairs, correction and verdict of a hoisting frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, decide_radial, standard_uncertainty
from aadm_workbench.assembly.pose.eopa import NoFit, turn
from aadm_workbench.assembly.pose.minimax import fit_minimax
from aadm_workbench.assembly.pose.minimax_spread import minimax_covariance
from aadm_workbench.assembly.tolerances import describe_limit, rules_for
from aadm_workbench.hoisting.bar_fit import BarFit
from aadm_workbench.hoisting.face import FootFace
from aadm_workbench.hoisting.foot import FootFit
from aadm_workbench.hoisting.frame import HoistingFrame, LocalAxes
from aadm_workbench.hoisting.unseen import look_again, unseen_in_words, verdict_unseen, would_pass
from aadm_workbench.model import (
    Array,
    BoolArray,
    CameraMove,
    ColumnDesign,
    Correction,
    HoistingMeasurement,
    HoistingPair,
    HoistingReport,
    Profile,
    Reason,
    Rule,
    Scan,
    Vector2,
    Vector3,
    Verdict,
    worst,
)

_NORMAL_U = 1.5e-4  # rad: what the warp of a camera does to the normal of a face
WARP_MM = 0.025
"""Of a place in the picture, rms: the reference camera warps by 0.05 mm."""

_SCALE_ERROR = 1e-4  # relative: of the reference camera, where the job tells no other
_KNOWN_MM, _FEWEST_DECIDE = 0.25, 3  # as well as what is seen (hoisting_bar_fit.py); a pose has three unknowns


@dataclass(frozen=True, eq=False)
class HungFit:
    """All that was fitted in one frame: the foot in the axes of its face, the bars in axes along their vertical.

    ``floor`` (3,) is its normal in the axes of the face, None where too little of it is seen; ``before`` are the labels
    of what was measured before hoisting.
    """

    face: FootFace
    foot: FootFit
    axes: LocalAxes
    bars: BarFit
    floor: Array | None = None
    before: tuple[str, ...] = ()

    @property
    def seen(self) -> BoolArray:
        """Which pairs (k,) have evidence of their own for the sleeve and for the bar."""
        return np.asarray(self.foot.seen & self.bars.seen)


@dataclass(frozen=True, eq=False)
class _Offsets:
    """Pairs in the bars' frame. ``to_bars`` (3, 3) rows are its axes in the frame; ``origin`` (3,) its origin there.

    ``sleeves``, ``rebars`` (k, 3) mm are centres in the frame, ``offsets`` (k, 2) mm, with the joint ``covariance``
    (2k, 2k); ``distances`` (k,) mm.
    """

    to_bars: Array
    origin: Array
    sleeves: Array
    rebars: Array
    offsets: Array
    distances: Array
    covariance: Array
    height_mm: float

    def of_pair(self, k: int) -> Array:
        """Covariance (2, 2) mm² of one pair's offset."""
        return self.covariance[2 * k : 2 * k + 2, 2 * k : 2 * k + 2]


def unmeasured(scan: Scan, design: ColumnDesign, method: str, reason: str) -> HoistingMeasurement:
    """The measurement of a frame that supports none."""
    pairs = tuple(
        HoistingPair(sleeve.label, rebar.label, None, None, None, None, None, False, reason)
        for sleeve, rebar in zip(design.sleeves, design.rebars, strict=False)
    )
    report = HoistingReport(
        scan.source, (), None, None, None, Verdict.NOT_MEASURED, pairs, None, (reason,), scan.sha256, method
    )
    return HoistingMeasurement(report, np.full((len(pairs), 2), np.nan), np.full((len(pairs), 2, 2), np.nan))


def report_pairs(
    scan: Scan,
    frame: HoistingFrame,
    design: ColumnDesign,
    hung: HungFit,
    orientation: str,
    profile: Profile | None,
    decision: DecisionRule,
    reason: str,
) -> HoistingMeasurement:
    """The measurement of a frame; with a ``reason`` against it, its verdict is ``not_measured``."""
    scale_error = scan.camera.scale_error if scan.camera is not None else _SCALE_ERROR
    found = _offsets(hung, scale_error)
    rule = _rule(profile)
    pairs = tuple(_pair(frame, design, hung, found, k, rule, decision, reason) for k in range(len(design.sleeves)))
    keys = _keys(found.sleeves)
    correction = _correction(hung, found, rule, [sleeve.label for sleeve in design.sleeves])
    tilt = float(np.degrees(np.arccos(np.clip(found.to_bars[2] @ hung.face.axes[2], -1.0, 1.0))))
    report = HoistingReport(
        source=scan.source,
        keys=tuple(design.sleeves[k].label for k in keys),
        mean_mm=float(np.mean([found.distances[k] for k in keys])),
        max_mm=float(found.distances.max()),
        column_tilt_deg=tilt,
        verdict=_verdict(pairs, rule, reason),
        pairs=pairs,
        correction=correction,
        reasons=_reasons(pairs, rule, reason),
        sha256=scan.sha256,
        method="refined",
        quality=_quality(hung),
        height_mm=found.height_mm,
        vertical_from="bar axes" if hung.floor is None else "floor",
        orientation=orientation,
    )
    covariances = np.array([found.of_pair(k) for k in range(len(pairs))])
    return HoistingMeasurement(report, found.offsets, covariances, *_poses(frame, hung, found))


def _offsets(hung: HungFit, scale_error: float) -> _Offsets:
    face, bars = hung.face, hung.bars
    tops = bars.tops.copy()
    level = float(np.nanmedian(np.where(bars.seen, tops[:, 2], np.nan)))
    tops[~bars.seen, 2] = level
    in_frame = hung.axes.to_frame(tops)
    local = face.local(in_frame)
    apart = local[:, :2] - hung.foot.centres
    to_bars = _bar_axes(hung)
    across = to_bars[:2] @ face.axes[:2].T
    origin = hung.axes.to_frame(np.array([*bars.pose[:2], level]))
    gap_mm = np.abs(local[:, 2])
    count = len(apart)
    covariance = hung.foot.covariance + bars.covariance
    # what tilts the face moves all bars' projections alike; what stretches the camera's lengths, each offset
    gaps = np.repeat(gap_mm, 2)
    covariance = covariance + _NORMAL_U**2 * np.outer(gaps, gaps) * np.kron(np.ones((count, count)), np.eye(2))
    covariance = covariance + scale_error**2 * np.outer(apart.ravel(), apart.ravel()) + WARP_MM**2 * np.eye(2 * count)
    # the directions of the bars' frame are those of bars that scatter about their places
    turning = np.column_stack([-apart[:, 1], apart[:, 0]]).ravel()
    covariance = covariance + bars.turn_u**2 * np.outer(turning, turning)
    turned = np.kron(np.eye(count), across)
    return _Offsets(
        to_bars=to_bars,
        origin=origin,
        sleeves=face.to_frame(np.column_stack([hung.foot.centres, np.zeros(count)])),
        rebars=in_frame,
        offsets=apart @ across.T,
        distances=np.hypot(apart[:, 0], apart[:, 1]),
        covariance=turned @ covariance @ turned.T,
        height_mm=float(np.median(gap_mm)),
    )


def _bar_axes(hung: HungFit) -> Array:
    """Axes (3, 3) of the bars' frame, rows in the frame: z the floor's normal or the mean of the bars, x their own."""
    seen = hung.bars.seen
    if hung.floor is not None:
        vertical = hung.axes.axes @ hung.face.axes.T @ hung.floor
    else:
        lean = np.median(hung.bars.leans[seen], axis=0) if seen.any() else np.zeros(2)
        vertical = np.array([*lean, 1.0]) / np.linalg.norm([*lean, 1.0])
    x = np.append(turn(float(hung.bars.pose[2]))[:, 0], 0.0)
    x = x - (x @ vertical) * vertical
    x /= np.linalg.norm(x)
    return np.asarray(np.vstack([x, np.cross(vertical, x), vertical]) @ hung.axes.axes)


def _rule(profile: Profile | None) -> Rule | None:
    return None if profile is None else next(iter(rules_for(profile, "sleeve_rebar_distance")), None)


def _pair(
    frame: HoistingFrame,
    design: ColumnDesign,
    hung: HungFit,
    found: _Offsets,
    k: int,
    rule: Rule | None,
    decision: DecisionRule,
    reason: str,
) -> HoistingPair:
    sleeve_seen, rebar_seen = bool(hung.foot.seen[k]), bool(hung.bars.seen[k])
    labels = design.sleeves[k].label, design.rebars[k].label
    unseen = [label for label, seen in zip(labels, (sleeve_seen, rebar_seen), strict=True) if not seen]
    covariance = found.of_pair(k)
    verdict, probability = Verdict.NOT_ASSESSED, None
    if rule is not None and not reason:
        decided = decide_radial(found.offsets[k], covariance, rule.upper, decision)
        verdict, probability = verdict_unseen(decided.verdict, unseen, hung.before), decided.probability
    in_scan = frame.to_scan(np.vstack([found.sleeves[k], found.rebars[k]]))
    return HoistingPair(
        sleeve=labels[0],
        rebar=labels[1],
        sleeve_scan_mm=_vector3(in_scan[0]),
        rebar_scan_mm=_vector3(in_scan[1]),
        offset_mm=_vector2(found.offsets[k]),
        distance_mm=float(found.distances[k]),
        u_mm=standard_uncertainty(covariance),
        seen=sleeve_seen and rebar_seen,
        reason=unseen_in_words(unseen, hung.before),
        sleeve_seen=sleeve_seen,
        rebar_seen=rebar_seen,
        limit_mm=None if rule is None else rule.upper,
        verdict=verdict,
        probability=probability,
    )


def _verdict(pairs: Sequence[HoistingPair], rule: Rule | None, reason: str) -> Verdict:
    if reason:
        return Verdict.NOT_MEASURED
    return Verdict.NOT_ASSESSED if rule is None else worst(pair.verdict for pair in pairs)


def _reasons(pairs: Sequence[HoistingPair], rule: Rule | None, reason: str) -> tuple[str, ...]:
    if reason:
        return (reason,)
    if rule is None:
        return ()
    clause = describe_limit(rule)
    inferred = [pair for pair in pairs if would_pass(pair)]
    beyond = [
        Reason("hoisting.far", sleeve=pair.sleeve, distance_mm=pair.distance_mm, rebar=pair.rebar, clause=clause)
        for pair in pairs
        if pair.verdict is Verdict.FAIL
    ]
    unsure = [
        Reason(
            "hoisting.close",
            sleeve=pair.sleeve,
            rebar=pair.rebar,
            distance_mm=pair.distance_mm,
            u_mm=pair.u_mm,
            clause=clause,
        )
        for pair in pairs
        if pair.verdict is Verdict.INCONCLUSIVE and pair not in inferred
    ]
    return (*beyond, *unsure, *look_again(inferred))


def key_labels(design: ColumnDesign, near: tuple[int, int]) -> tuple[str, str, str]:
    """Sleeves of the paper's key points as a camera beside corner ``near`` sees them: left, middle, right."""
    places = np.array([sleeve.centre[:2] for sleeve in design.sleeves])
    ahead = -np.array(near) / np.sqrt(2.0)
    right = np.array([ahead[1], -ahead[0]])
    chosen = ((places @ right).argmin(), (places @ ahead).argmin(), (places @ right).argmax())
    left, middle, far_right = (design.sleeves[int(index)].label for index in chosen)
    return left, middle, far_right


def _keys(sleeves: Array) -> list[int]:
    """The paper's key points (2.2.1): smallest and largest x, and smallest z, in the camera's frame."""
    chosen = {int(sleeves[:, 0].argmin()), int(sleeves[:, 2].argmin()), int(sleeves[:, 0].argmax())}
    return sorted(chosen)


def _correction(hung: HungFit, found: _Offsets, rule: Rule | None, labels: Sequence[str]) -> Correction | None:
    """The move of the column that leaves the smallest largest distance, and how sure it is."""
    foot = hung.foot
    across = found.to_bars[:2] @ hung.face.axes[:2].T
    source = (foot.centres - foot.pose[:2]) @ across.T
    limit_mm = 1.0 if rule is None else rule.upper
    target = source + found.offsets
    known = np.flatnonzero(_well_known(hung, found))
    pose = fit_minimax(source[known], target[known], np.full(len(known), limit_mm))
    if isinstance(pose, NoFit):
        return None
    rows = (2 * known[:, None] + np.arange(2)).ravel()
    generator = np.random.default_rng(0)  # the same frame is reported alike
    covariance = found.covariance[np.ix_(rows, rows)]
    spread = minimax_covariance(source[known], target[known], covariance, pose, generator)
    left_mm = float(np.hypot(*(source @ turn(pose.yaw).T + pose.shift - target).T).max())
    move = pose.shift @ found.to_bars[:2]
    ahead = np.array([0.0, 0.0, 1.0]) - found.to_bars[2, 2] * found.to_bars[2]
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, found.to_bars[2])
    yaw_deg = float(np.degrees(pose.yaw))
    return Correction(
        dx_mm=float(pose.shift[0]),
        dy_mm=float(pose.shift[1]),
        yaw_deg=yaw_deg,
        left_mm=left_mm,
        margin=None if rule is None else 1.0 - left_mm / limit_mm,
        u_mm=float(np.sqrt(np.trace(spread[:2, :2]) / 2.0)),
        u_yaw_deg=float(np.degrees(np.sqrt(spread[2, 2]))),
        camera=CameraMove(float(move @ right), float(move @ ahead), yaw_deg),
        over=tuple(labels[k] for k in known.tolist()),
    )


def _well_known(hung: HungFit, found: _Offsets) -> BoolArray:
    """Pairs (k,) that decide the move: those that are seen, or known closely from before hoisting; at least three."""
    spread_mm = np.sqrt(np.diag(found.covariance).reshape(-1, 2).mean(axis=1))
    known = hung.seen | (spread_mm < _KNOWN_MM)
    return known if known.sum() >= _FEWEST_DECIDE else np.ones(len(known), bool)


def _poses(frame: HoistingFrame, hung: HungFit, found: _Offsets) -> tuple[Array, Array]:
    """T_bars_column and T_scan_bars."""
    T_frame_bars = np.eye(4)
    T_frame_bars[:3, :3], T_frame_bars[:3, 3] = found.to_bars.T, found.origin
    angle, face = hung.foot.pose[2], hung.face
    x = np.array([np.cos(angle), np.sin(angle), 0.0]) @ face.axes
    T_frame_column = np.eye(4)
    T_frame_column[:3, :3] = np.column_stack([x, np.cross(face.axes[2], x), face.axes[2]])
    T_frame_column[:3, 3] = face.to_frame(np.array([*hung.foot.pose[:2], 0.0]))
    return np.asarray(np.linalg.inv(T_frame_bars) @ T_frame_column), np.asarray(frame.T_scan_frame @ T_frame_bars)


def _quality(hung: HungFit) -> dict[str, float | int]:
    foot, bars = hung.foot, hung.bars
    return {
        "sleeves_seen": int(foot.seen.sum()),
        "rebars_seen": int(bars.seen.sum()),
        "pairs_seen": int(hung.seen.sum()),
        "face_residual_mm": hung.face.residual_mm,
        "sleeve_diameter_mm": 2.0 * foot.radius_mm,
        "chamfer_mm": foot.push.chamfer_mm,
        "wall_push_mm": foot.push.push_mm,
        "rebar_core_diameter_mm": 2.0 * bars.radius_mm,
        "wall_points": int(foot.wall_count.sum()),
        "side_points": int(bars.counts.sum()),
    }


def _vector3(point: Array) -> Vector3:
    return float(point[0]), float(point[1]), float(point[2])


def _vector2(point: Array) -> Vector2:
    return float(point[0]), float(point[1])
