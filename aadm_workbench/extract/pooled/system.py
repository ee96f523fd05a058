"""Normal equations of features that share a few unknowns, solved feature by feature."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.pooled.evidence import EdgeTerms, WallTerms
from aadm_workbench.model import Array

OWN = 6
"""Unknowns of a feature: centre x, y; lean x, y; push; radius."""

POOLED = 4
"""Unknowns that all features share: radius of walls, of crossings beyond the edge, of rims; push."""

WALL, BEYOND, RIM, PUSH = range(POOLED)
_EDGE = np.array([0, 1, 5])  # what an edge depends on
_OWN_PUSH, _OWN_RADIUS = 4, 5  # places among a feature's own unknowns
_STEP_MAX = 2.0  # mm: first centres are right within that
_JUST_SOLVABLE = 1e-9  # 1/mm²: a belief of ± 30 m, which holds nothing but the arithmetic


@dataclass(frozen=True)
class Priors:
    """What is believed before any point is seen, as standard deviations (mm; lean: mm per mm)."""

    lean: float = 0.010
    own_radius: float = 0.05
    own_push: float = 0.25
    push: float = 0.4
    radius: float = 0.5
    wall_to_edge: float = 0.03
    rim_to_wall: float = np.inf
    rim_to_beyond: float = np.inf


class State:
    """The unknowns: ``own`` (k, 6) by feature, ``pooled`` (4,) shared; at first centres (k, 2) and a radius, mm."""

    def __init__(self, centre: Array, radius_mm: float) -> None:
        self.own = np.zeros((len(centre), OWN))
        self.own[:, :2] = centre
        self.pooled = np.array([radius_mm, radius_mm, radius_mm, 0.0])

    def wall_radius(self) -> Array:
        """Radius (k,) mm of each bore or bar, as its wall has it."""
        return np.asarray(self.pooled[WALL] + self.own[:, _OWN_RADIUS])

    def copy(self) -> State:
        """The same, to be moved by itself."""
        return deepcopy(self)

    def move(self, system: System) -> float:
        """Take the step of a system; the largest part of it."""
        own, pooled = system.step()
        own, pooled = np.clip(own, -_STEP_MAX, _STEP_MAX), np.clip(pooled, -_STEP_MAX, _STEP_MAX)
        self.own += own
        self.pooled += pooled
        return float(max(np.abs(own).max(), np.abs(pooled).max()))


class System:
    """Normal equations: ``own`` (k, 6, 6) of each feature, ``cross`` (k, 6, 4) to what they share, ``shared`` (4, 4).

    No two features depend on each other but through what they share, so the shared unknowns are solved for first
    (Schur complement), and each feature then by itself.
    """

    def __init__(self, features: int) -> None:
        self.own = np.zeros((features, OWN, OWN))
        self.cross = np.zeros((features, OWN, POOLED))
        self.shared = np.zeros((POOLED, POOLED))
        self.own_gradient = np.zeros((features, OWN))
        self.shared_gradient = np.zeros(POOLED)

    def add_walls(self, terms: WallTerms, bend: Array) -> None:
        """Add the points of walls with the curvatures (k, m) of their costs."""
        normal = (terms.jacobian * bend[:, None]) @ terms.jacobian.transpose(0, 2, 1)
        gradient = (terms.jacobian @ terms.pull[..., None])[..., 0]
        self.own += normal
        self.own_gradient += gradient
        # The pooled radius acts on a wall as its own radius does, the pooled push as its own push.
        for place, own in ((WALL, _OWN_RADIUS), (PUSH, _OWN_PUSH)):
            self.cross[:, :, place] += normal[:, :, own]
            self.shared_gradient[place] += gradient[:, own].sum()
            for other, other_own in ((WALL, _OWN_RADIUS), (PUSH, _OWN_PUSH)):
                self.shared[place, other] += normal[:, own, other_own].sum()

    def add_edges(self, terms: EdgeTerms, bend: Array, place: int) -> None:
        """Add outline points that the pooled radius of this place belongs to."""
        normal = (terms.jacobian * bend[:, None]) @ terms.jacobian.transpose(0, 2, 1)
        gradient = (terms.jacobian @ terms.pull[..., None])[..., 0]
        self.own[:, _EDGE[:, None], _EDGE] += normal
        self.own_gradient[:, _EDGE] += gradient
        self.cross[:, _EDGE, place] += normal[:, :, 2]
        self.shared[place, place] += normal[:, 2, 2].sum()
        self.shared_gradient[place] += gradient[:, 2].sum()

    def add_known(self, state: State, centre: Array, information: Array) -> None:
        """Add what is known of the centres (k, 2) mm from elsewhere, with information (k, 2, 2), 1/mm²."""
        self.own[:, :2, :2] += information
        self.own_gradient[:, :2] += np.einsum("kab,kb->ka", information, state.own[:, :2] - centre)

    def add_priors(self, state: State, priors: Priors, radius_mm: float) -> None:
        """Add what is believed before any point is seen."""
        precision = np.array([np.inf, np.inf, priors.lean, priors.lean, priors.own_push, priors.own_radius]) ** -2.0
        self.own[:, np.arange(OWN), np.arange(OWN)] += precision + _JUST_SOLVABLE
        self.own_gradient += precision * state.own
        pooled = np.array([priors.radius, priors.radius, 2 * priors.radius, priors.push]) ** -2.0
        self.shared[np.arange(POOLED), np.arange(POOLED)] += pooled + _JUST_SOLVABLE
        self.shared_gradient += pooled * (state.pooled - [radius_mm, radius_mm, radius_mm, 0.0])
        self._tie(state, WALL, BEYOND, priors.wall_to_edge)
        self._tie(state, WALL, RIM, priors.rim_to_wall)
        self._tie(state, BEYOND, RIM, priors.rim_to_beyond)

    def step(self) -> tuple[Array, Array]:
        """The step of each feature (k, 6) and of what they share (4,)."""
        solved = np.linalg.solve(self.own, np.concatenate([self.cross, self.own_gradient[..., None]], axis=2))
        across, alone = solved[..., :POOLED], solved[..., POOLED]
        reduced = self.shared - np.einsum("kip,kiq->pq", self.cross, across)
        pooled = np.linalg.solve(reduced, self.shared_gradient - np.einsum("kip,ki->p", self.cross, alone))
        return across @ pooled - alone, -pooled

    def covariance(self) -> Array:
        """Covariance (k, 4, 4) of centres and leans: that of their own unknowns and of what they share."""
        inverse = np.linalg.inv(self.own)
        across = inverse @ self.cross
        reduced = self.shared - np.einsum("kip,kiq->pq", self.cross, across)
        whole = inverse + across @ np.linalg.inv(reduced) @ across.transpose(0, 2, 1)
        return np.asarray(whole[:, :4, :4])

    def _tie(self, state: State, one: int, other: int, deviation_mm: float) -> None:
        """A bore has one radius, be it seen as a wall or as an edge."""
        difference = state.pooled[one] - state.pooled[other]
        pair = np.array([one, other])
        self.shared[pair[:, None], pair] += np.array([[1.0, -1.0], [-1.0, 1.0]]) / deviation_mm**2
        self.shared_gradient[pair] += np.array([difference, -difference]) / deviation_mm**2
