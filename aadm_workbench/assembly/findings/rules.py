"""All rules that look at one column by itself.

Bars that stick out of the floor too little or too much to be what the sleeves need. Where the design says how far they
stick out, that is what they are held against; elsewhere the other bars are, whose tops may differ by centimetres by
right: then only what lies far outside of their own spread is told; few bars have to be as long as they go in.

A lean that all sleeves, or all bars, share: theirs, or that of a principal point that is not the camera's. A principal
point that is off by p pixels shears all that is measured: whatever is farther away moves sideways by p/f of its depth.
Sleeves and bars then lean by that angle, towards the same side of the image, and places within a plane across the view
stay as they are.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.findings.diameters import diameter_findings
from aadm_workbench.assembly.findings.finding import SeenGroup, make_finding
from aadm_workbench.assembly.findings.scale import scale_findings
from aadm_workbench.assembly.matching.match import FAR_FROM_DECLARED
from aadm_workbench.assembly.pose.eopa import wrap
from aadm_workbench.extract.edges.learned_edges import EDGE_LAWS, OFF_RINGS
from aadm_workbench.extract.filter_signs import COPIED, GAPS_FILLED, SMOOTHED
from aadm_workbench.extract.pooled.fit import USUAL_LEAN
from aadm_workbench.extract.pooled.system import Priors
from aadm_workbench.extract.sleeves import BORE_LEAN_U
from aadm_workbench.model import Array, ColumnDesign, Finding, Kind, codes_of
from aadm_workbench.model.measured import OF_MEDIAN, TO_SIGMA
from aadm_workbench.model.special import median

_FILTERS = {SMOOTHED.code: "smoothed", GAPS_FILLED.code: "gaps_filled", COPIED.code: "edges_fattened"}

PLAY_MM = 20.0
"""What a sleeve gives at the end that is assembled on site, beyond the embedded length: JG/T 398-2019 (recalled)."""

U_MM = 1.0
"""Standard uncertainty of an exposed length: the floor about a bar is no plane."""

_LENGTH_SIGMAS = 3.0  # of sound bars one in 370 is farther off, before the play
_FEWEST_KNOWN = 4  # of fewer bars no median tells what is usual, or what all share

LEAST_DEG = 0.8
"""Floors, and feet, are square to their columns to half of that; a single bar or sleeve leans by 0.3° by right."""

_FEWEST_OF_BOTH = 3  # where sleeves and bars say the same, three of each are one of six
_LEAN_SIGMAS = 6.0  # beyond what noise, tried twelve times, ever does
# two scans that err alike by chance are rarer than one that errs
_LEAN_SIGMAS_OF_BOTH, _LEAN_SIGMAS_OF_EACH, _LEAN_SIGMAS_APART = 4.0, 1.5, 3.0
_LEAST_INFORMATION = 1.0  # of a lean of which nothing is seen: it may be anything
_SHARED_DEG = {Kind.SLEEVE: 0.15, Kind.REBAR: 0.3}  # what all leans of one scan may be off together
_ALIKE = 0.35  # of the larger: so much two scans of one camera may differ in
_OFF_PIXELS = -0.5, 0.8
"""Of the edges of mouths: with their own profile -0.4 to 0.2 on ray-cast cameras. On a path-traced one mouths with a
chamfer of half a millimetre, as no plate has, look 0.5 larger without a filter and 0.7 with a ring dropped. A ring that
the profile does not know makes 0.6 to 1.3, one that it knows and the camera does not drop as much the other way."""


def findings_of(design: ColumnDesign, groups: Sequence[SeenGroup]) -> tuple[Finding, ...]:
    """What contradicts the design, the declaration or the camera, of the groups of a column that were scanned."""
    found: list[Finding] = [finding for group in groups for finding in turn_findings(group)]
    found += scale_findings(groups)
    found += lean_findings(groups)
    found += filter_findings(groups)
    found += bend_findings(groups)
    found += profile_findings(groups)
    for group in groups:
        found += diameter_findings(group)
        found += exposed_length_findings(group, design.exposed_length_mm, design.embedded_length_mm)
    return tuple(found)


def filter_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A finding where a group was not measured because a filter spoilt its scan.

    Where holes were filled in one scan of a column, another one in which no pixel is lost was filled, too; where one
    was smoothed, so was another one that is too rough to show it.
    """
    filled, smoothed = (
        any(reason.code in codes_of(group.extraction.reason) for group in groups) for reason in (GAPS_FILLED, SMOOTHED)
    )
    for group in groups:
        told = codes_of(group.extraction.reason)
        for filtered, code in _FILTERS.items():
            also = filtered == GAPS_FILLED.code and filled and group.extraction.complete
            also |= filtered == SMOOTHED.code and smoothed and not group.extraction.noise_seen
            if filtered in told or also:
                yield make_finding(code, [group.kind.plural], group=group.kind.plural)


