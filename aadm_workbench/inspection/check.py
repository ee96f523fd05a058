"""One column, from scans to verdict: the order of the work, each step a function of its own stage.

Extract the centres, find which is which, compare them with the design, and try the assembly.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from aadm_workbench.assembly.findings.of_column import Seen, with_findings
from aadm_workbench.assembly.following import told_once
from aadm_workbench.assembly.inspect import describe_ambiguity
from aadm_workbench.assembly.place import in_column_frame
from aadm_workbench.assembly.tolerances import rules_of_the_erected_column, sum_up
from aadm_workbench.assembly.trial.virtual import try_scans
from aadm_workbench.errors import JobError
from aadm_workbench.inspection.measure import (
    CheckSettings,
    ColumnScans,
    Measured,
    Stage,
    measure_column,
    seen_group,
)
from aadm_workbench.model import (
    ColumnDesign,
    ColumnReport,
    Kind,
    Profile,
    RepairReport,
    TrialReport,
    Verdict,
)
from aadm_workbench.model.section import SectionReport

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
    from aadm_workbench.inspection.section import section_of

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
