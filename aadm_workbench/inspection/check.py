"""One column, from scans to verdict: the order of the work, each step a function of its own stage.

Extract the centres, find which is which, compare them with the design, and try the assembly.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.findings.of_column import Seen, with_findings
from aadm_workbench.assembly.inspect import describe_ambiguity
from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.assembly.pairs import in_column_frame
from aadm_workbench.assembly.section import inspect_section
from aadm_workbench.assembly.tolerances import rules_of_the_erected_column, sum_up
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.errors import JobError
from aadm_workbench.extract.sample import Thinned, thinned
from aadm_workbench.extract.section.outline import FaceHeights, face_heights, section_edges
from aadm_workbench.inspection.measure import (
    CheckSettings,
    ColumnScans,
    Measured,
    Stage,
    measure_column,
    seen_group,
)
from aadm_workbench.model import (
    Array,
    ColumnDesign,
    ColumnReport,
    Extraction,
    Kind,
    Profile,
    RepairReport,
    Scan,
    TrialReport,
    Verdict,
)
from aadm_workbench.model.reports import SectionReport

if TYPE_CHECKING:
    pass

CHECKS = ("sleeves", "rebars", "trial")


def check_column(
    design: ColumnDesign,
    scans: ColumnScans,
    settings: CheckSettings,
    stage: Stage = lambda name: nullcontext(),
) -> ColumnReport:
    """Check one column against its design and its bars.

    Parameters
    ----------
    stage
        Entered around ``"extract"`` and ``"assembly"``, for whoever wants to take times.

    Raises
    ------
    JobError
        Where the job asks for a check without giving its scans.
    """
    checks = _wanted(design, scans, settings)
    measured = measure_column(design, scans, settings, stage)
    trial, repair = None, None
    with stage("assembly"):
        if "trial" in checks:
            trial = _try(design, measured[Kind.SLEEVE], measured[Kind.REBAR], settings)
            trial, repair = _repair(design, measured[Kind.SLEEVE], measured[Kind.REBAR], trial, settings)
        section = _section(design, scans, measured, settings)
    report = replace(_report(design, measured, trial, checks, settings.profile), repair=repair, section=section)
    if report.reasons:
        from aadm_workbench.assembly.following import told_once

        report = told_once(report)
    seen = {kind: Seen(seen_group(design, kind, scans, measured[kind]), scans.of(kind)[0]) for kind in measured}
    rng = np.random.default_rng([settings.seed, 4])
    with stage("assembly"):
        return with_findings(report, design, seen, method=settings.method, rng=rng, others=scans.others, checks=checks)


def _section(
    design: ColumnDesign, scans: ColumnScans, measured: Mapping[Kind, Measured], settings: CheckSettings
) -> SectionReport | None:
    """The foot's own section, from the first of its scans."""
    sleeves = measured.get(Kind.SLEEVE)
    if sleeves is None or len(scans.sleeves) > 1 or settings.method != "refined":
        return None

    rng = np.random.default_rng([settings.seed, 5])
    return section_of(
        design, scans.sleeves[0], sleeves.extraction, sleeves.match, settings.profile, settings.decision, rng
    )


def _wanted(design: ColumnDesign, scans: ColumnScans, settings: CheckSettings) -> tuple[str, ...]:
    """Which checks are made: those that the job names, else those that the scans allow."""
    possible = [kind.plural for kind in Kind if scans.of(kind)]
    possible += ["trial"] if len(possible) == 2 else []
    if settings.checks is None:
        return tuple(possible)
    lacking = [check for check in settings.checks if check not in possible]
    if lacking:
        raise JobError.because("command.asks_without_scan", column=design.id, parts=", ".join(lacking))
    return settings.checks


def _try(design: ColumnDesign, sleeves: Measured, rebars: Measured, settings: CheckSettings) -> TrialReport:
    if sleeves.match.is_shifted and rebars.match.is_shifted:
        # Which sleeve meets which bar hangs on both at once: no shift of one against the other holds them all.
        return TrialReport(Verdict.NOT_MEASURED, reasons=(describe_ambiguity(sleeves.match),))
    return try_scans(
        design,
        (sleeves.extraction, sleeves.match),
        (rebars.extraction, rebars.match),
        settings.profile,
        np.random.default_rng([settings.seed, 2]),
        decision=settings.decision,
        turns=settings.turns,
    )


