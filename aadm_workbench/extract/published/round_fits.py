"""Circles and upright cylinders: RANSAC to find one, least squares on its inliers to measure it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from aadm_workbench.model import Array, BoolArray

HYPOTHESES = 300  # a circle that a third of the points lie on is missed once in 80,000
RADIUS_MISFIT = 0.15  # as in hough.py
_ROUNDS = 3  # inliers are chosen anew about each fit (a choice, not tuned since)
_SCORED = 1500  # points to rank circles by


@dataclass(frozen=True, eq=False)
class RoundFit:
    """A circle, or the section of a cylinder at height zero, mm.

    ``centre`` (2,), ``lean`` (2,): how far the axis moves in x and y per mm of height; zero for a circle.
    ``inliers`` (n,) tells which of the points lie on it.
    """

    centre: Array
    radius_mm: float
    lean: Array
    inliers: BoolArray


def ransac_circle(
    xy: Array, nominal_radius_mm: float, inlier_distance_mm: float, rng: np.random.Generator
) -> RoundFit | None:
    """The circle, of about a nominal radius, that most of the points (n, 2) mm lie on, by least squares on these."""
    found = _hypothesis(xy, nominal_radius_mm, inlier_distance_mm, rng)
    if found is None:
        return None
    return _least_squares(xy, np.zeros(len(xy)), found, inlier_distance_mm, leaning=False)


def ransac_cylinder(
    local: Array, nominal_radius_mm: float, inlier_distance_mm: float, leaning: bool, rng: np.random.Generator
) -> RoundFit | None:
    """The cylinder, of about a nominal radius, that most of the points (n, 3) mm lie on; z is about its axis.

    Hypotheses are circles through three points seen along z; least squares on the inliers then frees the axis,
    where ``leaning`` allows it.
    """
    found = _hypothesis(local[:, :2], nominal_radius_mm, inlier_distance_mm, rng)
    if found is None:
        return None
    return _least_squares(local[:, :2], local[:, 2], found, inlier_distance_mm, leaning=leaning)


def _hypothesis(
    xy: Array, nominal_radius_mm: float, inlier_distance_mm: float, rng: np.random.Generator
) -> Array | None:
    """Centre and radius (3,) of the best of many circles through three points."""
    if len(xy) < 3:
        return None
    circles = _through_three(xy[rng.integers(0, len(xy), (HYPOTHESES, 3))])
    circles = circles[np.abs(circles[:, 2] / nominal_radius_mm - 1.0) < RADIUS_MISFIT]
    if len(circles) == 0:
        return None
    scored = xy[rng.integers(0, len(xy), _SCORED)] if len(xy) > _SCORED else xy
    distance = np.hypot(*(scored[:, None] - circles[None, :, :2]).transpose(2, 0, 1))
    votes = (np.abs(distance - circles[:, 2]) < inlier_distance_mm).sum(axis=0)
    return np.asarray(circles[int(votes.argmax())])


def _through_three(corners: Array) -> Array:
    """Circles (m, 3) as x, y, radius through triples (k, 3, 2); triples on a line are left out."""
    origin = corners[:, 0]
    b, c = corners[:, 1] - origin, corners[:, 2] - origin
    cross = 2.0 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    sound = np.abs(cross) > 1e-6
    b, c, cross, origin = b[sound], c[sound], cross[sound], origin[sound]
    bb, cc = (b**2).sum(axis=1), (c**2).sum(axis=1)
    x = (c[:, 1] * bb - b[:, 1] * cc) / cross
    y = (b[:, 0] * cc - c[:, 0] * bb) / cross
    return np.column_stack([origin[:, 0] + x, origin[:, 1] + y, np.hypot(x, y)])


def _least_squares(
    xy: Array, height: Array, start: Array, inlier_distance_mm: float, *, leaning: bool
) -> RoundFit | None:
    found = np.array([*start, 0.0, 0.0])
    for _ in range(_ROUNDS):
        inliers = np.abs(_residual(found, xy, height)) < inlier_distance_mm
        if inliers.sum() < 8:  # barely more than unknowns
            return None
        free = 5 if leaning else 3  # centre, radius, and two slopes
        fixed = found[free:]

        def residual(free_part: Array, fixed: Array = fixed, inliers: BoolArray = inliers) -> Array:
            return _residual(np.concatenate([free_part, fixed]), xy[inliers], height[inliers])

        # A slope of 0.02 moves what is 50 mm down by one millimetre.
        scale = np.array([1.0, 1.0, 1.0, 0.02, 0.02])[:free]
        found = np.concatenate([least_squares(residual, found[:free], x_scale=scale).x, fixed])
    inliers = np.abs(_residual(found, xy, height)) < inlier_distance_mm
    return RoundFit(found[:2], float(found[2]), found[3:], inliers)


def _residual(found: Array, xy: Array, height: Array) -> Array:
    axis = found[:2] + height[:, None] * found[3:]
    return np.asarray(np.hypot(xy[:, 0] - axis[:, 0], xy[:, 1] - axis[:, 1]) - found[2])