def turn_findings(group: SeenGroup) -> Iterator[Finding]:
    """A contradicted ``up``, a mirrored scan, an ``up`` that lies nearly half-way between two turns."""
    match, name = group.match, group.kind.plural
    if match.contradiction == "mirrored":
        yield make_finding("mirrored", [name], group=name)
    elif match.contradiction == "turn_contradicted":
        yield _contradicted(group)
    elif match.open_turn is not None and match.open_turn > FAR_FROM_DECLARED and match.declared is not None:
        off = abs(wrap((match.placements[0].up or 0.0) - match.declared))
        yield make_finding("turn_doubtful", [name], group=name, off_deg=math.degrees(off))


def _contradicted(group: SeenGroup) -> Finding:
    match, name = group.match, group.kind.plural
    fitting, *as_declared = match.contradicting
    values = {
        "group": name,
        "declared_deg": _direction_deg(match.declared),
        "fitting_deg": _direction_deg(fitting.up),
        "fitting_mm": fitting.rms_mm,
    }
    if as_declared:
        return make_finding("turn_contradicted.worse", [name], **values, declared_mm=as_declared[0].rms_mm)
    return make_finding("turn_contradicted", [name], **values)


def _direction_deg(angle: float | None) -> float:
    """Degrees from +x, from 0 up, whole."""
    return float(round(math.degrees(angle or 0.0)) % 360)


def exposed_length_findings(
    group: SeenGroup, design_exposed_mm: float | None, embedded_mm: float | None = None
) -> Iterator[Finding]:
    """One finding for each bar that is too short, or too long.

    Where neither the design nor the other bars say how far they stick out, it is at least the embedded length.
    """
    if group.kind is not Kind.REBAR:
        return
    seen = [
        (target, float(point.exposed_length_mm))
        for target, point in group.placed()
        if point.exposed_length_mm is not None
    ]
    at_least = design_exposed_mm is None and len(seen) < _FEWEST_KNOWN
    design_exposed_mm = embedded_mm if at_least else design_exposed_mm
    if not seen or (at_least and embedded_mm is None):
        return
    # A bar that is designed to end higher sticks out further.
    heights = np.array([float(target.centre[2]) for target, _ in seen])
    over = np.array([length for _, length in seen]) - (heights - median(heights))
    usual_mm = float(median(over)) if design_exposed_mm is None else design_exposed_mm
    spread_mm = TO_SIGMA * float(median(np.abs(over - usual_mm))) if design_exposed_mm is None else 0.0
    threshold_mm = PLAY_MM + _LENGTH_SIGMAS * float(np.hypot(U_MM, spread_mm))
    of = "as the others do" if design_exposed_mm is None else "by design"
    for (target, length), deviation in zip(seen, over - usual_mm, strict=True):
        if abs(deviation) > threshold_mm and not (at_least and deviation > 0.0):
            name = "short" if deviation < 0.0 else "long"
            yield make_finding(
                f"exposed_length_differs.{name}",
                [target.label],
                measured_mm=length,
                expected_mm=length - float(deviation),
                of=of,
            )


@dataclass(frozen=True, eq=False)
class _Shear:
    """How far everything moves sideways per depth, (2,) in the axes of the image, and its covariance (2, 2)."""

    value: Array
    covariance: Array
    points: int

    @property
    def length(self) -> float:
        """Radians, for small ones."""
        return float(np.hypot(*self.value))

    @property
    def sigmas(self) -> float:
        """How far from none it is, in standard deviations."""
        return math.sqrt(float(self.value @ np.linalg.solve(self.covariance, self.value)))

    @property
    def degrees(self) -> float:
        return math.degrees(math.atan(self.length))

    @property
    def counts(self) -> bool:
        return self.points >= _FEWEST_KNOWN and self.degrees > LEAST_DEG and self.sigmas > _LEAN_SIGMAS


def lean_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """One finding for a lean that both groups share, towards one side of the image; else one for each that leans."""
    found = {group.kind: (group, shear) for group in groups if (shear := _shear(group)) is not None}
    if len(found) == 2:
        sleeves, bars = (found[kind][1] for kind in Kind)
        if _are_one(sleeves, bars):
            values = {"sleeves_deg": sleeves.degrees, "rebars_deg": bars.degrees}
            yield make_finding("common_lean.camera", ["sleeves", "rebars"], **values)
            return
    for group, shear in (one for one in found.values() if one[1].counts):
        name = group.kind.plural
        yield make_finding(f"common_lean.{group.kind.value}", [name], lean_deg=shear.degrees)


