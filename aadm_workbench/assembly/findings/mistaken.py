"""Scans that show something else than they were named for: the other group, another column, bars of another size.

Asked only of a group that does not lie on its design: then it is worth the time to look what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.findings.diameters import CORE_ABOVE, CORE_BELOW, sizes_in_words
from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.assembly.match import match_extraction
from aadm_workbench.design.bar_sizes import OVER_RIBS_MM
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Extraction, Finding, Kind

FITS_SHARE = 0.75
"""Of the points of a design: with so many on their places a scan shows it. Half may lie on some pattern by chance."""

_FEWEST = 4  # three points lie on some pattern by chance
_LOOKS = 3  # in one scan, for other columns' sizes: each takes as long as a check
_SIZES_EACH_WAY = 2  # bars two sizes off have been delivered; more would be seen from afar

Look = Callable[[Kind, Sequence[float]], Extraction]
"""Looks for points of a kind, of some diameters, mm, in one scan."""


@dataclass(frozen=True, eq=False)
class NamedScan:
    """The first scan of a group: its file as the job names it, and how to look for other things in it."""

    source: str
    look: Look


def mistaken_findings(
    design: ColumnDesign,
    groups: Mapping[Kind, SeenGroup],
    scans: Mapping[Kind, NamedScan],
    others: Sequence[ColumnDesign] = (),
) -> Iterator[Finding]:
    """Findings on groups that match nothing, each with what its scan does show.

    Parameters
    ----------
    others
        The other columns of the job, for a scan that fits one of them.
    """
    lost = [kind for kind, group in groups.items() if not group.match and not group.match.contradiction]
    crossed = [kind for kind in lost if _shows(design, scans[kind], _other(kind))]
    if len(crossed) == 2:
        yield make_finding("swapped", ["sleeves", "rebars"])
        return
    for kind in lost:
        if kind in crossed:
            names = {"group": kind.plural, "others": _other(kind).plural, "source": scans[kind].source}
            yield make_finding("swapped.one", [kind.plural], **names)
            continue
        found = _of_another_column(groups[kind], scans[kind], others)
        if found is None and kind is Kind.REBAR:
            found = _of_other_sizes(groups[kind], scans[kind])
        if found is not None:
            yield found


def _other(kind: Kind) -> Kind:
    return Kind.REBAR if kind is Kind.SLEEVE else Kind.SLEEVE


def _shows(design: ColumnDesign, scan: NamedScan, kind: Kind) -> bool:
    """Whether a scan shows the sleeves, or the rebars, of a design."""
    points = design.points(kind)
    return bool(points) and _fits(points, scan.look(kind, [point.diameter_mm for point in points]))


def _fits(points: Sequence[AssemblyPoint], extraction: Extraction) -> bool:
    match = match_extraction(points, extraction)
    needed = max(_FEWEST, FITS_SHARE * len(points))
    if match.contradiction == "mirrored":
        return True
    return bool(match) and match.placements[0].found >= needed


def _of_another_column(group: SeenGroup, scan: NamedScan, others: Sequence[ColumnDesign]) -> Finding | None:
    seen = {_sizes(group.design): group.extraction}
    # Those of the same sizes first: for them nothing has to be looked for again.
    for other in sorted(others, key=lambda design: _sizes(design.points(group.kind)) not in seen):
        points = other.points(group.kind)
        sizes = _sizes(points)
        if len(points) < _FEWEST or (sizes not in seen and len(seen) > _LOOKS):
            continue
        if sizes not in seen:
            seen[sizes] = scan.look(group.kind, sizes)
        if _fits(points, seen[sizes]):
            name = group.kind.plural
            return make_finding("other_column", [name], group=name, column=other.id)
    return None


def _sizes(points: Sequence[AssemblyPoint]) -> tuple[float, ...]:
    return tuple(sorted({point.diameter_mm for point in points}))


def _of_other_sizes(group: SeenGroup, scan: NamedScan) -> Finding | None:
    """Bars of another size that stand where those of the design should."""
    designed_mm = _sizes(group.design)
    for size_mm in _sizes_about(designed_mm):
        extraction = scan.look(group.kind, [size_mm])
        if _fits(group.design, extraction):
            core_mm = float(np.median([point.diameter_mm for point in extraction.points]))
            values = {"design_mm": designed_mm[0], "measured_mm": core_mm, "seems": sizes_in_words([core_mm])}
            return make_finding("diameter_differs.others", [group.kind.plural], **values)
    return None


def _sizes_about(designed_mm: Sequence[float]) -> list[float]:
    """Sizes that no bar of the design can be taken for, the nearest first."""
    low, high = designed_mm[0] * (1.0 - CORE_BELOW), designed_mm[-1] * (1.0 + CORE_ABOVE)
    below = [size for size in sorted(OVER_RIBS_MM, reverse=True) if size < low][:_SIZES_EACH_WAY]
    above = [size for size in sorted(OVER_RIBS_MM) if size > high][:_SIZES_EACH_WAY]
    return sorted([*below, *above], key=lambda size: min(abs(size - one) for one in designed_mm))
