"""Diameters that contradict the design: another size of bar, caps, burrs, grout, or a wrong scale.

What is measured of a bar is its core, and cores differ from the nominal diameter by what the standards allow and by
what their makers do; of a sleeve the bore at its mouth. Beyond that play and the expanded uncertainty (k = 2) the
measured diameter contradicts the design, and the room in the sleeves is not what the trial takes it for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from aadm_workbench.assembly.findings.finding import SeenGroup, make_finding
from aadm_workbench.assembly.pairs import PlacedPoint, flat_covariance
from aadm_workbench.design.recognise.pattern import OVER_RIBS_MM
from aadm_workbench.extract.method import distinct_sizes
from aadm_workbench.extract.own_tops import OwnDiameters, own_diameters
from aadm_workbench.model import Array, AssemblyPoint, Finding, Kind, Measure, Scan
from aadm_workbench.model.special import median

CORE_BELOW = 0.06
"""Cores are thinner than nominal by up to this part: 19.3 mm ± 0.5 mm of 20 mm (GB/T 1499.2-2018, Table 3, d1)."""

CORE_ABOVE = 0.03
"""Cores of nominal diameter, as in EN 10080, and the ± 0.5 mm of d1 on 20 mm; a core any thicker is the next size."""

SLEEVE_PLAY_MM = ((30.0, 0.2), (120.0, 0.3), (400.0, 0.5))
"""A machined bore up to so many mm, and its general tolerance: ISO 2768-1:1989, class m (recalled, not verified)."""

EDGE_U_PITCHES = 0.25
"""Standard uncertainty, in pixel pitches, that all edges of a scan share: where a camera sees an edge to be."""

COVERAGE = 2.0
"""The factor of an expanded uncertainty, 95 % (GUM)."""

_EVENLY = math.sqrt(3.0)  # half of a range over its standard deviation, of the rectangular law (GUM 4.3.7)
_SAME_SIZE = 0.04  # relative: design diameters this near to each other are one size


def diameter_findings(group: SeenGroup) -> Iterator[Finding]:
    """A finding for each designed size whose bars or sleeves measure something else, all of them or some."""
    if (
        group.match.orientation == "ambiguous"
        and len(distinct_sizes(target.diameter_mm for target in group.design)) > 1
    ):
        return  # it is open which size was meant where
    measured = [(target, point) for target, point in group.placed() if _is_known(point)]
    shared_u_mm = _shared_u_mm(group)
    for of_size in _by_size(measured):
        design_mm = float(median([target.diameter_mm for target, _ in of_size]))
        low_mm, high_mm = allowed_mm(group.kind, design_mm)
        off = [
            (target, point)
            for target, point in of_size
            if _beyond(point.point.diameter_mm, low_mm, high_mm, COVERAGE * _u_mm(point, shared_u_mm))
        ]
        if off:
            about = [group.kind.plural] if len(off) == len(measured) else [target.label for target, _ in off]
            yield _said(group.kind, about, [point for _, point in off], design_mm, shared_u_mm)


def bore_against_design(group: SeenGroup) -> Measure | None:
    """Measured over designed diameter of all sleeves together; None where that is not known.

    Its standard uncertainty is that of the edges of the scan, and the play of bores, spread evenly.
    """
    measured = [(target, point) for target, point in group.placed() if _is_known(point)]
    if not measured:
        return None
    design_mm = np.array([target.diameter_mm for target, _ in measured])
    if distinct_sizes(design_mm.tolist())[1:] and group.match.orientation == "ambiguous":
        return None  # it is open which size was meant where
    ratio = np.array([point.point.diameter_mm for _, point in measured]) / design_mm
    own_mm = float(median([_u_mm(point, 0.0) for _, point in measured])) / math.sqrt(len(measured))
    middle_mm = float(median(design_mm))
    u_mm = math.hypot(_shared_u_mm(group), own_mm, sleeve_play_mm(middle_mm) / _EVENLY)
    return Measure(float(median(ratio)), u_mm / middle_mm)


def _shared_u_mm(group: SeenGroup) -> float:
    """Standard uncertainty, mm, that all diameters of a scan share."""
    pitch_mm, diameter_u_mm = (
        float(value) if isinstance(value := group.extraction.quality.get(name), int | float) else 0.0
        for name in ("point_pitch_mm", "diameter_u_mm")
    )
    return max(EDGE_U_PITCHES * pitch_mm, diameter_u_mm)


def allowed_mm(kind: Kind, design_mm: float) -> tuple[float, float]:
    """Least and largest diameter that a sound bar or sleeve of a designed size measures, mm."""
    if kind is Kind.REBAR:
        return design_mm * (1.0 - CORE_BELOW), design_mm * (1.0 + CORE_ABOVE)
    play_mm = sleeve_play_mm(design_mm)
    return design_mm - play_mm, design_mm + play_mm


def sleeve_play_mm(design_mm: float) -> float:
    """How far the bore of a sound sleeve may be off its designed diameter, mm."""
    return next((play for up_to, play in SLEEVE_PLAY_MM if design_mm <= up_to), SLEEVE_PLAY_MM[-1][1])


def sizes_in_words(cores_mm: Sequence[float]) -> str:
    """The nominal sizes that bars with these cores may be: ``22 mm``, ``18/20 mm``, or ``none``."""
    sizes = [
        size
        for size in OVER_RIBS_MM
        if any(size * (1.0 - CORE_BELOW) <= core <= size * (1.0 + CORE_ABOVE) for core in cores_mm)
    ]
    return f"{'/'.join(f'{size:g}' for size in sizes)} mm" if sizes else "none"


def _by_size(
    measured: Sequence[tuple[AssemblyPoint, PlacedPoint]],
) -> Iterator[list[tuple[AssemblyPoint, PlacedPoint]]]:
    left = list(measured)
    while left:
        size_mm = min(target.diameter_mm for target, _ in left)
        yield [one for one in left if one[0].diameter_mm <= size_mm * (1.0 + _SAME_SIZE)]
        left = [one for one in left if one[0].diameter_mm > size_mm * (1.0 + _SAME_SIZE)]


def _is_known(point: PlacedPoint) -> bool:
    """Whether a diameter has an uncertainty: a method that states none for its points contradicts nothing."""
    return bool(np.isfinite(point.point.diameter_mm)) and flat_covariance(point.point) is not None


def _u_mm(point: PlacedPoint, shared_u_mm: float) -> float:
    """Standard uncertainty of a diameter: of a circle twice that of its radius, which is known as its centre is."""
    covariance = flat_covariance(point.point)
    own_mm = 0.0 if covariance is None else 2.0 * float(np.sqrt(max(np.linalg.eigvalsh(covariance)[-1], 0.0)))
    return float(np.hypot(own_mm, shared_u_mm))


def _beyond(value: float, low: float, high: float, expanded: float) -> bool:
    return value < low - expanded or value > high + expanded


def _said(
    kind: Kind, about: Sequence[str], off: Sequence[PlacedPoint], design_mm: float, shared_u_mm: float
) -> Finding:
    measured_mm = float(median([point.point.diameter_mm for point in off]))
    expanded_mm = COVERAGE * float(median([_u_mm(point, shared_u_mm) for point in off]))
    values: dict[str, object] = {"measured_mm": measured_mm, "U_mm": expanded_mm, "design_mm": design_mm}
    if kind is Kind.SLEEVE:
        return make_finding("diameter_differs.sleeve", about, **values, play_mm=sleeve_play_mm(design_mm))
    least_mm, most_mm = allowed_mm(kind, design_mm)
    seems = sizes_in_words([measured_mm])
    return make_finding("diameter_differs.rebar", about, **values, least_mm=least_mm, most_mm=most_mm, seems=seems)


def odd_bar_findings(
    group: SeenGroup, scan: Scan, known: Sequence[Finding], rng: np.random.Generator
) -> Iterator[Finding]:
    """A finding for each bar whose own outline contradicts the design beyond its uncertainty.

    Parameters
    ----------
    scan
        The first scan of the group.
    known
        What was found already: what is said of a bar, or of all, is not said again.
    """
    about = {label for finding in known if finding.code == "diameter_differs" for label in finding.about}
    one_size = len(distinct_sizes(target.diameter_mm for target in group.design)) == 1
    if group.kind is not Kind.REBAR or not group.match or not one_size or group.kind.plural in about:
        return
    own = _own(group, scan, rng)
    design_mm = group.design[0].diameter_mm
    low_mm, high_mm = allowed_mm(group.kind, design_mm)
    shared = _shared_diameter(group, low_mm, high_mm)
    expanded_mm = COVERAGE * math.hypot(own.u_mm, shared.u)
    for target, measured_mm in zip(group.design, (own.diameters_mm + shared.value).tolist(), strict=True):
        if target.label in about or not (measured_mm < low_mm - expanded_mm or measured_mm > high_mm + expanded_mm):
            continue
        values = {"measured_mm": measured_mm, "U_mm": expanded_mm, "design_mm": design_mm}
        fits = {"least_mm": low_mm, "most_mm": high_mm, "seems": sizes_in_words([measured_mm])}
        yield make_finding("diameter_differs.rebar", [target.label], **values, **fits)


def _shared_diameter(group: SeenGroup, low_mm: float, high_mm: float) -> Measure:
    """What is to be added to the diameter that all bars share, mm, and how sure it is then.

    Nothing contradicts the design in it, or that was told: where the edges leave it open, it is one of sound bars.
    """
    measured_mm = float(median([point.point.diameter_mm for _, point in group.placed()]))
    u_mm = min(_shared_u_mm(group), (high_mm - low_mm) / 2.0 / _EVENLY)
    return Measure(min(max(measured_mm, low_mm), high_mm) - measured_mm, u_mm)


def _own(group: SeenGroup, scan: Scan, rng: np.random.Generator) -> OwnDiameters:
    """Own diameters, in the order of the design."""
    places, shared_mm = _places(group)
    plane = group.extraction.plane
    if plane is None:
        return OwnDiameters(np.full(len(places), np.nan), 0.0)
    return own_diameters(scan, plane, places, shared_mm, group.design[0].diameter_mm, rng)


def _places(group: SeenGroup) -> tuple[Array, Array]:
    """Where each bar stands or should stand, (n, 3) mm, scan frame, and the diameters (n,) measured there."""
    placement = group.match.placements[0]
    T_scan_design = np.linalg.inv(placement.T_design_scan)
    places = np.array([T_scan_design[:3, :3] @ target.centre + T_scan_design[:3, 3] for target in group.design])
    shared_mm = np.full(len(places), np.nan)
    for k, index in enumerate(placement.matched.tolist()):
        if index >= 0:
            point = group.extraction.points[index]
            places[k], shared_mm[k] = point.centre, point.diameter_mm
    return places, shared_mm
