"""Scans that show something else than they were named for: the other group, another column, bars of another size.

Asked only of a group that does not lie on its design: then it is worth the time to look what it is.

Lengths that are wrong by a factor: a focal length that is not the camera's, a depth scale, a unit. A wrong focal length
stretches a scan across the view and leaves its depths; a wrong unit or depth scale stretches all. Nothing has the
designed size then, and nothing is found. So the scan is looked at as if it was made with likelier ones: where the
pattern is there then, sizes and all, that is what was wrong.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.findings.diameters import (
    CORE_ABOVE,
    CORE_BELOW,
    diameter_findings,
    sizes_in_words,
)
from aadm_workbench.assembly.findings.finding import SeenGroup, make_finding
from aadm_workbench.assembly.matching.match import match_extraction
from aadm_workbench.design.recognise.pattern import OVER_RIBS_MM
from aadm_workbench.extract.edges.bend import BLURRED
from aadm_workbench.extract.filter_signs import COPIED, GAPS_FILLED, SMOOTHED
from aadm_workbench.model import AssemblyPoint, ColumnDesign, Extraction, Finding, Kind, codes_of

_BADLY_BUILT_MM = 3.0  # root mean square: a half more than the limit of every single point
_FITS_BETTER = 2.0  # on its own design, or on one like it, a group scatters by as much: by half is no chance
_LOOKS = 3  # in one scan, for other columns' sizes: each takes as long as a check
_UNFIT = {SMOOTHED.code, GAPS_FILLED.code, COPIED.code, BLURRED.code}
_NEXT_BORES = 1.1, 1.2  # sleeves for the next bars are 2 to 6 mm wider; found are those within 4 to 8 %
_SIZES_EACH_WAY = 2  # bars two sizes off have been delivered; more would be seen from afar

UNIT_FACTORS = (10.0, 0.1, 100.0, 0.01, 25.4, 1.0 / 25.4)
"""By which lengths of scans have been too large: slips of a decimal, inches. A thousand is refused when it is read."""

FOCAL_FACTORS = (0.5, 2.0, 1.11, 0.9, 1.25, 0.8, 1.43, 0.7)
"""Of what the job says to what the camera has: a picture of half the resolution, and steps of a hole's play."""

_USUAL_DISTANCE_MM = (250.0, 4000.0)  # of cameras that see a sleeve by the tenth of a millimetre

FITS_SHARE = 0.75
"""Of the points of a design: with so many on their places a scan shows it. Half may lie on some pattern by chance."""

FEWEST = 4
"""Three points of many lie on some pattern by chance; all three of a design do not, where they are on their places."""

_OF_THREE_MM = 1.5  # root mean square: twice the usual scatter, over as much as three points may be moved for a fit

Look = Callable[[Kind, Sequence[float]], Extraction]
"""Looks for points of a kind, of some diameters, mm, in one scan."""


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
        told = [found] if found is not None else list(odd_size_findings(groups[kind], scans[kind]))
        yield from told
        if not told:
            unexplained.append((groups[kind], scans[kind]))
    yield from length_findings(unexplained)
    for kind, group in groups.items():
        if group.match.is_shifted:
            yield from odd_size_findings(group, scans[kind])
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
        if len(points) < FEWEST - 1 or (sizes not in seen and len(seen) > _LOOKS):
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


def odd_size_findings(group: SeenGroup, scan: NamedScan) -> Iterator[Finding]:
    """A finding on those of a few bars that are thicker than designed, where all lie on the design only with them.

    A bar with a cap is none of the size that was looked for: without it the others lie nowhere, or in two places.
    """
    designed_mm = _sizes(group.design)
    if group.kind is not Kind.REBAR or len(designed_mm) != 1:
        return
    for size_mm in (size for size in _sizes_about(designed_mm) if size > designed_mm[0]):
        extraction = scan.look(group.kind, [*designed_mm, size_mm])
        match = match_extraction(group.design, extraction)
        whole = bool(match) and match.placements[0].found == len(group.design) and not match.is_shifted
        if whole and match.placements[0].rms_mm < _OF_THREE_MM:
            found = list(diameter_findings(replace(group, extraction=extraction, match=match)))
            if found and group.kind.plural not in found[0].about:
                yield from found
                return


