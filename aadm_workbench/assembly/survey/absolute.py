"""Absolute position of the bars: where the group and each bar stand in the building, by control points.

The fit to design hides a group that stands off its place as a whole. The column would follow it: once the bars are in
its sleeves, a few millimetres of play are all that is left to put the column on its axis.

The report on a group of bars, completed by its absolute position.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.decision import (
    Decision,
    DecisionRule,
    decide_per_axis,
    decide_radial,
    standard_uncertainty,
)
from aadm_workbench.assembly.inspect import NO_ABSOLUTE_POSITION
from aadm_workbench.assembly.pairs import PlacedPoint, flat_covariance
from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar
from aadm_workbench.assembly.position import as_vector
from aadm_workbench.assembly.survey.control import ControlPose
from aadm_workbench.assembly.tolerances import (
    applicable_rules,
    counted_verdict,
    describe_clause,
    rule_result,
    rules_for,
)
from aadm_workbench.model import (
    AbsolutePoint,
    AbsolutePosition,
    Array,
    AssemblyPoint,
    ControlPoint,
    ControlResidual,
    GroupReport,
    Profile,
    Reason,
    Rule,
    RuleResult,
    Verdict,
    in_one,
    worst,
)

LARGEST_TURN_DEG = 10.0
"""A group turned by more than this was not built so: the control points, or the declared up, are wrong."""


@dataclass(frozen=True)
class DatumRules:
    """The rules of a profile for the group and for single bars against a datum, None where it has none."""

    group: Rule | None
    bar: Rule | None

    @classmethod
    def of(cls, profile: Profile) -> DatumRules:
        """Group: ``group_position``, else the limit of the column's axis, which the group decides. Bar: its own."""
        group = (*rules_for(profile, "group_position"), *rules_for(profile, "column_axis"))
        return cls(next(iter(group), None), next(iter(applicable_rules(profile, "rebar_position")[1]), None))


def inspect_absolute(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    points: Sequence[ControlPoint],
    pose: ControlPose | NoFit,
    rules: DatumRules,
    *,
    decision: DecisionRule,
    scale_error: float = 0.0,
) -> AbsolutePosition:
    """Offset and turn of the bars as a group, and the offset of each bar, against their places in the building.

    Parameters
    ----------
    design
        The bars in the column frame.
    placed
        What was measured of each; only where it is in the scan, and its covariance, is used.
    points, pose
        Control points, and the pose that they give.
    scale_error
        Relative standard uncertainty (k = 1) of the camera's lengths.
    """
    found = [(target, point) for target, point in zip(design, placed, strict=True) if point is not None]
    if isinstance(pose, NoFit):
        return AbsolutePosition(Verdict.NOT_MEASURED, Reason("said.of", what="absolute position", why=pose.reason))
    if len(found) < 2:
        reason = Reason("survey.absolute_few_bars")
        return AbsolutePosition(Verdict.NOT_MEASURED, reason)
    T = pose.T_column_scan
    measured = np.array([T[:3, :3] @ point.scan_mm + T[:3, 3] for _, point in found])
    offsets = (measured - np.array([target.centre for target, _ in found]))[:, :2]
    own = [flat_covariance(point.point) for _, point in found]
    bars = tuple(
        _bar(target.label, offset, _with_pose(covariance, pose, place, scale_error), rules, decision)
        for (target, _), offset, covariance, place in zip(found, offsets, own, measured, strict=True)
    )
    group = _group(measured, offsets, own, pose, scale_error, rules.group, decision)
    group = replace(group, control_points=_residuals(points, pose), points=bars)
    flat = np.array([target.centre[:2] for target, _ in found])
    return _turned(group, flat, measured[:, :2], pose, own)


def results_of(absolute: AbsolutePosition, rules: DatumRules) -> tuple[RuleResult, ...]:
    """What the rules against a datum came to."""
    results = []
    unknown = absolute.verdict is Verdict.NOT_MEASURED
    if rules.group is not None:
        results.append(rule_result(rules.group, absolute.verdict, absolute.reason, absolute.deviation_mm))
    if rules.bar is not None:
        verdict = Verdict.NOT_MEASURED if unknown else worst(point.verdict for point in absolute.points)
        reason = absolute.reason if unknown else in_one(point.reason for point in absolute.points if point.reason)
        worst_mm = max((point.deviation_mm for point in absolute.points), default=None)
        results.append(rule_result(rules.bar, verdict, reason, worst_mm))
    return tuple(results)


def _with_pose(covariance: Array | None, pose: ControlPose, place: Array, scale_error: float) -> Array | None:
    """Covariance (2, 2), mm², of a bar's place: its own, that of the pose, and that of the camera's lengths."""
    if covariance is None:
        return None
    stretch = scale_error * (place - pose.pivot)[:2]
    return np.asarray(covariance + pose.covariance_at(place) + np.outer(stretch, stretch))


