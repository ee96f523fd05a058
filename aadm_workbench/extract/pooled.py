"""One fit for all features of a type: their centres and leans, with one radius pooled over them.

Three witnesses are weighed against each other. *Beyond*: crossings of rays that passed the edge
(:mod:`~aadm_workbench.extract.bracket`). *Rims*: outline points, each somewhere between the true
edge and a pixel or two away from it, always on the same side, more or less far as the camera drops
pixels at depth steps. Their law (:mod:`~aadm_workbench.extract.edge_law`) does not depend on how many are lost.
*Walls*: points on the bore of a sleeve or the side of a bar. They carry no such one-sided error, but light
that bounces inside a sleeve can push them along the ray; that push is an unknown with a prior, pooled over
the features and free by a little for each of them.

A feature with index k has a centre c, a lean l (offset per mm of depth), a push e and its own share r of the
radius. Wall: ``|p - c - l*depth - (b + e)*t| = R + r``. Edge: ``|p - c| = E + r``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.edge_law import BracketLaw, RimLaw
from aadm_workbench.model import Array, IntArray

_OWN = 6  # unknowns of a feature: centre x, y; lean x, y; push; radius
_POOLED = 4  # unknowns that all features share: radius of walls, of crossings beyond the edge, of rims; push
_WALL, _BEYOND, _RIM, _PUSH = range(_POOLED)
_WALL_CORRELATION = 2.5  # neighbouring wall points share their errors: standard errors are this much larger
_TUKEY = 4.0
_DISAGREE_CHI2, _FEW, _ONE_SIDED = 13.8, 25, 1e3  # 0.1 % of chi-squared with two degrees of freedom
_SETTLED_MM = 1e-3


@dataclass(frozen=True, eq=False)
class Rims:
    """Outline points known from one side only: ``xy`` (n, 2) mm and the index ``owner`` (n,) of their feature.

    ``side`` is +1 where points lie outside of the true edge (holes), -1 where inside (discs).
    """

    xy: Array
    owner: IntArray
    side: float
    law: RimLaw


@dataclass(frozen=True, eq=False)
class Walls:
    """Points of a bore or a bar's side: ``xy`` (n, 2) mm, ``depth`` (n,) mm along the axis from the centre.

    ``slope`` (n, 2): how far the line of sight moves in the plan per mm of depth. ``law``: how the points of
    a bar's side (``side`` -1) or of a ribbed bore (+1) scatter; None where they scatter symmetrically.
    """

    xy: Array
    depth: Array
    slope: Array
    owner: IntArray
    law: BracketLaw | None = None
    side: float = -1.0


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


@dataclass(frozen=True, eq=False)
class PooledFit:
    """Result for k features: ``centre`` (k, 2) and ``lean`` (k, 2), their ``covariance`` (k, 2, 2) mm².

    ``radius`` (k,) mm of the wall, ``outline_radius`` (k,) mm of the edge. ``wall_count``, ``edge_count`` (k,) are the
    points with weight. ``wall_mm`` and ``edge_mm`` are robust standard deviations of the residuals.
    """

    centre: Array
    lean: Array
    radius: Array
    covariance: Array
    outline_radius: Array
    push_mm: float
    wall_mm: float
    edge_mm: float
    wall_count: IntArray
    edge_count: IntArray


def fit_pooled(
    beyond: Rims, rims: Rims, walls: Walls, start: Array, radius_mm: float, priors: Priors, rounds: int = 30
) -> PooledFit:
    """Fit all features (start centres (k, 2) mm, nominal radius mm) to their edges and walls together."""
    state = _State(start.copy(), radius_mm)
    for number in range(rounds):
        terms = _Terms(beyond, rims, walls, state)
        step = state.move(terms.system(state, priors, radius_mm, knowledge=False))
        if step < _SETTLED_MM and number > 2:
            break
    terms = _Terms(beyond, rims, walls, state)
    return _result(state, terms, terms.system(state, priors, radius_mm, knowledge=True))


class _Terms:
    """Residuals of all witnesses at a state, with their Jacobians and weights."""

    def __init__(self, beyond: Rims, rims: Rims, walls: Walls, state: _State) -> None:
        self.beyond, self.rims, self.walls = beyond, rims, walls
        self.wall, self.wall_jacobian = _wall_terms(walls, state)
        self.wall_mm = max(_spread(self.wall), 0.02)
        self.wall_weight = _tukey(self.wall / self.wall_mm) / (_WALL_CORRELATION * self.wall_mm) ** 2
        self.wall_pull, self.wall_bend = self.wall_weight * self.wall, self.wall_weight
        if walls.law is not None:
            self.wall_pull = walls.side * walls.law.slope(walls.side * self.wall) / _WALL_CORRELATION**2
            self.wall_bend = np.abs(self.wall_pull) / np.maximum(np.abs(self.wall), walls.law.softness_mm)
        self.edge, self.edge_jacobian = _edge_terms(beyond, state, _BEYOND)
        self.edge_slope = beyond.side * beyond.law.slope(beyond.side * self.edge)
        self.rim, self.rim_jacobian = _edge_terms(rims, state, _RIM)
        self.rim_slope = rims.side * rims.law.slope(rims.side * self.rim)

    def system(self, state: _State, priors: Priors, radius_mm: float, *, knowledge: bool) -> _System:
        """Normal equations for a step, or, with ``knowledge``, of what the witnesses tell (for the covariance)."""
        system = _System(len(state.own))
        bend = self.wall_bend if self.walls.law is None or not knowledge else self.wall_pull**2 * _WALL_CORRELATION**2
        system.add(self.wall_jacobian, self.wall_pull, bend, self.walls.owner)
        for points, residual, jacobian, slope in (
            (self.beyond, self.edge, self.edge_jacobian, self.edge_slope),
            (self.rims, self.rim, self.rim_jacobian, self.rim_slope),
        ):
            bend = np.abs(slope) / np.maximum(np.abs(residual), points.law.softness_mm)
            system.add(jacobian, slope, slope**2 if knowledge else bend, points.owner)
        system.add_priors(state, priors, radius_mm)
        return system


def owners_of(counts: list[int]) -> IntArray:
    """Index of the feature (n,) that each point belongs to, for features that bring these numbers of points."""
    return np.repeat(np.arange(len(counts)), counts)


class _State:
    """The unknowns, as arrays by feature and as pooled scalars."""

    def __init__(self, centre: Array, radius_mm: float) -> None:
        self.own = np.zeros((len(centre), _OWN))
        self.own[:, :2] = centre
        self.pooled = np.array([radius_mm, radius_mm, radius_mm, 0.0])

    def move(self, system: _System) -> float:
        step = np.clip(-np.linalg.solve(system.normal, system.gradient), -2.0, 2.0)
        count = self.own.size
        self.own += step[:count].reshape(self.own.shape)
        self.pooled += step[count:]
        return float(np.abs(step).max())


class _System:
    """Normal equations of all features, own unknowns first, pooled ones last."""

    def __init__(self, features: int) -> None:
        self.features = features
        size = features * _OWN + _POOLED
        self.normal = np.zeros((size, size))
        self.gradient = np.zeros(size)

    def add(self, jacobian: Array, slope: Array, bend: Array, owner: IntArray) -> None:
        """Add terms, sorted by owner: jacobian (n, own + pooled) of residuals, slope and bend (n,) of their costs."""
        begin = np.searchsorted(owner, np.arange(self.features + 1))
        for k in range(self.features):
            rows = slice(begin[k], begin[k + 1])
            if rows.start == rows.stop:
                continue
            weighted = jacobian[rows] * bend[rows, None]
            place = np.concatenate([np.arange(k * _OWN, (k + 1) * _OWN), np.arange(-_POOLED, 0)])
            self.normal[np.ix_(place, place)] += weighted.T @ jacobian[rows]
            self.gradient[place] += jacobian[rows].T @ slope[rows]

    def add_priors(self, state: _State, priors: Priors, radius_mm: float) -> None:
        deviations = np.array([np.inf, np.inf, priors.lean, priors.lean, priors.own_push, priors.own_radius])
        own = np.tile(deviations**-2.0, self.features)
        pooled = np.array([priors.radius, priors.radius, 2 * priors.radius, priors.push]) ** -2.0
        precision = np.concatenate([own, pooled])
        offset = np.concatenate([state.own.ravel(), state.pooled - [radius_mm, radius_mm, radius_mm, 0.0]])
        self.normal[np.diag_indices_from(self.normal)] += precision + 1e-9
        self.gradient += precision * offset
        self._tie(state, _WALL, _BEYOND, priors.wall_to_edge)
        self._tie(state, _WALL, _RIM, priors.rim_to_wall)
        self._tie(state, _BEYOND, _RIM, priors.rim_to_beyond)

    def _tie(self, state: _State, one: int, other: int, deviation_mm: float) -> None:
        """A bore has one radius, be it seen as a wall or as an edge."""
        difference = state.pooled[one] - state.pooled[other]
        first, second = one - _POOLED, other - _POOLED
        self.normal[np.ix_([first, second], [first, second])] += np.array([[1.0, -1.0], [-1.0, 1.0]]) / deviation_mm**2
        self.gradient[[first, second]] += np.array([difference, -difference]) / deviation_mm**2


def _wall_terms(walls: Walls, state: _State) -> tuple[Array, Array]:
    own = state.own[walls.owner]
    pushed = (state.pooled[_PUSH] + own[:, 4])[:, None] * walls.slope
    about = walls.xy - own[:, :2] - own[:, 2:4] * walls.depth[:, None] - pushed
    distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
    outward = about / distance[:, None]
    along_slope = -np.einsum("ij,ij->i", outward, walls.slope)
    minus, none = -np.ones(len(distance)), np.zeros(len(distance))
    jacobian = np.column_stack(
        [-outward, -outward * walls.depth[:, None], along_slope, minus, minus, none, none, along_slope]
    )
    return distance - state.pooled[_WALL] - own[:, 5], jacobian


def _edge_terms(rims: Rims, state: _State, pooled: int) -> tuple[Array, Array]:
    own = state.own[rims.owner]
    about = rims.xy - own[:, :2]
    distance = np.maximum(np.hypot(about[:, 0], about[:, 1]), 1e-9)
    outward = about / distance[:, None]
    minus, none = -np.ones(len(distance)), np.zeros(len(distance))
    shared = [minus if place == pooled else none for place in range(_POOLED)]
    jacobian = np.column_stack([-outward, none, none, none, minus, *shared])
    return distance - state.pooled[pooled] - own[:, 5], jacobian


def _spread(residual: Array) -> float:
    if len(residual) < 5:
        return 0.3
    return 1.4826 * float(np.median(np.abs(residual - np.median(residual))))


def _tukey(scaled: Array) -> Array:
    inside = 1.0 - (scaled / _TUKEY) ** 2
    return np.where(inside > 0, inside, 0.0) ** 2


def _result(state: _State, terms: _Terms, knowledge: _System) -> PooledFit:
    inverse = np.linalg.inv(knowledge.normal)
    features = knowledge.features
    starts = np.arange(features) * _OWN
    covariance = np.array([inverse[s : s + 2, s : s + 2] for s in starts]).reshape(-1, 2, 2)
    held = np.bincount(terms.beyond.owner, minlength=features)
    covariance = covariance + _disagreement(terms, features)
    return PooledFit(
        centre=state.own[:, :2],
        lean=state.own[:, 2:4],
        radius=state.pooled[_WALL] + state.own[:, 5],
        covariance=covariance,
        outline_radius=state.pooled[_BEYOND] + state.own[:, 5],
        push_mm=float(state.pooled[_PUSH]),
        wall_mm=terms.wall_mm,
        edge_mm=_spread(np.concatenate([terms.edge, terms.rim])),
        wall_count=np.bincount(terms.walls.owner[terms.wall_weight > 0], minlength=features),
        edge_count=held + np.bincount(terms.rims.owner, minlength=features),
    )


def _disagreement(terms: _Terms, features: int) -> Array:
    """What to add to the covariances (k, 2, 2) mm² where walls and rims of a feature place it differently.

    Each witness alone would move the centre by its own step; where the two steps differ by more than their
    errors explain, the walls' pull on the joint centre counts as uncertainty.
    """
    extra = np.zeros((features, 2, 2))
    for k in range(features):
        wall, wall_information = _step_alone(
            terms.wall_jacobian, terms.wall_pull, terms.wall_weight, terms.walls.owner, k
        )
        rim, rim_information = _step_alone(terms.rim_jacobian, terms.rim_slope, terms.rim_slope**2, terms.rims.owner, k)
        if wall is None or rim is None:
            continue
        apart = wall - rim
        expected = np.linalg.inv(wall_information) + np.linalg.inv(rim_information)
        if apart @ np.linalg.solve(expected, apart) > _DISAGREE_CHI2:
            pulled = np.linalg.solve(wall_information + rim_information, wall_information @ apart)
            extra[k] = np.outer(pulled, pulled)
    return extra


def _step_alone(jacobian: Array, pull: Array, weight: Array, owner: IntArray, k: int) -> tuple[Array | None, Array]:
    """Step (2,) of a feature's centre that one witness alone asks for, and its information (2, 2)."""
    rows = owner == k
    across = jacobian[rows, :2]
    information = (across * weight[rows, None]).T @ across
    if rows.sum() < _FEW or np.linalg.cond(information) > _ONE_SIDED:
        return None, information
    return -np.linalg.solve(information, across.T @ pull[rows]), information
