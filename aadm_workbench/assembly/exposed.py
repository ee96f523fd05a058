"""Exposed length of connecting rebars, from the floor to their tops, against design."""

from __future__ import annotations

from collections.abc import Sequence

from aadm_workbench.assembly.decision import decide_signed
from aadm_workbench.assembly.place import PlacedPoint
from aadm_workbench.assembly.spacing import describe_limits
from aadm_workbench.assembly.tolerances import describe_clause
from aadm_workbench.model import AssemblyPoint, Reason, Rule, RuleResult, Verdict, in_one, worst


def inspect_exposed_length(
    design: Sequence[AssemblyPoint],
    placed: Sequence[PlacedPoint | None],
    rule: Rule,
    design_exposed_mm: float | None,
) -> RuleResult:
    """Worst verdict on the exposed lengths, mm, measured minus design, by value alone.

    Not assessed where the design gives no exposed length or the scan shows no floor.
    """
    clause, counted = describe_clause(rule), not rule.advisory
    if design_exposed_mm is None:
        reason = Reason("assembly.no_exposed_length")
        return RuleResult(rule.name, clause, rule.source, Verdict.NOT_ASSESSED, counted, reason)
    verdicts, reasons, deviations = [], [], []
    for target, point in zip(design, placed, strict=True):
        if point is None or point.exposed_length_mm is None:
            continue
        deviation_mm = point.exposed_length_mm - design_exposed_mm
        verdict = decide_signed(deviation_mm, None, rule.lower, rule.upper, "simple").verdict
        verdicts.append(verdict)
        deviations.append(deviation_mm)
        if verdict is Verdict.FAIL:
            reasons.append(
                Reason(
                    "assembly.sticks_out",
                    label=target.label,
                    exposed_mm=point.exposed_length_mm,
                    deviation_mm=deviation_mm,
                    limits=describe_limits(rule),
                    clause=clause,
                )
            )
    if not verdicts:
        reason = Reason("assembly.no_floor")
        return RuleResult(rule.name, clause, rule.source, Verdict.NOT_ASSESSED, counted, reason)
    return RuleResult(
        rule.name, clause, rule.source, worst(verdicts), counted, in_one(reasons), max(deviations, key=abs)
    )
