"""What goes with the camera is its bias, what stays is the part: captures of one part from turned or moved cameras.

Metrologists turn what they measure by half a turn, and measure it again. Each centre is where the part has it, moved by
the pose of its capture and by what the camera bends at that place of its picture, which turns with the picture:

    offset = part + shift + turn x place + R(picture) bend(place in the picture)

The part of every centre is free, the bend is one smooth field of the camera. What turns with everything does not show:
a stretch alike in all directions, and so a wrong scale, and, without a quarter turn, any other stretch. That is said.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from aadm_workbench.assembly.matching.match import Match
from aadm_workbench.model import Array, AssemblyPoint, Extraction, IntArray, Reason

_TOLD_MM = 0.1  # at the edge of what is seen: what is known worse tells nothing of a camera that is to be right to that
_HALF = 0.5  # of a term that lies in what is told
_CHANCE = 1e-3  # of sound captures so few show a bend; a floor of a thousand columns has one
_FEWEST_SHARED = 4  # points in two captures: a pose takes three of their coordinates
_LEAST_NOISE_MM = 1e-4  # what files round centres to: no noise at all is no reason to be sure of everything
_TERMS = ("stretch", "stretch", *["keystone"] * 6, "radial")
"""Of the field, in the order of :func:`_terms`."""


@dataclass(frozen=True, eq=False)
class CameraView:
    """Of one capture, for all n design points: NaN where one is not seen.

    Parameters
    ----------
    offset
        (n, 2) mm from the design place, after the fit to design, column frame.
    design
        (n, 2) mm, design places.
    picture
        (n, 2) tangents of the line of sight, along the picture's x and y.
    turn
        (2, 2): from the picture's axes to the column frame's.
    u_mm
        (n,) standard uncertainty per axis, as stated.
    """

    offset: Array
    design: Array
    picture: Array
    turn: Array
    u_mm: Array

    @property
    def seen(self) -> IntArray:
        """Numbers of the points that it shows."""
        return np.flatnonzero(np.isfinite(self.offset).all(axis=1))


@dataclass(frozen=True, eq=False)
class Reversal:
    """What captures tell of the camera's bend.

    Parameters
    ----------
    bias
        (v, n, 2) mm in each view's picture axes: how far each centre is bent; NaN where one is not seen.
    u_mm
        Standard uncertainty of the largest.
    part
        (n, 2) mm: where the part's own centres are from design, without the bend; NaN where fewer than two views tell.
    untold
        Names of terms that these captures do not tell, of ``stretch``, ``keystone``, ``radial``.
    chance
        How often captures of a camera that bends nothing would show as much.
    stated_u_mm
        Median of what was stated per axis.
    noise_mm
        Scatter per axis of what is left.
    """

    bias: Array
    u_mm: float
    part: Array
    untold: tuple[str, ...]
    chance: float
    stated_u_mm: float
    noise_mm: float

    @property
    def largest_mm(self) -> float:
        """Of the bend at any centre that was seen."""
        return float(np.nanmax(np.hypot(self.bias[..., 0], self.bias[..., 1])))

    @property
    def shown(self) -> bool:
        """Whether there is a bend: chance does not explain it."""
        return self.chance < _CHANCE

    @property
    def contradicts(self) -> bool:
        """Whether the bend is more than twice what the stated uncertainty leaves open."""
        return self.shown and self.largest_mm > 2.0 * self.stated_u_mm


def view_of(design: Sequence[AssemblyPoint], extraction: Extraction, match: Match) -> CameraView | None:
    """A capture that was matched; None where it was not, or no point of it is before a camera."""
    if not match or not extraction.points:
        return None
    placement = match.placements[0]
    offset, picture = np.full((len(design), 2), np.nan), np.full((len(design), 2), np.nan)
    u_mm = np.full(len(design), np.nan)
    for number, (one, measured) in enumerate(zip(design, placement.matched.tolist(), strict=True)):
        if measured < 0:
            continue
        point = extraction.points[measured]
        if point.centre[2] <= 0.0:
            return None
        offset[number] = (placement.T_design_scan @ np.append(point.centre, 1.0))[:2] - one.centre[:2]
        picture[number] = point.centre[:2] / point.centre[2]
        if point.covariance is not None:
            u_mm[number] = np.sqrt(np.trace(point.covariance) / len(point.covariance))
    places = np.array([one.centre[:2] for one in design])
    return CameraView(offset, places, picture, image_axes(placement.T_design_scan), u_mm)


def image_axes(T_design_scan: Array) -> Array:
    """The picture's axes laid into the column's plane (2, 2): the nearest that keeps lengths."""
    left, _, right = np.linalg.svd(T_design_scan[:2, :2])
    return np.asarray(left @ right)


def reversal_of(views: Sequence[CameraView]) -> Reversal | Reason:
    """The camera's bend by captures of one part, or why they do not tell it."""
    count = np.sum([np.isfinite(view.offset).all(axis=1) for view in views], axis=0)
    shared = np.flatnonzero(count >= 2)
    used = [view for view in views if len(np.intersect1d(view.seen, shared)) >= _FEWEST_SHARED]
    if len(used) < 2:
        return Reason("calibration.few_views", used=len(used), fewest=_FEWEST_SHARED)
    return _solved(used, shared)


