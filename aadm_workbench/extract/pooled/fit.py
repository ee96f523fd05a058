"""One fit for all features of a type: their centres and leans, with one radius pooled over them.

Three witnesses are weighed against each other. *Beyond*: crossings of rays that passed the edge
(:mod:`~aadm_workbench.extract.circle`). *Rims*: outline points, each somewhere between the true
edge and a pixel or two away from it, always on the same side, more or less far as the camera drops
pixels at depth steps. Their law (:mod:`~aadm_workbench.extract.pooled.evidence`) does not depend on how many are lost.
*Walls*: points on the bore of a sleeve or the side of a bar. They carry no such one-sided error, but light
that bounces inside a sleeve can push them along the ray; that push is an unknown with a prior, pooled over
the features and free by a little for each of them.

A feature with index k has a centre c, a lean l (offset per mm of depth), a push e and its own share r of the
radius. Wall: ``|p - c - l*depth - (b + e)*t| = R + r``. Edge: ``|p - c| = E + r``.

Where to start a fit of discs from: the likeliest circles of one radius, on a grid. Robust fits mislead where ribs stand
out on half of an outline: half a rib makes an outline that a larger, shifted circle fits well, so the radius cannot
come from all features alike. Ribs only ever add. Each feature is fitted with a radius of its own, and the lower
quartile of these is the radius of the core; with it each centre follows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aadm_workbench.extract.circle import in_rows
from aadm_workbench.extract.pooled.evidence import BracketLaw, EdgeTerms, RimLaw, Rims, Walls, WallTerms, spread
from aadm_workbench.extract.pooled.system import BEYOND, PUSH, RIM, WALL, Priors, State, System
from aadm_workbench.model import Array, BoolArray, IntArray
from aadm_workbench.model.special import expit, median, percentiles

_DISAGREE_CHI2, _FEW = 13.8, 25  # 0.1 % of chi-squared with two degrees of freedom
# between the best and the worst known direction: rims that are known so much better one way are pieces of a circle,
# whose steps the other way go on over the tail of their law, for millimetres
_ONE_SIDED_WALL, _ONE_SIDED_RIM = 1e3, 8.0
# a state that begins at rest still takes its first steps; what goes on for longer swings
_ROUNDS_MIN, _ROUNDS_MAX = 3, 30
_SETTLED_MM = 4e-3  # a fifth of what the best camera errs by (docs/method.md, 2.5)

_POINTS_MAX = 30  # of each kind and feature
# first centres are right within a millimetre, at a fourth of it each; then the steps that are promised
_SHIFTS_MM = np.arange(-0.9, 0.91, 0.225), np.arange(-0.15, 0.16, 0.05)
RADII_REACH_MM = 1.0
"""How far from the radius that is looked for :func:`likeliest_circles` looks; what is farther ends at its edge.

