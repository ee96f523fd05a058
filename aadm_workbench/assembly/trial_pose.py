"""What becomes of each pair of rebar and sleeve at one pose of the trial assembly: distance, clearance, verdict."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aadm_workbench.assembly.decision import Decision, DecisionRule, decide_radial, standard_uncertainty
from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.tolerances import describe_clause
from aadm_workbench.assembly.upright import planar_transform, turn
from aadm_workbench.model import Array, PairResult, Rule, TrialPose, Verdict


def evaluate_pose(
    pairs: Sequence[Pair], yaw: float, shift: Array, rule: Rule | None, decision: DecisionRule
) -> TrialPose:
    """Distances and clearances of all pairs where bars are turned by ``yaw`` and moved by ``shift`` (2,) mm."""
    results = tuple(_evaluate(pair, yaw, shift, rule, decision) for pair in pairs)
    distances = np.array([result.distance_mm for result in results])
    return TrialPose(
        T_sleeves_rebars=planar_transform(yaw, shift),
        max_mm=float(distances.max()),
        mean_mm=float(distances.mean()),
        sd_mm=float(distances.std()),
        pairs=results,
    )


def _evaluate(pair: Pair, yaw: float, shift: Array, rule: Rule | None, decision: DecisionRule) -> PairResult:
    rotation = turn(yaw)
    offset = rotation @ pair.rebar_xy + shift - pair.sleeve_xy
    distance_mm = float(np.hypot(*offset))
    clearance_mm = None
    if pair.room_mm is not None:
        at_mouth = float(np.hypot(*(offset - rotation @ pair.bar_shift)))
        at_top = float(np.hypot(*(offset - pair.sleeve_shift)))
        clearance_mm = pair.room_mm - max(at_mouth, at_top)
    u_mm = standard_uncertainty(pair.covariance)
    decided = Decision(Verdict.NOT_ASSESSED, None)
    if rule is not None:
        decided = decide_radial(offset, pair.covariance, rule.upper, decision)
    collides = clearance_mm is not None and clearance_mm < 0.0
    return PairResult(
        sleeve=pair.sleeve,
        rebar=pair.rebar,
        offset_mm=(float(offset[0]), float(offset[1])),
        distance_mm=distance_mm,
        u_mm=u_mm,
        limit_mm=None if rule is None else rule.upper,
        clearance_mm=clearance_mm,
        verdict=Verdict.FAIL if collides else decided.verdict,
        reason=_reason(pair, distance_mm, u_mm, clearance_mm, rule, decided.verdict),
        probability=decided.probability,
    )


def _reason(
    pair: Pair,
    distance_mm: float,
    u_mm: float | None,
    clearance_mm: float | None,
    rule: Rule | None,
    verdict: Verdict,
) -> str:
    texts = []
    if rule is not None and verdict in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        limit = f"limit {rule.upper:g} mm ({describe_clause(rule)})"
        texts.append(f"{pair.rebar} is {distance_mm:.2f} mm from the centre of {pair.sleeve}, {limit}")
        if verdict is Verdict.INCONCLUSIVE:
            texts[-1] += f": too close to it for an uncertainty of {u_mm or 0.0:.2f} mm"
    if clearance_mm is not None and clearance_mm < 0.0:
        texts.append(
            f"{pair.rebar} collides with {pair.sleeve}: {-clearance_mm:.2f} mm of room are missing over the ribs"
        )
    return "; ".join(texts)
