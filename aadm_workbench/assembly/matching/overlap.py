"""How one view lies on another by points that are said to be the same, and how strongly the points say so.

No two sleeves are built alike: each stands a few tenths of a millimetre off its design place, and a view measures that
ten times better. So points that agree are likely the same, and points that do not are not. The evidence is a likelihood
ratio: that of the differences if both views measured the same points, over that if they measured different ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar, planar_transform, plane_basis
from aadm_workbench.model import Array, AssemblyPoint, Extraction

VIEW_U_MM = 0.1
"""Per axis: what two views of one point differ by beside their noise, for a camera's picture is warped by so much."""

_UNKNOWN_U_MM = 0.3  # of a method that states no covariance
_AGREES_SIGMAS = 3.3  # of the mean square: one in a thousand sound views lies beyond


@dataclass(frozen=True, eq=False)
class View:
    """The points of a view in the plane across its vertical: ``flat`` (n, 2), ``height`` (n,), ``u_mm`` (n,) per axis.

    ``T_plane_view`` (4, 4) brings points of the view's own frame there.
    """

    flat: Array
    height: Array
    u_mm: Array
    T_plane_view: Array

    @classmethod
    def of(cls, extraction: Extraction) -> View:
        """The view of one extraction; without a vertical, across z."""
        up = np.array([0.0, 0.0, 1.0]) if extraction.vertical is None else extraction.vertical
        T_plane_view = np.eye(4)
        T_plane_view[:3, :3] = plane_basis(up)
        local = np.array([point.centre for point in extraction.points]).reshape(-1, 3) @ T_plane_view[:3, :3].T
        u_mm = np.array([_u_mm(point, up) for point in extraction.points])
        return cls(local[:, :2], local[:, 2], u_mm, T_plane_view)


@dataclass(frozen=True, eq=False)
class Overlap:
    """A second view laid on a first one by the ``pairs`` of their points that are taken to be the same.

    Parameters
    ----------
    T_first_second
        (4, 4), from the frame of the second view to that of the first.
    evidence
        Logarithm of the likelihood ratio that they are the same points; 0 where it cannot be told.
    apart_mm, u_mm
        Largest difference in the plane, and the standard uncertainty per axis of a difference.
    agrees
        Whether the differences are what their uncertainty explains.
    """

    pairs: tuple[tuple[int, int], ...]
    T_first_second: Array
    evidence: float = 0.0
    apart_mm: float = 0.0
    u_mm: float = 0.0
    agrees: bool = True

    @property
    def shared(self) -> int:
        """How many points the views share."""
        return len(self.pairs)


def overlap_of(first: View, second: View, pairs: tuple[tuple[int, int], ...], scatter_mm: float) -> Overlap:
    """Lay the second view on the first by pairs of the indices of their points.

    ``scatter_mm`` is how far, per axis, points stand off their design places: where all stand exactly, all agree.
    """
    here, there = [pair[0] for pair in pairs], [pair[1] for pair in pairs]
    variance = first.u_mm[here] ** 2 + second.u_mm[there] ** 2 + 2.0 * VIEW_U_MM**2
    if len(pairs) < 2:
        return Overlap(pairs, np.eye(4))
    fit = fit_eopa_planar(second.flat[there], first.flat[here], 1.0 / variance)
    if isinstance(fit, NoFit):
        return Overlap(pairs, np.eye(4))
    joined = planar_transform(fit.yaw, fit.t)
    joined[2, 3] = float(np.mean(first.height[here] - second.height[there]))
    T = np.linalg.inv(first.T_plane_view) @ joined @ second.T_plane_view
    freedom = 2 * len(pairs) - 3  # what a shift and a turn leave of two coordinates a point
    squared = float(((fit.residuals**2).sum(axis=1) / variance).sum())
    wide = variance + 2.0 * scatter_mm**2
    as_others = float(((fit.residuals**2).sum(axis=1) / wide).sum())
    evidence = 0.5 * (as_others - squared + freedom * float(np.log(wide / variance).mean()))
    return Overlap(
        pairs,
        T,
        evidence,
        float(np.hypot(*fit.residuals.T).max()),
        math.sqrt(float(variance.mean())),
        squared < freedom + _AGREES_SIGMAS * math.sqrt(2.0 * freedom) + _AGREES_SIGMAS**2,
    )


def _u_mm(point: AssemblyPoint, up: Array) -> float:
    """Standard uncertainty of a centre per axis across the vertical."""
    covariance = point.covariance
    if covariance is None or not np.isfinite(covariance).all():
        return _UNKNOWN_U_MM
    return math.sqrt(max(float(np.trace(covariance) - up @ covariance @ up) / 2.0, 0.0))
