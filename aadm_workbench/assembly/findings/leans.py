"""A lean that all sleeves, or all bars, share: theirs, or that of a principal point that is not the camera's.

A principal point that is off by p pixels shears all that is measured: whatever is farther away moves sideways by
p/f of its depth. Sleeves and bars then lean by that angle, towards the same side of the image, and places within a
plane across the view stay as they are.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.findings.group import SeenGroup
from aadm_workbench.assembly.findings.make import make_finding
from aadm_workbench.model import Array, Finding, Kind

LEAST_DEG = 0.8
"""Floors, and feet, are square to their columns to half of that; a single bar or sleeve leans by 0.3° by right."""

# of fewer a median is no sign of what all share; where sleeves and bars say the same, three of each are one of six
_FEWEST, _FEWEST_OF_BOTH = 4, 3
_SIGMAS = 6.0  # beyond what noise, tried twelve times, ever does
_SIGMAS_OF_BOTH, _SIGMAS_OF_EACH, _SIGMAS_APART = (
    5.0,
    1.5,
    3.0,
)  # two scans that err alike by chance are rarer than one that errs
_SHARED_DEG = {Kind.SLEEVE: 0.15, Kind.REBAR: 0.3}  # what all leans of one scan may be off together
_ALIKE = 0.35  # of the larger: so much two scans of one camera may differ in


@dataclass(frozen=True, eq=False)
class _Shear:
    """How far everything moves sideways per depth, (2,) in the axes of the image, and its standard uncertainty."""

    value: Array
    u: float
    points: int

    @property
    def length(self) -> float:
        """Radians, for small ones."""
        return float(np.hypot(*self.value))

    @property
    def degrees(self) -> float:
        return math.degrees(math.atan(self.length))

    @property
    def counts(self) -> bool:
        return self.points >= _FEWEST and self.degrees > LEAST_DEG and self.length > _SIGMAS * self.u


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
    apart, u_apart = float(np.hypot(*(one.value - other.value))), math.hypot(one.u, other.u)
    if apart > max(_ALIKE * max(one.length, other.length), _SIGMAS_APART * u_apart):
        return False
    if one.counts and other.counts:
        return True
    weight = np.array([one.u, other.u]) ** -2
    both = _Shear(weight @ [one.value, other.value] / weight.sum(), float(weight.sum() ** -0.5), 0)
    each = min(one.length / one.u, other.length / other.u)
    return both.degrees > LEAST_DEG and both.length > _SIGMAS_OF_BOTH * both.u and each > _SIGMAS_OF_EACH


def _shear(group: SeenGroup) -> _Shear | None:
    """The median lean of a group against the vertical of its scan; None where that comes from the leans themselves."""
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
    own = np.array([np.trace(point.axis_covariance) / 2.0 for point in known])  # type: ignore[arg-type]
    middle = np.median(leans, axis=0)
    scatter = 1.4826 * float(np.median(np.abs(leans - middle)))
    u = 1.2533 * math.hypot(scatter, math.sqrt(float(np.median(own)))) / math.sqrt(len(known))
    return _Shear(middle / vertical[2], math.hypot(u, math.radians(_SHARED_DEG[group.kind]) / 2.0), len(known))
