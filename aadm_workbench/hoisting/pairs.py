"""From fitted sleeves and bars to pairs, correction and verdict of a hoisting frame."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule, decide_radial, standard_uncertainty
from aadm_workbench.assembly.tolerances import describe_limit, rules_for
from aadm_workbench.hoisting.correction import correction_of
from aadm_workbench.hoisting.frame import HoistingFrame
from aadm_workbench.hoisting.moved import repair_in_words
from aadm_workbench.hoisting.offsets import HungFit, Offsets, offsets_of
from aadm_workbench.hoisting.plain_sight import missing_in_words
from aadm_workbench.hoisting.unseen import look_again, unseen_in_words, verdict_unseen, would_pass
from aadm_workbench.model import (
    Array,
    ColumnDesign,
    HoistingMeasurement,
    HoistingPair,
    HoistingReport,
    Profile,
    Reason,
    Repair,
    Rule,
    Scan,
    Vector2,
    Vector3,
    Verdict,
    worst,
)

_SCALE_ERROR = 1e-4  # relative: of the reference camera, where the job tells no other


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
    found = offsets_of(hung, scale_error)
    rule = _rule(profile)
    pairs = tuple(_pair(frame, design, hung, found, k, rule, decision, reason) for k in range(len(design.sleeves)))
    keys = _keys(found.sleeves)
    correction = correction_of(hung, found, rule, design)
    tilt = float(np.degrees(np.arccos(np.clip(found.to_bars[2] @ hung.face.axes[2], -1.0, 1.0))))
    bent = () if correction is None else correction.repairs
    said = (reason,) if reason else _reasons(pairs, rule, bent, hung.missing, design)
    report = HoistingReport(
        source=scan.source,
        keys=tuple(design.sleeves[k].label for k in keys),
        mean_mm=float(np.mean([found.distances[k] for k in keys])),
        max_mm=float(found.distances.max()),
        column_tilt_deg=tilt,
        verdict=_verdict(pairs, rule, reason),
        pairs=pairs,
        correction=correction,
        reasons=said,
        sha256=scan.sha256,
        method="refined",
        quality=_quality(hung),
        height_mm=found.height_mm,
        vertical_from="bar axes" if hung.floor is None else "floor",
        orientation=orientation,
    )
    covariances = np.array([found.of_pair(k) for k in range(len(pairs))])
    return HoistingMeasurement(report, found.offsets, covariances, *_poses(frame, hung, found))


def _rule(profile: Profile | None) -> Rule | None:
    return None if profile is None else next(iter(rules_for(profile, "sleeve_rebar_distance")), None)


def _pair(
    frame: HoistingFrame,
    design: ColumnDesign,
    hung: HungFit,
    found: Offsets,
    k: int,
    rule: Rule | None,
    decision: DecisionRule,
    reason: str,
) -> HoistingPair:
    sleeve_seen, rebar_seen = bool(hung.foot.seen[k]), bool(hung.bars.seen[k])
    labels = design.sleeves[k].label, design.rebars[k].label
    unseen = [label for label, seen in zip(labels, (sleeve_seen, rebar_seen), strict=True) if not seen]
    missing = tuple(label for label in unseen if label in hung.missing)
    said = missing_in_words(missing, design)
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
        reason=unseen_in_words([label for label in unseen if label not in missing], hung.before, said),
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


def _reasons(
    pairs: Sequence[HoistingPair],
    rule: Rule | None,
    repairs: Sequence[Repair],
    missing: tuple[str, ...],
    design: ColumnDesign,
) -> tuple[str, ...]:
    said = missing_in_words(missing, design)
    if rule is None:
        return said
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
    bent = [repair_in_words(one) for one in repairs]
    return (*said, *bent, *beyond, *unsure, *look_again(inferred, missing))


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


def _poses(frame: HoistingFrame, hung: HungFit, found: Offsets) -> tuple[Array, Array]:
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
        "face_bend_mm": hung.face.bend_mm,
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
