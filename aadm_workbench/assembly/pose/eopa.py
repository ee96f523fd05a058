"""Extended orthogonal Procrustes analysis: the rigid pose that lays one set of points on another, in least squares.

The model is Y = XR + jtᵀ + E with rows as points (Long et al., Eqs. 2 to 6). Two things are added to what is
printed there: the determinant is kept at +1 (the centres of a foot face are coplanar, so the third singular value
is zero and its vectors have arbitrary signs), and weights are allowed.

Poses that keep "up" up: the plane across a known vertical, and the 4×4 transforms that such poses are. Sleeves are seen
from below and bars from above. With the vertical known there is no mirror and no flip left: what remains is a shift and
a turn in the plane across it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from aadm_workbench.errors import AadmError
from aadm_workbench.model import Array, Reason

COLLINEAR_RATIO = 1e-6
"""Points whose second extent is below this part of the first lie on a line, and leave a turn about it open."""

_ROUNDS = 60  # a cap: a choice, not tuned since
_SMALLEST_MM = 0.02
"""Distances below this count alike: no scan resolves less, and a weight may not grow without end."""


@dataclass(frozen=True)
class NoFit:
    """What an estimator returns that cannot fit: false, with the reason."""

    reason: str

    def __bool__(self) -> Literal[False]:
        return False


@dataclass(frozen=True, eq=False)
class EopaFit:
    """The rotation and translation of Y = XR + jtᵀ + E.

    Parameters
    ----------
    R
        (k, k) float64, acts on rows from the right; determinant +1.
    t
        (k,) float64, mm.
    residuals
        (n, k) float64, mm: E = Y − XR − jtᵀ, target minus aligned source.
    rms_mm
        Root of the weighted mean of the squared lengths of the residuals.
    scale
        The factor that a fit with free scale would give X. Diagnostic: it is never applied.
    """

    R: Array
    t: Array
    residuals: Array
    rms_mm: float
    scale: float

    @property
    def T(self) -> Array:
        """T_target_source (4, 4) for column vectors, so it holds Rᵀ; a planar fit leaves z alone."""
        size = len(self.t)
        transform = np.eye(4)
        transform[:size, :size] = self.R.T
        transform[:size, 3] = self.t
        return transform

    @property
    def yaw(self) -> float:
        """Turn in the x-y plane, radians, counter-clockwise seen from +z."""
        return float(np.arctan2(self.R[0, 1], self.R[0, 0]))


def fit_eopa(X: Array, Y: Array, weights: Array | None = None) -> EopaFit | NoFit:
    """Rigid pose in space that maps points X onto points Y with the smallest (weighted) sum of squares.

    Parameters
    ----------
    X, Y
        (n, 3) float64, mm, in the source and in the target frame; row i of one belongs to row i of the other.
    weights
        (n,) float64, none negative; all equal by default.

    Returns
    -------
    EopaFit, or NoFit for fewer than three points or points on one line.

    Raises
    ------
    AadmError
        If the shapes do not belong together.

    Notes
    -----
    V D Wᵀ = Xᵀ(I − jjᵀ/p)Y;  R = V·diag(1, 1, det(VWᵀ))·Wᵀ;  t = (Y − XR)ᵀj/p.
    """
    _check_shapes(X, Y, 3)
    if len(X) < 3:
        return NoFit(Reason("assembly.fit_few_space", count=len(X)))
    return _fit(X, Y, weights, rank=2)


def fit_eopa_planar(X: Array, Y: Array, weights: Array | None = None) -> EopaFit | NoFit:
    """Shift and turn in the plane (dx, dy, yaw) that map points X onto points Y with the smallest sum of squares.

    As :func:`fit_eopa`, for X and Y (n, 2) in mm whose frames share the z axis.

    Returns
    -------
    EopaFit with R (2, 2) and t (2,), or NoFit for fewer than two distinct points.
    """
    _check_shapes(X, Y, 2)
    if len(X) < 2:
        return NoFit(Reason("assembly.fit_few_plane", count=len(X)))
    return _fit(X, Y, weights, rank=1)


def _check_shapes(X: Array, Y: Array, width: int) -> None:
    if X.shape != Y.shape or X.ndim != 2 or X.shape[1] != width:
        raise AadmError.because("assembly.eopa_shapes", width=width, first=str(X.shape), second=str(Y.shape))


def _fit(X: Array, Y: Array, weights: Array | None, rank: int) -> EopaFit | NoFit:
    prior = np.ones(len(X)) if weights is None else np.asarray(weights, dtype=np.float64)
    reason = _why_not(X, Y, prior, rank)
    if reason:
        return NoFit(reason)
    return _weighted(X, Y, prior)


def _why_not(X: Array, Y: Array, weights: Array, rank: int) -> str:
    if not (np.isfinite(X).all() and np.isfinite(Y).all()):
        return Reason("assembly.fit_not_finite")
    if weights.shape != (len(X),) or not np.isfinite(weights).all() or (weights < 0).any():
        return Reason("assembly.fit_weights", count=len(X))
    used = weights > 0
    for points, name in ((X[used], "source"), (Y[used], "target")):
        if len(points) <= rank:
            return Reason("assembly.fit_few_weights", count=len(points))
        extents = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
        if extents[rank - 1] <= COLLINEAR_RATIO * max(extents[0], 1e-9 * float(np.abs(points).max()) + 1e-12):
            return Reason(
                "assembly.fit_on_line" if rank == 2 and extents[0] > 0 else "assembly.fit_coincide", name=name
            )
    return ""


def _weighted(X: Array, Y: Array, weights: Array) -> EopaFit:
    share = weights / weights.sum()
    # Centred first: map coordinates of 10^9 mm would leave no digits for the deviations.
    centre_x, centre_y = share @ X, share @ Y
    centred_x, centred_y = X - centre_x, Y - centre_y
    U = (centred_x * share[:, None]).T @ centred_y
    V, _, Wt = np.linalg.svd(U)
    signs = np.ones(X.shape[1])
    signs[-1] = np.sign(np.linalg.det(V @ Wt))
    R = (V * signs) @ Wt
    residuals = centred_y - centred_x @ R
    scale = float(np.trace(R.T @ U) / (share @ (centred_x**2).sum(axis=1)))
    rms_mm = float(np.sqrt(share @ (residuals**2).sum(axis=1)))
    return EopaFit(R, centre_y - centre_x @ R, residuals, rms_mm, scale)


def robust_offsets(measured: Array, design: Array) -> Array:
    """Offsets (n, 2) mm, measured minus design, after the planar fit with the least sum of absolute distances.

    Parameters
    ----------
    measured, design
        (n, 2) float64, mm; row i of one belongs to row i of the other.
    """
    fit = fit_eopa_planar(measured, design)
    if isinstance(fit, NoFit):
        return np.asarray(measured - design)
    residuals = fit.residuals
    for _ in range(_ROUNDS):
        weights = 1.0 / np.maximum(np.hypot(*residuals.T), _SMALLEST_MM)
        residuals = _weighted(measured, design, weights).residuals
    return np.asarray(-residuals)


def plane_basis(vertical: Array) -> Array:
    """Rotation (3, 3) whose rows are x, y across ``vertical`` and ``vertical`` itself, right-handed.

    ``plane_basis(v) @ p`` has x and y as somebody sees them who looks down against the (3,) vector v.
    """
    up = np.asarray(vertical, dtype=np.float64)
    up = up / np.linalg.norm(up)
    # The axis least along the vertical gives the best conditioned x; ties go to the first axis.
    x = np.eye(3)[int(np.argmin(np.round(np.abs(up), 9)))]
    x = x - (x @ up) * up
    x = x / np.linalg.norm(x)
    return np.stack([x, np.cross(up, x), up])


def turn(yaw: float) -> Array:
    """Rotation (2, 2) by ``yaw`` radians, counter-clockwise, for column vectors."""
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return np.array([[cosine, -sine], [sine, cosine]])


def planar_transform(yaw: float, shift: Array) -> Array:
    """T_target_source (4, 4): turned by ``yaw`` about the z axis, then moved by ``shift`` (2,) mm in the plane."""
    transform = np.eye(4)
    transform[:2, :2] = turn(yaw)
    transform[:2, 3] = shift
    return transform


def upright_transform(basis: Array, yaw: float, shift: Array, rise: float) -> Array:
    """T_column_scan (4, 4): into the plane of ``basis`` (3, 3), turned, moved in the plane and along the vertical."""
    into_plane = np.eye(4)
    into_plane[:3, :3] = basis
    transform = planar_transform(yaw, shift) @ into_plane
    transform[2, 3] = rise
    return transform


def wrap(angle: float) -> float:
    """The same direction, radians, in (−π, π]."""
    return float(np.pi - (np.pi - angle) % (2.0 * np.pi))
