"""Position of each centre against design, after the fit of its group: radial, in the plane (paper, 2.1.2).

What is judged is the residual of the fit, so its covariance is that of a residual: with H the projection of all
coordinates on the three parameters of the pose, C' = (I − H)·C·(I − H)ᵀ. The fit hides a group that stands off the
grid as a whole: the absolute position is another check.

Spacing of adjacent centres against design: signed, in the plane, without any fit (T/CCES 30-2022, 4.3.3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.decision import (
    Decision,
    DecisionRule,
    decide_per_axis,
    decide_radial,
    decide_signed,
    standard_uncertainty,
)
from aadm_workbench.assembly.pairs import PlacedPoint, flat_covariance
from aadm_workbench.assembly.tolerances import describe_clause, describe_limit
from aadm_workbench.design.recognise.pattern import adjacent
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    PointResult,
    Reason,
    Rule,
    SpacingResult,
    Vector2,
    Vector3,
    Verdict,
)


def inspect_positions(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    rule: Rule | None,
    *,
    decision: DecisionRule,
    missing: str,
    scale_error: float = 0.0,
) -> tuple[PointResult, ...]:
    """Offset of every measured centre from its design point, and the verdict on it.

    Parameters
    ----------
    design
        Design points in the column frame.
    placed
        What was measured of each, in the column frame, after the least-squares fit of the group.
    rule
        The limit; None reports deviations without a verdict.
    scale_error
        Relative standard uncertainty (k = 1) of the camera's lengths, where the covariances do not hold it.
    missing
        The reason given for points that were not measured.

    Returns
    -------
    One result for each design point, in their order, also for those not measured.
    """
    found = [index for index, point in enumerate(placed) if point is not None]
    points = [point.point for point in placed if point is not None]
    flat = np.array([design[index].centre[:2] for index in found]).reshape(-1, 2)
    covariances = residual_covariances(flat, [flat_covariance(point) for point in points], scale_error)
    known = dict(zip(found, covariances, strict=True))
    return tuple(
        _unmeasured(target, rule, missing)
        if point is None
        else _measured(target, point, known[index], rule, decision, scale_error)
        for index, (target, point) in enumerate(zip(design, placed, strict=True))
    )


def residual_covariances(
    points: Array, covariances: Sequence[Array | None], scale_error: float = 0.0
) -> list[Array | None]:
    """Covariance (2, 2), mm², of each residual of an unweighted rigid fit in the plane.

    Parameters
    ----------
    points
        (n, 2) float64, mm.
    covariances
        Of the measured points, (2, 2) each. Where one is None so is its result, and for the fit's part of the
        others it is taken to be the mean of those known.
    scale_error
        Relative standard uncertainty of all lengths together: it moves every point along its distance from the
        centroid, which no rigid pose can take up.
    """
    known = [covariance for covariance in covariances if covariance is not None]
    if not known:
        return [None] * len(covariances)
    mean = np.mean(known, axis=0)
    count = len(points)
    full = np.zeros((2 * count, 2 * count))
    for index, covariance in enumerate(covariances):
        full[2 * index : 2 * index + 2, 2 * index : 2 * index + 2] = mean if covariance is None else covariance
    spoke = points - points.mean(axis=0)
    parameters = np.zeros((2 * count, 3))
    parameters[0::2, 0] = parameters[1::2, 1] = 1.0
    parameters[0::2, 2], parameters[1::2, 2] = -spoke[:, 1], spoke[:, 0]
    residual = np.eye(2 * count) - parameters @ np.linalg.pinv(parameters)
    stretch = scale_error * spoke.reshape(-1)
    full = residual @ full @ residual.T + np.outer(stretch, stretch)
    blocks = [full[2 * index : 2 * index + 2, 2 * index : 2 * index + 2] for index in range(count)]
    return [None if covariances[index] is None else block for index, block in enumerate(blocks)]


def _unmeasured(target: AssemblyPoint, rule: Rule | None, missing: str) -> PointResult:
    return PointResult(
        label=target.label,
        global_id=target.global_id,
        design_mm=as_vector(target.centre),
        scan_mm=None,
        aligned_mm=None,
        diameter_mm=None,
        axis_tilt_deg=None,
        offset_mm=None,
        deviation_mm=None,
        u_mm=None,
        limit_mm=None if rule is None else rule.upper,
        verdict=Verdict.NOT_MEASURED,
        reason=Reason("said.of", what=target.label, why=missing),
    )


def covariance_before_fit(measured: PlacedPoint, scale_error: float) -> Array | None:
    """Covariance (2, 2), mm², of a centre as the scan has it, in the plane of the column frame.

    Parameters
    ----------
    scale_error
        Relative standard uncertainty of the camera's lengths: it moves a point along its line from the camera, the
        origin of the scan frame. What of that is common to all points is still in it, for no fit was made.
    """
    own = flat_covariance(measured.point)
    if own is None:
        return None
    stretch = scale_error * measured.from_camera[:2]
    return own + np.outer(stretch, stretch)


def _measured(
    target: AssemblyPoint,
    measured: PlacedPoint,
    covariance: Array | None,
    rule: Rule | None,
    decision: DecisionRule,
    scale_error: float,
) -> PointResult:
    offset = measured.point.centre[:2] - target.centre[:2]
    deviation_mm = math.hypot(float(offset[0]), float(offset[1]))
    u_mm = standard_uncertainty(covariance)
    decided = Decision(Verdict.NOT_ASSESSED, None)
    if rule is not None:
        decide = decide_per_axis if rule.kind == "per_axis" else decide_radial
        decided = decide(offset, covariance, rule.upper, decision)
    return PointResult(
        label=target.label,
        global_id=target.global_id,
        design_mm=as_vector(target.centre),
        scan_mm=as_vector(measured.scan_mm),
        aligned_mm=as_vector(measured.point.centre),
        diameter_mm=measured.point.diameter_mm,
        axis_tilt_deg=math.degrees(math.acos(min(1.0, float(measured.point.axis[2])))),
        offset_mm=(float(offset[0]), float(offset[1])),
        deviation_mm=deviation_mm,
        u_mm=u_mm,
        limit_mm=None if rule is None else rule.upper,
        verdict=decided.verdict,
        reason=_reason(target.label, deviation_mm, u_mm, rule, decided.verdict),
        probability=decided.probability,
        exposed_length_mm=measured.exposed_length_mm,
        axis=as_vector(measured.point.axis),
        u_axis_deg=None if measured.point.axis_covariance is None else _u_deg(measured.point.axis_covariance),
        cov_mm2=_rows(covariance_before_fit(measured, scale_error)),
    )


def _u_deg(axis_covariance: Array) -> float:
    """Standard uncertainty of a direction per axis: its covariance (3, 3) has two axes across it."""
    return math.degrees(math.sqrt(max(float(np.trace(axis_covariance)) / 2.0, 0.0)))


def _rows(covariance: Array | None) -> tuple[Vector2, Vector2] | None:
    if covariance is None:
        return None
    (xx, xy), (yx, yy) = covariance.tolist()
    return (xx, xy), (yx, yy)


def _reason(label: str, deviation_mm: float, u_mm: float | None, rule: Rule | None, verdict: Verdict) -> str:
    if rule is None or verdict not in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        return ""
    text = Reason("assembly.from_design", label=label, deviation_mm=deviation_mm, limit=describe_limit(rule))
    return text if verdict is Verdict.FAIL else Reason("assembly.close_rescan", what=text, u_mm=u_mm or 0.0)


def as_vector(values: Array) -> Vector3:
    """The three numbers of a (3,) array, as reports hold them."""
    x, y, z = (float(value) for value in values)
    return x, y, z


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
        reason=_spacing_reason(between, deviation_mm, u_mm, rule, decided.verdict),
        probability=decided.probability,
    )


def _uncertainty(span: Array, covariances: tuple[Array | None, Array | None], scale_error: float) -> float | None:
    first, second = covariances
    length = float(np.linalg.norm(span))
    if first is None or second is None or length == 0.0:
        return None
    along = span / length
    return math.sqrt(max(float(along @ (first + second) @ along), 0.0) + (scale_error * length) ** 2)


def _spacing_reason(
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
