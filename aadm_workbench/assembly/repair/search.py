"""The smallest sets of bars whose bending lets a column in.

Where no pose meets all limits, the multipliers of :mod:`aadm_workbench.assembly.pose.smallest_common_disc` name the few
pairs, at most four but for ties, that prove it. Every set that helps must hold one of them, so it is enough to branch
on these: all sets of up to three bars are decided by at most 4 + 16 + 64 small convex problems, and none is missed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from aadm_workbench.assembly.pose.best_pose import PoseConstraints
from aadm_workbench.assembly.pose.smallest_common_disc import DiscSolution, proven_bound, smallest_common_disc
from aadm_workbench.assembly.repair.places import FreePlace
from aadm_workbench.model import Array, BoolArray, IntArray

EXACT_BARS = 3
"""Up to so many bars the smallest set is proven; beyond, the best of a search is given."""

FEASIBLE = 1.0 + 1e-9
"""Squared ratio up to which limits are met: one, and what rounding adds."""

_BEAM = 48  # sets of a size that are followed on: a choice, not tuned since
_OFF = 1e-9  # not zero: with two or three pairs left, the problem must keep its curvature
_SMALLEST_LIMIT_MM = 0.01  # keeps a division where a bar is as wide as its sleeve
_SUPPORT = 1e-4  # of the largest multiplier: what has less holds nothing up, and the bound that is proven says so


@dataclass(frozen=True, eq=False)
class Limits:
    """Limits of discs, (c,) mm, with their vectors (c, 2) or (k, c, 2) for k sets of bars.

    ``owner`` (c,) is the pair that each belongs to; ``when_bent`` whether they hold for bars that are bent, or for
    those that stay. A limit of zero or below is a bar that is wider than its sleeve.
    """

    vectors: Array
    turning: Array
    limits_mm: Array
    owner: IntArray
    when_bent: bool


@dataclass(frozen=True, eq=False)
class BarSet:
    """Bars to bend, by the indices of their pairs, and the pose z = (τ, t_x, t_y) furthest inside all limits."""

    bent: tuple[int, ...]
    z: Array
    ratio: float


def of_bars_that_stay(constraints: PoseConstraints) -> Limits:
    """The limits of pairs whose bars are not bent."""
    return Limits(constraints.vectors, constraints.turning, constraints.limits_mm, constraints.owner, False)


def within_reach(
    constraints: PoseConstraints, rebars_xy: Array, sleeves_xy: Array, places: Sequence[FreePlace], reach_mm: float
) -> Limits:
    """The limits of bars that are bent, (n, 2) mm before that, by not more than ``reach_mm``."""
    middles = sleeves_xy + np.array([place.middle for place in places])
    p, q = constraints.start.vectors_of(rebars_xy, middles)
    radii = np.array([max(place.radius_mm, 0.0) + reach_mm for place in places])
    return Limits(p, q, radii, np.arange(len(places)), True)


def solve_sets(sets: Sequence[tuple[int, ...]], limits: Sequence[Limits], pairs: int) -> DiscSolution:
    """The best pose for each of k sets of bars to bend, of so many ``pairs``."""
    return _stacked(sets, limits, pairs).solved()


def smallest_sets(limits: Sequence[Limits], pairs: int, among: BoolArray) -> tuple[list[BarSet], bool]:
    """All sets of the smallest size that let the column in, and whether no smaller set does.

    Beyond :data:`EXACT_BARS` bars a beam of the best sets is followed, and what it finds is returned as not exact;
    nothing where not even all bars together help.

    Parameters
    ----------
    among
        (pairs,): which bars may be bent.
    """
    everything = tuple(np.flatnonzero(among).tolist())
    hopeless = {int(owner) for limit in limits for owner in limit.owner[limit.limits_mm <= 0.0]}
    if not hopeless <= set(everything):
        return [], True
    restricted = len(limits) > 1 or len(everything) < pairs
    if restricted and solve_sets([everything], limits, pairs).ratio_squared[0] > FEASIBLE:
        return [], True
    level = [tuple(sorted(hopeless))]
    for size in range(len(hopeless), pairs + 1):
        stack = _stacked(level, limits, pairs)
        solution = stack.solved()
        found = [_set(bent, solution, row) for row, bent in enumerate(level) if _feasible(solution, row)]
        if found:
            return (found, True) if size <= EXACT_BARS else ([_without_idle(found[0], limits, pairs)], False)
        order = np.argsort(solution.ratio_squared, kind="stable")
        kept = order if size < EXACT_BARS else order[:_BEAM]
        level = _branch(stack, solution, kept, among)
        if not level:
            return [], size < EXACT_BARS
    return [], False


@dataclass(frozen=True, eq=False)
class _Stack:
    """k problems of c limits each; ``active`` (k, c) says which of them hold."""

    sets: tuple[tuple[int, ...], ...]
    p: Array
    q: Array
    weights: Array
    active: BoolArray
    owner: IntArray
    of_staying: BoolArray

    def solved(self) -> DiscSolution:
        return smallest_common_disc(self.p, self.q, self.weights)


def _stacked(sets: Sequence[tuple[int, ...]], limits: Sequence[Limits], pairs: int) -> _Stack:
    bent = np.zeros((len(sets), pairs), dtype=bool)
    for row, members in enumerate(sets):
        bent[row, list(members)] = True
    owner = np.concatenate([limit.owner for limit in limits])
    when_bent = np.concatenate([np.full(len(limit.owner), limit.when_bent) for limit in limits])
    active = bent[:, owner] == when_bent
    p, q = (
        np.concatenate([np.broadcast_to(v, (len(sets), *v.shape[-2:])) for v in vectors], axis=1)
        for vectors in ([limit.vectors for limit in limits], [limit.turning for limit in limits])
    )
    limits_mm = np.maximum(np.concatenate([limit.limits_mm for limit in limits]), _SMALLEST_LIMIT_MM)
    weights = np.where(active, 1.0, _OFF) / limits_mm**2
    return _Stack(tuple(sets), p, q, weights, active, owner, ~when_bent)


def _feasible(solution: DiscSolution, row: int) -> bool:
    return bool(solution.ratio_squared[row] <= FEASIBLE)


def _set(bent: tuple[int, ...], solution: DiscSolution, row: int) -> BarSet:
    return BarSet(bent, solution.z[row], float(np.sqrt(solution.ratio_squared[row])))


def _without_idle(best: BarSet, limits: Sequence[Limits], pairs: int) -> BarSet:
    """A set that was found, without bars that the others make needless."""
    while True:
        fewer = [tuple(k for k in best.bent if k != left_out) for left_out in best.bent]
        solution = solve_sets(fewer, limits, pairs)
        row = int(np.argmin(solution.ratio_squared))
        if not _feasible(solution, row):
            return best
        best = _set(fewer[row], solution, row)


def _branch(stack: _Stack, solution: DiscSolution, rows: IntArray, among: BoolArray) -> list[tuple[int, ...]]:
    """The sets with one more bar, each of those that prove why the set without it does not help and may be bent."""
    grown: dict[tuple[int, ...], None] = {}
    for row in rows.tolist():
        proof = _proof(stack, solution.multipliers[row], row) & stack.of_staying
        for bar in np.unique(stack.owner[proof & among[stack.owner]]).tolist():
            grown[tuple(sorted((*stack.sets[row], bar)))] = None
    return list(grown)


def _proof(stack: _Stack, multipliers: Array, row: int) -> BoolArray:
    """Which active limits (c,) prove that there is no pose; all of them where rounding leaves no shorter proof."""
    active = stack.active[row]
    few = active & (multipliers > _SUPPORT * float(multipliers[active].max()))
    one = slice(row, row + 1)
    bound = proven_bound(stack.p[one], stack.q[one], stack.weights[one], np.where(few, multipliers, 0.0)[None])
    return np.asarray(few if float(bound[0]) > FEASIBLE else active)
