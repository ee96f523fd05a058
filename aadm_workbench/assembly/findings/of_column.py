"""What of a measured column contradicts its design, its job or its camera, and what that does to its verdict."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.hold import held_back
from aadm_workbench.assembly.findings.mistaken import mistaken_findings
from aadm_workbench.assembly.findings.named_scan import NamedScan
from aadm_workbench.assembly.findings.odd_bars import odd_bar_findings
from aadm_workbench.assembly.findings.rules import findings_of
from aadm_workbench.assembly.findings.shared_ids import shared_id_findings
from aadm_workbench.assembly.findings.void import without_spoilt
from aadm_workbench.assembly.section.findings import section_findings
from aadm_workbench.extract.sizes import extract_sizes
from aadm_workbench.model import ColumnDesign, ColumnReport, Extraction, Finding, Kind, Reason, Scan

_SAMPLE = 10_000  # points: a look, not a measurement


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
    scans = {kind: _named(one.scan, method, rng) for kind, one in seen.items()}
    found = _without_turns(
        [*findings_of(design, list(groups.values())), *mistaken_findings(design, groups, scans, others)]
    )
    found += [*shared_id_findings(design), *section_findings(report.section)]
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
    return float(np.nanmedian(np.abs(some))) if np.isfinite(some).any() else 0.0


def _stretched(scan: Scan, across: float, along: float) -> Scan:
    """The scan with its x and y, and its z, times a factor each, as a camera would have it that measures so."""
    factors = np.array([across, across, along])
    camera = scan.camera
    if camera is not None:
        camera = replace(camera, fx=camera.fx * along / across, fy=camera.fy * along / across)
    viewpoint = None if scan.viewpoint is None else scan.viewpoint * factors
    return replace(scan, points=scan.points * factors.astype(scan.points.dtype), camera=camera, viewpoint=viewpoint)
