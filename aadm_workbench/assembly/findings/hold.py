"""What findings do to the verdicts of a column: one that holds back keeps it from passing, and from being hoisted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aadm_workbench.model import ColumnReport, Finding, TrialReport, Verdict, worst

NOT_MEASURED = ("mirrored", "swapped", "turn_contradicted", "other_column")
"""What was scanned is not what was to be measured; all else that holds back leaves a verdict open."""

SPOILS_ALL = (*NOT_MEASURED, "same_scan_twice", "scale_differs")
"""These stand before whatever else is said: with them no deviation is to be believed."""


def held_back(report: ColumnReport, findings: Sequence[Finding], superseded: Sequence[str] = ()) -> ColumnReport:
    """The report with some findings more, in its verdicts too.

    Parameters
    ----------
    superseded
        Reasons that a finding says better.
    """
    if not findings:
        return report
    holding = [finding for finding in findings if finding.holds_back]
    told = [finding.text for finding in findings if not finding.holds_back]
    verdict = worst((report.verdict, *(_verdict_of(finding) for finding in holding)))
    trial = report.trial_assembly
    goes_on = report.goes_on
    if holding and report.goes_on is Verdict.PASS and trial is not None:
        trial = _held_trial(trial, holding)
        goes_on = trial.verdict
    return replace(
        report,
        verdict=verdict,
        goes_on=goes_on,
        trial_assembly=trial,
        reasons=_reasons(report, holding, superseded),
        notes=(*report.notes, *told),
        findings=(*report.findings, *findings),
    )


def _verdict_of(finding: Finding) -> Verdict:
    return Verdict.NOT_MEASURED if finding.code in NOT_MEASURED else Verdict.INCONCLUSIVE


def _held_trial(trial: TrialReport, holding: Sequence[Finding]) -> TrialReport:
    verdict = worst((trial.verdict, *(_verdict_of(finding) for finding in holding)))
    return replace(trial, verdict=verdict, reasons=(*trial.reasons, *(finding.text for finding in holding)))


def _reasons(report: ColumnReport, holding: Sequence[Finding], superseded: Sequence[str]) -> tuple[str, ...]:
    """The findings first, unless a failure was found that does not hang on them."""
    kept = [reason for reason in report.reasons if reason not in superseded]
    first = [finding.text for finding in holding if finding.code in SPOILS_ALL or report.verdict is not Verdict.FAIL]
    last = [finding.text for finding in holding if finding.text not in first]
    return tuple(dict.fromkeys([*first, *kept, *last]))
