"""Positions that a finding takes back: where the lengths of a scan are wrong, none of its points is off or right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aadm_workbench.assembly.column import sum_up
from aadm_workbench.model import (
    ColumnReport,
    Finding,
    GroupReport,
    PointResult,
    Reason,
    SpacingResult,
    TrialReport,
    Verdict,
)

TAKES_BACK = ("scale_differs", "other_column", "swapped", "gaps_filled")
"""A part in a hundred moves a point at the corner of a column by millimetres, whoever is to blame; and some points of
another column, or of the other group, lie on this one by chance; how far filled edges were moved nobody knows."""

OPENS_TRIAL = "common_lean"
"""Of all sleeves and all bars alike: places within a plane are as they were; leans, and with them the room in the
sleeves, are not."""


def without_spoilt(report: ColumnReport, findings: Sequence[Finding], checks: Sequence[str]) -> ColumnReport:
    """The report with nothing decided on groups that a finding takes back: their points are not measured.

    Parameters
    ----------
    checks
        What the verdict of the column counts: ``sleeves``, ``rebars``, ``trial``.
    """
    reason = {name: one.text for one in findings if one.code in TAKES_BACK for name in one.about}
    sheared = [one.text for one in findings if one.code == OPENS_TRIAL and len(one.about) > 1]
    if not reason and not sheared:
        return report
    sleeves, rebars = (
        _voided(group, reason[name]) if group is not None and name in reason else group
        for name, group in (("sleeves", report.sleeves), ("rebars", report.rebars))
    )
    trial = None if report.trial_assembly is None else _open(report.trial_assembly, [*reason.values(), *sheared][0])
    counted = [group if name in checks else None for name, group in (("sleeves", sleeves), ("rebars", rebars))]
    verdict, goes_on, reasons = sum_up(counted[0], counted[1], trial if "trial" in checks else None)
    return replace(
        report,
        verdict=verdict,
        goes_on=goes_on,
        reasons=reasons,
        sleeves=sleeves,
        rebars=rebars,
        trial_assembly=trial,
        repair=None,
    )


def _open(trial: TrialReport, reason: str) -> TrialReport:
    if trial.verdict is Verdict.NOT_MEASURED:
        return replace(trial, reasons=(reason,))
    return TrialReport(Verdict.INCONCLUSIVE, rules=trial.rules, reasons=(reason,), missing=trial.missing)


def _voided(group: GroupReport, reason: str) -> GroupReport:
    if group.fit is None:
        return group
    return replace(
        group,
        found=0,
        verdict=Verdict.INCONCLUSIVE,
        points=tuple(_unmeasured(point, reason) for point in group.points),
        spacing=tuple(_unspaced(spacing, reason) for spacing in group.spacing),
        rules=tuple(
            replace(rule, verdict=Verdict.NOT_MEASURED, reason=reason, worst_mm=None)
            if rule.verdict in (Verdict.PASS, Verdict.FAIL, Verdict.INCONCLUSIVE)
            else rule
            for rule in group.rules
        ),
        reasons=(reason,),
        absolute=None,
    )


def _unmeasured(point: PointResult, reason: str) -> PointResult:
    return replace(
        point,
        scan_mm=None,
        aligned_mm=None,
        offset_mm=None,
        deviation_mm=None,
        u_mm=None,
        cov_mm2=None,
        probability=None,
        verdict=Verdict.NOT_MEASURED,
        reason=Reason("said.of", what=point.label, why=reason),
    )


def _unspaced(spacing: SpacingResult, reason: str) -> SpacingResult:
    return SpacingResult(
        spacing.between, spacing.design_mm, None, None, None, spacing.limit_mm, Verdict.NOT_MEASURED, reason
    )
