"""The turns about the column's axis that map a pattern of sleeves onto itself, and whether a mirror does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.eopa import NoFit, fit_eopa_planar, turn, wrap
from aadm_workbench.model import Array, IntArray

SYMMETRIC_WITHIN_MM = 0.5
"""A pattern is symmetric where no scan tells its turns apart: a quarter of what a sleeve may stand off."""


@dataclass(frozen=True, eq=False)
class SymmetricTurn:
    """A turn of the pattern onto itself: turned by ``angle``, point k comes to where point ``onto[k]`` was."""

    angle: float
    onto: IntArray


def symmetric_turns(centres: Array) -> tuple[SymmetricTurn, ...]:
    """All turns of the pattern onto itself, the identity first, then by growing size.

    Parameters
    ----------
    centres
        (n, 2) or (n, 3) float64, mm, column frame; the pattern is turned about its centroid.
    """
    points = np.asarray(centres, dtype=np.float64)[:, :2]
    centred = points - points.mean(axis=0)
    radius = np.hypot(*centred.T)
    reference = int(np.argmax(radius))
    identity = SymmetricTurn(0.0, np.arange(len(points)))
    if radius[reference] <= SYMMETRIC_WITHIN_MM:
        return (identity,)
    turns = [identity]
    for index in np.flatnonzero(np.abs(radius - radius[reference]) <= 2.0 * SYMMETRIC_WITHIN_MM):
        if index == reference:
            continue
        a, b = centred[reference], centred[index]
        found = _turn_by(centred, float(np.arctan2(b[1], b[0]) - np.arctan2(a[1], a[0])))
        if found is not None:
            turns.append(found)
    # Rounded, so that turns which are equal but for the last digits keep their order on every machine.
    return tuple(sorted(turns, key=lambda found: (round(abs(found.angle), 9), -found.angle)))


def is_its_own_mirror(centres: Array) -> bool:
    """Whether the mirror image of a pattern, turned in some way, is the pattern: then no scan shows a mirror.

    Parameters
    ----------
    centres
        (n, 2) or (n, 3) float64, mm.
    """
    points = np.asarray(centres, dtype=np.float64)[:, :2]
    centred = points - points.mean(axis=0)
    image = centred * np.array([1.0, -1.0])
    radius = np.hypot(*centred.T)
    reference = int(np.argmax(radius))
    alike = np.flatnonzero(np.abs(radius - radius[reference]) <= 2.0 * SYMMETRIC_WITHIN_MM)
    angles = np.arctan2(*centred[alike, ::-1].T) - np.arctan2(image[reference, 1], image[reference, 0])
    return any(_lies_on(image @ turn(float(angle)).T, centred) for angle in angles)


def _lies_on(points: Array, centred: Array) -> bool:
    nearest = _distances(points, centred).argmin(axis=1)
    if len(set(nearest.tolist())) < len(nearest):
        return False
    fit = fit_eopa_planar(points, centred[nearest])
    return not isinstance(fit, NoFit) and float(np.hypot(*fit.residuals.T).max()) <= SYMMETRIC_WITHIN_MM


def _turn_by(centred: Array, about: float) -> SymmetricTurn | None:
    """The turn near an angle that two corresponding points suggest, None where it is no turn onto itself."""
    nearest = _distances(centred @ turn(about).T, centred).argmin(axis=1)
    if len(set(nearest.tolist())) < len(nearest):
        return None
    fit = fit_eopa_planar(centred, centred[nearest])
    if isinstance(fit, NoFit) or float(np.hypot(*fit.residuals.T).max()) > SYMMETRIC_WITHIN_MM:
        return None
    return SymmetricTurn(wrap(fit.yaw), nearest)


def _distances(a: Array, b: Array) -> Array:
    return np.asarray(np.hypot(*(a[:, None] - b[None]).transpose(2, 0, 1)))
