"""What is said beside the figures of one group: of its files and their axes, of how sure it is, of what is missing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.assembly.tolerances import rules_for
from aadm_workbench.model import (
    AXES_UNKNOWN,
    OPENGL_AXES,
    AbsolutePosition,
    Array,
    AssemblyPoint,
    ControlPoint,
    Extraction,
    GroupReport,
    Kind,
    PointResult,
    Profile,
    Reason,
    Scan,
    Vector3,
    Verdict,
    codes_of,
)
from aadm_workbench.model.special import median

LARGEST_U_TO_LIMIT = 0.409
"""1/sqrt(-2 ln 0.05): with a larger u per axis no radial deviation is within the limit at 95 % (Rice law)."""

_UNEXPLAINED = {"assembly.not_measured", "assembly.missing", "assembly.unspaced", "extract.not_found"}

NO_CAMERA = Reason("assembly.no_camera")
"""Note of a scan whose viewpoint nobody knows."""

AXES_NOT_TOLD = Reason("assembly.axes_not_told")
"""Note of a cloud in any frame, for which the job declares what is at the top."""


def of_the_files(views: tuple[Scan, ...]) -> tuple[str, ...]:
    """What was noticed while the scans were read."""
    return tuple(
        Reason("said.of_file", file=view.source, why=note)
        for view in views
        for note in (*view.notes, *(() if view.viewpoint is not None else (NO_CAMERA,)))
    )


def typical_u_mm(extraction: Extraction) -> float | None:
    """Median standard uncertainty, mm per axis across the vertical, of the centres; None without covariances."""
    known = [point.covariance for point in extraction.points if point.covariance is not None]
    if not known or extraction.vertical is None:
        return None
    up = extraction.vertical
    return float(median([np.sqrt(max(np.trace(c) - up @ c @ up, 0.0) / 2.0) for c in known]))


def unsupported(u_mm: float | None, profile: Profile, kind: Kind) -> tuple[str, ...]:
    """A note where no deviation, however small, could be accepted at 95 % with this uncertainty."""
    limits = [rule.upper for rule in rules_for(profile, f"{kind.value}_position")]
    if u_mm is None or not limits or u_mm < LARGEST_U_TO_LIMIT * min(limits):
        return ()
    return (Reason("assembly.unsupported", limit_mm=min(limits), u_mm=u_mm),)


def missing_places(points: tuple[AssemblyPoint, ...], match: Match) -> dict[int, Array]:
    """Where in the scan (3,) mm the design points should be that were not found, by their index."""
    if not match:
        return {}
    placement = match.placements[0]
    T_scan_design = np.linalg.inv(placement.T_design_scan)
    return {
        k: T_scan_design[:3, :3] @ points[k].centre + T_scan_design[:3, 3]
        for k in np.flatnonzero(placement.matched < 0).tolist()
    }


def reasons_of_missing(
    scan: Scan, extraction: Extraction, places: Mapping[int, Array], diameter_mm: float, rng: np.random.Generator
) -> dict[int, str]:
    """Why each design point was not measured, by its place in the design; ``places`` (3,) mm, scan frame."""
    if not places:
        return {}
    from aadm_workbench.extract.missing import explain_missing

    texts = explain_missing(scan, extraction, np.array(list(places.values())), diameter_mm, rng)
    return dict(zip(places, texts, strict=True))


def with_reasons(report: GroupReport, reasons: Mapping[int, str]) -> GroupReport:
    """The report with the reason for each point that was not measured, in the points and in the summary."""
    if not reasons:
        return report
    points = tuple(_explained(point, reasons.get(k)) for k, point in enumerate(report.points))
    said = tuple(Reason("assembly.not_measured", label=report.points[k].label, why=text) for k, text in reasons.items())
    kept = tuple(text for text in report.reasons if not _UNEXPLAINED & codes_of(text))
    return replace(report, points=points, reasons=(*kept, *said))


def _explained(point: PointResult, reason: str | None) -> PointResult:
    if reason is None or point.verdict is not Verdict.NOT_MEASURED:
        return point
    return replace(point, reason=Reason("said.of", what=point.label, why=reason))


def in_scan_frame(points: Sequence[ControlPoint], scan: Scan) -> tuple[ControlPoint, ...]:
    """Control points, given in the coordinates of a file, in the scan frame."""
    return tuple(replace(point, scan_mm=_turned(scan.R_file_scan.T, point.scan_mm)) for point in points)


def in_coordinates_of_the_file(report: GroupReport, scan: Scan) -> GroupReport:
    """Return a report on a scan with all that is in the scan frame in the coordinates of its file."""
    if scan.axes != OPENGL_AXES:
        return report
    R = scan.R_file_scan
    points = tuple(
        point if point.scan_mm is None else replace(point, scan_mm=_turned(R, point.scan_mm)) for point in report.points
    )
    fit = None if report.fit is None else replace(report.fit, T_design_scan=_from_file(report.fit.T_design_scan, R))
    absolute = None if report.absolute is None else _absolute(report.absolute, R)
    quality = {**report.quality, "axes": scan.axes}
    return replace(report, points=points, fit=fit, absolute=absolute, quality=quality)


def axes_not_told(views: Sequence[Scan], up_deg: float | None) -> tuple[str, ...]:
    """A note on each scan whose top a job declares, and whose axes nobody does."""
    if up_deg is None:
        return ()
    return tuple(
        Reason("said.of_file", file=view.source, why=AXES_NOT_TOLD) for view in views if view.axes == AXES_UNKNOWN
    )


def _absolute(absolute: AbsolutePosition, R: Array) -> AbsolutePosition:
    residuals = tuple(replace(point, scan_mm=_turned(R, point.scan_mm)) for point in absolute.control_points)
    T = absolute.T_column_scan
    return replace(absolute, control_points=residuals, T_column_scan=None if T is None else _from_file(T, R))


def _from_file(T_to_scan: Array, R: Array) -> Array:
    """A transform (4, 4) from the scan frame, as one from the file's coordinates."""
    T_scan_file = np.eye(4)
    T_scan_file[:3, :3] = R.T
    return np.asarray(T_to_scan @ T_scan_file)


def _turned(R: Array, point: Vector3) -> Vector3:
    x, y, z = (R @ np.array(point, dtype=np.float64)).tolist()
    return x, y, z
