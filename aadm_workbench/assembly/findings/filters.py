"""Filters that the camera's software was left to apply: they move edges by more than what is to be measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.extract.copied_pixels import COPIED
from aadm_workbench.extract.filter_signs import GAPS_FILLED, SMOOTHED
from aadm_workbench.model import Finding, codes_of

_FILTERS = {SMOOTHED.code: "smoothed", GAPS_FILLED.code: "gaps_filled", COPIED.code: "edges_fattened"}


def filter_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A finding where a group was not measured because a filter spoilt its scan.

    Where holes were filled in one scan of a column, another one in which no pixel is lost was filled, too.
    """
    filled = any(GAPS_FILLED.code in codes_of(group.extraction.reason) for group in groups)
    for group in groups:
        told = codes_of(group.extraction.reason)
        for filtered, code in _FILTERS.items():
            also = filtered == GAPS_FILLED.code and filled and group.extraction.complete
            if filtered in told or also:
                yield make_finding(code, [group.kind.plural], group=group.kind.plural)
