"""Single bars of another size than designed, which the diameter that all bars share does not show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from aadm_workbench.assembly.findings.diameters import COVERAGE, allowed_mm, sizes_in_words
from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.extract.own_diameters import OwnDiameters, own_diameters
from aadm_workbench.extract.sizes import distinct_sizes
from aadm_workbench.model import Array, Finding, Kind, Scan


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
    expanded_mm = COVERAGE * own.u_mm
    for target, measured_mm in zip(group.design, own.diameters_mm.tolist(), strict=True):
        if target.label in about or not (measured_mm < low_mm - expanded_mm or measured_mm > high_mm + expanded_mm):
            continue
        values = {"measured_mm": measured_mm, "U_mm": expanded_mm, "design_mm": design_mm}
        fits = {"least_mm": low_mm, "most_mm": high_mm, "seems": sizes_in_words([measured_mm])}
        yield make_finding("diameter_differs.rebar", [target.label], **values, **fits)


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
