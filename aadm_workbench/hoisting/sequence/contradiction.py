"""Two frames of one hanging column that cannot both be right: the ``near`` of one of them names a wrong corner.

A ring of sleeves looks alike from all four corners, so a single frame cannot show it. Two can: each pair stands off its
place in the ring by an amount of its own, which does not change as the column moves, and so do its sleeve and its bar
by themselves; and while the column hangs still, a frame that is labelled a quarter too far asks for the same push,
turned by a quarter.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import stats

from aadm_workbench.assembly.findings.finding import make_finding
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.hoisting.sequence.joint import shapes_agree
from aadm_workbench.model import Array, ColumnDesign, Finding, HoistingMeasurement

_QUARTERS_DEG = (90, -90, 180)  # turns of a square column
_FEWEST_PAIRS = 4  # three lie anyhow by chance
_UNLIKELY = 1e-5  # of the pairs' own amounts to differ so, where both frames name them rightly
_APART_MM = 1.5  # of two pushes: nearer to each other nobody is misled
_ALIKE_MM, _ALIKE_SHARE = 0.6, 0.1  # of turned pushes: frames of two corners weigh different pairs
_WARP_MM = 0.08  # what a camera's warp does to a pair differently in two places of the picture


def contradiction_of(
    first: HoistingMeasurement, second: HoistingMeasurement, design: ColumnDesign, *, swings: bool = False
) -> Finding | None:
    """What two frames of one column say against each other; None where both can be right.

    Of a column that ``swings`` only the pairs' own amounts count: half a swing later the push is the opposite one.
    """
    alike = _own_amounts_agree(first, second, design) if shapes_agree(first, second) is not False else False
    turned_deg = None if alike or swings else _turned(first, second)
    values = {
        "source": first.report.source,
        "near": first.report.near or "?",
        "other": second.report.source,
        "other_near": second.report.near or "?",
    }
    if turned_deg is not None:
        return make_finding("hoisting_frames_contradict", ["column"], **values, turn_deg=abs(turned_deg))
    return make_finding("hoisting_frames_contradict.pairs", ["column"], **values) if alike is False else None


def _own_amounts_agree(first: HoistingMeasurement, second: HoistingMeasurement, design: ColumnDesign) -> bool | None:
    """Whether the pairs that both frames see stand off their places alike; None where that cannot be told."""
    common = [
        k
        for k, pairs in enumerate(zip(first.report.pairs, second.report.pairs, strict=False))
        if all(pair.seen for pair in pairs)
    ]
    if len(common) < _FEWEST_PAIRS:
        return None
    places = np.array([design.rebars[k].centre[:2] for k in common])
    variance = _variances(first, common) + _variances(second, common) + _WARP_MM**2
    freedom = 2 * len(common) - 3
    apart = _misfit(places, (first.offsets_mm - second.offsets_mm)[common], variance)
    if stats.chi2.sf(apart, freedom) < _UNLIKELY:
        return False
    own = _misfit(places, first.offsets_mm[common], variance)
    return True if stats.chi2.sf(own, freedom) < _UNLIKELY else None


def _variances(measurement: HoistingMeasurement, common: Sequence[int]) -> Array:
    return np.asarray(np.trace(measurement.covariances[common], axis1=1, axis2=2) / 2.0)


def _misfit(places: Array, offsets: Array, variance: Array) -> float:
    """χ² of offsets (k, 2) mm about the rigid move that they share."""
    weight = np.repeat(1.0 / np.sqrt(variance), 2)
    system = np.zeros((2 * len(places), 3))
    system[0::2, 0] = system[1::2, 1] = 1.0
    system[0::2, 2], system[1::2, 2] = -places[:, 1], places[:, 0]
    scaled = offsets.ravel() * weight
    found, *_ = np.linalg.lstsq(system * weight[:, None], scaled, rcond=None)
    return float(((scaled - (system * weight[:, None]) @ found) ** 2).sum())


def _turned(first: HoistingMeasurement, second: HoistingMeasurement) -> int | None:
    """By how much one frame's push is turned against the other's, degrees; None where it is not."""
    one, other = first.report.correction, second.report.correction
    if one is None or other is None:
        return None
    a, b = np.array([one.dx_mm, one.dy_mm]), np.array([other.dx_mm, other.dy_mm])
    spread_mm = 3.0 * float(np.hypot(one.u_mm or 0.0, other.u_mm or 0.0))
    if np.hypot(*(a - b)) < _APART_MM + spread_mm:
        return None
    near_mm = _ALIKE_MM + spread_mm + _ALIKE_SHARE * min(float(np.hypot(*a)), float(np.hypot(*b)))
    return next((deg for deg in _QUARTERS_DEG if np.hypot(*(turn(np.radians(deg)) @ a - b)) < near_mm), None)
