"""Lengths that are wrong by a factor: a focal length that is not the camera's, a depth scale, a unit.

A wrong focal length stretches a scan across the view and leaves its depths; a wrong unit or depth scale stretches all.
Nothing has the designed size then, and nothing is found. So the scan is looked at as if it was made with likelier ones:
where the pattern is there then, sizes and all, that is what was wrong.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.assembly.findings.named_scan import NamedScan, fits
from aadm_workbench.model import Finding

UNIT_FACTORS = (10.0, 0.1, 100.0, 0.01, 25.4, 1.0 / 25.4)
"""By which lengths of scans have been too large: slips of a decimal, inches. A thousand is refused when it is read."""

FOCAL_FACTORS = (0.5, 2.0, 1.11, 0.9, 1.25, 0.8, 1.43, 0.7)
"""Of what the job says to what the camera has: a picture of half the resolution, and steps of a hole's play."""

_USUAL_DISTANCE_MM = (250.0, 4000.0)  # of cameras that see a sleeve by the tenth of a millimetre


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
