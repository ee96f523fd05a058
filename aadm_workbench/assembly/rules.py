"""What the rules of a profile came to: one result a rule, and the verdict of those that count."""

from __future__ import annotations

from collections.abc import Sequence

from aadm_workbench.assembly.tolerances import describe_clause, rules_for
from aadm_workbench.model import PointResult, Profile, Rule, RuleResult, SpacingResult, Verdict, in_one, worst


def applicable_rules(profile: Profile, quantity: str) -> tuple[tuple[Rule, ...], tuple[Rule, ...]]:
    """Rules that hold within the group, the governing one first, and those that hold against a datum."""
    rules = rules_for(profile, quantity)
    within = tuple(rule for rule in rules if rule.level == "bar_in_group")
    return within, tuple(rule for rule in rules if rule.level != "bar_in_group")


def position_result(rule: Rule, points: Sequence[PointResult]) -> RuleResult:
    """What one rule of position came to over all points of a group."""
    deviations = [point.deviation_mm for point in points if point.deviation_mm is not None]
    verdict, reason = _worst_of([point.verdict for point in points], [point.reason for point in points])
    return rule_result(rule, verdict, reason, max(deviations, default=None))


def spacing_result(rule: Rule, spacing: Sequence[SpacingResult]) -> RuleResult:
    """What one rule of spacing came to over all adjacent pairs of a group."""
    deviations = [pair.deviation_mm for pair in spacing if pair.deviation_mm is not None]
    verdict, reason = _worst_of([pair.verdict for pair in spacing], [pair.reason for pair in spacing])
    return rule_result(rule, verdict, reason, max(deviations, key=abs, default=None))


def _worst_of(verdicts: Sequence[Verdict], reasons: Sequence[str]) -> tuple[Verdict, str]:
    """The worst verdict, and the reasons of all that are not a pass, the worst first."""
    order = (Verdict.FAIL, Verdict.NOT_MEASURED, Verdict.INCONCLUSIVE)
    ordered = [reason for kind in order for verdict, reason in zip(verdicts, reasons, strict=True) if verdict is kind]
    return worst(verdicts), in_one(reason for reason in ordered if reason)


def rule_result(rule: Rule, verdict: Verdict, reason: str, worst_mm: float | None = None) -> RuleResult:
    """The result of one rule, marked with its clause, its source and whether it counts."""
    return RuleResult(rule.name, describe_clause(rule), rule.source, verdict, not rule.advisory, reason, worst_mm)


def not_assessed(rule: Rule, reason: str) -> RuleResult:
    """The result of a rule for which there is no input."""
    return rule_result(rule, Verdict.NOT_ASSESSED, reason)


def counted_verdict(rules: Sequence[RuleResult]) -> Verdict:
    """Worst of the rules that count; not assessed where there is none."""
    counted = [rule.verdict for rule in rules if rule.counted and rule.verdict is not Verdict.NOT_ASSESSED]
    return worst(counted) if counted else Verdict.NOT_ASSESSED