def _are_one(one: _Shear, other: _Shear) -> bool:
    """Whether two scans are sheared alike, and by more than chance: few points of each tell it together."""
    apart = _Shear(one.value - other.value, one.covariance + other.covariance, 0)
    if apart.length > _ALIKE * max(one.length, other.length) and apart.sigmas > _LEAN_SIGMAS_APART:
        return False
    if one.counts and other.counts:
        return True
    both = _weighted([one.value, other.value], [one.covariance, other.covariance])
    each = min(one.sigmas, other.sigmas)
    return both.degrees > LEAST_DEG and both.sigmas > _LEAN_SIGMAS_OF_BOTH and each > _LEAN_SIGMAS_OF_EACH


def _weighted(values: Sequence[Array] | Array, covariances: Sequence[Array] | Array) -> _Shear:
    information = np.linalg.inv(np.array(covariances))
    covariance = np.linalg.inv(information.sum(axis=0))
    value = covariance @ np.einsum("kij,kj->i", information, np.array(values))
    return _Shear(value, covariance, len(information))


def _shear(group: SeenGroup) -> _Shear | None:
    """The lean that a group shares against the vertical of its scan; None where that comes from leans itself."""
    extraction = group.extraction
    vertical = extraction.vertical
    known = [point for point in extraction.points if point.axis_covariance is not None and point.seen_length_mm]
    if (
        len(known) < _FEWEST_OF_BOTH
        or vertical is None
        or extraction.vertical_from == "bar axes"
        or abs(vertical[2]) < 0.5
    ):
        return None
    axes = np.array([point.axis * np.sign(point.axis @ vertical) for point in known])
    leans = (axes / (axes @ vertical)[:, None] - vertical)[:, :2]
    own = np.array([point.axis_covariance for point in known])[:, :2, :2]
    shared = (math.radians(_SHARED_DEG[group.kind]) / 2.0) ** 2 * np.eye(2)
    if group.kind is Kind.SLEEVE and extraction.method == "refined":
        found = _of_bores(leans, own)
        return _Shear(found.value / vertical[2], found.covariance + shared, len(known))
    middle = median(leans, axis=0)
    scatter = TO_SIGMA * float(median(np.abs(leans - middle)))
    u = OF_MEDIAN * math.hypot(scatter, math.sqrt(float(median(np.trace(own, axis1=1, axis2=2) / 2.0))))
    return _Shear(middle / vertical[2], u**2 / len(known) * np.eye(2) + shared, len(known))


def _of_bores(leans: Array, covariances: Array) -> _Shear:
    """What leans (k, 2) of bores share, without what each was drawn to an upright one for want of points.

    Sleeves lean by little; that was taken in where each was measured. All of them lean where the camera is wrong.
    """
    own = np.linalg.inv(covariances - BORE_LEAN_U**2 * np.eye(2))
    seen = own - np.eye(2) / Priors().lean ** 2
    values, vectors = np.linalg.eigh(seen)
    seen = np.einsum("kij,kj,klj->kil", vectors, np.maximum(values, _LEAST_INFORMATION), vectors)
    alone = np.linalg.inv(seen)
    lean = np.einsum("kij,kjl,kl->ki", alone, own, leans)
    apart = alone + (USUAL_LEAN**2 + BORE_LEAN_U**2) * np.eye(2)
    middle = _weighted(lean, apart)
    off = lean - middle.value
    # What scatters by more than it should is less sure, by as much.
    misfit = float(np.einsum("ki,kij,kj->", off, np.linalg.inv(apart), off)) / (2.0 * len(lean) - 2.0)
    return _Shear(middle.value, middle.covariance * max(1.0, misfit), len(lean))


def profile_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A camera whose edges are not those of the profile that the job names; a profile that other laws have learned."""
    for group in groups:
        name, quality = group.kind.plural, group.extraction.quality
        limits = {"learned_rings_off": (-OFF_RINGS, OFF_RINGS), "learned_edges_off_pixels": _OFF_PIXELS}
        for figure, (low, high) in limits.items():
            off = quality.get(figure)
            if isinstance(off, float) and not low < off < high:
                yield make_finding("profile_differs", [name], group=name, off_pixels=off)
                break
        if "learned_by_laws" in quality:
            told = make_finding(
                "profile_of_other_laws", [name], group=name, laws=quality["learned_by_laws"], now=EDGE_LAWS
            )
            yield replace(told, holds_back=False)


def bend_findings(groups: Sequence[SeenGroup]) -> Iterator[Finding]:
    """A camera whose bend goes with it from view to view, and is more than the stated uncertainty leaves open."""
    for group in groups:
        quality = group.extraction.quality
        if "camera_bend_stated_u_mm" in quality:
            yield make_finding(
                "camera_bends",
                [group.kind.plural],
                group=group.kind.plural,
                bend_mm=quality["camera_bend_mm"],
                u_mm=quality["camera_bend_u_mm"],
                stated_u_mm=quality["camera_bend_stated_u_mm"],
            )
