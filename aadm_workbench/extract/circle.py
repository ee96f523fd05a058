"""Circles: the outline of a hole or a disc in angular bins, and a robust first fit to it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array, IntArray

_SETTLED_MM = 5e-3
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
