"""One column, from scans to verdict: the order of the work, each step a function of its own stage.

Extract the centres, find which is which, compare them with the design, and try the assembly.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.column import rules_of_the_erected_column, sum_up
from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.match import Match, match_extraction
from aadm_workbench.assembly.trial import try_scans
from aadm_workbench.errors import JobError
from aadm_workbench.extract.method import extract
from aadm_workbench.extract.missing import explain_missing
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    ColumnDesign,
    ColumnReport,
    Extraction,
    GroupReport,
    Kind,
    PointResult,
    Profile,
    Scan,
    TrialReport,
    Verdict,
)

IMAGE_UP_SCAN = np.array([0.0, -1.0, 0.0])
"""Direction of the image's top in the scan frame: -y."""

CHECKS = ("sleeves", "rebars", "trial")

Stage = Callable[[str], AbstractContextManager[None]]


@dataclass(frozen=True)
class CheckSettings:
    """How a column is checked. ``checks`` None: what its scans allow. ``seed`` starts every random draw."""

    profile: Profile
    method: str = "refined"
    decision: DecisionRule = "guarded"
    checks: tuple[str, ...] | None = None
    turns: bool = False
    seed: int = 0


@dataclass(frozen=True)
class ColumnScans:
    """The scans of one column.

    ``..._up_deg``: column-frame direction at the top of the image, in degrees from +x, counter-clockwise seen from
    above; None where nobody declared it.
    """

    sleeves: tuple[Scan, ...] = ()
    rebars: tuple[Scan, ...] = ()
    sleeves_up_deg: float | None = None
    rebars_up_deg: float | None = None

    def of(self, kind: Kind) -> tuple[Scan, ...]:
        """The views of one kind."""
        return self.sleeves if kind is Kind.SLEEVE else self.rebars

    def up_deg(self, kind: Kind) -> float | None:
        """The declared direction of the views of one kind."""
        return self.sleeves_up_deg if kind is Kind.SLEEVE else self.rebars_up_deg


@dataclass(frozen=True, eq=False)
class Measured:
    """One group of a column: what was extracted, how it lies on the design, and the report on it."""

    extraction: Extraction
    match: Match
    report: GroupReport


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
    measured = {
        kind: _measure(design, scans.of(kind), scans.up_deg(kind), kind, settings, stage)
        for kind in Kind
        if scans.of(kind)
    }
    trial = None
    if "trial" in checks:
        with stage("assembly"):
            trial = _try(design, measured[Kind.SLEEVE], measured[Kind.REBAR], settings)
    return _report(design, measured, trial, checks, settings.profile)


def _wanted(design: ColumnDesign, scans: ColumnScans, settings: CheckSettings) -> tuple[str, ...]:
    """Which checks are made: those that the job names, else those that the scans allow."""
    possible = [kind.plural for kind in Kind if scans.of(kind)]
    possible += ["trial"] if len(possible) == 2 else []
    if settings.checks is None:
        return tuple(possible)
    lacking = [check for check in settings.checks if check not in possible]
    if lacking:
        raise JobError(f"column {design.id}: the job asks for {', '.join(lacking)}, but names no scan for it")
    return settings.checks


def _measure(
    design: ColumnDesign,
    scans: tuple[Scan, ...],
    up_deg: float | None,
    kind: Kind,
    settings: CheckSettings,
    stage: Stage,
) -> Measured:
    """Extract, match and inspect one group of points."""
    if len(scans) > 1:
        raise JobError(f"column {design.id}: several views of one scan are not merged by this version; name one file")
    scan, points = scans[0], design.points(kind)
    diameter_mm = float(np.median([point.diameter_mm for point in points]))
    rng = np.random.default_rng([settings.seed, list(Kind).index(kind)])
    with stage("extract"):
        extraction = extract(scan, kind, diameter_mm, settings.method, rng)
        match = match_extraction(points, extraction, up=up_deg, image_up_scan=IMAGE_UP_SCAN)
        places = _missing_places(points, match)
        if places and settings.method == "refined":
            again = extract(scan, kind, diameter_mm, settings.method, rng, np.array(list(places.values())))
            second = match_extraction(points, again, up=up_deg, image_up_scan=IMAGE_UP_SCAN)
            if second and second.placements[0].found > match.placements[0].found:
                extraction, match = again, second
                places = _missing_places(points, match)
        reasons = _reasons(scan, extraction, places, diameter_mm, rng)
    with stage("assembly"):
        report = inspect_group(
            points,
            extraction,
            match,
            settings.profile,
            decision=settings.decision,
            scale_error=scan.camera.scale_error if scan.camera else 0.0,
            source=scan.source,
            sha256=scan.sha256,
        )
    return Measured(extraction, match, _with_reasons(report, reasons))


def _missing_places(points: tuple[AssemblyPoint, ...], match: Match) -> dict[int, Array]:
    """Where in the scan (3,) mm the design points should be that were not found, by their index."""
    if not match:
        return {}
    placement = match.placements[0]
    T_scan_design = np.linalg.inv(placement.T_design_scan)
    return {
        k: T_scan_design[:3, :3] @ points[k].centre + T_scan_design[:3, 3]
        for k in np.flatnonzero(placement.matched < 0).tolist()
    }


def _reasons(
    scan: Scan, extraction: Extraction, places: Mapping[int, Array], diameter_mm: float, rng: np.random.Generator
) -> dict[int, str]:
    if not places:
        return {}
    texts = explain_missing(scan, extraction, np.array(list(places.values())), diameter_mm, rng)
    return dict(zip(places, texts, strict=True))


def _with_reasons(report: GroupReport, reasons: Mapping[int, str]) -> GroupReport:
    """The report with the reason for each point that was not measured, in the points and in the summary."""
    if not reasons:
        return report
    points = tuple(_explained(point, reasons.get(k)) for k, point in enumerate(report.points))
    said = tuple(f"{report.points[k].label} not measured: {text}" for k, text in reasons.items())
    kept = tuple(text for text in report.reasons if "not measured" not in text and "not found" not in text)
    return replace(report, points=points, reasons=(*kept, *said))


def _explained(point: PointResult, reason: str | None) -> PointResult:
    if reason is None or point.verdict is not Verdict.NOT_MEASURED:
        return point
    return replace(point, reason=f"{point.label}: {reason}")


def _try(design: ColumnDesign, sleeves: Measured, rebars: Measured, settings: CheckSettings) -> TrialReport:
    return try_scans(
        design,
        (sleeves.extraction, sleeves.match),
        (rebars.extraction, rebars.match),
        settings.profile,
        np.random.default_rng([settings.seed, 2]),
        decision=settings.decision,
        turns=settings.turns,
    )


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
    return ColumnReport(
        id=design.id,
        verdict=verdict,
        goes_on=goes_on,
        reasons=reasons,
        sleeves=groups.get(Kind.SLEEVE.plural),
        rebars=groups.get(Kind.REBAR.plural),
        trial_assembly=trial,
        global_id=design.global_id,
        piece_mark=design.piece_mark,
        storey=design.storey,
        grid=design.grid,
        size_mm=design.size_mm,
        T_model_column=design.T_model_column,
        rules=rules_of_the_erected_column(profile),
        notes=design.warnings,
    )
