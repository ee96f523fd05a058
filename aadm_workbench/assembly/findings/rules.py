"""All rules that look at one column by itself."""

from __future__ import annotations

from collections.abc import Sequence

from aadm_workbench.assembly.findings.diameters import diameter_findings
from aadm_workbench.assembly.findings.exposed_lengths import exposed_length_findings
from aadm_workbench.assembly.findings.filters import filter_findings
from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.leans import lean_findings
from aadm_workbench.assembly.findings.scales import scale_findings
from aadm_workbench.assembly.findings.turns import turn_findings
from aadm_workbench.model import ColumnDesign, Finding


def findings_of(design: ColumnDesign, groups: Sequence[SeenGroup]) -> tuple[Finding, ...]:
    """What contradicts the design, the declaration or the camera, of the groups of a column that were scanned."""
    found: list[Finding] = [finding for group in groups for finding in turn_findings(group)]
    found += scale_findings(groups)
    found += lean_findings(groups)
    found += filter_findings(groups)
    for group in groups:
        found += diameter_findings(group)
        found += exposed_length_findings(group, design.exposed_length_mm)
    return tuple(found)
