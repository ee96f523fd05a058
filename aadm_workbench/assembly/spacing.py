"""Spacing of adjacent centres against design: signed, in the plane, without any fit (T/CCES 30-2022, 4.3.3)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.decision import Decision, DecisionRule, decide_signed
from aadm_workbench.assembly.place import PlacedPoint, flat_covariance
from aadm_workbench.assembly.tolerances import describe_clause
from aadm_workbench.design.recognise.pattern import adjacent
from aadm_workbench.model import Array, AssemblyPoint, Reason, Rule, SpacingResult, Verdict


def inspect_spacing(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    rule: Rule | None,
    *,
    decision: DecisionRule,
    scale_error: float = 0.0,
) -> tuple[SpacingResult, ...]:
    """Measured minus design distance of every two adjacent centres, and the verdict on it.

    Parameters are those of :func:`~aadm_workbench.assembly.position.inspect_positions`. The uncertainty comes from
    both centres, along the line between them, and from the scale of the camera.
    """
    if len(design) < 2:
        return ()
    pairs = adjacent(np.array([point.centre[:2] for point in design]))
    return tuple(_spacing(design, placed, pair, rule, decision, scale_error) for pair in pairs)


def _spacing(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    pair: tuple[int, int],
    rule: Rule | None,
    decision: DecisionRule,
    scale_error: float,
) -> SpacingResult:
    between = (design[pair[0]].label, design[pair[1]].label)
    design_mm = float(np.linalg.norm((design[pair[1]].centre - design[pair[0]].centre)[:2]))
    limit_mm = None if rule is None else (rule.lower, rule.upper)
    first, second = placed[pair[0]], placed[pair[1]]
    if first is None or second is None:
        missing = [label for label, point in zip(between, (first, second), strict=True) if point is None]
        reason = Reason("assembly.unspaced", first=between[0], second=between[1], missing=missing)
        return SpacingResult(between, design_mm, None, None, None, limit_mm, Verdict.NOT_MEASURED, reason)
    span = (second.point.centre - first.point.centre)[:2]
    measured_mm = float(np.linalg.norm(span))
    deviation_mm = measured_mm - design_mm
    covariances = flat_covariance(first.point), flat_covariance(second.point)
    u_mm = _uncertainty(span, covariances, scale_error)
    decided = Decision(Verdict.NOT_ASSESSED, None)
    if rule is not None:
        decided = decide_signed(deviation_mm, u_mm, rule.lower, rule.upper, decision)
    return SpacingResult(
        between=between,
        design_mm=design_mm,
        measured_mm=measured_mm,
        deviation_mm=deviation_mm,
        u_mm=u_mm,
        limit_mm=limit_mm,
        verdict=decided.verdict,
        reason=_reason(between, deviation_mm, u_mm, rule, decided.verdict),
        probability=decided.probability,
    )


def _uncertainty(span: Array, covariances: tuple[Array | None, Array | None], scale_error: float) -> float | None:
    first, second = covariances
    length = float(np.linalg.norm(span))
    if first is None or second is None or length == 0.0:
        return None
    along = span / length
    return math.sqrt(max(float(along @ (first + second) @ along), 0.0) + (scale_error * length) ** 2)


def _reason(
    between: tuple[str, str], deviation_mm: float, u_mm: float | None, rule: Rule | None, verdict: Verdict
) -> str:
    if rule is None or verdict not in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        return ""
    text = Reason(
        "assembly.spaced",
        first=between[0],
        second=between[1],
        deviation_mm=deviation_mm,
        limits=describe_limits(rule),
        clause=describe_clause(rule),
    )
    return text if verdict is Verdict.FAIL else Reason("assembly.close_rescan", what=text, u_mm=u_mm or 0.0)


def describe_limits(rule: Rule) -> str:
    """The limits of a signed rule as messages print them: ``±2`` or ``0 to +10``."""
    if rule.lower is None:
        return f"{rule.upper:+g}"
    if rule.lower == -rule.upper:
        return f"±{rule.upper:g}"
    code = "assembly.from_zero" if rule.lower == 0.0 else "assembly.from_to"
    return Reason(code, lower=rule.lower, upper=rule.upper)