def _bar(
    label: str, offset: Array, covariance: Array | None, rules: DatumRules, decision: DecisionRule
) -> AbsolutePoint:
    rule = rules.bar or rules.group
    decided = _decide(offset, covariance, rule, decision)
    deviation_mm, u_mm = float(np.hypot(*offset)), standard_uncertainty(covariance)
    what = Reason("survey.off_in_building", label=label, deviation_mm=deviation_mm)
    return AbsolutePoint(
        label=label,
        offset_mm=(float(offset[0]), float(offset[1])),
        deviation_mm=deviation_mm,
        u_mm=u_mm,
        limit_mm=None if rule is None else rule.upper,
        verdict=decided.verdict,
        probability=decided.probability,
        reason=_reason(what, u_mm, rule, decided.verdict),
    )


def _group(
    measured: Array,
    offsets: Array,
    own: Sequence[Array | None],
    pose: ControlPose,
    scale_error: float,
    rule: Rule | None,
    decision: DecisionRule,
) -> AbsolutePosition:
    offset = offsets.mean(axis=0)
    known = [covariance for covariance in own if covariance is not None]
    mean = np.mean(known, axis=0) / len(own) if known else None
    covariance = _with_pose(mean, pose, measured.mean(axis=0), scale_error)
    decided = _decide(offset, covariance, rule, decision)
    deviation_mm, u_mm = float(np.hypot(*offset)), standard_uncertainty(covariance)
    what = Reason("survey.group_off", deviation_mm=deviation_mm, dx_mm=offset[0], dy_mm=offset[1])
    return AbsolutePosition(
        verdict=decided.verdict,
        reason=_reason(what, u_mm, rule, decided.verdict),
        T_column_scan=pose.T_column_scan,
        vertical_from=pose.vertical_from,
        rms_mm=pose.rms_mm,
        offset_mm=(float(offset[0]), float(offset[1])),
        deviation_mm=deviation_mm,
        u_mm=u_mm,
        limit_mm=None if rule is None else rule.upper,
        clause="" if rule is None else describe_clause(rule),
        probability=decided.probability,
    )


def _turned(
    group: AbsolutePosition, design: Array, measured: Array, pose: ControlPose, own: Sequence[Array | None]
) -> AbsolutePosition:
    """The group with its turn; not measured where it is turned by what nobody builds."""
    fit = fit_eopa_planar(design, measured)
    if isinstance(fit, NoFit):
        return group
    turn_deg = math.degrees(fit.yaw)
    known = [covariance for covariance in own if covariance is not None]
    variance = float(pose.covariance[5, 5])
    if known:
        spread = float(((design - design.mean(axis=0)) ** 2).sum())
        variance += float(np.trace(np.mean(known, axis=0))) / 2.0 / spread
    group = replace(group, turn_deg=turn_deg, turn_u_deg=math.degrees(math.sqrt(variance)))
    if abs(turn_deg) <= LARGEST_TURN_DEG:
        return group
    reason = Reason("survey.group_turned", turn_deg=turn_deg)
    return replace(group, verdict=Verdict.NOT_MEASURED, reason=reason, points=())


def _decide(offset: Array, covariance: Array | None, rule: Rule | None, decision: DecisionRule) -> Decision:
    if rule is None:
        return Decision(Verdict.NOT_ASSESSED, None)
    decide = decide_per_axis if rule.kind == "per_axis" else decide_radial
    return decide(offset, covariance, rule.upper, decision)


def _reason(what: str, u_mm: float | None, rule: Rule | None, verdict: Verdict) -> str:
    if rule is None or verdict not in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        return ""
    text = Reason("assembly.beyond", how=what, upper=rule.upper, clause=describe_clause(rule))
    return text if verdict is Verdict.FAIL else Reason("assembly.close", what=text, u_mm=u_mm or 0.0)


def _residuals(points: Sequence[ControlPoint], pose: ControlPose) -> tuple[ControlResidual, ...]:
    return tuple(
        ControlResidual(point.name, as_vector(known), point.scan_mm, as_vector(residual), float(u_mm))
        for point, known, residual, u_mm in zip(points, pose.known, pose.residuals, pose.u_mm, strict=True)
    )


def with_absolute(report: GroupReport, absolute: AbsolutePosition, profile: Profile) -> GroupReport:
    """The report with the absolute position, its rules and its reasons; its verdict is the worse of the two.

    Nothing is said about the position of a group that was not measured at all.
    """
    if report.fit is None:
        return report
    results = results_of(absolute, DatumRules.of(profile))
    verdict = _verdict(report, results)
    reasons = [result.reason for result in results if result.reason and result.verdict is not Verdict.PASS]
    return replace(
        report,
        verdict=verdict,
        absolute=absolute,
        rules=_in_place(report.rules, results),
        reasons=(*report.reasons, *reasons),
        notes=tuple(note for note in report.notes if note != NO_ABSOLUTE_POSITION),
    )


def _verdict(report: GroupReport, results: Sequence[RuleResult]) -> Verdict:
    counted = counted_verdict(results)
    if counted is Verdict.NOT_ASSESSED:
        return report.verdict
    return counted if report.verdict is Verdict.NOT_ASSESSED else worst((report.verdict, counted))


def _in_place(rules: Sequence[RuleResult], results: Sequence[RuleResult]) -> tuple[RuleResult, ...]:
    """The results where the same rules stood as not assessed, and behind them what is new."""
    known = {result.rule: result for result in results}
    kept = tuple(known.pop(rule.rule, rule) if rule.verdict is Verdict.NOT_ASSESSED else rule for rule in rules)
    return (*kept, *known.values())
