"""Why points were not measured, said at each of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.extract.missing import explain_missing
from aadm_workbench.model import (
    Array,
    AssemblyPoint,
    Extraction,
    GroupReport,
    PointResult,
    Reason,
    Scan,
    Verdict,
    codes_of,
)

_UNEXPLAINED = {"assembly.not_measured", "assembly.missing", "assembly.unspaced", "extract.not_found"}


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
