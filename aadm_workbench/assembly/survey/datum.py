"""The report on a group of bars, completed by its absolute position."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aadm_workbench.assembly.inspect import NO_ABSOLUTE_POSITION
from aadm_workbench.assembly.rules import counted_verdict
from aadm_workbench.assembly.survey.absolute import DatumRules, results_of
from aadm_workbench.model import AbsolutePosition, GroupReport, Profile, RuleResult, Verdict, worst


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
