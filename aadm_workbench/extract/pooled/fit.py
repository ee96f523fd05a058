"""One fit for all features of a type: their centres and leans, with one radius pooled over them.

Three witnesses are weighed against each other. *Beyond*: crossings of rays that passed the edge
(:mod:`~aadm_workbench.extract.outlines`). *Rims*: outline points, each somewhere between the true
edge and a pixel or two away from it, always on the same side, more or less far as the camera drops
pixels at depth steps. Their law (:mod:`~aadm_workbench.extract.pooled.edge_law`) does not depend on how many are lost.
*Walls*: points on the bore of a sleeve or the side of a bar. They carry no such one-sided error, but light
that bounces inside a sleeve can push them along the ray; that push is an unknown with a prior, pooled over
the features and free by a little for each of them.

A feature with index k has a centre c, a lean l (offset per mm of depth), a push e and its own share r of the
radius. Wall: ``|p - c - l*depth - (b + e)*t| = R + r``. Edge: ``|p - c| = E + r``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aadm_workbench.extract.pooled.evidence import EdgeTerms, Rims, Walls, WallTerms, spread
from aadm_workbench.extract.pooled.system import BEYOND, PUSH, RIM, WALL, Priors, State, System
from aadm_workbench.model import Array, BoolArray, IntArray

_DISAGREE_CHI2, _FEW, _ONE_SIDED = 13.8, 25, 1e3  # 0.1 % of chi-squared with two degrees of freedom
# a state that begins at rest still takes its first steps; what goes on for longer swings
_ROUNDS_MIN, _ROUNDS_MAX = 3, 30
_SETTLED_MM = 4e-3  # a fifth of what the best camera errs by (docs/method.md, 2.5)


@dataclass(frozen=True, eq=False)
class PooledFit:
    """Result for k features: ``centre`` (k, 2) mm with ``covariance`` (k, 2, 2) mm², ``lean`` (k, 2) with its own.

    ``radius`` (k,) mm of the wall, ``outline_radius`` (k,) mm of the edge. ``wall_count``, ``edge_count`` (k,) are the
    points with weight. ``wall_mm`` and ``edge_mm`` are robust standard deviations of the residuals;
    ``radius_u_mm`` is what all radii may be off together, by what the camera does at edges.
    """

    centre: Array
    lean: Array
    radius: Array
    covariance: Array
    lean_covariance: Array
    outline_radius: Array
    push_mm: float
    wall_mm: float
    edge_mm: float
    wall_count: IntArray
    edge_count: IntArray
    radius_u_mm: float = 0.0


@dataclass(frozen=True, eq=False)
class Evidence:
    """All that is seen of k features, their nominal radius, mm, and what is believed before any point is seen.

    ``known`` are centres (k, 2) mm that another witness tells, with its information (k, 2, 2), 1/mm².
    """

    beyond: Rims
    rims: Rims
    walls: Walls
    radius_mm: float
    priors: Priors
    known: tuple[Array, Array] | None = None


class _Terms:
    """Residuals of all witnesses at a state, with their Jacobians and pulls."""

    def __init__(self, evidence: Evidence, state: State) -> None:
        centre, own_radius, pooled = state.own[:, :2], state.own[:, 5], state.pooled
        self.wall = WallTerms(evidence.walls, state.own, pooled[WALL], pooled[PUSH])
        self.edge = EdgeTerms(evidence.beyond, centre, own_radius, pooled[BEYOND])
        self.rim = EdgeTerms(evidence.rims, centre, own_radius, pooled[RIM])

    def system(self, state: State, evidence: Evidence, *, knowledge: bool) -> System:
        """Normal equations for a step, or, with ``knowledge``, of what the witnesses tell (for the covariance)."""
        system = System(len(state.own))
        system.add_walls(self.wall, self.wall.knowledge if knowledge else self.wall.bend)
        system.add_edges(self.edge, self.edge.knowledge if knowledge else self.edge.bend, BEYOND)
        system.add_edges(self.rim, self.rim.knowledge if knowledge else self.rim.bend, RIM)
        if evidence.known is not None:
            system.add_known(state, *evidence.known)
        system.add_priors(state, evidence.priors, evidence.radius_mm)
        return system


def settled(evidence: Evidence, start: State, within_mm: float = _SETTLED_MM) -> State:
    """The state in which all witnesses agree best: steps end when none is longer than ``within_mm``."""
    state = start.copy()
    for number in range(_ROUNDS_MAX):
        step = state.move(_Terms(evidence, state).system(state, evidence, knowledge=False))
        if step < within_mm and number >= _ROUNDS_MIN:
            break
    return state


def fit_pooled(evidence: Evidence, start: State) -> PooledFit:
    """Fit all features to their edges and walls together, and tell how well each is known."""
    state = settled(evidence, start)
    terms = _Terms(evidence, state)
    beyond, rims, walls = evidence.beyond, evidence.rims, evidence.walls
    wall_weight = terms.wall.robust_weight()
    shown = np.concatenate([terms.edge.residual[beyond.seen], terms.rim.residual[rims.seen]])
    covariance = terms.system(state, evidence, knowledge=True).covariance()
    return PooledFit(
        centre=state.own[:, :2],
        lean=state.own[:, 2:4],
        radius=state.wall_radius(),
        covariance=covariance[:, :2, :2] + _disagreement(terms, wall_weight, walls.seen, rims.seen),
        lean_covariance=covariance[:, 2:, 2:],
        outline_radius=state.pooled[BEYOND] + state.own[:, 5],
        push_mm=float(state.pooled[PUSH]),
        wall_mm=terms.wall.spread_mm,
        edge_mm=spread(shown),
        wall_count=(wall_weight > 0).sum(axis=1),
        edge_count=beyond.seen.sum(axis=1) + rims.seen.sum(axis=1),
    )


def _disagreement(terms: _Terms, wall_weight: Array, wall_seen: BoolArray, rim_seen: BoolArray) -> Array:
    """What to add to the covariances (k, 2, 2) mm² where walls and rims of a feature place it differently.

    Each witness alone would move the centre by its own step; where the two steps differ by more than their
    errors explain, the walls' pull on the joint centre counts as uncertainty.
    """
    extra = np.zeros((len(wall_seen), 2, 2))
    wall, wall_information, wall_tells = _steps_alone(terms.wall.jacobian, terms.wall.pull, wall_weight, wall_seen)
    rim, rim_information, rim_tells = _steps_alone(terms.rim.jacobian, terms.rim.pull, terms.rim.knowledge, rim_seen)
    for k in np.flatnonzero(wall_tells & rim_tells).tolist():
        apart = wall[k] - rim[k]
        expected = np.linalg.inv(wall_information[k]) + np.linalg.inv(rim_information[k])
        if apart @ np.linalg.solve(expected, apart) > _DISAGREE_CHI2:
            pulled = np.linalg.solve(wall_information[k] + rim_information[k], wall_information[k] @ apart)
            extra[k] = np.outer(pulled, pulled)
    return extra


def _steps_alone(jacobian: Array, pull: Array, weight: Array, seen: BoolArray) -> tuple[Array, Array, BoolArray]:
    """Step (k, 2) of each centre that one witness alone asks for, its information (k, 2, 2), and whether it tells."""
    across = jacobian[:, :2]
    information = (across * weight[:, None]) @ across.transpose(0, 2, 1)
    low, high = np.linalg.eigvalsh(information).T
    tells = (seen.sum(axis=1) >= _FEW) & (low * _ONE_SIDED > high)
    step = np.zeros((len(seen), 2))
    gradient = (across @ pull[..., None])[tells]
    step[tells] = -np.linalg.solve(information[tells], gradient)[..., 0]
    return step, information, tells