A core may be that much smaller or larger than nominal.
"""
# the same steps as of centres
_RADII_MM = np.arange(-RADII_REACH_MM, RADII_REACH_MM + 0.01, 0.25), np.arange(-0.15, 0.16, 0.05)
_CORE_PERCENTILE = 25.0  # the lower quartile: ribs only ever add to a radius
# half of the finest step; as far as rays that pass a top are looked for; past the end of any table
_TABLE_STEP_MM, _TABLE_REACH_MM, _FAR = 0.025, 6.0, 1_000_000


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
    walls, rims = terms.wall, terms.rim
    wall, wall_information, wall_tells = _steps_alone(
        walls.jacobian, walls.pull, wall_weight, wall_seen, _ONE_SIDED_WALL
    )
    rim, rim_information, rim_tells = _steps_alone(rims.jacobian, rims.pull, rims.knowledge, rim_seen, _ONE_SIDED_RIM)
    for k in np.flatnonzero(wall_tells & rim_tells).tolist():
        apart = wall[k] - rim[k]
        expected = np.linalg.inv(wall_information[k]) + np.linalg.inv(rim_information[k])
        if apart @ np.linalg.solve(expected, apart) > _DISAGREE_CHI2:
            pulled = np.linalg.solve(wall_information[k] + rim_information[k], wall_information[k] @ apart)
            extra[k] = np.outer(pulled, pulled)
    return extra


def _steps_alone(
    jacobian: Array, pull: Array, weight: Array, seen: BoolArray, one_sided: float
) -> tuple[Array, Array, BoolArray]:
    """Step (k, 2) of each centre that one witness alone asks for, its information (k, 2, 2), and whether it tells."""
    across = jacobian[:, :2]
    information = (across * weight[:, None]) @ across.transpose(0, 2, 1)
    low, high = np.linalg.eigvalsh(information).T
    tells = (seen.sum(axis=1) >= _FEW) & (low * one_sided > high)
    step = np.zeros((len(seen), 2))
    gradient = (across @ pull[..., None])[tells]
    step[tells] = -np.linalg.solve(information[tells], gradient)[..., 0]
    return step, information, tells


@dataclass(frozen=True, eq=False)
class CircleEvidence:
    """Points of one kind about each feature: ``xy`` (k, m, 2) mm, which are there, and their law.

    ``side`` is +1 where the points lie outside of the circle, -1 where inside.
    """

    xy: Array
    seen: BoolArray
    law: RimLaw | BracketLaw
    side: float


def likeliest_circles(evidence: list[CircleEvidence], centres: Array, radius_mm: float) -> tuple[Array, float]:
    """Centres (k, 2) and the one radius, mm, of discs near some centres (k, 2), to about 0.05 mm."""
    thin = [_Tabled(part) for part in evidence]
    count = len(centres)
    radii = radius_mm + np.tile(_RADII_MM[0], (count, 1))
    near, own = _likeliest(thin, centres, radii, _SHIFTS_MM[0])
    _, own = _likeliest(thin, near, own[:, None] + _RADII_MM[1], _SHIFTS_MM[1])
    core_mm = float(percentiles(own, _CORE_PERCENTILE))
    radii = np.full((count, 1), core_mm)
    near, _ = _likeliest(thin, centres, radii, _SHIFTS_MM[0])
    return _likeliest(thin, near, radii, _SHIFTS_MM[1])[0], core_mm


class _Tabled:
    """A thinned part of the evidence, and the cost of its law in steps of distance."""

    def __init__(self, evidence: CircleEvidence) -> None:
        self.xy, self.seen = _thinned(evidence.xy, evidence.seen)
        off = np.arange(-_TABLE_REACH_MM, _TABLE_REACH_MM, _TABLE_STEP_MM)
        self._cost = evidence.law.cost(evidence.side * off).astype(np.float32)
        self._cost[-1] = 0.0  # of what is farther away, and of padding

    def costs(self, centres: Array, shifts: Array, radii: Array) -> npt.NDArray[np.float32]:
        """Cost (k, radii, shifts) of circles about ``centres + shifts`` (k, s, 2) with ``radii`` (k, r)."""
        about = (self.xy - centres[:, None]).astype(np.float32)
        moved = shifts.astype(np.float32)
        x = about[:, None, :, 0] - moved[:, None, 0]
        y = about[:, None, :, 1] - moved[:, None, 1]
        steps = (np.sqrt(x * x + y * y) / np.float32(_TABLE_STEP_MM)).astype(np.int32)
        steps[~np.broadcast_to(self.seen[:, None], steps.shape)] = _FAR
        first = np.rint((radii - _TABLE_REACH_MM) / _TABLE_STEP_MM).astype(np.int32)
        answer = np.empty((*radii.shape, len(shifts)), np.float32)
        for place in range(radii.shape[1]):
            cost = np.take(self._cost, steps - first[:, place, None, None], mode="clip")
            answer[:, place] = cost.sum(axis=2)
        return answer


def _likeliest(parts: list[_Tabled], centres: Array, radii: Array, steps_mm: Array) -> tuple[Array, Array]:
    """The most likely centre (k, 2) and radius (k,) on a grid around each centre."""
    shifts = np.stack(np.meshgrid(steps_mm, steps_mm), -1).reshape(-1, 2)
    costs = sum(part.costs(centres, shifts, radii) for part in parts)
    best = np.asarray(costs).reshape(len(centres), -1).argmin(axis=1)
    which, where = np.divmod(best, len(shifts))
    return centres + shifts[where], radii[np.arange(len(centres)), which]


def _thinned(xy: Array, seen: BoolArray) -> tuple[Array, BoolArray]:
    """At most so many points of each feature, evenly taken."""
    rank = np.cumsum(seen, axis=1) - 1
    step = seen.sum(axis=1) // _POINTS_MAX + 1
    chosen = seen & (rank % step[:, None] == 0)
    owner = np.nonzero(chosen)[0]
    return in_rows(xy[chosen], owner, len(xy))


BAR_PRIORS = Priors(
    lean=0.03, own_radius=0.02, own_push=1e-3, push=1e-3, radius=0.06, wall_to_edge=0.02, rim_to_beyond=0.03
)
"""Leans of bars that were bent, too; cores of a group are alike; a side is not pushed; edge and side are one radius."""

_BAR_LEAN_U = 7e-3  # ribs, which stand out on one side here and on the other there: half of one over 60 mm of side
USUAL_LEAN = 5e-3
"""0.3 degrees, as bars and sleeves are cast in; this product's own figure."""
_COMMON_COUNT = 4  # fewer bars have no middle that one of them does not move
_BENT_SHARE = 0.1  # of bars that lean by more than that: bent by hand, or hit


