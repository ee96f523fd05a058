"""Small displacements of rigid bodies, to first order: how far any point of a column moves with it.

A displacement is ξ = (d, r): the shift of the origin, mm, and the turn about it, radians. A point p moves by u = d + r
× p, which is linear, so that covariances follow as A Σ Aᵀ. Sources: small-displacement torsors for the geometry of
buildings, Kaufmann, Effenberger and Huber 2021 (J. Sens. Sens. Syst. 10, 101); chains of such parts as in
kinematic-chain variation analysis; the same linearisation in assemblies, Chase, Gao and Magleby 1995 (J. Design and
Manufacturing 5, 263).

What is left out is of second order: half of the turn squared times the lever, 0.003 mm for 5 mm of lean on 3.6 m.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.model import Array

TILTS = (3, 4)
"""Places of the turns about x and y among the six: braces set them to zero, measurements in the plan never see them."""


@dataclass(frozen=True, eq=False)
class Torsor:
    """A displacement ``values`` (6,) dx, dy, dz mm and rx, ry, rz radians, and its ``covariance`` (6, 6)."""

    values: Array
    covariance: Array

    def through(self, matrix: Array, noise: Array | None = None) -> Torsor:
        """The displacement ``matrix`` (6, 6) @ ξ, with an independent covariance (6, 6) added to it."""
        added = 0.0 if noise is None else noise
        return Torsor(matrix @ self.values, matrix @ self.covariance @ matrix.T + added)

    def plus(self, values: Array, covariance: Array) -> Torsor:
        """Followed by another, independent one."""
        return Torsor(self.values + values, self.covariance + covariance)

    def at(self, point: Array) -> tuple[Array, Array]:
        """Displacement (3,) mm of a point (3,) mm, and its covariance (3, 3)."""
        matrix = point_matrix(point)
        return matrix @ self.values, matrix @ self.covariance @ matrix.T


STILL = Torsor(np.zeros(6), np.zeros((6, 6)))
"""What does not move, for certain."""


def cross_matrix(vector: Array) -> Array:
    """[v]× (3, 3), for which [v]× w = v × w."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def point_matrix(point: Array) -> Array:
    """(3, 6), by which a point (3,) mm moves with a displacement: u = d + r × p = d − [p]× r."""
    return np.hstack([np.eye(3), -cross_matrix(point)])


def carried_to(point: Array) -> Array:
    """A (6, 6): the same displacement told at another origin (3,) mm; the turn stays."""
    return np.vstack([point_matrix(point), np.hstack([np.zeros((3, 3)), np.eye(3)])])


def seen_from(rotation: Array) -> Array:
    """(6, 6) that tells a displacement in a frame turned by R (3, 3), which maps old components to new ones."""
    return np.asarray(np.kron(np.eye(2), rotation))


def plumbed() -> Array:
    """F (6, 6): braces set the tilt of a column anew, whatever stands below it."""
    kept = np.ones(6)
    kept[list(TILTS)] = 0.0
    return np.diag(kept)


def in_plan(planar: Array, covariance: Array) -> Torsor:
    """A displacement in the plan, (dx, dy mm, yaw radians) with covariance (3, 3), as one of six numbers."""
    where = [0, 1, 5]
    values, full = np.zeros(6), np.zeros((6, 6))
    values[where] = planar
    full[np.ix_(where, where)] = covariance
    return Torsor(values, full)