def _repair(
    design: ColumnDesign, sleeves: Measured, rebars: Measured, trial: TrialReport, settings: CheckSettings
) -> tuple[TrialReport, RepairReport | None]:
    """The trial with what is in its way, and advice where it did not pass.

    There is none where it is open which bar belongs to which sleeve.
    """
    if "ambiguous" in (sleeves.match.orientation, rebars.match.orientation) or trial.minimax is None:
        return trial, None
    if trial.verdict not in (Verdict.FAIL, Verdict.INCONCLUSIVE):
        return trial, None
    from aadm_workbench.assembly.blame import with_blame
    from aadm_workbench.assembly.repair.bends import advise_repair

    feet, tops = (in_column_frame(one.extraction, one.match.placements[0]) for one in (sleeves, rebars))
    rng = np.random.default_rng([settings.seed, 3])
    repair = advise_repair(design, feet, tops, trial, settings.profile, rng, decision=settings.decision)
    return with_blame(trial, repair), repair


def _report(
    design: ColumnDesign,
    measured: Mapping[Kind, Measured],
    trial: TrialReport | None,
    checks: tuple[str, ...],
    profile: Profile,
) -> ColumnReport:
    groups = {kind.plural: measured[kind].report for kind in measured}
    asked = {name: report for name, report in groups.items() if name in checks}
    verdict, goes_on, reasons = sum_up(asked.get(Kind.SLEEVE.plural), asked.get(Kind.REBAR.plural), trial)
    return replace(
        report_on(design, verdict, goes_on, reasons),
        sleeves=groups.get(Kind.SLEEVE.plural),
        rebars=groups.get(Kind.REBAR.plural),
        trial_assembly=trial,
        rules=rules_of_the_erected_column(profile),
    )


def report_on(design: ColumnDesign, verdict: Verdict, goes_on: Verdict, reasons: tuple[str, ...]) -> ColumnReport:
    """A report on a column that holds what its design says of it, and nothing measured."""
    return ColumnReport(
        id=design.id,
        verdict=verdict,
        goes_on=goes_on,
        reasons=reasons,
        global_id=design.global_id,
        piece_mark=design.piece_mark,
        storey=design.storey,
        grid=design.grid,
        size_mm=design.size_mm,
        T_model_column=design.T_model_column,
        notes=design.warnings,
    )


_SAMPLE = 30_000  # points: a hundred in each cell of the face, whose median is then known to an eighth of the noise
_ROUGH_FACE_MM = 1.5  # scatter about the plane: feet that are roughened by order have no flatness


def section_of(
    design: ColumnDesign,
    scan: Scan,
    extraction: Extraction,
    match: Match,
    profile: Profile,
    decision: DecisionRule,
    rng: np.random.Generator,
) -> SectionReport | None:
    """The section of a foot; None where the design gives none, or where nothing says which edge is which."""
    if design.size_mm is None or design.section_middle_mm is None or extraction.plane is None or not match:
        return None
    if match.orientation == "ambiguous":
        return None
    T_column_scan = match.placements[0].T_design_scan
    middle, half = np.array(design.section_middle_mm), np.array(design.size_mm) / 2.0
    outline = middle + half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    sample = thinned(scan, _SAMPLE, rng)
    T_scan_column = np.asarray(np.linalg.inv(T_column_scan), np.float64)
    bores_mm = [point.diameter_mm for point in design.sleeves]
    seen = section_edges(scan, sample, extraction, T_scan_column, outline, bores_mm)
    heights = _heights(design, sample, extraction, T_column_scan, middle, half)
    fit_u_mm = _fit_u_mm(extraction)
    places = np.array([point.centre[:2] for point in design.sleeves])
    spread_mm = float(np.sqrt(np.mean(np.sum((places - places.mean(axis=0)) ** 2, axis=1))))
    return inspect_section(
        design, seen, heights, profile, fit_u_mm=fit_u_mm, fit_u_turn=fit_u_mm / spread_mm, decision=decision
    )


def _heights(
    design: ColumnDesign,
    sample: Thinned,
    extraction: Extraction,
    T_column_scan: Array,
    middle: Array,
    half: Array,
) -> FaceHeights | None:
    assert extraction.plane is not None
    if extraction.plane.residual_mm > _ROUGH_FACE_MM:
        return None
    mouths = np.array([point.centre[:2] for point in design.sleeves])
    radius_mm = max(point.diameter_mm for point in design.sleeves) / 2.0
    return face_heights(sample, extraction.plane, T_column_scan, middle - half, middle + half, mouths, radius_mm)


def _fit_u_mm(extraction: Extraction) -> float:
    """Standard uncertainty per axis of the mean of all centres, but for what shifts them all: that moves edges, too."""
    own = [float(np.trace(point.covariance)) / 3.0 for point in extraction.points if point.covariance is not None]
    return math.sqrt(float(np.mean(own)) / len(own)) if own else 0.0