def _solved(views: Sequence[CameraView], shared: IntArray) -> Reversal | Reason:
    reach = max(float(np.nanmax(np.abs(view.picture))) for view in views)
    rows, wanted, fields = [], [], []
    for number, view in enumerate(views):
        points = np.intersect1d(view.seen, shared)
        field = _terms(view.picture[points] / reach)
        fields.append((points, field))
        bend = np.einsum("ab,kbt->kat", view.turn, field)
        rows.append(_row(points, bend, view.design[points], number, shared, len(views)))
        wanted.append(view.offset[points])
    design, seen = np.concatenate(rows), np.concatenate(wanted).ravel()
    free = design.shape[1] - len(_TERMS)
    freedom = len(seen) - int(np.linalg.matrix_rank(design))
    if freedom < 1:
        return Reason("calibration.few_views", used=len(views), fewest=_FEWEST_SHARED)
    noise_mm = max(float(np.sqrt(_left(design, seen) / freedom)), _LEAST_NOISE_MM)
    told, u_told = _told(design[:, :free], design[:, free:], noise_mm)
    if told.shape[1] == 0:
        unmoved = _told(design[:, :free], design[:, free:], _LEAST_NOISE_MM)[0].shape[1] == 0
        return Reason("calibration.unmoved") if unmoved else Reason("calibration.scattered", noise_mm=noise_mm)
    reduced = np.hstack([design[:, :free], design[:, free:] @ told])
    found = np.linalg.lstsq(reduced, seen, rcond=None)[0]
    bias, u_mm = _bias(views, fields, told @ found[free:], told @ np.diag(u_told**2) @ told.T)
    part = np.full(views[0].offset.shape, np.nan)
    part[shared] = found[: 2 * len(shared)].reshape(-1, 2)
    return Reversal(
        bias,
        u_mm,
        part,
        _untold(told),
        _chance(reduced, free, seen),
        float(np.nanmedian(np.concatenate([view.u_mm for view in views]))),
        noise_mm,
    )


def _row(points: IntArray, bend: Array, places: Array, number: int, shared: IntArray, views: int) -> Array:
    """Rows (2 k, …) of one view: parts, poses of the others against the first, terms of the bend."""
    count = len(points)
    parts = np.zeros((count, 2, len(shared), 2))
    parts[np.arange(count), :, np.searchsorted(shared, points), :] = np.eye(2)
    poses = np.zeros((count, 2, 3 * (views - 1)))
    if number:
        first = 3 * (number - 1)
        poses[:, 0, first] = poses[:, 1, first + 1] = 1.0
        poses[:, 0, first + 2], poses[:, 1, first + 2] = -places[:, 1], places[:, 0]
        poses[:, :, first + 2] /= np.abs(places).max()
    return np.concatenate([parts.reshape(2 * count, -1), poses.reshape(2 * count, -1), bend.reshape(2 * count, -1)], 1)


