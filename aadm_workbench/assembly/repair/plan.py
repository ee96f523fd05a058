"""Of all smallest sets of bars to bend the one to advise, with the pose and the bends that go with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from aadm_workbench.assembly.pairs import Pair
from aadm_workbench.assembly.pose.eopa import turn
from aadm_workbench.assembly.repair.case import RepairCase
from aadm_workbench.assembly.repair.places import nearest_in_discs, own_places
from aadm_workbench.assembly.repair.search import FEASIBLE, BarSet, Limits, solve_sets
from aadm_workbench.model import Array

_MOST_SETS = 64  # of one size: the best few are alike, and each takes a search of its own
_REACHED_MM = 1e-6  # a nanometre: rounding


@dataclass(frozen=True, eq=False)
class Bend:
    """A bar's way: ``by`` (2,) mm in the bars' column frame, None where no bend helps; ``least_mm`` would do."""

    pair: int
    by: Array | None
    least_mm: float
    upright: bool

    @property
    def length_mm(self) -> float:
        """Length of the bend; without end where none helps."""
        return float("inf") if self.by is None else float(np.hypot(*self.by))


@dataclass(frozen=True, eq=False)
class RepairPlan:
    """Bends and the pose (radians, (2,) mm) for which they were found.

    ``within_own`` says whether every bar stays near the place that the bars which stay give it, ``ratio`` how much of
    its limit the worst pair of these uses.
    """

    bends: tuple[Bend, ...]
    yaw: float
    shift: Array
    within_own: bool
    ratio: float

    @property
    def longest_mm(self) -> float:
        """Length of the longest bend."""
        return max((bend.length_mm for bend in self.bends), default=0.0)


def choose_plan(
    case: RepairCase, sets: Sequence[BarSet], limits: Sequence[Limits], reach_mm: float | None
) -> RepairPlan:
    """The plan that bends the fewest bars that are right, keeps all bars within their own limits, and bends least.

    The first comes before the second, and that before the third.

    Parameters
    ----------
    sets
        Sets of one size that let the column in.
    limits
        By which they were found.
    reach_mm
        How far a bar may be bent; None for any distance.
    """
    sets = sorted(sets, key=lambda found: (_good(case, found.bent), found.ratio))[:_MOST_SETS]
    plans = [_plan(case, found.bent, found.z, found.ratio, None, reach_mm) for found in sets]
    if case.position_limit_mm is not None and sets[0].bent:
        plans += _within_own_limits(case, sets, limits, reach_mm)
    return min(plans, key=lambda plan: _preference(case, plan))


def _preference(case: RepairCase, plan: RepairPlan) -> tuple[int, bool, float, float]:
    good = _good(case, tuple(bend.pair for bend in plan.bends))
    return good, not plan.within_own, round(plan.longest_mm, 3), plan.ratio


def _good(case: RepairCase, bent: tuple[int, ...]) -> int:
    """How many of these pairs have neither a bar nor a sleeve that stands beyond its own limit."""
    return int((~(case.rebar_fails | case.sleeve_fails))[list(bent)].sum())


def after_repair(case: RepairCase, plan: RepairPlan) -> tuple[Pair, ...]:
    """The pairs once all bends are made."""
    pairs = list(case.pairs)
    for bend in plan.bends:
        if bend.by is not None:
            pair = pairs[bend.pair]
            lean = np.zeros(2) if bend.upright else pair.bar_shift
            pairs[bend.pair] = replace(pair, rebar_xy=pair.rebar_xy + bend.by, bar_shift=lean)
    return tuple(pairs)


def _within_own_limits(
    case: RepairCase, sets: Sequence[BarSet], limits: Sequence[Limits], reach_mm: float | None
) -> list[RepairPlan]:
    """The plans of those sets for which a pose lets every bent bar stand near its own place."""
    limit_mm = case.position_limit_mm or 0.0
    own = [own_places(case.rebars, case.rebar_design, found.bent) for found in sets]
    known = [(found, places) for found, places in zip(sets, own, strict=True) if places is not None]
    if not known:
        return []
    middles = case.sleeves + np.array([place.middle for place in case.places])
    radii = np.array([max(place.radius_mm, 0.0) + limit_mm for place in case.places])
    vectors, turning = (
        np.stack(v)
        for v in zip(*(case.constraints.start.vectors_of(places, middles) for _, places in known), strict=True)
    )
    near_own = Limits(vectors, turning, radii, np.arange(len(case.pairs)), when_bent=True)
    solution = solve_sets([found.bent for found, _ in known], [*limits, near_own], len(case.pairs))
    return [
        _plan(case, found.bent, solution.z[row], float(np.sqrt(solution.ratio_squared[row])), places, reach_mm)
        for row, (found, places) in enumerate(known)
        if solution.ratio_squared[row] <= FEASIBLE
    ]


def _plan(
    case: RepairCase, bent: tuple[int, ...], z: Array, ratio: float, own: Array | None, reach_mm: float | None
) -> RepairPlan:
    yaw, shift = case.constraints.start.pose(z)
    bends = [_bend(case, k, yaw, shift, None if own is None else own[k], reach_mm) for k in bent]
    within_own = own is not None and all(near for _, near in bends)
    return RepairPlan(tuple(bend for bend, _ in bends), yaw, shift, within_own, ratio)


def _bend(
    case: RepairCase, k: int, yaw: float, shift: Array, own: Array | None, reach_mm: float | None
) -> tuple[Bend, bool]:
    """The bend to the middle of the sleeve, or as near to it as the bar's own place and reach allow; whether near."""
    place, pair = case.places[k], case.pairs[k]
    if place.radius_mm <= 0.0:
        return Bend(k, None, 0.0, place.upright), False
    goal = turn(yaw).T @ (pair.sleeve_xy + place.middle - shift)
    discs = [] if reach_mm is None else [(pair.rebar_xy, reach_mm)]
    near = own is not None
    if own is not None:
        wanted = [*discs, (own, case.position_limit_mm or 0.0)]
        target = _nearest(goal, wanted)
        near = all(_distance(target, centre) <= radius + _REACHED_MM for centre, radius in wanted)
        near &= _distance(target, goal) <= place.radius_mm
    if not near:
        target = _nearest(goal, discs)
    least_mm = max(0.0, _distance(pair.rebar_xy, goal) - place.radius_mm)
    return Bend(k, target - pair.rebar_xy, least_mm, place.upright), near


def _nearest(goal: Array, discs: Sequence[tuple[Array, float]]) -> Array:
    return nearest_in_discs(goal, [centre for centre, _ in discs], [radius for _, radius in discs])


def _distance(point: Array, other: Array) -> float:
    return float(np.hypot(*(point - other)))
