"""Elements of the model whose GlobalId is not theirs alone: results cannot be written to them."""

from __future__ import annotations

from dataclasses import replace

from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.model import ColumnDesign, Finding


def shared_id_findings(design: ColumnDesign) -> list[Finding]:
    """One finding about all of them; it says nothing against the column itself."""
    if not design.shared_ids:
        return []
    return [replace(make_finding("duplicate_global_id", design.shared_ids), holds_back=False)]
