"""Circles: the outline of a hole or a disc in angular bins, and a robust first fit to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, IntArray

_SETTLED_MM = 5e-3
AGREES_MM = 0.8
_AGREEING_SHARE, _SOUND_SHARE, _FEWEST = 0.75, 0.3, 12
_MISFIT_MM = 0.5  # residual at which a point counts half in the first fit


@dataclass(frozen=True, eq=False)
class Outline:
    """The outermost (or innermost) point of each angular bin around a centre.

    ``index`` (m,) tells which of the points it is, ``bin`` (m,) which of the ``bins`` it stands for.
    """

    index: IntArray
    bin: IntArray
    bins: int

    @property
    def coverage(self) -> float:
        """Share of the circle's bins that hold a point."""
        return len(self.bin) / self.bins


def bins_of(xy: Array, bins: int) -> IntArray:
    """Angular bin (n,) of points (n, 2) about the origin."""
    turn = np.arctan2(xy[:, 1], xy[:, 0]) / (2 * np.pi) + 0.5
    return np.minimum((turn * bins).astype(np.int64), bins - 1)


def outline(xy: Array, centre: Array, bins: int, *, innermost: bool) -> Outline:
    """Take from points (n, 2) mm the one nearest to the centre in each bin, or the farthest one."""
    about = xy - centre
    radius = np.hypot(about[:, 0], about[:, 1])
    place = bins_of(about, bins)
    order = np.lexsort((radius if innermost else -radius, place))
    first = np.ones(len(order), bool)
    first[1:] = place[order[1:]] != place[order[:-1]]
    chosen = order[first]
    return Outline(chosen, place[chosen], bins)


def circle_through(xy: Array, centre: Array, radius_mm: float) -> tuple[Array, float]:
    """Robust circle of free radius through points (n, 2) mm: centre (2,) and radius.

    Gauss-Newton on the distances with Cauchy weights, so that a chip, a rib or a tape on a small part of
    the outline hardly pulls it.
    """
    if len(xy) < 5:
        return centre, radius_mm
    for _ in range(8):
        about = xy - centre
        distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
        residual = distance - radius_mm
        weight = 1.0 / (1.0 + ((residual - np.median(residual)) / _MISFIT_MM) ** 2)
        jacobian = np.column_stack([about / distance[:, None], np.ones(len(xy))])
        weighted = jacobian * weight[:, None]
        normal = weighted.T @ jacobian + 1e-9 * len(xy) * np.eye(3)
        step = np.linalg.solve(normal, weighted.T @ residual)
        step[:2] = np.clip(step[:2], -radius_mm, radius_mm)
        centre, radius_mm = centre + step[:2], radius_mm + float(step[2])
        if np.abs(step).max() < _SETTLED_MM:
            break
    return centre, radius_mm


def settled_centre(
    points: Array, centre: Array, radius_mm: float, bins: int, zone_mm: tuple[float, float], *, innermost: bool
) -> Array:
    """First centre (2,) of an outline among points (n, 2) mm, near a guess.

    ``zone_mm``: the outline is sought between these distances from the centre. Where less than three quarters of
    it agree with the radius, something spoils a part of it, and the centre is that of the part that agrees.
    """
    ring_xy = points[:0]
    for _ in range(3):
        within = np.hypot(*(points - centre).T)
        candidates = points[(within > zone_mm[0]) & (within < zone_mm[1])]
        if len(candidates) < _FEWEST:
            return centre
        ring_xy = candidates[outline(candidates, centre, bins, innermost=innermost).index]
        moved, _ = circle_through(ring_xy, centre, radius_mm)
        if np.hypot(*(moved - centre)) > radius_mm:
            break
        centre = moved
    if agreeing_share(ring_xy, centre, radius_mm) > _AGREEING_SHARE:
        return centre
    for _ in range(2):
        moved, share = circle_of_radius(ring_xy, radius_mm, AGREES_MM)
        if share < _SOUND_SHARE or np.hypot(*(moved - centre)) > radius_mm:
            return centre
        centre = moved
        ring_xy = candidates[outline(candidates, centre, bins, innermost=innermost).index]
    return centre


def agreeing_share(outline_xy: Array, centre: Array, radius_mm: float, within_mm: float = AGREES_MM) -> float:
    """Share of outline points (n, 2) mm that lie on a circle, or that near to it."""
    off_mm = np.hypot(*(outline_xy - centre).T) - radius_mm
    return float((np.abs(off_mm) < within_mm).mean()) if len(off_mm) else 0.0


def circle_of_radius(xy: Array, radius_mm: float, within_mm: float) -> tuple[Array, float]:
    """Circle of a known radius that most points (n, 2) of an outline lie on: centre (2,) and their share.

    Each pair of points gives two circles; where a tape or a break spoils half of an outline, the other half agrees.
    """
    thin = xy[:: len(xy) // 90 + 1]
    count = len(thin)
    first = np.tile(np.arange(count), 3)
    second = np.concatenate([np.roll(np.arange(count), -max(1, count // part)) for part in (8, 6, 4)])
    chord = thin[second] - thin[first]
    length = np.hypot(chord[:, 0], chord[:, 1])
    usable = (length > 1e-6) & (length < 2 * radius_mm)
    if not usable.any():
        return xy.mean(axis=0), 0.0
    middle, chord, length = (thin[first] + 0.5 * chord)[usable], chord[usable], length[usable]
    height = np.sqrt(radius_mm**2 - (0.5 * length) ** 2)
    across = np.column_stack([-chord[:, 1], chord[:, 0]]) / length[:, None] * height[:, None]
    centres = np.vstack([middle + across, middle - across])
    distance = np.hypot(*(thin[None, :, :] - centres[:, None, :]).transpose(2, 0, 1))
    agree = (np.abs(distance - radius_mm) < within_mm).sum(axis=1)
    best = centres[int(agree.argmax())]
    return best, float(agree.max() / count)
