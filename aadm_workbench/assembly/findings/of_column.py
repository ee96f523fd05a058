"""What of a measured column contradicts its design, its job or its camera, and what that does to its verdict.

Positions that a finding takes back: where the lengths of a scan are wrong, none of its points is off or right.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.findings.diameters import odd_bar_findings
from aadm_workbench.assembly.findings.finding import SeenGroup, held_back, make_finding
from aadm_workbench.assembly.findings.mistaken import NamedScan, mistaken_findings
from aadm_workbench.assembly.findings.rules import findings_of
from aadm_workbench.assembly.findings.section import section_findings
from aadm_workbench.assembly.tolerances import sum_up
from aadm_workbench.extract.method import BY_DESIGN, extract_sizes
from aadm_workbench.model import (
    ColumnDesign,
    ColumnReport,
    Extraction,
    Finding,
    GroupReport,
    Kind,
    PointResult,
    Reason,
    Scan,
    SpacingResult,
    TrialReport,
    Verdict,
)
from aadm_workbench.model.special import median_of_known

_SAMPLE = 10_000  # points: a look, not a measurement

TAKES_BACK = ("scale_differs", "other_column", "swapped", "gaps_filled", "smoothed")
"""A part in a hundred moves a point at the corner of a column by millimetres, whoever is to blame; and some points of
another column, or of the other group, lie on this one by chance; how far filled or smoothed edges were moved nobody
knows."""

OPENS_TRIAL = "common_lean"
"""Of all sleeves and of all bars: places within a plane are as they were; leans, and with them the room in the sleeves,
are not, as long as it is open whether they are the camera's."""


@dataclass(frozen=True, eq=False)
class Seen:
    """A group of a column with the first of its scans."""

    group: SeenGroup
    scan: Scan


def with_findings(
    report: ColumnReport,
    design: ColumnDesign,
    seen: Mapping[Kind, Seen],
    *,
    method: str,
    rng: np.random.Generator,
    others: Sequence[ColumnDesign] = (),
    checks: Sequence[str] = ("sleeves", "rebars", "trial"),
) -> ColumnReport:
    """The report of a column with its findings, held back by them.

    Parameters
    ----------
    seen
        What was scanned of the column.
    method, rng
        For looking again at scans that show nothing of what they should.
    others
        The other columns of the job.
    checks
        What the verdict of the column counts.
    """
    groups = {kind: one.group for kind, one in seen.items()}
    look = "refined" if method in BY_DESIGN else method
    scans = {kind: _named(one.scan, look, rng) for kind, one in seen.items()}
    found = _without_turns(
        [*findings_of(design, list(groups.values())), *mistaken_findings(design, groups, scans, others)]
    )
    found += [*shared_id_findings(design), *section_findings(report.section)]
    if method in BY_DESIGN and Kind.SLEEVE in groups and groups[Kind.SLEEVE].match:
        by_design = make_finding("sleeves_by_design", [Kind.SLEEVE.plural], method=method)
        found.append(by_design)
        report = _without_sleeves(report, by_design.text)
    if Kind.REBAR in seen and method == "refined":
        found += odd_bar_findings(groups[Kind.REBAR], seen[Kind.REBAR].scan, found, rng)
    lost = {kind for kind, group in groups.items() if not group.match}
    said = [Reason("said.of", what=kind.plural, why=groups[kind].match.reason) for kind in lost if _told(found, kind)]
    return held_back(without_spoilt(report, found, checks), found, said)


def _without_turns(found: Sequence[Finding]) -> list[Finding]:
    """Some findings, without what they say of the turn of a scan that shows another column."""
    foreign = {name for one in found if one.code == "other_column" for name in one.about}
    turns = ("turn_contradicted", "turn_doubtful")
    return [one for one in found if one.code not in turns or foreign.isdisjoint(one.about)]


def _told(found: Sequence[Finding], kind: Kind) -> bool:
    return any(kind.plural in finding.about for finding in found)


def _named(scan: Scan, method: str, rng: np.random.Generator) -> NamedScan:
    def look(kind: Kind, diameters_mm: Sequence[float]) -> Extraction:
        return extract_sizes(scan, kind, diameters_mm, method, rng)

    def stretched(across: float, along: float) -> NamedScan:
        return _named(_stretched(scan, across, along), method, rng)

    return NamedScan(scan.source, look, stretched, _distance_mm(scan))


def _distance_mm(scan: Scan) -> float:
    some = scan.points.reshape(-1, 3)[:: scan.points.size // 3 // _SAMPLE + 1, 2]
    return median_of_known(np.abs(some)) if np.isfinite(some).any() else 0.0


def _stretched(scan: Scan, across: float, along: float) -> Scan:
    """The scan with its x and y, and its z, times a factor each, as a camera would have it that measures so."""
    factors = np.array([across, across, along])
    camera = scan.camera
    if camera is not None:
        camera = replace(camera, fx=camera.fx * along / across, fy=camera.fy * along / across)
    viewpoint = None if scan.viewpoint is None else scan.viewpoint * factors
    return replace(scan, points=scan.points * factors.astype(scan.points.dtype), camera=camera, viewpoint=viewpoint)


def without_spoilt(report: ColumnReport, findings: Sequence[Finding], checks: Sequence[str]) -> ColumnReport:
    """The report with nothing decided on groups that a finding takes back: their points are not measured.

    Parameters
    ----------
    checks
        What the verdict of the column counts: ``sleeves``, ``rebars``, ``trial``.
    """
    reason = {name: one.text for one in findings if one.code in TAKES_BACK for name in one.about}
    leaning = [one for one in findings if one.code == OPENS_TRIAL]
    sheared = [one.text for one in leaning] if len({name for one in leaning for name in one.about}) > 1 else []
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


def _without_sleeves(report: ColumnReport, reason: str) -> ColumnReport:
    """The report without deviations of sleeves that were laid where the design has them; the trial stands."""
    if report.sleeves is None:
        return report
    return replace(report, sleeves=replace(_voided(report.sleeves, reason), verdict=Verdict.NOT_MEASURED))


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


def shared_id_findings(design: ColumnDesign) -> list[Finding]:
    """One finding about all of them; it says nothing against the column itself."""
    if not design.shared_ids:
        return []
    return [replace(make_finding("duplicate_global_id", design.shared_ids), holds_back=False)]