def believed_leans(fit: PooledFit, prior: float) -> tuple[Array, Array]:
    """Leans (k, 2) and covariances (k, 2, 2): what sides show, and that bars of one group stand alike.

    Most bars lean about their median by what is usual, some were bent and lean anyhow. Each is both, by the odds of the
    two: one that leans like the others, as far as its side tells, is drawn to them; one that does not is left as seen;
    between the two it is not known which, and that counts. A side that does not show tells nothing: the odds stay.
    """
    told, weight = _told_by_sides(fit, prior)
    common = median(fit.lean, axis=0) if len(fit.lean) >= _COMMON_COUNT else np.zeros(2)
    off = weight - told @ common
    usual, usual_off, usual_odds = _posterior(told, off, USUAL_LEAN)
    bent, bent_off, bent_odds = _posterior(told, off, BAR_PRIORS.lean)
    odds = np.log(_BENT_SHARE / (1.0 - _BENT_SHARE)) + bent_odds - usual_odds
    share = expit(odds)[:, None]
    apart = bent_off - usual_off
    unsure = (share * (1.0 - share))[..., None] * apart[:, :, None] * apart[:, None, :]
    usual = usual + np.eye(2) * (USUAL_LEAN**2 / max(len(fit.lean), 1))
    lean = common + usual_off + share * apart
    return lean, share[..., None] * bent + (1.0 - share[..., None]) * usual + unsure


def _told_by_sides(fit: PooledFit, prior: float) -> tuple[Array, Array]:
    """Information (k, 2, 2) of what sides show of leans, and that times the leans (k, 2): without the fit's prior."""
    of_prior = np.eye(2) / prior**2
    told = np.linalg.inv(fit.lean_covariance) - of_prior
    values, axes = np.linalg.eigh(told)
    told = (axes * np.maximum(values, 0.0)[:, None, :]) @ axes.transpose(0, 2, 1)
    ribs = np.linalg.inv(np.eye(2) + _BAR_LEAN_U**2 * told)
    weight = np.einsum("kij,kj->ki", told + of_prior, fit.lean)
    return ribs @ told, np.einsum("kij,kj->ki", ribs, weight)


def _posterior(told: Array, off: Array, lean: float) -> tuple[Array, Array, Array]:
    """Covariance (k, 2, 2) and mean (k, 2) of leans with a prior about zero, and its log evidence (k,)."""
    covariance = np.asarray(np.linalg.inv(told + np.eye(2) / lean**2), float)
    mean = np.einsum("kij,kj->ki", covariance, off)
    evidence = 0.5 * (np.einsum("ki,ki->k", off, mean) + np.linalg.slogdet(covariance / lean**2)[1])
    return covariance, mean, evidence
