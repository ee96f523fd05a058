"""One group of a column, from scans to a report on it: extract, match, look again, inspect."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from aadm_workbench.assembly.decision import DecisionRule
from aadm_workbench.assembly.findings.finding import SeenGroup
from aadm_workbench.assembly.findings.scale import doubted_scale_error
from aadm_workbench.assembly.group_notes import (
    axes_not_told,
    in_coordinates_of_the_file,
    in_scan_frame,
    missing_places,
    of_the_files,
    reasons_of_missing,
    typical_u_mm,
    unsupported,
    with_reasons,
)
from aadm_workbench.assembly.inspect import inspect_group
from aadm_workbench.assembly.matching.match import Match, match_extraction
from aadm_workbench.assembly.pairs import place_points
from aadm_workbench.assembly.pose.eopa import NoFit
from aadm_workbench.extract.method import Known, extract_sizes
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    ColumnDesign,
    ControlPoint,
    Extraction,
    GroupReport,
    Kind,
    Profile,
    Reason,
    Scan,
)
from aadm_workbench.model.special import median

if TYPE_CHECKING:
    from aadm_workbench.assembly.survey.control import ControlPose

IMAGE_UP_SCAN = np.array([0.0, -1.0, 0.0])
"""Direction of the image's top in the scan frame: -y."""

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
    above; None where nobody declared it. ``control_points`` are measured in the scan of the rebars. ``others`` are the
    other columns of the job: a scan that does not fit this column may fit one of them.
    """

    sleeves: tuple[Scan, ...] = ()
    rebars: tuple[Scan, ...] = ()
    sleeves_up_deg: float | None = None
    rebars_up_deg: float | None = None
    control_points: tuple[ControlPoint, ...] = ()
    others: tuple[ColumnDesign, ...] = ()

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


def measure_column(
    design: ColumnDesign,
    scans: ColumnScans,
    settings: CheckSettings,
    stage: Stage = lambda name: nullcontext(),
) -> dict[Kind, Measured]:
    """Extract, match and inspect what there are scans of; parameters as :func:`check_column`."""
    measured: dict[Kind, Measured] = {}
    for kind in (kind for kind in Kind if scans.of(kind)):
        before = [seen_group(design, other, scans, one) for other, one in measured.items()]
        measured[kind] = _measure(design, scans, kind, settings, stage, before)
    return measured


def seen_group(design: ColumnDesign, kind: Kind, scans: ColumnScans, measured: Measured) -> SeenGroup:
    """A group as the rules on findings look at it."""
    scale_error = scale_error_of(scans.of(kind)[0], kind)
    return SeenGroup(kind, design.points(kind), measured.extraction, measured.match, scale_error)


def _measure(
    design: ColumnDesign,
    scans: ColumnScans,
    kind: Kind,
    settings: CheckSettings,
    stage: Stage,
    before: Sequence[SeenGroup] = (),
) -> Measured:
    """Extract, match and inspect one group of points; ``before`` it others were measured, with the same camera."""
    views, points, up_deg = scans.of(kind), design.points(kind), scans.up_deg(kind)
    scan, diameter_mm = views[0], float(median(_diameters_mm(points)))
    rng = np.random.default_rng([settings.seed, list(Kind).index(kind)])
    known = Known(design, up_deg)
    with stage("extract"):
        seen = [_extracted(view, kind, points, settings, rng, known=known) for view in views]
        control = _control(design, scans, kind, seen[0])
        ups = [up_deg] * len(views)
        if up_deg is None and control:
            from aadm_workbench.assembly.survey.control import shown_up_deg

            # It says how the first view is turned, and nothing about the others.
            up_deg = ups[0] = shown_up_deg(control, IMAGE_UP_SCAN)
        found = [_matched(points, *one, settings, rng) for one in zip(views, seen, ups, strict=True)]
        extraction, match = found[0]
        if control is not None and not match:
            control = NoFit(Reason("survey.control_unmatched"))
        notes: tuple[str, ...] = ()
        if len(views) > 1:
            from aadm_workbench.assembly.matching.views import merge_views

            extraction, notes = merge_views([one for one, _ in found], [one for _, one in found])
            extraction = _with_reversal(extraction, points, found)
            match = match_extraction(points, extraction, up=up_deg, image_up_scan=IMAGE_UP_SCAN)
            unseen: str = Reason("assembly.in_no_view", views=len(views))
            reasons = dict.fromkeys(missing_places(points, match), unseen)
        else:
            reasons = reasons_of_missing(scan, extraction, missing_places(points, match), diameter_mm, rng)
    group = SeenGroup(kind, points, extraction, match, scale_error_of(scan, kind))
    with stage("assembly"):
        scale_error = doubted_scale_error(group, before)
        report = inspect_group(
            points,
            extraction,
            match,
            settings.profile,
            decision=settings.decision,
            scale_error=scale_error,
            design_exposed_mm=design.exposed_length_mm if kind is Kind.REBAR else None,
            source=", ".join(view.source for view in views),
            sha256=", ".join(view.sha256 for view in views),
        )
        u_mm = typical_u_mm(extraction)
        notes = (*of_the_files(views), *axes_not_told(views, scans.up_deg(kind)), *notes)
        notes = (*report.notes, *notes, *unsupported(u_mm, settings.profile, kind))
        dropped = sum(view.dropped for view in views)
        report = replace(report, notes=notes, quality={**report.quality, "u_mm": u_mm, "dropped_points": dropped})
        measured = Measured(extraction, match, with_reasons(report, reasons))
        if control is not None and match:
            at = in_scan_frame(scans.control_points, scan)
            measured = _in_the_building(measured, points, at, control, settings, scale_error)
        return replace(measured, report=in_coordinates_of_the_file(measured.report, scan))


def _with_reversal(
    extraction: Extraction, points: tuple[AssemblyPoint, ...], found: list[tuple[Extraction, Match]]
) -> Extraction:
    """The merged points, with what their views tell of the camera: what went with it, and not with the part."""
    from aadm_workbench.assembly.matching.reversal import reversal_of, view_of

    seen = [view_of(points, *one) for one in found]
    told = reversal_of([view for view in seen if view is not None])
    if isinstance(told, str):
        return extraction
    bend = {"camera_bend_mm": told.largest_mm, "camera_bend_u_mm": told.u_mm}
    if told.contradicts:
        bend["camera_bend_stated_u_mm"] = told.stated_u_mm
    return replace(extraction, quality={**extraction.quality, **bend})


def _extracted(
    scan: Scan,
    kind: Kind,
    points: tuple[AssemblyPoint, ...],
    settings: CheckSettings,
    rng: np.random.Generator,
    places: Array | None = None,
    known: Known | None = None,
) -> Extraction:
    """The points of a scan, set right by what was learned of its camera: with the method that it was learned with."""
    found = extract_sizes(scan, kind, _diameters_mm(points), settings.method, rng, places, known=known)
    if scan.learned is None or settings.method != "refined":
        return found
    from aadm_workbench.extract.edges.learned_edges import with_learned_stretch

    return with_learned_stretch(found, scan.learned)


def scale_error_of(scan: Scan, kind: Kind) -> float:
    """Relative standard uncertainty of the lengths of a scan: as learned, else as its camera states it."""
    if scan.learned is not None and kind in scan.learned.edges:
        edges = scan.learned.edges[kind]
        return float(np.hypot(edges.stretch.u, edges.spread))
    return scan.camera.scale_error if scan.camera else 0.0


def _diameters_mm(points: tuple[AssemblyPoint, ...]) -> list[float]:
    return [point.diameter_mm for point in points]


def _matched(
    points: tuple[AssemblyPoint, ...],
    scan: Scan,
    extraction: Extraction,
    up_deg: float | None,
    settings: CheckSettings,
    rng: np.random.Generator,
) -> tuple[Extraction, Match]:
    """Which point of a scan is which; where some are missing, look again at the places where they should be."""
    match = match_extraction(points, extraction, up=up_deg, image_up_scan=IMAGE_UP_SCAN)
    places = missing_places(points, match)
    if not places or settings.method != "refined":
        return extraction, match
    sought = np.array(list(places.values()))
    again = _extracted(scan, extraction.kind, points, settings, rng, sought)
    second = match_extraction(points, again, up=up_deg, image_up_scan=IMAGE_UP_SCAN)
    if second and second.placements[0].found > match.placements[0].found:
        return again, second
    return extraction, match


def _control(
    design: ColumnDesign, scans: ColumnScans, kind: Kind, extraction: Extraction
) -> ControlPose | NoFit | None:
    """The pose of the scan of the bars by the job's control points; None without any."""
    if kind is not Kind.REBAR or not scans.control_points:
        return None
    from aadm_workbench.assembly.survey.control import fit_control_points

    at = in_scan_frame(scans.control_points, scans.rebars[0])
    return fit_control_points(at, design.T_model_column, extraction.vertical)


def _in_the_building(
    measured: Measured,
    points: tuple[AssemblyPoint, ...],
    control_points: tuple[ControlPoint, ...],
    control: ControlPose | NoFit,
    settings: CheckSettings,
    scale_error: float,
) -> Measured:
    """The measured bars with their absolute position in the report."""
    from aadm_workbench.assembly.survey.absolute import DatumRules, inspect_absolute, with_absolute

    absolute = inspect_absolute(
        points,
        place_points(measured.extraction, measured.match.placements[0]),
        control_points,
        control,
        DatumRules.of(settings.profile),
        decision=settings.decision,
        scale_error=scale_error,
    )
    return replace(measured, report=with_absolute(measured.report, absolute, settings.profile))
