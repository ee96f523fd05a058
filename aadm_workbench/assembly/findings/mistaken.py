"""Scans that show something else than they were named for: the other group, another column, bars of another size.

Asked only of a group that does not lie on its design: then it is worth the time to look what it is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from aadm_workbench.assembly.findings.diameters import CORE_ABOVE, CORE_BELOW, sizes_in_words
from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.lengths import is_usual, length_findings
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.assembly.findings.named_scan import FEWEST, FITS_SHARE, NamedScan, fits
from aadm_workbench.design.recognise.bar_sizes import OVER_RIBS_MM
from aadm_workbench.extract.copied_pixels import COPIED
from aadm_workbench.extract.edges.edge_shift import BLURRED
from aadm_workbench.extract.filter_signs import GAPS_FILLED, SMOOTHED
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Finding, Kind, codes_of

_BADLY_BUILT_MM = 3.0  # root mean square: a half more than the limit of every single point
_FITS_BETTER = 2.0  # on its own design, or on one like it, a group scatters by as much: by half is no chance
_LOOKS = 3  # in one scan, for other columns' sizes: each takes as long as a check
_UNFIT = {SMOOTHED.code, GAPS_FILLED.code, COPIED.code, BLURRED.code}
_NEXT_BORE = 1.15  # sleeves for the next bar are 2 to 6 mm wider; found are those within 8 %
_SIZES_EACH_WAY = 2  # bars two sizes off have been delivered; more would be seen from afar


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
    lost = [kind for kind, group in groups.items() if _is_lost(group)]
    odd = list(length_findings([(groups[kind], scans[kind]) for kind in lost if not is_usual(scans[kind].distance_mm)]))
    yield from odd
    lost = [kind for kind in lost if not _is_told(odd, kind)]
    crossed = _crossed(design, groups, scans, odd)
    if len(crossed) == 2:
        yield make_finding("swapped", ["sleeves", "rebars"])
        return
    for kind in crossed:
        names = {"group": kind.plural, "others": _other(kind).plural, "source": scans[kind].source}
        yield make_finding("swapped.one", [kind.plural], **names)
    unexplained = []
    for kind in (kind for kind in lost if kind not in crossed):
        found = _of_another_column(groups[kind], scans[kind], others)
        found = found or _of_other_sizes(groups[kind], scans[kind])
        if found is not None:
            yield found
        else:
            unexplained.append((groups[kind], scans[kind]))
    yield from length_findings(unexplained)
    for kind, group in groups.items():
        doubtful = _hardly_fits(group) or group.match.contradiction == "turn_contradicted"
        found = _of_another_column(group, scans[kind], others) if doubtful and kind not in crossed else None
        if found is not None:
            yield found


def _crossed(
    design: ColumnDesign, groups: Mapping[Kind, SeenGroup], scans: Mapping[Kind, NamedScan], odd: Sequence[Finding]
) -> list[Kind]:
    """The groups whose scans show the other group: lost ones, and with one such the other, whatever it seems to be."""
    lost = [kind for kind, group in groups.items() if _is_lost(group) and not _is_told(odd, kind)]
    crossed = [kind for kind in lost if _shows(design, scans[kind], _other(kind))]
    if len(crossed) != 1:
        return crossed
    (one,) = crossed
    doubtful = [kind for kind, group in groups.items() if kind is not one and (not group.match or _hardly_fits(group))]
    return [one, *(kind for kind in doubtful if kind not in lost and _shows(design, scans[kind], one))]


def _is_told(findings: Sequence[Finding], kind: Kind) -> bool:
    return any(kind.plural in finding.about for finding in findings)


def _is_lost(group: SeenGroup) -> bool:
    """Whether nothing explains yet that a group lies nowhere."""
    explained = group.match.contradiction or _UNFIT & codes_of(group.extraction.reason)
    return not group.match and not explained


def _hardly_fits(group: SeenGroup) -> bool:
    """Whether a group lies on its design only in part, and farther off than anything is built."""
    if not group.match:
        return False
    placement, points = group.match.placements[0], len(group.extraction.points)
    few = placement.found < FITS_SHARE * min(points, len(group.design))
    return few or placement.rms_mm > _BADLY_BUILT_MM


def _other(kind: Kind) -> Kind:
    return Kind.REBAR if kind is Kind.SLEEVE else Kind.SLEEVE


def _shows(design: ColumnDesign, scan: NamedScan, kind: Kind) -> bool:
    """Whether a scan shows the sleeves, or the rebars, of a design."""
    points = design.points(kind)
    return bool(points) and fits(points, scan.look(kind, [point.diameter_mm for point in points]))


def _of_another_column(group: SeenGroup, scan: NamedScan, others: Sequence[ColumnDesign]) -> Finding | None:
    seen = {_sizes(group.design): group.extraction}
    # Those of the same sizes first: for them nothing has to be looked for again.
    for other in sorted(others, key=lambda design: _sizes(design.points(group.kind)) not in seen):
        points = other.points(group.kind)
        sizes = _sizes(points)
        if len(points) < FEWEST or (sizes not in seen and len(seen) > _LOOKS):
            continue
        if sizes not in seen:
            seen[sizes] = scan.look(group.kind, sizes)
        if fits(points, seen[sizes], _own_rms_mm(group) / _FITS_BETTER):
            name = group.kind.plural
            return make_finding("other_column", [name], group=name, column=other.id)
    return None


def _own_rms_mm(group: SeenGroup) -> float:
    """How well a group lies on its own design in a turn that is not the declared one; infinite where it does not."""
    return min((one.rms_mm for one in group.match.contradicting), default=math.inf)


def _sizes(points: Sequence[AssemblyPoint]) -> tuple[float, ...]:
    return tuple(sorted({point.diameter_mm for point in points}))


def _of_other_sizes(group: SeenGroup, scan: NamedScan) -> Finding | None:
    """Bars, or sleeves, of another size that stand where those of the design should."""
    designed_mm = _sizes(group.design)
    for size_mm in _sizes_about(designed_mm) if group.kind is Kind.REBAR else _bores_about(designed_mm):
        extraction = scan.look(group.kind, [size_mm])
        if fits(group.design, extraction):
            seen_mm = float(np.median([point.diameter_mm for point in extraction.points]))
            values: dict[str, object] = {"design_mm": designed_mm[0], "measured_mm": seen_mm}
            if group.kind is Kind.SLEEVE:
                return make_finding("diameter_differs.other_sleeves", [group.kind.plural], **values)
            return make_finding(
                "diameter_differs.others", [group.kind.plural], **values, seems=sizes_in_words([seen_mm])
            )
    return None


def _bores_about(designed_mm: Sequence[float]) -> list[float]:
    """Bores that no sleeve of the design can be taken for: the next sizes to either side."""
    return [designed_mm[0] / _NEXT_BORE, designed_mm[-1] * _NEXT_BORE]


def _sizes_about(designed_mm: Sequence[float]) -> list[float]:
    """Sizes that no bar of the design can be taken for, the nearest first."""
    low, high = designed_mm[0] * (1.0 - CORE_BELOW), designed_mm[-1] * (1.0 + CORE_ABOVE)
    below = [size for size in sorted(OVER_RIBS_MM, reverse=True) if size < low][:_SIZES_EACH_WAY]
    above = [size for size in sorted(OVER_RIBS_MM) if size > high][:_SIZES_EACH_WAY]
    return sorted([*below, *above], key=lambda size: min(abs(size - one) for one in designed_mm))