def _terms(at: Array) -> Array:
    """The field's terms (k, 2, 9) at places (k, 2) of the picture, one at its edge; without what no capture tells."""
    x, y = at.T
    zero, radius = np.zeros_like(x), x * x + y * y
    along = [x, y, x * x, x * y, y * y, zero, zero, zero, radius * x]
    across = [-y, x, zero, zero, zero, x * x, x * y, y * y, radius * y]
    return np.stack([np.stack(along, -1), np.stack(across, -1)], axis=1)


def _bias(
    views: Sequence[CameraView], fields: Sequence[tuple[IntArray, Array]], terms: Array, u_terms: Array
) -> tuple[Array, float]:
    """The bend (v, n, 2) mm without what a pose or a scale would do, and the u of its largest, mm."""
    bias = np.full((len(views), *views[0].offset.shape), np.nan)
    largest, u_mm = -1.0, 0.0
    for number, (view, (points, field)) in enumerate(zip(views, fields, strict=True)):
        flat = _without_pose(field.reshape(-1, field.shape[2]), view.picture[points])
        bent = (flat @ terms).reshape(-1, 2)
        bias[number, points] = bent
        worst = int(np.hypot(*bent.T).argmax())
        if np.hypot(*bent[worst]) > largest:
            largest = float(np.hypot(*bent[worst]))
            rows = flat.reshape(-1, 2, flat.shape[1])[worst]
            u_mm = float(np.sqrt(np.trace(rows @ u_terms @ rows.T) / 2.0))
    return bias, u_mm


def _without_pose(field: Array, picture: Array) -> Array:
    """Columns (2 k, t) without what a shift, a turn and a scale make of the places (k, 2)."""
    about = picture - picture.mean(axis=0)
    pose = np.zeros((len(picture), 2, 4))
    pose[:, 0, 0] = pose[:, 1, 1] = 1.0
    pose[:, 0, 2], pose[:, 1, 2] = -about[:, 1], about[:, 0]
    pose[:, :, 3] = about
    flat = pose.reshape(-1, 4)
    return np.asarray(field - flat @ np.linalg.lstsq(flat, field, rcond=None)[0])


def _told(nuisance: Array, field: Array, noise_mm: float) -> tuple[Array, Array]:
    """Directions (t, d) among the terms that are told well enough, and the u (d,) mm of each.

    What parts and poses do as well is taken out of the field; of what is left each direction has its own strength.
    """
    left = field - nuisance @ np.linalg.lstsq(nuisance, field, rcond=None)[0]
    strength, directions = np.linalg.eigh(left.T @ left)
    u_mm = noise_mm / np.sqrt(np.maximum(strength, 1e-12))
    told = u_mm < _TOLD_MM
    return np.asarray(directions[:, told]), np.asarray(u_mm[told])


def _untold(told: Array) -> tuple[str, ...]:
    """Names of the terms that lie, by more than half, in none of the told directions (t, d)."""
    share = (told**2).sum(axis=1)
    return tuple(dict.fromkeys(name for name, one in zip(_TERMS, share, strict=True) if one < _HALF))


def _left(design: Array, seen: Array) -> float:
    return float(((seen - design @ np.linalg.lstsq(design, seen, rcond=None)[0]) ** 2).sum())


def _chance(design: Array, free: int, seen: Array) -> float:
    """How often noise alone would make a field explain as much: Fisher's F."""
    terms, freedom = design.shape[1] - free, len(seen) - int(np.linalg.matrix_rank(design))
    without, left = _left(design[:, :free], seen), _left(design, seen)
    if freedom < 1 or left <= 0.0:
        return 1.0
    return float(stats.f.sf((without - left) / terms / (left / freedom), terms, freedom))
