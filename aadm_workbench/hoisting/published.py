"""Alignment during hoisting by the methods of the literature: three key pairs, without uncertainty or correction."""

from __future__ import annotations

import numpy as np

from aadm_workbench.assembly.decision import decide_radial
from aadm_workbench.assembly.tolerances import rules_for
from aadm_workbench.design.recognise.rings import smallest_spacing
from aadm_workbench.extract.published.hoisting import METHODS, find_key_points
from aadm_workbench.hoisting.pairs import key_labels, unmeasured
from aadm_workbench.model import (
    ColumnDesign,
    HoistingMeasurement,
    HoistingPair,
    HoistingReport,
    Profile,
    Reason,
    Scan,
    Verdict,
    worst,
)


def measure_published(
    scan: Scan,
    design: ColumnDesign,
    method: str,
    *,
    near: tuple[int, int] | None,
    rng: np.random.Generator,
    profile: Profile | None = None,
) -> HoistingMeasurement:
    """Measure one frame by ``fusion``, ``pointcloud`` or ``image``: the distances of three key pairs (Eq. 11).

    Which pairs they are follows from the design and the corner that is next to the camera; other pairs have no
    distance, and nothing has an uncertainty: the methods give none.

    Raises
    ------
    MissingDependencyError
        Where Open3D is not installed.
    """
    if method not in METHODS:
        return unmeasured(scan, design, method, Reason("hoisting.no_such_method", method=method))
    sleeve_mm = float(np.median([point.diameter_mm for point in design.sleeves]))
    rebar_mm = float(np.median([point.diameter_mm for point in design.rebars]))
    places = np.array([point.centre[:2] for point in design.rebars])
    clear_mm = smallest_spacing(places) - rebar_mm
    found = find_key_points(scan, method, sleeve_mm, rebar_mm, clear_mm, rng)
    if found.reason:
        return unmeasured(scan, design, method, found.reason)
    rules = () if profile is None else rules_for(profile, "sleeve_rebar_distance")
    limit_mm = rules[0].upper if rules else None
    keys = key_labels(design, near or (-1, -1))
    distances = dict(zip(keys, found.distances_mm().tolist(), strict=True))
    pairs = []
    for sleeve, rebar in zip(design.sleeves, design.rebars, strict=True):
        distance = distances.get(sleeve.label)
        verdict = Verdict.NOT_ASSESSED
        if distance is not None and limit_mm is not None:
            verdict = decide_radial(np.array([distance, 0.0]), None, limit_mm, "simple").verdict
        reason = "" if distance is not None else Reason("hoisting.three_pairs")
        pairs.append(
            HoistingPair(
                sleeve.label,
                rebar.label,
                None,
                None,
                None,
                distance,
                None,
                distance is not None,
                reason,
                limit_mm=limit_mm,
                verdict=verdict,
            )
        )
    judged = [pair.verdict for pair in pairs if pair.verdict is not Verdict.NOT_ASSESSED]
    values = list(distances.values())
    report = HoistingReport(
        source=scan.source,
        keys=tuple(sorted(keys, key=[point.label for point in design.sleeves].index)),
        mean_mm=float(np.mean(values)),
        max_mm=float(np.max(values)),
        column_tilt_deg=None,
        verdict=worst(judged) if judged else Verdict.NOT_ASSESSED,
        pairs=tuple(pairs),
        sha256=scan.sha256,
        method=method,
    )
    count = len(pairs)
    return HoistingMeasurement(report, np.full((count, 2), np.nan), np.full((count, 2, 2), np.nan))
