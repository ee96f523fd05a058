"""Filters that the camera's software was left to apply: they move edges by more than what is to be measured."""

from __future__ import annotations

from collections.abc import Iterator

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.extract.copied_pixels import COPIED
from aadm_workbench.extract.filter_signs import GAPS_FILLED, SMOOTHED
from aadm_workbench.model import Finding

_CODES = {SMOOTHED: "smoothed", GAPS_FILLED: "gaps_filled", COPIED: "edges_fattened"}


def filter_findings(group: SeenGroup) -> Iterator[Finding]:
    """A finding where a group was not measured because a filter spoilt its scan."""
    for reason, code in _CODES.items():
        if reason in group.extraction.reason:
            yield make_finding(code, [group.kind.plural], group=group.kind.plural)