def _of_other_sizes(group: SeenGroup, scan: NamedScan) -> Finding | None:
    """Bars, or sleeves, of another size that stand where those of the design should."""
    designed_mm = _sizes(group.design)
    for size_mm in _sizes_about(designed_mm) if group.kind is Kind.REBAR else _bores_about(designed_mm):
        extraction = scan.look(group.kind, [size_mm])
        if fits(group.design, extraction):
            seen_mm = float(np.median([point.diameter_mm for point in extraction.points]))
            told = replace(group, extraction=extraction, match=match_extraction(group.design, extraction))
            if not list(diameter_findings(told)):
                continue  # as designed, for all that is known: that they were not found as such has another cause
            values: dict[str, object] = {"design_mm": designed_mm[0], "measured_mm": seen_mm}
            if group.kind is Kind.SLEEVE:
                return make_finding("diameter_differs.other_sleeves", [group.kind.plural], **values)
            return make_finding(
                "diameter_differs.others", [group.kind.plural], **values, seems=sizes_in_words([seen_mm])
            )
    return None


def _bores_about(designed_mm: Sequence[float]) -> list[float]:
    """Bores that no sleeve of the design can be taken for: the next sizes to either side."""
    return [bore for times in _NEXT_BORES for bore in (designed_mm[0] / times, designed_mm[-1] * times)]


def _sizes_about(designed_mm: Sequence[float]) -> list[float]:
    """Sizes that no bar of the design can be taken for, the nearest first."""
    low, high = designed_mm[0] * (1.0 - CORE_BELOW), designed_mm[-1] * (1.0 + CORE_ABOVE)
    below = [size for size in sorted(OVER_RIBS_MM, reverse=True) if size < low][:_SIZES_EACH_WAY]
    above = [size for size in sorted(OVER_RIBS_MM) if size > high][:_SIZES_EACH_WAY]
    return sorted([*below, *above], key=lambda size: min(abs(size - one) for one in designed_mm))


def length_findings(lost: Sequence[tuple[SeenGroup, NamedScan]]) -> Iterator[Finding]:
    """A finding for each group that lies on its design once its lengths are put right."""
    told: list[tuple[str, float]] = []
    for group, scan in lost:
        for law, factor in [*told, *_likely(scan.distance_mm)]:
            across, along = (factor, 1.0) if law == "focal" else (1.0 / factor, 1.0 / factor)
            looked = scan.stretched(across, along)
            if fits(group.design, looked.look(group.kind, [point.diameter_mm for point in group.design])):
                told = [(law, factor)]
                name = group.kind.plural
                said = {"times": 1.0 / factor} if law == "focal" else {"factor": factor}
                yield make_finding(f"scale_differs.{law}", [name], group=name, **said)
                break


def _likely(distance_mm: float) -> list[tuple[str, float]]:
    """Laws and factors, the likelier first: a camera that stood too near or too far is no camera."""
    units = [("unit", factor) for factor in UNIT_FACTORS if is_usual(distance_mm / factor)]
    focal = [("focal", factor) for factor in FOCAL_FACTORS]
    return [*focal, *units] if is_usual(distance_mm) else units


def is_usual(distance_mm: float) -> bool:
    """Whether a camera stands so far from what it measures."""
    low, high = _USUAL_DISTANCE_MM
    return low <= distance_mm <= high


@dataclass(frozen=True, eq=False)
class NamedScan:
    """The first scan of a group: its file as the job names it, and how to look for other things in it.

    ``stretched`` gives the scan with lengths across the view, and along it, times a factor each. ``distance_mm`` is
    that of most of its points from the camera.
    """

    source: str
    look: Look
    stretched: Callable[[float, float], NamedScan]
    distance_mm: float = 0.0


def fits(points: Sequence[AssemblyPoint], extraction: Extraction, within_mm: float = math.inf) -> bool:
    """Whether an extraction lies on a design, mirrored or not, and scatters about it by less than so much, rms.

    Of designs of three points nothing may be missing, nor left over, and no mirror.
    """
    of_three = len(points) < FEWEST
    if of_three and len(extraction.points) != len(points):
        return False
    match = match_extraction(points, extraction)
    needed = len(points) if of_three else max(FEWEST, FITS_SHARE * len(points))
    if match.contradiction == "mirrored":
        return math.isinf(within_mm) and not of_three
    within_mm = min(within_mm, _OF_THREE_MM) if of_three else within_mm
    return bool(match) and match.placements[0].found >= needed and match.placements[0].rms_mm < within_mm
